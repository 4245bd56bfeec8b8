// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <glint/core/config.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>

/// Pearson's chi-square test: do the samples of a routine have the density that it says they have?
namespace glint::testing {

/// The upper regularized incomplete gamma function Q(a, x) = Γ(a, x) / Γ(a), by the power series below the mean and
/// Legendre's continued fraction above.
///
/// Requires: a > 0, x ≥ 0.
/// Source:   Abramowitz, Stegun, Handbook of Mathematical Functions (1964), 6.5.29 and 6.5.31; the fraction by the
///           method of Lentz as modified by Thompson, Barnett, 1986.
[[nodiscard]] inline double regularized_gamma_q(double a, double x) {
  GLINT_ASSERT(a > 0 && x >= 0);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr int terms = 100'000;  // about √a of them are needed
  if (x == 0) return 1;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a;
    double sum = term;
    for (int n = 1; n < terms && term > epsilon * sum; ++n) sum += term *= x / (a + n);
    return 1 - scale * sum;
  }
  double b = x + 1 - a;
  double d = 1 / b;
  double c = infinity<double>;
  double fraction = d;
  double change = 0;
  for (int n = 1; n < terms && std::abs(change - 1) > epsilon; ++n) {
    const double numerator = n * (a - n);
    b += 2;
    c = b + numerator / c;
    d = 1 / (b + numerator * d);
    change = c * d;
    fraction *= change;
  }
  return scale * fraction;
}

/// The chance that a chi-square variable is at least as large.
[[nodiscard]] inline double chi_square_p_value(double statistic, int degrees_of_freedom) {
  return regularized_gamma_q(0.5 * degrees_of_freedom, 0.5 * statistic);
}

/// The significance that each of several tests may have so that all together are wrongly failed with `significance`.
///
/// Source: Šidák, "Rectangular Confidence Regions for the Means of Multivariate Normal Distributions", JASA 62, 1967.
[[nodiscard]] inline double sidak(double significance, int tests) {
  return -std::expm1(std::log1p(-significance) / tests);
}

struct ChiSquareOptions {
  int samples = 100'000;
  Vec2i resolution{32, 16};  ///< cells; on the sphere: of longitude, and of latitude (even: the equator is a border)
  std::uint64_t seed = 0;
  double significance = 0.01;  ///< how often a correct routine may fail, over all `tests` together
  int tests = 1;               ///< how many tests of this kind are made
};

struct ChiSquareResult {
  double p_value = 1;
  bool passed = true;
  std::string message;  ///< the figures, and if failed the reason
};

namespace detail {

/// Sums up how far counts are from their expectations, cell by cell.
struct ChiSquareTally {
  double statistic = 0;
  int cells = 0;
  double worst = -1;
  std::size_t worst_cell = 0;
  double rare_observed = 0;  ///< of the cells that expect too few to be judged alone
  double rare_expected = 0;
  double total = 0;
  bool valid = true;

  void judge(double count, double mean, std::size_t cell) {
    const double term = (count - mean) * (count - mean) / mean;
    statistic += term;
    ++cells;
    if (term > worst) {
      worst = term;
      worst_cell = cell;
    }
  }

  void add(double count, double mean, std::size_t cell) {
    constexpr double fewest = 5;
    total += count;
    if (!(mean >= 0 && mean < infinity<double>)) {
      valid = false;
    } else if (mean >= fewest) {
      judge(count, mean, cell);
    } else {
      rare_observed += count;
      rare_expected += mean;
    }
  }

  /// The rare cells are judged as one, or where even that is rare, by the chance of at least as many.
  [[nodiscard]] double p_value(std::size_t rare_cell) {
    double rare_p = 1;
    if (rare_expected >= 5) {
      judge(rare_observed, rare_expected, rare_cell);
    } else if (rare_observed > 0) {
      rare_p = 1 - regularized_gamma_q(rare_observed, rare_expected + 1e-6 * total);
    }
    if (!valid) return 0;
    const double common_p = cells > 0 ? chi_square_p_value(statistic, std::max(1, cells - 1)) : 1.0;
    return std::min(1.0, rare_p < 1 ? 2 * std::min(rare_p, common_p) : common_p);
  }
};

}  // namespace detail

