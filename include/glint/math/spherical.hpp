// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>

#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Where a direction is found in an equirectangular panorama: u = atan2(x, −z) / 2π, v = acos(y) / π. The zenith +y is
/// the top row v = 0; the left border u = 0 looks along −z, and +x follows at u = ¼.
///
/// The polar angle is taken by atan2 too: acos loses half its digits around the poles, and cares about length.
///
/// Shapes: directions of any length.
/// Ensures: u in [0, 1), v in [0, 1].
/// Errors: zero and NaN give some point of the panorama.
template <std::floating_point T>
[[nodiscard]] Vec2<T> direction_to_equirectangular(const Vec3<T>& direction) noexcept {
  const T turn = std::atan2(direction.x, -direction.z) * (inv_pi<T> / 2);
  const T u = turn < 0 ? turn + 1 : turn;
  const T v = std::atan2(std::sqrt(direction.x * direction.x + direction.z * direction.z), direction.y) * inv_pi<T>;
  return {u < 1 ? u : T(0), std::min(std::max(T(0), v), T(1))};
}

/// The unit direction of a point of an equirectangular panorama: the inverse of direction_to_equirectangular.
template <std::floating_point T>
[[nodiscard]] Vec3<T> equirectangular_to_direction(const Vec2<T>& uv) noexcept {
  const T phi = 2 * pi<T> * uv.x;
  const T theta = pi<T> * uv.y;
  const T sine = std::sin(theta);
  return {sine * std::sin(phi), std::cos(theta), -sine * std::cos(phi)};
}

}  // namespace glint
