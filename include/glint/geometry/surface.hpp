// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/math/vec.hpp>

namespace glint {

/// The neighborhood that a path stands for on a surface: how far the point moves, in the tangent plane, where the
/// path's pixel is exchanged for the next one across (x) or up (y). Zero: the path stands for the point alone.
template <std::floating_point T>
struct FootprintOf {
  Vec3<T> x{T(0)};
  Vec3<T> y{T(0)};

  [[nodiscard]] friend bool operator==(const FootprintOf&, const FootprintOf&) noexcept = default;
};

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
  Vec3<T> bitangent{T(0)};           ///< ∂position/∂v, likewise
  Vec2<T> uv{T(0)};                  ///< texture coordinates
  FootprintOf<T> footprint{};        ///< put in by scenes that filter textures; primitives leave it alone

  [[nodiscard]] friend bool operator==(const SurfaceOf&, const SurfaceOf&) noexcept = default;
};

/// Shading happens in `float`.
using Surface = SurfaceOf<float>;
using Footprint = FootprintOf<float>;

/// The same surface in another precision.
template <std::floating_point To, std::floating_point From>
[[nodiscard]] SurfaceOf<To> surface_cast(const SurfaceOf<From>& s) noexcept {
  return {.position = Vec3<To>(s.position),
          .position_error = Vec3<To>(s.position_error),
          .normal = Vec3<To>(s.normal),
          .shading_normal = Vec3<To>(s.shading_normal),
          .tangent = Vec3<To>(s.tangent),
          .bitangent = Vec3<To>(s.bitangent),
          .uv = Vec2<To>(s.uv),
          .footprint = {Vec3<To>(s.footprint.x), Vec3<To>(s.footprint.y)}};
}

/// A point chosen on a primitive's surface, uniformly by area.
template <std::floating_point T>
struct AreaSample {
  SurfaceOf<T> surface;
  T pdf = 0;  ///< per unit area: 1 / area
};

}  // namespace glint
