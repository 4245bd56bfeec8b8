// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glint/math/vec.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/testing/chi_square.hpp>

namespace glint::testing {

struct SamplerLawsOptions {
  int samples = 4096;          ///< of one pixel; best a multiple of what the sequence is made for
  Vec2i pixels{64, 64};        ///< of the image
  double significance = 1e-3;  ///< how often a lawful sequence may be accused
  double dispersion = 1;       ///< squared deviations from the mean that are lawful, over those of independent numbers
};

namespace detail {

/// The first numbers of a path: in turn one number and a pair.
inline constexpr std::size_t law_dimensions = 12;
using Numbers = std::array<float, law_dimensions>;

template <SampleSequence Q>
[[nodiscard]] Numbers numbers(const Q& sequence, const Vec2i& pixel, int sample) {
  auto sampler = sequence.stream(pixel, sample);
  Numbers result{};
  for (std::size_t i = 0; i < law_dimensions; i += 3) {
    result[i] = sampler.next_1d();
    const Vec2<float> pair = sampler.next_2d();
    result[i + 1] = pair.x;
    result[i + 2] = pair.y;
  }
  return result;
}

/// Pearson's coefficient of correlation times √count: about a standard normal variable for independent numbers.
[[nodiscard]] inline double correlation(std::span<const Numbers> rows, std::size_t a, std::size_t b, std::size_t lag) {
  double sum = 0;
  const std::size_t count = rows.size() - lag;
  for (std::size_t i = 0; i < count; ++i) {
    sum += (static_cast<double>(rows[i][a]) - 0.5) * (static_cast<double>(rows[i + lag][b]) - 0.5);
  }
  return sum * 12 / std::sqrt(static_cast<double>(count));  // the variance of a uniform number is 1/12
}

/// Collects what is wrong with a table of numbers, a path a row.
class SamplerJudge {
 public:
  SamplerJudge(double significance, double dispersion) : significance_(significance), dispersion_(dispersion) {}

  void range(const std::string& where, std::span<const Numbers> rows) {
    for (const Numbers& row : rows) {
      for (const float x : row) {
        if (x >= 0 && x < 1) continue;
        violations.push_back(where + ": " + std::to_string(x) + " is not in [0, 1)");
        return;
      }
    }
  }

  void uniformity(const std::string& where, std::span<const Numbers> rows) {
    for (std::size_t a = 0; a < law_dimensions; ++a) {
      cells(where + ": dimension " + std::to_string(a), rows, {a, a}, {64, 1});
      for (std::size_t b = a + 1; b < law_dimensions; ++b) {
        cells(where + ": dimensions " + std::to_string(a) + ", " + std::to_string(b), rows, {a, b}, {8, 8});
      }
    }
  }

  void independence(const std::string& where, std::span<const Numbers> rows, std::size_t lag) {
    for (std::size_t a = 0; a < law_dimensions; ++a) {
      for (std::size_t b = lag == 0 ? a + 1 : 0; b < law_dimensions; ++b) {
        const double z = correlation(rows, a, b, lag) / std::sqrt(dispersion_);
        if (a == b && z < 0) continue;  // neighbors that make up for each other
        const double p = std::erfc(std::abs(z) / std::sqrt(2.0));
        if (p >= sidak(significance_, 2 * law_dimensions * law_dimensions)) continue;
        violations.push_back(where + ": dimensions " + std::to_string(a) + ", " + std::to_string(b) + ", " +
                             std::to_string(lag) + " apart, correlate: " + std::to_string(z) + " standard deviations");
      }
    }
  }

  std::vector<std::string> violations;

 private:
  void cells(const std::string& where, std::span<const Numbers> rows, std::pair<std::size_t, std::size_t> dimensions,
             Vec2i resolution) {
    const std::size_t width = static_cast<std::size_t>(resolution.x);
    const std::size_t size = width * static_cast<std::size_t>(resolution.y);
    std::vector<double> observed(size, 0.0);
    for (const Numbers& row : rows) {
      const Vec2<float> at = Vec2<float>{row[dimensions.first], row[dimensions.second]} * Vec2<float>(resolution);
      const std::size_t cell = static_cast<std::size_t>(at.y) * width + static_cast<std::size_t>(at.x);
      observed[std::min(cell, size - 1)] += 1;
    }
    const double mean = static_cast<double>(rows.size()) / static_cast<double>(size);
    for (double& count : observed) count = mean + (count - mean) / std::sqrt(dispersion_);
    const std::vector<double> expected(size, mean);
    const ChiSquareResult result =
        chi_square(observed, expected, {.significance = significance_, .tests = law_dimensions * law_dimensions});
    if (!result.passed) violations.push_back(where + " not uniform: " + result.message);
  }

