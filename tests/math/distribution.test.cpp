// SPDX-License-Identifier: MIT
#include <glint/math/distribution.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <glint/math/random.hpp>
#include <glint/testing/chi_square.hpp>
#include <support/catch.hpp>

namespace test_math_distribution {

using glint::AliasTable;
using glint::Distribution1D;
using glint::Distribution2D;
using glint::Random;
using glint::Vec2;

namespace {

/// Weights over many orders of magnitude, a third of them zero, at least one not.
std::vector<float> random_weights(Random& random, std::size_t count) {
  std::vector<float> weights(count, 0.0F);
  for (float& weight : weights) {
    const float exponent = random.uniform(-6.0F, 6.0F);
    if (random.below(3) != 0) weight = std::pow(10.0F, exponent);
  }
  weights[random.below(static_cast<std::uint32_t>(count))] = 1;
  return weights;
}

double sum(const std::vector<float>& weights) {
  double total = 0;
  for (const float weight : weights) total += double(weight);
  return total;
}

}  // namespace

TEST_CASE("distribution: one interval of four gets its share of u", "[math][distribution]") {
  const Distribution1D distribution{std::array{1.0F, 3.0F, 0.0F, 4.0F}};  // ends at 1/8, 1/2, 1/2, 1
  CHECK(distribution.mean() == 2);
  const auto a = distribution.sample(0.0625F);  // halfway through the first
  CHECK(a.x == 0.125F);
  CHECK(a.pdf == 0.5F);  // 1 / 2
  CHECK(a.cell == 0);
  const auto b = distribution.sample(0.3125F);  // halfway through the second
  CHECK(b.x == 0.375F);
  CHECK(b.pdf == 1.5F);
  const auto c = distribution.sample(0.5F);  // the third is empty: the beginning of the fourth
  CHECK(c.x == 0.75F);
  CHECK(c.pdf == 2.0F);
  CHECK(c.cell == 3);
}

TEST_CASE("distribution: samples are those of a linear search", "[math][distribution]") {
  Random random{11};
  for (int run = 0; run < 50; ++run) {
    const auto weights = random_weights(random, 1 + random.below(40));
    const Distribution1D distribution{weights};
    const double total = sum(weights);
    for (int i = 0; i < 200; ++i) {
      const float u = random.uniform<float>();
      const auto sample = distribution.sample(u);
      double before = 0;
      for (std::size_t k = 0; k < sample.cell; ++k) before += double(weights[k]);
      // Ends of cells are rounded to float: half an ulp of one.
      REQUIRE(before / total <= double(u) + 6e-8);
      REQUIRE((before + double(weights[sample.cell])) / total >= double(u) - 6e-8);
      REQUIRE(weights[sample.cell] > 0);
      REQUIRE(sample.x >= 0);
      REQUIRE(sample.x < 1);
      REQUIRE(double(sample.pdf) == Approx(double(weights[sample.cell]) / total * double(weights.size())));
    }
  }
}

TEST_CASE("distribution: the density integrates to one and ignores bad weights", "[math][distribution]") {
  const float infinity = std::numeric_limits<float>::infinity();
  const Distribution1D distribution{std::array{1.0F, -1.0F, std::nanf(""), infinity, 3.0F}};
  float integral = 0;
  for (const float x : {0.1F, 0.3F, 0.5F, 0.7F, 0.9F}) integral += distribution.pdf(x) / 5;
  CHECK(integral == Approx(1));
  CHECK(distribution.pdf(0.3F) == 0);
  CHECK(distribution.pdf(0.5F) == 0);
  CHECK(distribution.pdf(0.7F) == 0);
}

TEST_CASE("distribution: lookups beyond the ends use the nearest cell", "[math][distribution]") {
  const Distribution1D distribution{std::array{1.0F, 3.0F}};
  CHECK(distribution.pdf(-1.0F) == 0.5F);
  CHECK(distribution.pdf(1.0F) == 1.5F);
  CHECK(distribution.pdf(1e30F) == 1.5F);
  CHECK(distribution.pdf(std::nanf("")) == 0.5F);
}

TEST_CASE("distribution: nothing to choose from has density zero", "[math][distribution]") {
  for (const auto& weights : {std::vector<float>{}, std::vector<float>(5, 0.0F)}) {
    const Distribution1D distribution{weights};
    CHECK(distribution.sample(0.7F).pdf == 0);
    CHECK(distribution.sample(0.7F).x < 1);
    CHECK(distribution.pdf(0.7F) == 0);
    CHECK(distribution.mean() == 0);
  }
  const Distribution2D grid{std::vector<float>(6, 0.0F), 3, 2};
  CHECK(grid.sample({0.2F, 0.9F}).pdf == 0);
  CHECK(grid.pdf({0.2F, 0.9F}) == 0);
  CHECK(Distribution2D{}.sample({0.2F, 0.9F}).pdf == 0);
}

TEST_CASE("distribution: even at the ends of [0, 1) no empty cell is chosen", "[math][distribution]") {
  const Distribution1D distribution{std::array{0.0F, 0.0F, 1e-3F, 1e6F, 1e-6F, 0.0F, 0.0F}};
  for (const float u : {0.0F, 1e-30F, 0.5F, glint::one_minus_epsilon<float>}) {
    CAPTURE(u);
    CHECK(distribution.sample(u).pdf > 0);
  }
}

TEST_CASE("distribution: x runs along the rows of a grid", "[math][distribution]") {
  const Distribution2D grid{std::array{0.0F, 0.0F, 0.0F,  //
                                       0.0F, 0.0F, 1.0F},
                            3, 2};
  const auto sample = grid.sample({0.5F, 0.5F});
  CHECK(sample.point.x == Approx(2.5 / 3));
  CHECK(sample.point.y == 0.75F);
  CHECK(sample.pdf == 6);  // one cell of six
  CHECK(grid.pdf(sample.point) == 6);
  CHECK(grid.pdf({0.1F, 0.1F}) == 0);
  CHECK(grid.mean() == Approx(1.0 / 6));
}

TEST_CASE("distribution: points over a grid have their density", "[math][distribution]") {
  Random random{12};
  constexpr int width = 13;
  constexpr int height = 7;
  std::vector<float> weights(static_cast<std::size_t>(width) * height);
  for (float& weight : weights) weight = random.below(4) == 0 ? 0.0F : random.uniform<float>();
  const Distribution2D grid{weights, width, height};
  const auto result = glint::testing::chi_square_square([&](const Vec2<float>& u) { return grid.sample(u).point; },
                                                        [&](const Vec2<float>& point) { return grid.pdf(point); },
                                                        {.resolution = {width, height}});
  INFO(result.message);
  CHECK(result.passed);
  for (int i = 0; i < 1000; ++i) {
    const auto sample = grid.sample(random.uniform_vec2());
    REQUIRE(sample.pdf > 0);
    REQUIRE(grid.pdf(sample.point) == sample.pdf);
  }
}

TEST_CASE("distribution: huge weights do not overflow", "[math][distribution]") {
  const Distribution2D grid{std::vector<float>(8, 3e38F), 4, 2};
  CHECK(grid.pdf({0.4F, 0.4F}) == 1);
  CHECK(grid.sample({0.4F, 0.4F}).pdf == 1);
}

TEST_CASE("distribution: an alias table gives each index its exact share of u", "[math][distribution]") {
  Random random{13};
  for (int run = 0; run < 20; ++run) {
    const auto weights = random_weights(random, 1 + random.below(50));
    const AliasTable table{weights};
    constexpr int steps = 100'000;
    std::vector<int> counts(weights.size(), 0);
    for (int i = 0; i < steps; ++i) {
      const auto chosen = table.sample((i + 0.5) / steps);
      REQUIRE(chosen.probability == table.probability(chosen.index));
      ++counts[chosen.index];
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double share = double(weights[i]) / sum(weights);
      CAPTURE(run, i);
      REQUIRE(double(table.probability(i)) == Approx(share).epsilon(1e-6));
      // Each of the up to n + 1 pieces of [0, 1) that belong to an index is off by at most one step at either end.
      REQUIRE(std::abs(counts[i] - share * steps) <= 2.0 * double(weights.size() + 1));
      if (weights[i] == 0) REQUIRE(counts[i] == 0);
    }
  }
}

TEST_CASE("distribution: an alias table of equal weights is the identity on bins", "[math][distribution]") {
  for (std::size_t count = 1; count < 200; ++count) {
    const AliasTable table{std::vector<float>(count, 0.1F)};
    for (std::size_t i = 0; i < count; ++i) {
      REQUIRE(table.sample((double(i) + 0.5) / double(count)).index == i);
    }
    REQUIRE(table.sample(glint::one_minus_epsilon<float>).index == count - 1);
  }
}

TEST_CASE("distribution: an alias table never chooses a weight of zero", "[math][distribution]") {
  Random random{14};
  for (int run = 0; run < 500; ++run) {
    const auto weights = random_weights(random, 1 + random.below(100));
    const AliasTable table{weights};
    for (int i = 0; i < 100; ++i) {
      const auto chosen = table.sample(random.uniform<float>());
      REQUIRE(weights[chosen.index] > 0);
      REQUIRE(chosen.probability > 0);
    }
    REQUIRE(weights[table.sample(0.0F).index] > 0);
    REQUIRE(weights[table.sample(glint::one_minus_epsilon<float>).index] > 0);
  }
}

TEST_CASE("distribution: an alias table of nothing has probability zero", "[math][distribution]") {
  CHECK(AliasTable{}.sample(0.5F).probability == 0);
  CHECK(AliasTable{}.total() == 0);
  const AliasTable zeros{std::array{0.0F, -1.0F, std::nanf("")}};
  CHECK(zeros.sample(0.5F).probability == 0);
  CHECK(zeros.probability(1) == 0);
  CHECK(zeros.size() == 3);
}

}  // namespace test_math_distribution
