// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/cone.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/interval.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The surface of all points whose distance from a segment is `radius`: a cylinder with half a sphere at either end.
/// Where start and end are one point it is a sphere.
///
/// Parametrization: uv = (φ/2π, fraction of the way from pole to pole over the surface), φ from the x toward the y of
///                  Frame::around(end − start).
///
/// Requires: radius ≥ 0; a capsule of radius 0 is never hit.
template <std::floating_point T>
struct Capsule {
  Vec3<T> start{T(0)};
  Vec3<T> end{T(0), T(0), T(1)};
  T radius = 1;

  [[nodiscard]] friend bool operator==(const Capsule&, const Capsule&) noexcept = default;
};

template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const Capsule<T>& capsule) noexcept {
  return {glm::min(capsule.start, capsule.end) - capsule.radius, glm::max(capsule.start, capsule.end) + capsule.radius};
}

namespace detail {

/// A capsule's axis: along z of a frame, from the origin to `height`.
template <std::floating_point T>
struct CapsuleAxis {
  Frame<T> frame;
  T height;

  explicit CapsuleAxis(const Capsule<T>& capsule) noexcept {
    const Vec3<T> axis = capsule.end - capsule.start;
    height = std::sqrt(length_squared(axis));
    if (height > T(0)) frame = Frame<T>::around(axis * (T(1) / height));
  }
};

/// Where a line is inside a sphere around the origin; the middle of the chord where rounding makes it miss.
template <std::floating_point T>
[[nodiscard]] Interval<T> inside_sphere(const Vec3<T>& o, const Vec3<T>& d, T radius) noexcept {
  const T a = length_squared(d);
  const T middle = -glm::dot(o, d) / a;
  const T half_chord_squared = radius * radius - length_squared(o + d * middle);
  const T half = std::sqrt(std::max(half_chord_squared, T(0)) / a);
  return {middle - half, middle + half};
}

/// Where a line is inside a capsule along z: between the crossings of the endless cylinder, or where these are beyond
/// an end, of the sphere there. A line that misses that sphere misses the capsule.
template <std::floating_point T>
[[nodiscard]] Interval<T> inside_capsule(const Vec3<T>& o, const Vec3<T>& d, T radius, T height) noexcept {
  const Interval<T> tube = inside_cone(o, d, radius, T(0));
  if (is_empty(tube)) return {};
  const T enter_z = o.z + d.z * tube.lower;
  const T leave_z = o.z + d.z * tube.upper;
  const auto is_beside = [&](T z) { return z >= T(0) && z <= height; };
  if (is_beside(enter_z) && is_beside(leave_z)) return tube;

  const auto sphere_at = [&](T z) { return Vec3<T>(o.x, o.y, o.z - (z > T(0) ? height : T(0))); };
  const auto is_missed = [&](T z) {
    return length_squared(glm::cross(sphere_at(z), d)) > radius * radius * length_squared(d);
  };
  if ((enter_z < T(0) && leave_z < T(0)) || (enter_z > height && leave_z > height)) {
    if (is_missed(enter_z)) return {};
  }
  return {is_beside(enter_z) ? tube.lower : inside_sphere(sphere_at(enter_z), d, radius).lower,
          is_beside(leave_z) ? tube.upper : inside_sphere(sphere_at(leave_z), d, radius).upper};
}

}  // namespace detail

/// The first crossing of a capsule within the ray's interval, from outside or from inside.
///
/// The ray is first moved to where it passes the capsule's middle, so that its distance costs no more than the rounding
/// of its own origin.
///
/// Errors:  a NaN, a zero direction, or a capsule without radius reports no hit. Squares of sizes, distances and
///          |direction| must be in T's range.
/// Source:  Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems
///          (2019), ch. 7, for the move and for the spheres.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Capsule<T>& capsule) noexcept {
  if (!(capsule.radius > T(0))) return std::nullopt;
  const detail::CapsuleAxis<T> axis(capsule);
  const Vec3<T> from_start = ray.origin - capsule.start;
  const Vec3<T> to_middle = (capsule.end - capsule.start) * T(0.5) - from_start;
  const T shift = glm::dot(to_middle, ray.direction) / length_squared(ray.direction);
  const Vec3<T> o = axis.frame.to_local(from_start + ray.direction * shift);
  const Vec3<T> d = axis.frame.to_local(ray.direction);
  const Interval<T> inside = detail::inside_capsule(o, d, capsule.radius, axis.height);
  if (is_empty(inside)) return std::nullopt;
  for (const T local_t : {inside.lower, inside.upper}) {
    const T t = shift + local_t;
    if (t >= ray.t_min && t <= ray.t_max && std::abs(t) < infinity<T>) return Hit<T>{.t = t};
  }
  return std::nullopt;
}

