// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/math/vec.hpp>

namespace glint {

/// What shading needs to know of a point on a surface.
///
/// `position_error` bounds, per axis, how far `position` is from the true surface; `offset_origin` uses it to start
/// rays off the surface. Zero means unknown: sets then put in a bound from the ray that found the point.
template <std::floating_point T>
struct SurfaceOf {
  Vec3<T> position{T(0)};
  Vec3<T> position_error{T(0)};
  Vec3<T> normal{T(0), T(0), T(1)};  ///< geometric, unit length, the primitive's outer side
  Vec3<T> shading_normal = normal;   ///< interpolated, unit length
  Vec3<T> tangent{T(0)};             ///< ∂position/∂u, any length; zero where there is no parametrization
  Vec2<T> uv{T(0)};                  ///< texture coordinates

  [[nodiscard]] friend bool operator==(const SurfaceOf&, const SurfaceOf&) noexcept = default;
};

/// Shading happens in `float`.
using Surface = SurfaceOf<float>;

/// The same surface in another precision.
template <std::floating_point To, std::floating_point From>
[[nodiscard]] SurfaceOf<To> surface_cast(const SurfaceOf<From>& s) noexcept {
  return {Vec3<To>(s.position),       Vec3<To>(s.position_error), Vec3<To>(s.normal),
          Vec3<To>(s.shading_normal), Vec3<To>(s.tangent),        Vec2<To>(s.uv)};
}

/// A point chosen on a primitive's surface, uniformly by area.
template <std::floating_point T>
struct AreaSample {
  SurfaceOf<T> surface;
  T pdf = 0;  ///< per unit area: 1 / area
};

}  // namespace glint
