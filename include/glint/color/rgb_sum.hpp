// SPDX-License-Identifier: MIT
#pragma once
#include <glint/color/rgb.hpp>

namespace glint {

/// A sum of colors, kept in double. Whatever the compiler does with the multiplications that made them, what is added
/// was rounded to float before: the sum has the same bits wherever it is taken.
class RgbSum {
 public:
  constexpr void add(const Rgb& c) noexcept {
    r_ += static_cast<double>(c.r);
    g_ += static_cast<double>(c.g);
    b_ += static_cast<double>(c.b);
  }

  /// Rounded to float.
  [[nodiscard]] constexpr Rgb value() const noexcept {
    return {static_cast<float>(r_), static_cast<float>(g_), static_cast<float>(b_)};
  }

 private:
  double r_ = 0;
  double g_ = 0;
  double b_ = 0;
};

}  // namespace glint
