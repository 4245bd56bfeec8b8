// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>

#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// An ellipse around the origin: the points p with pᵀ M⁻¹ p ≤ 1, M the symmetric matrix (xx xy; xy yy).
struct Ellipse {
  float xx = 0;
  float xy = 0;
  float yy = 0;

  /// What two conjugate radii span: the image of the unit disk.
  [[nodiscard]] static Ellipse spanned(const Vec2<float>& a, const Vec2<float>& b) noexcept {
    return {a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y};
  }

  /// The squares of the longest and the shortest radius.
  [[nodiscard]] Vec2<float> squared_radii() const noexcept {
    const float half_sum = 0.5F * (xx + yy);
    const float half_difference = 0.5F * (xx - yy);
    const float root = std::sqrt(half_difference * half_difference + xy * xy);
    return {half_sum + root, std::max(0.0F, half_sum - root)};
  }

  /// With a shortest radius of at least longest / bound; the longest stays. Requires: bound ≥ 1.
  [[nodiscard]] Ellipse rounded_to(float bound) const noexcept {
    const Vec2<float> radii = squared_radii();
    const float missing = radii.x / (bound * bound) - radii.y;
    const float span = radii.x - radii.y;
    if (!(missing > 0 && span > 0)) return *this;
    const float share = missing / span;  // of the longest axis's λ₁ I − M, which is a multiple of the other's projector
    return {xx + share * (radii.x - xx), xy - share * xy, yy + share * (radii.x - yy)};
  }

  [[nodiscard]] Ellipse scaled(const Vec2<float>& by) const noexcept {
    return {xx * by.x * by.x, xy * by.x * by.y, yy * by.y * by.y};
  }

  [[nodiscard]] friend bool operator==(const Ellipse&, const Ellipse&) noexcept = default;
};

/// The mean of pixels in an ellipse around a point, by the weights e^(−2r²) − e^(−2), where r is 0 at the center and 1
/// on the rim. The ellipse is first widened by the unit disk, which stands for the pixels' own width. `pixel(x, y)` is
/// asked for any whole numbers; pixel (i, j) lies at the point (i, j).
///
/// Cost:   two multiplications for each weight, along rows whose ends are known.
/// Source: Greene, Heckbert, "Creating Raster Omnimax Images from Multiple Perspective Views Using the Elliptical
///         Weighted Average Filter", IEEE CG&A 6(6), 1986; Heckbert, "Fundamentals of Texture Mapping and Image
///         Warping" (1989), section 3.5.8, for the disk. Weights go on along a row by recurrence, not from a table.
template <typename Pixel>
[[nodiscard]] Rgb elliptical_mean(const Vec2<float>& center, const Ellipse& around, const Pixel& pixel) {
  const float rim = std::exp(-2.0F);
  const float xx = around.xx + 1;
  const float yy = around.yy + 1;
  const float squared_scale = yy / (xx * yy - around.xy * around.xy);  // of x in a row: r² = (x − middle)² · this + …
  const float scale = std::sqrt(squared_scale);
  const float bend = std::exp(-4 * squared_scale);
  const float half_height = std::sqrt(yy);
  Rgb sum;
  float weights = 0;
  const int last_row = static_cast<int>(std::floor(center.y + half_height));
  for (int y = static_cast<int>(std::ceil(center.y - half_height)); y <= last_row; ++y) {
    const float up = static_cast<float>(y) - center.y;
    const float row = up * up / yy;
    const float middle = center.x + up * around.xy / yy;
    const float half_width = std::sqrt(std::max(0.0F, 1 - row)) / scale;
    const int first = static_cast<int>(std::ceil(middle - half_width));
    const int last = static_cast<int>(std::floor(middle + half_width));
    const float start = static_cast<float>(first) - middle;
    float gauss = std::exp(-2 * (row + start * start * squared_scale));
    float ratio = std::exp(-2 * (2 * start + 1) * squared_scale);  // of the next pixel's e^(−2r²) to this one's
    for (int x = first; x <= last; ++x) {
      const float weight = std::max(0.0F, gauss - rim);
      sum += weight * pixel(x, y);
      weights += weight;
      gauss *= ratio;
      ratio *= bend;
    }
  }
  return sum / weights;
}

}  // namespace glint
