// SPDX-License-Identifier: MIT
#include <glint/sampler/stratified.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glint/testing/sampler_laws.hpp>
#include <support/catch.hpp>

namespace test_sampler_stratified {

using glint::permuted;
using glint::Stratified;

namespace {

/// How many samples the fullest of the intervals, or cells, holds.
int fullest(const std::vector<int>& cells) {
  return *std::max_element(cells.begin(), cells.end());
}

std::size_t cell(float x, int cells) {
  return static_cast<std::size_t>(x * static_cast<float>(cells));
}

/// The samples of one pattern in one dimension: the fourth 1D, or the fourth pair.
std::vector<glint::Vec2<float>> pairs(const Stratified& sequence, int first) {
  std::vector<glint::Vec2<float>> result;
  for (int i = 0; i < sequence.samples_per_pixel; ++i) {
    auto sampler = sequence.stream({3, 4}, first + i);
    for (int skip = 0; skip < 3; ++skip) static_cast<void>(sampler.next_2d());
    result.push_back(sampler.next_2d());
  }
  return result;
}

}  // namespace

TEST_CASE("stratified: a permutation hits each index once", "[sampler][stratified]") {
  for (std::uint32_t count = 1; count < 130; ++count) {
    for (std::uint64_t key = 0; key < 20; ++key) {
      std::vector<int> hits(count, 0);
      for (std::uint32_t i = 0; i < count; ++i) ++hits.at(permuted(i, count, glint::mix(key)));
      CAPTURE(count, key);
      REQUIRE(fullest(hits) == 1);
    }
  }
}

TEST_CASE("stratified: over random keys each index goes to each place equally often", "[sampler][stratified]") {
  const auto count = GENERATE(2U, 4U, 7U, 16U, 31U);
  std::vector<double> observed(count, 0.0);
  const std::vector<double> expected(count, 1000.0);
  for (std::uint64_t key = 0; key < 1000 * count; ++key) ++observed[permuted(count / 3, count, glint::mix(key))];
  const auto result = glint::testing::chi_square(observed, expected, {.tests = 5});
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("stratified: over random keys two indices go to all pairs of places nearly equally often",
          "[sampler][stratified]") {
  const auto count = GENERATE(3U, 4U, 7U, 16U, 31U);
  for (const std::uint32_t other : {1U, count / 2, count - 1}) {
    CAPTURE(count, other);
    const std::size_t pairs = std::size_t{count} * (count - 1);
    std::vector<double> observed(std::size_t{count} * count, 0.0);
    for (std::uint64_t key = 0; key < 400 * pairs; ++key) {
      const std::uint64_t hashed = glint::mix(key);
      ++observed[permuted(0, count, hashed) * count + permuted(other, count, hashed)];
    }
    double squares = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
      const bool possible = i % (count + 1) != 0;  // two indices never share a place
      if (possible) squares += std::pow(observed[i] / 400 - 1, 2);
      if (!possible) REQUIRE(observed[i] == 0);
    }
    CHECK(std::sqrt(squares / double(pairs)) < 0.1);  // counting alone departs by 1/√400 = 5 %
  }
}

TEST_CASE("stratified: obeys the laws of sample sequences", "[sampler][stratified][laws]") {
  const auto samples = GENERATE(1, 7, 16, 64);
  CAPTURE(samples);
  const auto violations = glint::testing::violations_of_sampler_laws(
      Stratified{.samples_per_pixel = samples, .seed = 5}, {.samples = 4096 / samples * samples});
  for (const std::string& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

TEST_CASE("stratified: each interval of a number holds one sample", "[sampler][stratified]") {
  const auto count = GENERATE(1, 2, 3, 7, 16, 30, 100, 1000);
  const auto pattern = GENERATE(0, 1, 5);
  CAPTURE(count, pattern);
  std::vector<int> intervals(static_cast<std::size_t>(count), 0);
  for (int i = 0; i < count; ++i) {
    auto sampler = Stratified{.samples_per_pixel = count, .seed = 1}.stream({1, 2}, pattern * count + i);
    static_cast<void>(sampler.next_1d());
    ++intervals.at(cell(sampler.next_1d(), count));
  }
  CHECK(fullest(intervals) == 1);
}

TEST_CASE("stratified: a pair is stratified as a grid and in both coordinates", "[sampler][stratified]") {
  const auto side = GENERATE(1, 2, 3, 4, 8, 10, 32);
  const auto pattern = GENERATE(0, 1, 5);
  const int count = side * side;
  CAPTURE(side, pattern);
  std::vector<int> columns(static_cast<std::size_t>(count), 0);
  std::vector<int> rows(static_cast<std::size_t>(count), 0);
  std::vector<int> cells(static_cast<std::size_t>(count), 0);
  for (const auto& p : pairs({.samples_per_pixel = count, .seed = 2}, pattern * count)) {
    ++columns.at(cell(p.x, count));
    ++rows.at(cell(p.y, count));
    ++cells.at(cell(p.y, side) * static_cast<std::size_t>(side) + cell(p.x, side));
  }
  CHECK(fullest(columns) == 1);
  CHECK(fullest(rows) == 1);
  CHECK(fullest(cells) == 1);
}

TEST_CASE("stratified: counts that are no squares are stratified too", "[sampler][stratified]") {
  const auto count = GENERATE(2, 3, 5, 6, 7, 12, 13, 20, 97, 200);
  CAPTURE(count);
  const int columns = static_cast<int>(std::sqrt(float(count)));
  const int rows = (count + columns - 1) / columns;
  std::vector<int> fine(static_cast<std::size_t>(columns * rows), 0);
  std::vector<int> lines(static_cast<std::size_t>(count), 0);
  std::vector<int> cells(static_cast<std::size_t>(columns * rows), 0);
  for (const auto& p : pairs({.samples_per_pixel = count, .seed = 3}, 0)) {
    ++fine.at(cell(p.x, columns * rows));
    ++lines.at(cell(p.y, count));
    // Rows of cells begin every `columns` lines; the last may be lower.
    ++cells.at(cell(p.y, count) / static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns) +
               cell(p.x, columns));
  }
  CHECK(fullest(fine) == 1);
  CHECK(fullest(lines) == 1);
  CHECK(fullest(cells) == 1);
}

TEST_CASE("stratified: the samples after the last begin a fresh pattern", "[sampler][stratified]") {
  const Stratified sequence{.samples_per_pixel = 16, .seed = 4};
  CHECK(pairs(sequence, 0) != pairs(sequence, 16));
}

TEST_CASE("stratified: an edge has far less error than by independent numbers", "[sampler][stratified]") {
  // Half of the square is below the edge: 256 independent samples err by √(1/4 / 256) = 1/32 on average.
  double squares = 0;
  for (int pixel = 0; pixel < 64; ++pixel) {
    double sum = 0;
    for (int i = 0; i < 256; ++i) {
      const auto p = Stratified{.samples_per_pixel = 256}.stream({pixel, 0}, i).next_2d();
      sum += p.y < 0.2F + 0.6F * p.x ? 1 : 0;
    }
    squares += std::pow(sum / 256 - 0.5, 2);
  }
  CHECK(std::sqrt(squares / 64) < 1.0 / 32 / 4);
}

}  // namespace test_sampler_stratified