namespace detail {

/// The surface that a unit normal, given in the axis' frame, points to from the point of the axis at z.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> capsule_surface(const Capsule<T>& capsule, const CapsuleAxis<T>& axis, T z,
                                           const Vec3<T>& local_normal) noexcept {
  const T radius = capsule.radius;
  const Frame<T>& frame = axis.frame;
  const Vec3<T> normal = glm::normalize(frame.to_world(local_normal));
  const Vec3<T> position = capsule.start + (frame.z * z + normal * radius);
  const T off = (axis.height + radius) * rounding_bound<T>(24) + max_component(abs(position)) * rounding_bound<T>(2);
  const T arc = radius * std::acos(std::clamp(-local_normal.z, T(-1), T(1)));  // along both half spheres
  const Vec3<T> around = frame.y * local_normal.x - frame.x * local_normal.y;
  const T squared_sine = length_squared(around);
  const T profile = pi<T> * radius + axis.height;
  const T to_profile = squared_sine > T(0) ? profile / std::sqrt(squared_sine) : T(0);
  return {.position = position,
          .position_error = Vec3<T>(off),
          .normal = normal,
          .shading_normal = normal,
          .tangent = around * (T(2) * pi<T> * radius),
          .bitangent = glm::cross(normal, around) * to_profile,
          .uv = {turns_of(local_normal.x, local_normal.y), (arc + z) / profile}};
}

}  // namespace detail

/// The surface at the point of the capsule nearest to `position`.
///
/// Ensures: `position_error` bounds the distance to the capsule, alike on all axes.
/// Errors:  for a position that rounding has put onto the axis: the surface at the frame's x.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const Capsule<T>& capsule, const Vec3<T>& position) noexcept {
  const detail::CapsuleAxis<T> axis(capsule);
  const Vec3<T> local = axis.frame.to_local(position - capsule.start);
  const T z = std::clamp(local.z, T(0), axis.height);
  const Vec3<T> outward{local.x, local.y, local.z - z};
  const T squared = length_squared(outward);
  const Vec3<T> normal = squared > T(0) ? outward * (T(1) / std::sqrt(squared)) : Vec3<T>(T(1), T(0), T(0));
  return detail::capsule_surface(capsule, axis, z, normal);
}

template <std::floating_point T>
[[nodiscard]] T area(const Capsule<T>& capsule) noexcept {
  return T(2) * pi<T> * capsule.radius * (glm::length(capsule.end - capsule.start) + T(2) * capsule.radius);
}

/// A point uniform by area, from a uniform point of the unit square: u.x is how far along the axis it lies between the
/// poles.
///
/// Source: Archimedes: slices of equal thickness have equal area, on spheres and on cylinders.
template <std::floating_point T>
[[nodiscard]] AreaSample<T> sample_area(const Capsule<T>& capsule, const Vec2<T>& u) noexcept {
  const detail::CapsuleAxis<T> axis(capsule);
  const T radius = capsule.radius;
  const T along = u.x * (axis.height + T(2) * radius) - radius;
  const T z = std::clamp(along, T(0), axis.height);
  const T cosine = std::clamp((along - z) / radius, T(-1), T(1));
  const T sine = std::sqrt((T(1) - cosine) * (T(1) + cosine));
  const T phi = T(2) * pi<T> * u.y;
  const Vec3<T> normal{sine * std::cos(phi), sine * std::sin(phi), cosine};
  return {detail::capsule_surface(capsule, axis, z, normal), T(1) / area(capsule)};
}

/// The point of the capsule closest to `point`, from outside or from inside.
template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, const Capsule<T>& capsule) noexcept {
  return surface(capsule, point).position;
}

}  // namespace glint