  double significance_;
  double dispersion_;
};

/// Whether there is one row in each of 2ᵏ columns × 2ˡ lines of cells of dimensions a and a + 1.
///
/// Requires: 2ᵏ⁺ˡ rows.
[[nodiscard]] inline bool one_in_each(std::span<const Numbers> rows, std::size_t a, int k, int l) {
  std::vector<bool> taken(rows.size(), false);
  for (const Numbers& row : rows) {
    const auto column = static_cast<std::size_t>(std::ldexp(row[a], k));
    const std::size_t line = l == 0 ? 0 : static_cast<std::size_t>(std::ldexp(row[a + 1], l));
    const std::size_t cell = line << k | column;
    if (cell >= taken.size() || taken[cell]) return false;
    taken[cell] = true;
  }
  return true;
}

/// What 2ᵐ samples do against being nets.
[[nodiscard]] inline std::vector<std::string> violations_of_net(std::span<const Numbers> rows, int m) {
  std::vector<std::string> violations;
  for (std::size_t a = 0; a < law_dimensions; ++a) {
    const bool pair = a % 3 == 1;
    for (int k = pair ? 0 : m; k <= m; ++k) {
      if (one_in_each(rows, a, k, m - k)) continue;
      violations.push_back("dimension " + std::to_string(a) + ": not one in each of 2^" + std::to_string(k) + " x 2^" +
                           std::to_string(m - k) + " cells");
    }
  }
  return violations;
}

}  // namespace detail

/// What a sample sequence does against the laws, in words; nothing for a lawful one.
///
/// - Every number is in [0, 1).
/// - Numbers are a function of (pixel, sample) alone, in whatever order streams are asked for and however
///   they interleave.
/// - Each dimension, and each two together, are uniform: over the samples of a pixel, and over the pixels of an image.
///   More even than random is lawful.
/// - Dimensions do not correlate, neither in a pixel, nor between neighboring ones. But one may have too much of
///   what its neighbor has too little of, in the same dimension.
///
/// Looks at the first twelve dimensions, drawn in turn as one number and a pair.
///
/// Padded nets want a dispersion of 3: two dimensions of them deviate from uniformity no more than random ones on
/// average, but in fewer, larger steps, so that single ones deviate much.
template <SampleSequence Q>
[[nodiscard]] std::vector<std::string> violations_of_sampler_laws(const Q& sequence,
                                                                  const SamplerLawsOptions& options = {}) {
  std::vector<detail::Numbers> samples;
  std::vector<detail::Numbers> pixels;
  const Vec2i middle = options.pixels / 2;
  for (int i = 0; i < options.samples; ++i) samples.push_back(detail::numbers(sequence, middle, i));
  for (int y = 0; y < options.pixels.y; ++y) {
    for (int x = 0; x < options.pixels.x; ++x) pixels.push_back(detail::numbers(sequence, {x, y}, 0));
  }
  detail::SamplerJudge judge(options.significance / 6, options.dispersion);
  judge.range("samples", samples);
  judge.range("pixels", pixels);
  if (!judge.violations.empty()) return judge.violations;
  for (int i = options.samples - 1; i >= 0; --i) {  // backward, and with another stream alive
    auto other = sequence.stream(middle + 1, i);
    const float before = other.next_1d();
    if (detail::numbers(sequence, middle, i) != samples[static_cast<std::size_t>(i)] ||
        sequence.stream(middle + 1, i).next_1d() != before) {
      judge.violations.push_back("sample " + std::to_string(i) + " differs when asked for again");
      break;
    }
  }
  judge.uniformity("samples", samples);
  judge.uniformity("pixels", pixels);
  judge.independence("samples", samples, 0);
  judge.independence("pixels", pixels, 0);
  judge.independence("pixels", pixels, 1);
  judge.independence("pixels", pixels, static_cast<std::size_t>(options.pixels.x));
  return judge.violations;
}

/// What a sequence does against the laws of (0, m, 2)-nets in base two, in words: blocks of 2ᵐ samples of a pixel, for
/// each m up to max_m, that begin at a multiple of 2ᵐ.
///
/// - In each dimension, each of 2ᵐ equal intervals holds one number.
/// - In each pair drawn as one, each rectangle 2⁻ᵏ wide and 2ᵏ⁻ᵐ high holds one, for every k.
///
/// Looks at the first twelve dimensions, drawn in turn as one number and a pair, and at the first two blocks.
template <SampleSequence Q>
[[nodiscard]] std::vector<std::string> violations_of_net_laws(const Q& sequence, const Vec2i& pixel, int max_m = 8) {
  std::vector<detail::Numbers> rows;
  for (int i = 0; i < 2 << max_m; ++i) rows.push_back(detail::numbers(sequence, pixel, i));
  std::vector<std::string> violations;
  for (int block = 0; block < 2 * (max_m + 1); ++block) {
    const int m = block / 2;
    const std::size_t size = std::size_t{1} << m;
    const std::size_t first = block % 2 == 0 ? 0 : size;
    for (const std::string& violation : detail::violations_of_net(std::span(rows).subspan(first, size), m))
      violations.push_back(std::to_string(size) + " samples from " + std::to_string(first) + " on: " + violation);
  }
  return violations;
}

}  // namespace glint::testing
