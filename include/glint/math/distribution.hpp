// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glint/core/config.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

/// Choosing in proportion to tabulated weights. In all of these a weight that is not positive and finite counts as
/// zero, an entry of weight zero is never chosen, and where all are zero every density is zero.
namespace glint {

namespace detail {

[[nodiscard]] inline double counted_weight(float weight) noexcept {
  return weight > 0 && weight < infinity<float> ? static_cast<double>(weight) : 0.0;
}

/// Fills cdf, one longer than the weights, from 0 to 1, and returns the sum of the weights. A cell of weight zero has
/// equal ends: the sum does not change, nor does its quotient by the total.
[[nodiscard]] inline double accumulate(std::span<const float> weights, std::span<float> cdf) noexcept {
  double total = 0;
  for (const float weight : weights) total += counted_weight(weight);
  double sum = 0;
  cdf[0] = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += counted_weight(weights[i]);
    cdf[i + 1] =
        total > 0 ? static_cast<float>(sum / total) : static_cast<float>(i + 1) / static_cast<float>(weights.size());
  }
  return total;
}

/// The cell that u falls in, and how far into it, in [0, 1).
struct CellPoint {
  std::size_t cell = 0;
  float offset = 0;
};

/// The last cell that begins at or before u: a binary search without branches to guess. As u is below the last value,
/// one, and the cell after begins beyond u, it is not empty.
[[nodiscard]] inline CellPoint find_cell(std::span<const float> cdf, float u) noexcept {
  u = std::clamp(u, 0.0F, one_minus_epsilon<float>);
  std::size_t first = 0;
  for (std::size_t length = cdf.size() - 1; length > 1;) {
    const std::size_t half = length / 2;
    first += cdf[first + half] <= u ? half : 0;
    length -= half;
  }
  const float offset = (u - cdf[first]) / (cdf[first + 1] - cdf[first]);
  return {first, std::min(offset, one_minus_epsilon<float>)};
}

/// The cell that holds x in [0, 1]; anything else goes to the nearest.
[[nodiscard]] inline std::size_t cell_at(float x, std::size_t cells) noexcept {
  const float scaled = x * static_cast<float>(cells);
  return scaled > 0 ? std::min(static_cast<std::size_t>(std::min(scaled, 1e9F)), cells - 1) : 0;
}

/// Where in [0, 1) a point of a cell is.
[[nodiscard]] inline float unit_position(const CellPoint& point, std::size_t cells) noexcept {
  return std::min((static_cast<float>(point.cell) + point.offset) / static_cast<float>(cells),
                  one_minus_epsilon<float>);
}

}  // namespace detail

/// A density over [0, 1), constant on equal intervals.
///
/// Cost:   logarithmic in the number of intervals.
/// Source: Pharr, Jakob, Humphreys, Physically Based Rendering (2023), section A.4.7.
class Distribution1D {
 public:
  struct Sample {
    float x = 0;
    float pdf = 0;
    std::size_t cell = 0;
  };

  Distribution1D() : Distribution1D(std::span<const float>{}) {}

  /// No weights count as one of zero.
  explicit Distribution1D(std::span<const float> weights) : density_(weights.begin(), weights.end()) {
    if (density_.empty()) density_.push_back(0.0F);
    cdf_.resize(density_.size() + 1);
    mean_ = detail::accumulate(density_, cdf_) / static_cast<double>(density_.size());
    for (float& density : density_) {
      density = mean_ > 0 ? static_cast<float>(detail::counted_weight(density) / mean_) : 0.0F;
    }
  }

  /// Requires: u in [0, 1).
  [[nodiscard]] Sample sample(float u) const noexcept {
    const detail::CellPoint point = detail::find_cell(cdf_, u);
    return {detail::unit_position(point, size()), density_[point.cell], point.cell};
  }

  [[nodiscard]] float pdf(float x) const noexcept { return density_[detail::cell_at(x, size())]; }

  /// The mean of the weights: their integral over [0, 1).
  [[nodiscard]] float mean() const noexcept { return static_cast<float>(mean_); }
  [[nodiscard]] std::size_t size() const noexcept { return density_.size(); }

 private:
  std::vector<float> density_;
  std::vector<float> cdf_;
  double mean_ = 0;
};

/// A density over [0, 1)², constant on the cells of a grid: first the row by u.y, then the column by u.x.
///
/// Cost:   logarithmic in width plus height; two numbers stored a cell.
/// Source: Pharr, Jakob, Humphreys, Physically Based Rendering (2023), section A.5.4.
class Distribution2D {
 public:
  struct Sample {
    Vec2<float> point{0.0F};
    float pdf = 0;
  };

  Distribution2D() : Distribution2D(std::vector<float>(1, 0.0F), 1, 1) {}

  /// Shapes:   weights row after row, width · height of them; x along the width.
  /// Requires: width ≥ 1, height ≥ 1.
  Distribution2D(std::span<const float> weights, int width, int height)
      : width_(static_cast<std::size_t>(width)), density_(weights.begin(), weights.end()) {
    GLINT_ASSERT(width >= 1 && height >= 1 && weights.size() == width_ * static_cast<std::size_t>(height));
    const auto rows = static_cast<std::size_t>(height);
    cdf_.resize(rows * (width_ + 1));
    std::vector<double> totals(rows);
    for (std::size_t y = 0; y < rows; ++y) {
      totals[y] = detail::accumulate(weights.subspan(y * width_, width_), row_cdf(y));
    }
    const double largest = *std::max_element(totals.begin(), totals.end());
    std::vector<float> shares(rows);  // relative to the largest: the total of a row may be too large for a float
    double total = 0;
    for (std::size_t y = 0; y < rows; ++y) {
      shares[y] = largest > 0 ? static_cast<float>(totals[y] / largest) : 0.0F;
      total += totals[y];
    }
    rows_ = Distribution1D{shares};
    mean_ = total / static_cast<double>(density_.size());
    for (float& density : density_) {
      density = mean_ > 0 ? static_cast<float>(detail::counted_weight(density) / mean_) : 0.0F;
    }
  }

