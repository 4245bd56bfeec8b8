// SPDX-License-Identifier: MIT
#include <glint/sampler/halton.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glint/testing/sampler_laws.hpp>
#include <support/catch.hpp>

namespace test_sampler_halton {

using glint::Halton;

namespace {

/// The numbers of dimension `dimension`, counted from 0, of samples one after the other.
std::vector<double> numbers(const Halton& sequence, int dimension, int first, int count) {
  std::vector<double> result;
  for (int i = first; i < first + count; ++i) {
    auto sampler = sequence.stream({3, 4}, i);
    for (int skip = 0; skip < dimension; ++skip) static_cast<void>(sampler.next_1d());
    result.push_back(static_cast<double>(sampler.next_1d()));
  }
  return result;
}

/// Numbers are rounded downward to 2⁻²⁴, which may carry them over the lower border of their interval.
std::size_t interval(double x, int count) {
  return static_cast<std::size_t>((x + 0x1p-25) * count);
}

int fullest(const std::vector<int>& cells) {
  return *std::max_element(cells.begin(), cells.end());
}

constexpr int set_size = static_cast<int>(glint::HaltonSampler::bases.size());

}  // namespace

TEST_CASE("halton: obeys the laws of sample sequences", "[sampler][halton][laws]") {
  const auto seed = GENERATE(range(0U, 3U));
  CAPTURE(seed);
  const auto violations = glint::testing::violations_of_sampler_laws(Halton{.seed = seed});
  for (const std::string& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

TEST_CASE("halton: of every b^m samples each interval of a number of base b holds one", "[sampler][halton]") {
  const auto [dimension, base] = GENERATE(std::pair{0, 2}, std::pair{1, 3}, std::pair{2, 5}, std::pair{3, 7});
  const int block = GENERATE(0, 1, 5);
  for (int count = base; count < 1000; count *= base) {
    CAPTURE(base, count, block);
    std::vector<int> intervals(static_cast<std::size_t>(count), 0);
    for (const double x : numbers(Halton{}, dimension, block * count, count)) ++intervals.at(interval(x, count));
    CHECK(fullest(intervals) == 1);
  }
}

TEST_CASE("halton: of any b^m c^n samples each rectangle of a pair of bases b and c holds one", "[sampler][halton]") {
  const int first = GENERATE(0, 17, 65000);
  const auto check = [&](int dimension, int columns, int rows) {
    CAPTURE(first, dimension, columns, rows);
    const auto x = numbers(Halton{.seed = 2}, dimension, first, columns * rows);
    const auto y = numbers(Halton{.seed = 2}, dimension + 1, first, columns * rows);
    std::vector<int> cells(x.size(), 0);
    for (std::size_t i = 0; i < x.size(); ++i)
      ++cells.at(interval(y[i], rows) * std::size_t(columns) + interval(x[i], columns));
    CHECK(fullest(cells) == 1);
  };
  check(0, 2, 3);
  check(0, 8, 9);
  check(0, 16, 27);
  check(1, 3, 5);
  check(2, 5, 7);
  check(2, 25, 7);
}

TEST_CASE("halton: a pair is two numbers, and does not straddle two sets of bases", "[sampler][halton]") {
  auto pairs = Halton{}.stream({1, 2}, 3);
  auto singles = Halton{}.stream({1, 2}, 3);
  for (int i = 0; i < set_size; i += 2) {
    const auto pair = pairs.next_2d();
    CHECK(pair.x == singles.next_1d());
    CHECK(pair.y == singles.next_1d());
  }
  // One number less to begin with: the set's last would be the first of a pair, which begins the next set instead.
  auto skipping = Halton{}.stream({1, 2}, 3);
  auto plain = Halton{}.stream({1, 2}, 3);
  for (int i = 0; i < set_size - 1; ++i) CHECK(skipping.next_1d() == plain.next_1d());
  CHECK(skipping.next_2d().x != plain.next_1d());
}

TEST_CASE("halton: when the bases begin anew, blocks of 2^m samples are still spread evenly, and otherwise",
          "[sampler][halton]") {
  for (const int count : {2, 16, 256}) {
    const auto early = numbers(Halton{}, 0, count, count);
    const auto late = numbers(Halton{}, set_size, count, count);
    const auto later = numbers(Halton{}, 2 * set_size, count, count);
    std::vector<int> intervals(late.size(), 0);
    for (const double x : late) ++intervals.at(interval(x, count));
    CHECK(fullest(intervals) == 1);
    // As 1/12 is a number's variance, its correlations are Σ 12 (a − 1/2) (b − 1/2) / n, of deviation 1/√n.
    if (count < 256) continue;
    for (const auto& [a, b] : {std::pair{early, late}, std::pair{late, later}}) {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i) sum += 12 * (a[i] - 0.5) * (b[i] - 0.5);
      CHECK(std::abs(sum / count) < 4 / std::sqrt(count));
    }
  }
}

TEST_CASE("halton: sample 65536 begins a fresh pattern", "[sampler][halton]") {
  CHECK(Halton{}.stream({1, 2}, 0).next_1d() != Halton{}.stream({1, 2}, 65536).next_1d());
}

TEST_CASE("halton: the error of linear functions falls with the power -3/2 of the samples", "[sampler][halton]") {
  // As for one number uniform in each of N = bᵐ intervals: (1/12 N²) / N. 1024 squares: off by 4.4 % on average.
  const auto [dimension, samples] = GENERATE(std::pair{0, 64}, std::pair{1, 81}, std::pair{2, 125}, std::pair{7, 19});
  double squares = 0;
  for (std::uint64_t seed = 0; seed < 1024; ++seed) {
    double sum = 0;
    for (const double x : numbers(Halton{.seed = seed}, dimension, 0, samples)) sum += x;
    squares += std::pow(sum / samples - 0.5, 2);
  }
  CHECK(squares / 1024 == Approx(1.0 / 12 / std::pow(samples, 3)).epsilon(0.25));
}

}  // namespace test_sampler_halton