/// Compares counts with what they should be on average.
///
/// Cells that expect fewer than five counts are judged together, and where even all of them expect fewer, by the exact
/// Poisson distribution. Their expectation is raised by a millionth of all counts, the share that rounding may carry
/// over a border.
///
/// Requires: as many expected as observed counts.
/// Errors:   an expectation that is negative or NaN fails.
[[nodiscard]] inline ChiSquareResult chi_square(std::span<const double> observed, std::span<const double> expected,
                                                const ChiSquareOptions& options = {}) {
  GLINT_ASSERT(observed.size() == expected.size());
  detail::ChiSquareTally tally;
  for (std::size_t i = 0; i < observed.size(); ++i) tally.add(observed[i], expected[i], i);
  ChiSquareResult result;
  result.p_value = tally.p_value(observed.size());
  const double limit = sidak(options.significance, options.tests);
  result.passed = result.p_value >= limit;
  std::ostringstream message;
  message << (result.passed ? "passed" : "FAILED") << ": p = " << result.p_value << ", limit " << limit
          << "; chi-square " << tally.statistic << " over " << tally.cells << " cells; rare cells hold "
          << tally.rare_observed << ", expected " << tally.rare_expected;
  if (!tally.valid) message << "; an expected count is negative or not finite";
  if (tally.worst_cell < observed.size() && tally.cells > 0) {
    message << "; worst cell " << tally.worst_cell << " holds " << observed[tally.worst_cell] << ", expected "
            << expected[tally.worst_cell];
  }
  result.message = message.str();
  return result;
}

namespace detail {

/// A square cell of the unit square, in an adaptive integration.
struct Cell {
  Vec2<double> lower{0.0};
  Vec2<double> size{1.0};

  [[nodiscard]] std::array<Cell, 4> quarters() const {
    const Vec2<double> half = size * 0.5;
    return {Cell{lower, half}, Cell{{lower.x + half.x, lower.y}, half}, Cell{{lower.x, lower.y + half.y}, half},
            Cell{lower + half, half}};
  }
};

/// The integral over a cell by 3 × 3 points of Gauss and Legendre.
template <typename Density>
[[nodiscard]] double gauss(const Density& density, const Cell& cell) {
  constexpr double offset = 0.3872983346207417;  // √(3/5) / 2
  constexpr std::array<double, 3> points{0.5 - offset, 0.5, 0.5 + offset};
  constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (std::size_t y = 0; y < 3; ++y) {
    for (std::size_t x = 0; x < 3; ++x) {
      sum += weights[x] * weights[y] * density(cell.lower + cell.size * Vec2<double>{points[x], points[y]});
    }
  }
  return sum * cell.size.x * cell.size.y;
}

/// The integral over a cell, cut in quarters `depth` times and then on, up to eight times in all, until cutting no
/// longer changes it.
template <typename Density>
[[nodiscard]] double integral(const Density& density, const Cell& cell, double tolerance, int depth, int cuts = 0) {
  double fine = 0;
  for (const Cell& quarter : cell.quarters()) fine += gauss(density, quarter);
  const double change = std::abs(fine - gauss(density, cell));
  const bool settled = cuts >= depth && !(change > tolerance + 1e-4 * std::abs(fine));  // NaN stays NaN
  if (cuts >= 8 || settled) return fine;
  double sum = 0;
  for (const Cell& quarter : cell.quarters()) sum += integral(density, quarter, 0.25 * tolerance, depth, cuts + 1);
  return sum;
}

/// How many of `options.samples` points fall into each cell; nothing where one is not finite or out of the domain.
template <typename Sample>
[[nodiscard]] std::optional<std::vector<double>> counted_points(const Sample& sample, const ChiSquareOptions& options) {
  const Vec2<double> resolution(options.resolution);
  const auto width = static_cast<std::size_t>(options.resolution.x);
  std::vector<double> counts(width * static_cast<std::size_t>(options.resolution.y), 0.0);
  Random random{options.seed};
  for (int i = 0; i < options.samples; ++i) {
    const std::optional<Vec2<double>> point = sample(random);
    if (!point) continue;
    const Vec2<double> at = *point * resolution;
    if (!(at.x >= 0 && at.y >= 0 && at.x <= resolution.x && at.y <= resolution.y)) return std::nullopt;
    const auto x = static_cast<std::size_t>(std::min(at.x, resolution.x - 1));
    const auto y = static_cast<std::size_t>(std::min(at.y, resolution.y - 1));
    counts[y * width + x] += 1;
  }
  return counts;
}

/// How many points each cell should get by the density. Cells that differ much are integrated more finely: a peak may
/// hide between the points.
template <typename Density>
[[nodiscard]] std::vector<double> expected_points(const Density& density, const std::vector<double>& observed,
                                                  const ChiSquareOptions& options) {
  const double samples = options.samples;
  const Vec2<double> size = 1.0 / Vec2<double>(options.resolution);
  std::vector<double> expected;
  for (int y = 0; y < options.resolution.y; ++y) {
    for (int x = 0; x < options.resolution.x; ++x) {
      const Cell cell{Vec2<double>(x, y) * size, size};
      const double coarse = samples * integral(density, cell, 0.01 / samples, 0);
      const bool doubtful = !(std::abs(observed[expected.size()] - coarse) <= 3 * std::sqrt(coarse + 1));
      expected.push_back(doubtful ? samples * integral(density, cell, 0.01 / samples, 5) : coarse);
    }
  }
  return expected;
}

/// The test in the unit square: `sample(random)` gives a point or nothing, `density(point)` must integrate to the
/// chance of a point.
template <typename Sample, typename Density>
[[nodiscard]] ChiSquareResult chi_square_unit(const Sample& sample, const Density& density,
                                              const ChiSquareOptions& options) {
  const auto observed = counted_points(sample, options);
  if (!observed)
    return {.p_value = 0, .passed = false, .message = "FAILED: a sample is not finite or out of the domain"};
  const std::vector<double> expected = expected_points(density, *observed, options);
  const double samples = options.samples;
  const double accepted = std::accumulate(observed->begin(), observed->end(), 0.0);
  const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
  ChiSquareResult result = chi_square(*observed, expected, options);
  const double share = std::min(1.0, total / samples);
  const double allowed = 5 * std::sqrt(samples * share * (1 - share)) + 2e-3 * samples;
  std::ostringstream message;
  message << "; the density integrates to " << total / samples << ", accepted samples: " << accepted / samples;
  if (!(std::abs(total - accepted) <= allowed)) {
    result.p_value = 0;
    result.passed = false;
    message << "; FAILED: these two differ";
  }
  result.message += message.str();
  return result;
}

}  // namespace detail

