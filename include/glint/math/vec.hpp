// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <glint/core/config.hpp>

namespace glint {

/// GLM's vectors with the layout spelled out: GLM_FORCE_DEFAULT_ALIGNED_GENTYPES cannot change it. `glm::vec3`, aligned
/// or not, converts.
template <std::floating_point T>
using Vec2 = glm::vec<2, T, glm::packed_highp>;
template <std::floating_point T>
using Vec3 = glm::vec<3, T, glm::packed_highp>;

/// Pixel coordinates and image sizes.
using Vec2i = glm::vec<2, int, glm::packed_highp>;

/// Component 0, 1 or 2, without GLM's checked operator[].
template <std::floating_point T>
[[nodiscard]] constexpr T component(const Vec3<T>& v, int axis) noexcept {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

template <std::floating_point T>
[[nodiscard]] constexpr T max_component(const Vec3<T>& v) noexcept {
  return std::max(std::max(v.x, v.y), v.z);
}

/// The axis of the largest component; the first of equals.
template <std::floating_point T>
[[nodiscard]] constexpr int max_axis(const Vec3<T>& v) noexcept {
  return v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2;
}

template <std::floating_point T>
[[nodiscard]] Vec3<T> abs(const Vec3<T>& v) noexcept {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

template <std::floating_point T>
[[nodiscard]] constexpr T length_squared(const Vec3<T>& v) noexcept {
  return v.x * v.x + v.y * v.y + v.z * v.z;
}

/// The vector scaled to unit length: glm::normalize for hot loops, where compilers leave that one a call.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE Vec3<T> normalized(const Vec3<T>& v) noexcept {
  return v * (T(1) / std::sqrt(length_squared(v)));
}

template <std::floating_point T>
[[nodiscard]] bool is_finite(const Vec3<T>& v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace glint
