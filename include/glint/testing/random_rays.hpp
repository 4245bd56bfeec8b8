// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>

/// Rays made by rule, for tests and benchmarks. Equal arguments give equal rays.
namespace glint::testing {

namespace detail {

/// Uniform in direction, unit length. Source: Marsaglia, "Choosing a Point from the Surface of a Sphere" (1972).
template <std::floating_point T>
[[nodiscard]] Vec3<T> random_unit_vector(Random& random) {
  for (;;) {
    const T x = random.uniform(T(-1), T(1));
    const T y = random.uniform(T(-1), T(1));
    const T s = x * x + y * y;
    if (s >= T(1)) continue;
    const T r = T(2) * std::sqrt(T(1) - s);
    return {x * r, y * r, T(1) - T(2) * s};
  }
}

template <std::floating_point T, typename MakeRay>
[[nodiscard]] std::vector<Ray<T>> rays_by(std::size_t count, std::uint64_t seed, MakeRay make_ray) {
  Random random(seed);
  std::vector<Ray<T>> rays;
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) rays.push_back(make_ray(random));
  return rays;
}

template <std::floating_point T>
[[nodiscard]] Vec3<T> random_point(const Aabb<T>& box, Random& random) {
  return box.lower + extent(box) * random.uniform_vec3<T>();
}

template <std::floating_point T>
void set_component(Vec3<T>& v, std::uint32_t axis, T value) {
  (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
}

}  // namespace detail

/// From points within the box in all directions: what bounces look like.
template <std::floating_point T>
[[nodiscard]] std::vector<Ray<T>> rays_within(const Aabb<T>& box, std::size_t count, std::uint64_t seed) {
  return detail::rays_by<T>(count, seed, [&](Random& random) {
    const Vec3<T> origin = detail::random_point(box, random);
    return Ray<T>{origin, detail::random_unit_vector<T>(random)};
  });
}

/// From all around toward points in the box; directions of many lengths.
template <std::floating_point T>
[[nodiscard]] std::vector<Ray<T>> rays_into(const Aabb<T>& box, std::size_t count, std::uint64_t seed) {
  return detail::rays_by<T>(count, seed, [&](Random& random) {
    const Vec3<T> target = detail::random_point(box, random);
    const Vec3<T> origin = centroid(box) + detail::random_unit_vector<T>(random) * glm::length(extent(box));
    return Ray<T>{origin, (target - origin) * random.uniform(T(0.1), T(2))};
  });
}

/// From a face of the box along the axis it is across: two components of the direction are zeros of either sign.
template <std::floating_point T>
[[nodiscard]] std::vector<Ray<T>> axis_aligned_rays(const Aabb<T>& box, std::size_t count, std::uint64_t seed) {
  return detail::rays_by<T>(count, seed, [&](Random& random) {
    const std::uint32_t axis = random.below(3);
    const bool down = random.below(2) == 0;
    Ray<T> ray{detail::random_point(box, random), Vec3<T>(random.below(2) == 0 ? T(0) : T(-0.0))};
    detail::set_component(ray.origin, axis, component(down ? box.upper : box.lower, static_cast<int>(axis)));
    detail::set_component(ray.direction, axis, down ? T(-1) : T(1));
    return ray;
  });
}

/// In the planes of the box's faces, where slab tests meet 0 · ∞: the origin is in the plane and the direction's
/// component across it is a zero of either sign.
template <std::floating_point T>
[[nodiscard]] std::vector<Ray<T>> rays_in_face_planes(const Aabb<T>& box, std::size_t count, std::uint64_t seed) {
  return detail::rays_by<T>(count, seed, [&](Random& random) {
    const std::uint32_t axis = random.below(3);
    const Vec3<T>& corner = random.below(2) == 0 ? box.upper : box.lower;
    Ray<T> ray{detail::random_point(box, random), detail::random_unit_vector<T>(random)};
    detail::set_component(ray.origin, axis, component(corner, static_cast<int>(axis)));
    detail::set_component(ray.direction, axis, random.below(2) == 0 ? T(0) : T(-0.0));
    return ray;
  });
}

}  // namespace glint::testing