/// Tests a routine that samples directions: `sample(u, uv)` gives a direction or nothing, `pdf(w)` says how densely.
///
/// Densities may integrate to less than one, by the chance that `sample` gives nothing. Peaks are integrated
/// adaptively; narrower than a hundredth of a cell they may be missed. Put a discontinuity on a border of cells.
///
/// Shapes:   u in [0, 1), uv in [0, 1)²; cells are of equal angles, z the pole.
/// Units:    pdf in 1/sr.
/// Errors:   a sample that is not finite fails the test.
template <typename Sample, typename Pdf>
[[nodiscard]] ChiSquareResult chi_square_sphere(const Sample& sample, const Pdf& pdf,
                                                const ChiSquareOptions& options = {}) {
  const auto to_unit = [&](Random& random) -> std::optional<Vec2<double>> {
    const float u = random.uniform<float>();
    const std::optional<Vec3<float>> w = sample(u, random.uniform_vec2());
    if (!w) return std::nullopt;
    const Vec3<double> d(*w);
    const double turn = std::atan2(d.y, d.x) * (0.5 * inv_pi<double>);
    return Vec2<double>{turn < 0 ? turn + 1 : turn, std::atan2(std::hypot(d.x, d.y), d.z) * inv_pi<double>};
  };
  const auto density = [&](const Vec2<double>& point) {
    const double phi = 2 * pi<double> * point.x;
    const double theta = pi<double> * point.y;
    const Vec3<double> w{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    return 2 * pi<double> * pi<double> * std::sin(theta) * static_cast<double>(pdf(Vec3<float>(w)));
  };
  return detail::chi_square_unit(to_unit, density, options);
}

/// Tests a routine that samples the unit square: `sample(uv)` gives a point or nothing, `pdf(point)` says how densely.
///
/// Shapes:   uv in [0, 1)².
template <typename Sample, typename Pdf>
[[nodiscard]] ChiSquareResult chi_square_square(const Sample& sample, const Pdf& pdf,
                                                const ChiSquareOptions& options = {}) {
  const auto to_unit = [&](Random& random) -> std::optional<Vec2<double>> {
    const std::optional<Vec2<float>> point = sample(random.uniform_vec2());
    if (!point) return std::nullopt;
    return Vec2<double>(*point);
  };
  const auto density = [&](const Vec2<double>& point) { return static_cast<double>(pdf(Vec2<float>(point))); };
  return detail::chi_square_unit(to_unit, density, options);
}

}  // namespace glint::testing
