// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// What the samples of one pixel say about their mean.
///
/// Source: Welford, "Note on a Method for Calculating Corrected Sums of Squares and Products", Technometrics 4(3),
/// 1962.
class SampleStatistics {
 public:
  void add(const Rgb& value) noexcept {
    ++count_;
    const Vec3<double> x{value.r, value.g, value.b};
    const Vec3<double> gap = x - mean_;
    mean_ += gap / static_cast<double>(count_);
    squares_ += gap * (x - mean_);
  }

  [[nodiscard]] std::uint32_t count() const noexcept { return count_; }

  /// The variance of the mean of the samples, channel by channel, estimated without bias where they are independent:
  /// that of the samples, over their count. Its root is the standard error. Infinite for fewer than two samples.
  ///
  /// Errors: samples that are spread evenly have a mean that varies less than this says.
  [[nodiscard]] Rgb variance_of_mean() const noexcept {
    if (count_ < 2) return infinity<float>;
    const double n = count_;
    const Vec3<double> v = squares_ / (n * (n - 1));
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  }

 private:
  std::uint32_t count_ = 0;
  Vec3<double> mean_{0.0};
  Vec3<double> squares_{0.0};  ///< of the distances from the mean, summed
};

}  // namespace glint
