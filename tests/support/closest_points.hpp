// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glint/geometry/concepts.hpp>
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

}  // namespace glint::testing
