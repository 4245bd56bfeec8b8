// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glint/color/image.hpp>
#include <glint/math/constants.hpp>

namespace glint {

/// How far an image is from its reference. Means are over pixels and channels.
struct ImageDifference {
  double mean_ratio = 1;   ///< mean of the image over mean of the reference; 1 where both are 0
  double mse = 0;          ///< mean of (a − b)²
  double rmse = 0;         ///< √mse
  double relmse = 0;       ///< mean of (a − b)² / (b² + 0.01), b the reference
  double share_above = 0;  ///< share of pixels with a channel off by more than 0.01
  double max_abs = 0;      ///< largest |a − b|

  [[nodiscard]] friend bool operator==(const ImageDifference&, const ImageDifference&) noexcept = default;
};

/// Compares an image with a reference; empty where their sizes differ. Two images without pixels are equal.
///
/// Errors: a channel that is NaN or infinite, in either image, makes its pixel count as off, max_abs infinite, and mse,
///         rmse and relmse infinite or NaN: no test of the form `difference.mse < limit` lets a broken image pass.
[[nodiscard]] inline std::optional<ImageDifference> compare(const Image& image, const Image& reference) {
  if (image.size() != reference.size()) return std::nullopt;
  if (image.empty()) return ImageDifference{};
  ImageDifference difference;
  double sum = 0;
  double reference_sum = 0;
  std::size_t pixels_off = 0;
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const Rgb& a = image.pixels()[i];
    const Rgb& b = reference.pixels()[i];
    double worst = 0;
    const auto add = [&](double x, double y) {
      const double gap = std::abs(x - y);
      sum += x;
      reference_sum += y;
      difference.mse += gap * gap;
      difference.relmse += gap * gap / (y * y + 0.01);
      worst = std::max(worst, std::isfinite(gap) ? gap : infinity<double>);
    };
    add(static_cast<double>(a.r), static_cast<double>(b.r));
    add(static_cast<double>(a.g), static_cast<double>(b.g));
    add(static_cast<double>(a.b), static_cast<double>(b.b));
    pixels_off += worst > 0.01 ? 1 : 0;
    difference.max_abs = std::max(difference.max_abs, worst);
  }
  const auto pixels = static_cast<double>(image.pixels().size());
  difference.mean_ratio = sum == 0 && reference_sum == 0 ? 1 : sum / reference_sum;
  difference.mse /= 3 * pixels;
  difference.relmse /= 3 * pixels;
  difference.rmse = std::sqrt(difference.mse);
  difference.share_above = static_cast<double>(pixels_off) / pixels;
  return difference;
}

}  // namespace glint
