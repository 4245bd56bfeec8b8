// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The same ray in another space. Its direction is not made unit length, so t means the same in both.
template <std::floating_point T>
[[nodiscard]] Ray<T> transform(const Affine<T>& affine, const Ray<T>& ray) noexcept {
  return {affine.point(ray.origin), affine.vector(ray.direction), ray.t_min, ray.t_max, ray.time, ray.mask};
}

namespace detail {

/// Grows the interval that one row of a map makes of a box by the row's term in one coordinate. A zero coefficient
/// makes nothing of an infinite coordinate.
template <std::floating_point T>
void add_term(T coefficient, T lower, T upper, T& sum_lower, T& sum_upper) noexcept {
  if (coefficient == T(0)) return;
  const T a = coefficient * lower;
  const T b = coefficient * upper;
  sum_lower += std::min(a, b);
  sum_upper += std::max(a, b);
}

}  // namespace detail

/// The smallest box around the image of a box, up to rounding; an empty box stays empty.
///
/// Source: Arvo, "Transforming Axis-Aligned Bounding Boxes", Graphics Gems (1990).
template <std::floating_point T>
[[nodiscard]] Aabb<T> transform(const Affine<T>& affine, const Aabb<T>& box) noexcept {
  if (is_empty(box)) return {};
  Aabb<T> result{Vec3<T>(T(0)), Vec3<T>(T(0))};
  const auto add_axis = [&](const Vec3<T>& column, T lower, T upper) {
    detail::add_term(column.x, lower, upper, result.lower.x, result.upper.x);
    detail::add_term(column.y, lower, upper, result.lower.y, result.upper.y);
    detail::add_term(column.z, lower, upper, result.lower.z, result.upper.z);
  };
  add_axis(affine.linear[0], box.lower.x, box.upper.x);
  add_axis(affine.linear[1], box.lower.y, box.upper.y);
  add_axis(affine.linear[2], box.lower.z, box.upper.z);
  return {result.lower + affine.translation, result.upper + affine.translation};
}

/// A surface point carried along: its error bound grows by what the map rounds; an unknown error stays unknown.
///
/// Requires: `to_local` is the inverse of `to_world`.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> transform(const Affine<T>& to_world, const Affine<T>& to_local,
                                     const SurfaceOf<T>& local) noexcept {
  const Mat3<T> magnitude{abs(Vec3<T>(to_world.linear[0])), abs(Vec3<T>(to_world.linear[1])),
                          abs(Vec3<T>(to_world.linear[2]))};
  const Vec3<T> rounded = magnitude * abs(local.position) + abs(to_world.translation);
  const Vec3<T> carried = magnitude * local.position_error * (T(1) + rounding_bound<T>(4));
  const bool known = local.position_error != Vec3<T>(T(0));
  return {.position = to_world.point(local.position),
          .position_error = known ? carried + rounded * rounding_bound<T>(5) : Vec3<T>(T(0)),
          .normal = transform_normal(to_local, local.normal),
          .shading_normal = transform_normal(to_local, local.shading_normal),
          .tangent = to_world.vector(local.tangent),
          .bitangent = to_world.vector(local.bitangent),
          .uv = local.uv};
}

}  // namespace glint
