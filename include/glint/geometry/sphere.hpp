// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A sphere: the surface, not the ball. Its outer side is away from the center.
///
/// Parametrization: uv = (θ/π, φ/2π), θ from +z, φ from +x toward +y in [0, 2π).
///
/// Units:    scene units.
/// Requires: radius ≥ 0; a sphere of radius 0 is never hit.
template <std::floating_point T>
struct Sphere {
  Vec3<T> center{T(0)};
  T radius = 1;

  [[nodiscard]] friend bool operator==(const Sphere&, const Sphere&) noexcept = default;
};

template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const Sphere<T>& sphere) noexcept {
  return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

/// The first crossing of a sphere within the ray's interval, from outside or from inside.
///
/// The discriminant of school, b² − ac, cancels where the sphere is small and far away. The gap between the center
/// and the line does not, so t is right within a few roundings, except where the ray grazes.
///
/// Units:    t in multiples of |direction|.
/// Ensures:  t_min ≤ t ≤ t_max.
/// Errors:   a NaN or a zero direction reports no hit. Squares of radius, distance and |direction| must be in T's
///           range.
/// Source:   Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems
///           (2019), ch. 7.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Sphere<T>& sphere) noexcept {
  const Vec3<T> from_center = ray.origin - sphere.center;
  const T a = length_squared(ray.direction);
  const T b = -glm::dot(from_center, ray.direction);
  const T inv_a = T(1) / a;
  const T radius_squared = sphere.radius * sphere.radius;
  const T half_chord_squared = radius_squared - length_squared(from_center + ray.direction * (b * inv_a));
  const T c = length_squared(from_center) - radius_squared;
  if (!(half_chord_squared >= T(0) && sphere.radius > T(0) && c < infinity<T>)) return std::nullopt;

  const T root = std::sqrt(a * half_chord_squared);
  const T q = b > T(0) ? b + root : b - root;  // equal signs do not cancel
  const T one = q * inv_a;
  const T other = c / q;  // NaN where both are 0: min and max then keep the first
  const T near = std::min(one, other);
  const T far = std::max(one, other);
  if (near >= ray.t_min && near <= ray.t_max) return Hit<T>{.t = near};
  if (far >= ray.t_min && far <= ray.t_max) return Hit<T>{.t = far};
  return std::nullopt;
}

namespace detail {

/// The parameters of the point with this normal.
template <std::floating_point T>
[[nodiscard]] Vec2<T> sphere_uv(const Vec3<T>& normal) noexcept {
  const T theta = std::acos(std::clamp(normal.z, T(-1), T(1)));
  const T turns = std::atan2(normal.y, normal.x) * (inv_pi<T> / T(2));
  return {theta * inv_pi<T>, turns < T(0) ? std::min(turns + T(1), one_minus_epsilon<T>) : turns};
}

/// The surface at center + outward, |outward| = radius.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> sphere_surface(const Sphere<T>& sphere, const Vec3<T>& normal, const Vec2<T>& uv) noexcept {
  const Vec3<T> outward = normal * sphere.radius;
  const Vec3<T> position = sphere.center + outward;
  const T sin_theta = std::sqrt(normal.x * normal.x + normal.y * normal.y);
  const T inv_sin = T(1) / sin_theta;
  const T cos_phi = sin_theta > T(0) ? normal.x * inv_sin : T(1);
  const T sin_phi = sin_theta > T(0) ? normal.y * inv_sin : T(0);
  return {.position = position,
          .position_error = abs(outward) * rounding_bound<T>(7) + abs(position) * rounding_bound<T>(2),
          .normal = normal,
          .shading_normal = normal,
          .tangent = Vec3<T>(normal.z * cos_phi, normal.z * sin_phi, -sin_theta) * (pi<T> * sphere.radius),
          .bitangent = Vec3<T>(-outward.y, outward.x, T(0)) * (T(2) * pi<T>),
          .uv = uv};
}

}  // namespace detail

/// The surface at the point of the sphere nearest to `position`.
///
/// Ensures: `position_error` bounds the distance to the sphere, per axis.
/// Errors:  for a position that rounding has put into the center: the surface at +z.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const Sphere<T>& sphere, const Vec3<T>& position) noexcept {
  const Vec3<T> outward = position - sphere.center;
  const T squared = length_squared(outward);
  const Vec3<T> normal = squared > T(0) ? outward * (T(1) / std::sqrt(squared)) : Vec3<T>(T(0), T(0), T(1));
  return detail::sphere_surface(sphere, normal, detail::sphere_uv(normal));
}

template <std::floating_point T>
[[nodiscard]] T area(const Sphere<T>& sphere) noexcept {
  return T(4) * pi<T> * sphere.radius * sphere.radius;
}

/// A point uniform by area, from a uniform point of the unit square.
///
/// Source: Archimedes: slices of equal thickness have equal area.
template <std::floating_point T>
[[nodiscard]] AreaSample<T> sample_area(const Sphere<T>& sphere, const Vec2<T>& u) noexcept {
  const T cos_theta = T(1) - T(2) * u.x;
  const T sin_theta = T(2) * std::sqrt(u.x * (T(1) - u.x));
  const T phi = T(2) * pi<T> * u.y;
  const Vec3<T> normal{sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
  return {detail::sphere_surface(sphere, normal, {std::acos(cos_theta) * inv_pi<T>, u.y}), T(1) / area(sphere)};
}

/// The point of the sphere closest to `point`; of its center, the one along x.
template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, const Sphere<T>& sphere) noexcept {
  const Vec3<T> outward = point - sphere.center;
  const T distance = std::sqrt(length_squared(outward));
  if (!(distance > T(0))) return sphere.center + Vec3<T>(sphere.radius, T(0), T(0));
  return sphere.center + outward * (sphere.radius / distance);
}

}  // namespace glint
