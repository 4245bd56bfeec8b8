// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>

namespace glint {

/// Linear Rec. 709 color: radiance, reflectance, weights. A type of its own, so that colors and positions do not mix.
struct Rgb {
  float r = 0;
  float g = 0;
  float b = 0;

  constexpr Rgb() = default;
  /// Gray: the same value in all channels.
  constexpr Rgb(float value) noexcept : r(value), g(value), b(value) {}
  constexpr Rgb(float red, float green, float blue) noexcept : r(red), g(green), b(blue) {}

  constexpr Rgb& operator+=(const Rgb& c) noexcept { return *this = {r + c.r, g + c.g, b + c.b}; }
  constexpr Rgb& operator-=(const Rgb& c) noexcept { return *this = {r - c.r, g - c.g, b - c.b}; }
  constexpr Rgb& operator*=(const Rgb& c) noexcept { return *this = {r * c.r, g * c.g, b * c.b}; }
  constexpr Rgb& operator/=(const Rgb& c) noexcept { return *this = {r / c.r, g / c.g, b / c.b}; }

  [[nodiscard]] friend constexpr Rgb operator+(Rgb x, const Rgb& y) noexcept { return x += y; }
  [[nodiscard]] friend constexpr Rgb operator-(Rgb x, const Rgb& y) noexcept { return x -= y; }
  [[nodiscard]] friend constexpr Rgb operator*(Rgb x, const Rgb& y) noexcept { return x *= y; }
  [[nodiscard]] friend constexpr Rgb operator/(Rgb x, const Rgb& y) noexcept { return x /= y; }
  [[nodiscard]] friend constexpr bool operator==(const Rgb&, const Rgb&) noexcept = default;
};

/// Relative luminance. Source: ITU-R BT.709.
[[nodiscard]] constexpr float luminance(const Rgb& c) noexcept {
  return 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
}

[[nodiscard]] constexpr float max_component(const Rgb& c) noexcept {
  return std::max(std::max(c.r, c.g), c.b);
}

[[nodiscard]] constexpr bool is_black(const Rgb& c) noexcept {
  return c.r == 0 && c.g == 0 && c.b == 0;
}

[[nodiscard]] inline bool is_finite(const Rgb& c) noexcept {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

}  // namespace glint
