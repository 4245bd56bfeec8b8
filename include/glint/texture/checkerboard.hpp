// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include <glint/texture/concepts.hpp>
#include <glint/texture/mapping.hpp>

namespace glint {

/// Squares of two colors, two by two in each unit of texture coordinates.
///
/// Squares are numbered by trunc(2s) and trunc(2t), toward zero: those that touch an axis from below zero carry on the
/// color from above it. Color 0 where both numbers are even or both odd.
///
/// Errors: a coordinate that is not finite counts as zero.
struct Checkerboard {
  Rgb color0{0.4F};
  Rgb color1{0.2F};
  UvMapping mapping{};

  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv) const noexcept {
    const Vec2<float> st = mapping(uv);
    return ((square(st.x) ^ square(st.y)) & 1) == 0 ? color0 : color1;
  }

  [[nodiscard]] friend bool operator==(const Checkerboard&, const Checkerboard&) noexcept = default;

 private:
  /// Floats from 2²⁵ on are all even: beyond 2³⁰, where int ends, zero stands for any of them.
  [[nodiscard]] static int square(float s) noexcept {
    const float doubled = 2 * s;
    return std::abs(doubled) < 0x1p30F ? static_cast<int>(doubled) : 0;
  }
};

static_assert(Texture<Checkerboard>);

}  // namespace glint
