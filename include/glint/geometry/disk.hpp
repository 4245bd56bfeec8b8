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
#include <glint/math/frame.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A flat disk. Both sides are hit; the outer side is the one that `normal` points to.
///
/// Parametrization: uv = (distance from the center / radius, φ/2π), φ from the x toward the y of Frame::around(normal).
///
/// Requires: normal ≠ 0, of any length; radius ≥ 0. A disk of radius 0 is never hit.
template <std::floating_point T>
struct Disk {
  Vec3<T> center{T(0)};
  Vec3<T> normal{T(0), T(0), T(1)};
  T radius = 1;

  [[nodiscard]] friend bool operator==(const Disk&, const Disk&) noexcept = default;
};

/// The smallest box: the rim reaches radius · sin of the angle between an axis and the normal along that axis.
template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const Disk<T>& disk) noexcept {
  const Vec3<T> n = disk.normal * disk.normal;
  const T scale = disk.radius / std::sqrt(n.x + n.y + n.z);
  const Vec3<T> reach{scale * std::sqrt(n.y + n.z), scale * std::sqrt(n.z + n.x), scale * std::sqrt(n.x + n.y)};
  return {disk.center - reach, disk.center + reach};
}

/// The crossing of a disk, rim included.
///
/// Errors: no hit for a ray in the disk's plane, a disk without area or normal, or a NaN.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Disk<T>& disk) noexcept {
  const T speed = glm::dot(disk.normal, ray.direction);
  const Vec3<T> from_center = ray.origin - disk.center;
  const T t = -glm::dot(disk.normal, from_center) / speed;
  if (!(t >= ray.t_min && t <= ray.t_max && std::abs(speed) < infinity<T>)) return std::nullopt;
  const T squared = length_squared(from_center + ray.direction * t);
  if (!(squared <= disk.radius * disk.radius && disk.radius > T(0))) return std::nullopt;
  return Hit<T>{.t = t};
}

namespace detail {

/// The surface at center + local, where `off_disk` bounds how far rounding may have put `local` off the disk.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> disk_surface(const Disk<T>& disk, const Frame<T>& frame, const Vec3<T>& local, T off_disk,
                                        const Vec2<T>& uv) noexcept {
  const T distance = glm::length(local);
  const Vec3<T> position = disk.center + local;
  return {.position = position,
          .position_error = Vec3<T>(off_disk + max_component(abs(position)) * rounding_bound<T>(2)),
          .normal = frame.z,
          .shading_normal = frame.z,
          .tangent = distance > T(0) ? local * (disk.radius / distance) : frame.x * disk.radius,
          .bitangent = glm::cross(frame.z, local) * (T(2) * pi<T>),
          .uv = uv};
}

}  // namespace detail

/// The surface at the point of the disk nearest to `position`.
///
/// Ensures: `position_error` bounds the distance to the disk, alike on all axes.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const Disk<T>& disk, const Vec3<T>& position) noexcept {
  const Frame<T> frame = Frame<T>::around(glm::normalize(disk.normal));
  const Vec3<T> from_center = position - disk.center;
  Vec3<T> local = from_center - frame.z * glm::dot(frame.z, from_center);
  const T distance = glm::length(local);
  if (distance > disk.radius) local *= disk.radius / distance;

  const T turns = std::atan2(glm::dot(local, frame.y), glm::dot(local, frame.x)) * (inv_pi<T> / T(2));
  const T v = turns < T(0) ? std::min(turns + T(1), one_minus_epsilon<T>) : turns;
  const T off_disk = rounding_bound<T>(16) * glm::length(from_center);
  return detail::disk_surface(disk, frame, local, off_disk, {std::min(distance / disk.radius, T(1)), v});
}

template <std::floating_point T>
[[nodiscard]] T area(const Disk<T>& disk) noexcept {
  return pi<T> * disk.radius * disk.radius;
}

/// A point uniform by area, from a uniform point of the unit square.
template <std::floating_point T>
[[nodiscard]] AreaSample<T> sample_area(const Disk<T>& disk, const Vec2<T>& u) noexcept {
  const Frame<T> frame = Frame<T>::around(glm::normalize(disk.normal));
  const T fraction = std::sqrt(u.x);
  const T phi = T(2) * pi<T> * u.y;
  const Vec3<T> local = (frame.x * std::cos(phi) + frame.y * std::sin(phi)) * (fraction * disk.radius);
  const T off_disk = rounding_bound<T>(16) * disk.radius;
  return {detail::disk_surface(disk, frame, local, off_disk, {fraction, u.y}), T(1) / area(disk)};
}

/// The point of the disk closest to `point`.
template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, const Disk<T>& disk) noexcept {
  const Vec3<T> from_center = point - disk.center;
  const T height = glm::dot(from_center, disk.normal) / length_squared(disk.normal);
  const Vec3<T> across = from_center - disk.normal * height;
  const T squared = length_squared(across);
  if (squared <= disk.radius * disk.radius) return disk.center + across;
  return disk.center + across * (disk.radius / std::sqrt(squared));
}

}  // namespace glint
