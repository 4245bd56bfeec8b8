// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace glint {

/// From linear light to the sRGB curve, and back: exact piecewise forms, each the other's inverse.
///
/// Shapes: [0, 1] to [0, 1]; larger values continue the curve, negative ones the straight piece.
/// Source: IEC 61966-2-1:1999, sections 5.2 and 5.3.
template <std::floating_point T>
[[nodiscard]] T encode_srgb(T linear) noexcept {
  return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}
template <std::floating_point T>
[[nodiscard]] T decode_srgb(T encoded) noexcept {
  return encoded <= T(0.04045) ? encoded / T(12.92) : std::pow((encoded + T(0.055)) / T(1.055), T(2.4));
}

/// The linear light of an 8-bit sRGB value: a table lookup.
[[nodiscard]] inline float decode_srgb8(std::uint8_t encoded) noexcept {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<float>(decode_srgb(static_cast<double>(i) / 255));
    }
    return values;
  }();
  return table[encoded];
}

/// The 8-bit sRGB value nearest to linear light, correctly rounded: a search without branches among the 255
/// values at which it changes.
///
/// Errors: below 0 and NaN give 0, above 1 gives 255.
[[nodiscard]] inline std::uint8_t encode_srgb8(float linear) noexcept {
  static const std::array<float, 255> steps = [] {  // the least float that rounds to i + 1
    std::array<float, 255> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double exact = decode_srgb((static_cast<double>(i) + 0.5) / 255);
      const auto near = static_cast<float>(exact);
      values[i] =
          static_cast<double>(near) < exact ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near;
    }
    return values;
  }();
  std::size_t code = 0;
  for (std::size_t half = 128; half > 0; half /= 2) code += half * (linear >= steps[code + half - 1] ? 1U : 0U);
  return static_cast<std::uint8_t>(code);
}

}  // namespace glint
