// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glint/geometry/concepts.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>

namespace glint::testing {

/// What a primitive's closest points get wrong, against points all over its surface: none of them may be closer, and
/// one of them must be near the closest point, or that is not on the surface.
///
/// Requires: a primitive about as large as one, near the origin.
template <SampleablePrimitive P>
[[nodiscard]] std::vector<std::string> violations_of_closest_points(const P& primitive) {
  using T = ScalarOf<P>;
  Random random(17);
  std::vector<Vec3<T>> surface;
  for (int i = 0; i < 4000; ++i) {
    const Vec3<T> u = random.uniform_vec3<T>();
    surface.push_back(sample_area(primitive, Vec2<T>{u.x, u.y}).surface.position);
  }
  std::vector<std::string> violations;
  for (int i = 0; i < 60; ++i) {
    const Vec3<T> point = random.uniform_vec3<T>() * T(6) - T(3);
    const Vec3<T> closest = closest_point(point, primitive);
    const T distance = std::sqrt(length_squared(closest - point));
    T least = std::numeric_limits<T>::max();
    T gap = std::numeric_limits<T>::max();
    for (const Vec3<T>& s : surface) {
      least = std::min(least, std::sqrt(length_squared(s - point)));
      gap = std::min(gap, std::sqrt(length_squared(s - closest)));
    }
    if (least < distance - T(1e-5)) violations.push_back("a point of the surface is closer, case " + std::to_string(i));
    if (!(gap < T(0.2))) violations.push_back("the closest point is not on the surface, case " + std::to_string(i));
  }
  return violations;
}

/// How far a triangle is, by another way than ours. Points that are the same part of the way from v0 to v1 are a
/// segment; the distance to these segments falls and then rises, as it is convex in the weights.
template <std::floating_point T>
[[nodiscard]] long double distance_by_slices(const Vec3<T>& point, const Triangle<T>& triangle) {
  using Exact = Vec3<long double>;
  const Exact from(point);
  const Exact a(triangle.v0);
  const Exact ab = Exact(triangle.v1) - a;
  const Exact ac = Exact(triangle.v2) - a;
  const auto slice = [&](long double part) {
    const Exact start = a + ab * part;
    return std::sqrt(length_squared(closest_on_segment(from, start, start + ac * (1 - part)) - from));
  };
  long double low = 0;
  long double high = 1;
  for (int i = 0; i < 120; ++i) {  // (2/3)^120 < 2^-64
    const long double third = (high - low) / 3;
    if (slice(low + third) < slice(high - third))
      high -= third;
    else
      low += third;
  }
  return slice((low + high) / 2);
}

template <std::floating_point T>
struct PointOverSliver {
  Vec3<T> point;
  Triangle<T> triangle;
};

/// Triangles about as large as one, from as high as long to a ten-millionth of that, the tip above any place of the
/// base and beyond its ends; and points over them and beside, from as far as they are large to a hundred-thousandth.
template <std::floating_point T>
[[nodiscard]] std::vector<PointOverSliver<T>> points_over_slivers(int count) {
  Random random(29);
  const auto anywhere = [&] { return random.uniform_vec3<T>() * T(2) - T(1); };
  std::vector<PointOverSliver<T>> all;
  for (int i = 0; i < count; ++i) {
    const T height = std::pow(T(10), T(-(i % 8)));
    const T off = std::pow(T(10), T(-(i / 8 % 6)));
    const Vec3<T> a = anywhere();
    const Vec3<T> b = anywhere();
    const Vec3<T> c = a + (b - a) * (T(1.5) * random.uniform<T>() - T(0.25)) + anywhere() * height;
    const T w1 = random.uniform<T>();
    const T w2 = random.uniform<T>();
    const Vec3<T> point = a + (b - a) * w1 + (c - a) * w2 + anywhere() * off;
    all.push_back({point, i % 3 == 0   ? Triangle<T>{a, b, c}
                          : i % 3 == 1 ? Triangle<T>{c, a, b}
                                       : Triangle<T>{b, c, a}});
  }
  return all;
}

}  // namespace glint::testing
