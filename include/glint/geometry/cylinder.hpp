// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <optional>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/cone.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A circular cylinder from base to top, capped or open: in all it does, the Cone of equal radii.
///
/// Parametrization: that of Cone.
///
/// Requires: radius ≥ 0. Where base and top are one point, or the radius is 0, it is never hit.
template <std::floating_point T>
struct Cylinder {
  Vec3<T> base{T(0)};
  Vec3<T> top{T(0), T(0), T(1)};
  T radius = 1;
  Ends ends = Ends::Capped;

  [[nodiscard]] friend bool operator==(const Cylinder&, const Cylinder&) noexcept = default;
};

namespace detail {

template <std::floating_point T>
[[nodiscard]] Cone<T> cone_of(const Cylinder<T>& c) noexcept {
  return {.base = c.base, .top = c.top, .base_radius = c.radius, .top_radius = c.radius, .ends = c.ends};
}

}  // namespace detail

template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const Cylinder<T>& cylinder) noexcept {
  return bounds(detail::cone_of(cylinder));
}

template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Cylinder<T>& cylinder) noexcept {
  return intersect(ray, detail::cone_of(cylinder));
}

template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const Cylinder<T>& cylinder, const Vec3<T>& position, const Hit<T>& hit) noexcept {
  return surface(detail::cone_of(cylinder), position, hit);
}

template <std::floating_point T>
[[nodiscard]] T area(const Cylinder<T>& cylinder) noexcept {
  return area(detail::cone_of(cylinder));
}

template <std::floating_point T>
[[nodiscard]] AreaSample<T> sample_area(const Cylinder<T>& cylinder, const Vec2<T>& u) noexcept {
  return sample_area(detail::cone_of(cylinder), u);
}

template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, const Cylinder<T>& cylinder) noexcept {
  return closest_point(point, detail::cone_of(cylinder));
}

}  // namespace glint