  /// Requires: u in [0, 1)².
  [[nodiscard]] Sample sample(const Vec2<float>& u) const noexcept {
    const Distribution1D::Sample row = rows_.sample(u.y);
    const std::size_t begin = row.cell * (width_ + 1);
    const detail::CellPoint column = detail::find_cell(std::span{cdf_}.subspan(begin, width_ + 1), u.x);
    return {{detail::unit_position(column, width_), row.x}, density_[row.cell * width_ + column.cell]};
  }

  [[nodiscard]] float pdf(const Vec2<float>& point) const noexcept {
    return density_[detail::cell_at(point.y, rows_.size()) * width_ + detail::cell_at(point.x, width_)];
  }

  /// The mean of the weights: their integral over [0, 1)².
  [[nodiscard]] float mean() const noexcept { return static_cast<float>(mean_); }

 private:
  [[nodiscard]] std::span<float> row_cdf(std::size_t y) noexcept {
    return std::span{cdf_}.subspan(y * (width_ + 1), width_ + 1);
  }

  std::size_t width_;
  std::vector<float> density_;
  std::vector<float> cdf_;
  Distribution1D rows_;
  double mean_ = 0;
};

/// Chooses an index in proportion to its weight, in constant time: each of n equal bins is shared by at most two.
///
/// Cost:   linear to build; one look-up in the bin, one at the choice.
/// Source: Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", IEEE TSE 17(9), 1991.
class AliasTable {
 public:
  struct Sample {
    std::uint32_t index = 0;
    float probability = 0;
    float remainder = 0;  ///< what choosing leaves of u: uniform in [0, 1) again, with so many bits fewer
  };

  AliasTable() = default;

  /// Requires: fewer than 2³² weights.
  explicit AliasTable(std::span<const float> weights) : bins_(weights.size()) {
    for (const float weight : weights) total_ += detail::counted_weight(weight);
    if (!(total_ > 0)) return;
    std::vector<double> left(weights.size());  // of each weight, in bins
    std::vector<std::uint32_t> small;
    std::vector<std::uint32_t> large;
    for (std::uint32_t i = 0; i < bins_.size(); ++i) {
      const double probability = detail::counted_weight(weights[i]) / total_;
      bins_[i] = {1, i, static_cast<float>(probability)};
      left[i] = bins_[i].probability > 0 ? probability * static_cast<double>(bins_.size()) : 0;
      (left[i] < 1 ? small : large).push_back(i);
    }
    fill(left, small, large);
  }

  /// The finer u, the more exact: 24 bits less the logarithm of the size decide within a bin if u is a float.
  ///
  /// Requires: u in [0, 1).
  /// Errors:   where all weights are zero, index 0 with probability 0.
  template <std::floating_point T>
  [[nodiscard]] Sample sample(T u) const noexcept {
    if (!(total_ > 0)) return {};
    const T scaled = u * static_cast<T>(bins_.size());
    const std::size_t bin = std::min(static_cast<std::size_t>(scaled), bins_.size() - 1);
    const T place = scaled - static_cast<T>(bin);
    const T own_share = static_cast<T>(bins_[bin].own_share);
    const bool own = place < own_share;
    const std::uint32_t index = own ? static_cast<std::uint32_t>(bin) : bins_[bin].alias;
    const T rest = own ? place / own_share : (place - own_share) / (T(1) - own_share);
    return {index, bins_[index].probability, std::min(static_cast<float>(rest), one_minus_epsilon<float>)};
  }

  [[nodiscard]] float probability(std::size_t index) const noexcept { return bins_[index].probability; }
  [[nodiscard]] double total() const noexcept { return total_; }
  [[nodiscard]] std::size_t size() const noexcept { return bins_.size(); }

 private:
  struct Bin {
    float own_share = 0;      ///< of the bin, at its beginning
    std::uint32_t alias = 0;  ///< whose the rest is
    float probability = 0;
  };

  /// Fills up each small bin from a large one. Where rounding leaves small bins over, they are full but for rounding,
  /// or their weight is zero and the heaviest takes them.
  void fill(std::vector<double>& left, std::vector<std::uint32_t>& small, std::vector<std::uint32_t>& large) {
    const auto heaviest = static_cast<std::uint32_t>(std::max_element(left.begin(), left.end()) - left.begin());
    while (!small.empty() && !large.empty()) {
      const std::uint32_t poor = small.back();
      const std::uint32_t rich = large.back();
      small.pop_back();
      bins_[poor].own_share = static_cast<float>(left[poor]);
      bins_[poor].alias = rich;
      left[rich] -= 1 - left[poor];
      if (left[rich] >= 1) continue;
      large.pop_back();
      small.push_back(rich);
    }
    for (const std::uint32_t poor : small) {
      if (!(bins_[poor].probability > 0)) bins_[poor] = {0, heaviest, 0};
    }
  }

  std::vector<Bin> bins_;
  double total_ = 0;
};

}  // namespace glint
