// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <limits>

#include <glm/geometric.hpp>

#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

namespace detail {

/// A point on the side of the normal that `direction` points to, just beyond the reach of the position's error.
template <std::floating_point T>
[[nodiscard]] Vec3<T> offset_origin(const Vec3<T>& position, const Vec3<T>& error, const Vec3<T>& normal,
                                    const Vec3<T>& direction) noexcept {
  const Vec3<T> last_place = abs(position) * std::numeric_limits<T>::epsilon();
  const T reach = glm::dot(abs(normal), error + last_place) * (T(1) + rounding_bound<T>(16));
  return position + normal * (glm::dot(direction, normal) < T(0) ? -reach : reach);
}

}  // namespace detail

/// A point to start a ray in `direction` from: off the surface, on the side of the geometric normal that `direction`
/// points to, just beyond the reach of the position's error. No tunable epsilon: it scales with the scene.
///
/// The last place of the position is counted in as an error, which pays for rounding the result without a search for
/// the next representable number; a few roundings more pay for the sums and for a normal that is not quite unit.
///
/// Requires: `position_error` bounds the error of the position.
/// Ensures:  no point of the box position ± position_error is on that side of the plane through the result.
/// Source:   Pharr, Jakob, Humphreys, Physically Based Rendering (2023), section 6.8.6.
template <std::floating_point T>
[[nodiscard]] Vec3<T> offset_origin(const SurfaceOf<T>& at, const Vec3<T>& direction) noexcept {
  return detail::offset_origin(at.position, at.position_error, at.normal, direction);
}

/// A ray that leaves a surface and does not meet the place it left.
template <std::floating_point T>
[[nodiscard]] Ray<T> spawn_ray(const SurfaceOf<T>& at, const Vec3<T>& direction) noexcept {
  return {.origin = offset_origin(at, direction), .direction = direction};
}

/// The ray from a surface to a point, which is at t = 1; it ends a few roundings before it, so that a surface the
/// point lies on is met by no more than grazing rays. For points on a surface that is known, pass the surface.
template <std::floating_point T>
[[nodiscard]] Ray<T> spawn_ray_to(const SurfaceOf<T>& at, const Vec3<T>& target) noexcept {
  const Vec3<T> origin = offset_origin(at, target - at.position);
  return {.origin = origin, .direction = target - origin, .t_max = T(1) - rounding_bound<T>(16)};
}

/// A point off a surface, on the side of its geometric normal that `viewer` is on, where a ray from there may end
/// without meeting the surface: moved out further than the position's error, by what an intersector loses when it looks
/// from that far away.
template <std::floating_point T>
[[nodiscard]] Vec3<T> offset_toward(const SurfaceOf<T>& at, const Vec3<T>& viewer) noexcept {
  const Vec3<T> away = viewer - at.position;
  const Vec3<T> seen_from_afar(rounding_bound<T>(16) * max_component(abs(away)));
  return detail::offset_origin(at.position, at.position_error + seen_from_afar, at.normal, away);
}

/// The ray from one surface to another: both ends are off their surfaces, so that neither hides the other.
template <std::floating_point T>
[[nodiscard]] Ray<T> spawn_ray_to(const SurfaceOf<T>& at, const SurfaceOf<T>& target) noexcept {
  const Vec3<T> origin = offset_origin(at, target.position - at.position);
  return {.origin = origin, .direction = offset_toward(target, at.position) - origin, .t_max = one_minus_epsilon<T>};
}

}  // namespace glint
