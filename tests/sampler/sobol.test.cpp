// SPDX-License-Identifier: MIT
#include <glint/sampler/sobol.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstdint>
#include <string>

#include <glint/sampler/independent.hpp>
#include <glint/testing/sampler_laws.hpp>
#include <support/catch.hpp>

namespace test_sampler_sobol {

using glint::Sobol;
using glint::Vec2;

namespace {

/// The mean square, over pixels, by which a pixel's average of f over its fourth pair differs from the integral.
template <typename Q, typename F>
double mean_square_error(const Q& sequence, int samples, double integral, const F& f) {
  constexpr int pixels = 1024;
  double squares = 0;
  for (int pixel = 0; pixel < pixels; ++pixel) {
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
      auto sampler = sequence.stream({pixel % 32, pixel / 32}, i);
      for (int skip = 0; skip < 3; ++skip) static_cast<void>(sampler.next_2d());
      const Vec2<double> point(sampler.next_2d());
      sum += f(point);
    }
    squares += std::pow(sum / samples - integral, 2);
  }
  return squares / pixels;
}

}  // namespace

TEST_CASE("sobol: obeys the laws of sample sequences", "[sampler][sobol][laws]") {
  const auto seed = GENERATE(range(0U, 3U));
  CAPTURE(seed);
  const auto violations = glint::testing::violations_of_sampler_laws(Sobol{.seed = seed}, {.dispersion = 3});
  for (const std::string& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

TEST_CASE("sobol: every 2^m samples are nets, in each number and in each pair", "[sampler][sobol][laws]") {
  const auto seed = GENERATE(range(0U, 3U));
  CAPTURE(seed);
  const auto violations = glint::testing::violations_of_net_laws(Sobol{.seed = seed}, {static_cast<int>(seed), 5});
  for (const std::string& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

TEST_CASE("sobol: the thousandth dimension is as good as the first", "[sampler][sobol]") {
  struct Late {
    [[nodiscard]] static auto stream(const glint::Vec2i& pixel, int sample) {
      auto sampler = Sobol{}.stream(pixel, sample);
      for (int i = 0; i < 1000; ++i) static_cast<void>(sampler.next_1d());
      return sampler;
    }
  };
  CHECK(glint::testing::violations_of_sampler_laws(Late{}, {.samples = 1024, .pixels = {32, 32}, .dispersion = 3})
            .empty());
  CHECK(glint::testing::violations_of_net_laws(Late{}, {3, 4}, 5).empty());
}

TEST_CASE("sobol: seeds and pixels give different numbers", "[sampler][sobol]") {
  const float first = Sobol{.seed = 1}.stream({2, 3}, 4).next_1d();
  CHECK(first != Sobol{.seed = 2}.stream({2, 3}, 4).next_1d());
  CHECK(first != Sobol{.seed = 1 + (std::uint64_t{1} << 32)}.stream({2, 3}, 4).next_1d());
  CHECK(first != Sobol{.seed = 1}.stream({3, 2}, 4).next_1d());
}

TEST_CASE("sobol: the error of a linear function falls with the power -3/2 of the samples", "[sampler][sobol]") {
  // One number, uniform in each of N intervals, whatever the others are: a variance of (1/12 N²) / N. Half of it is to
  // tell from 1/12 N, which is N² times that. The mean of 1024 squares is off by √(2 / 1024) = 4.4 % on average.
  for (const int samples : {1, 4, 16, 64}) {
    CAPTURE(samples);
    const double variance = 1.0 / 12 / std::pow(samples, 3);
    const auto x = [](const Vec2<double>& p) { return p.x; };
    const auto y = [](const Vec2<double>& p) { return p.y; };
    CHECK(mean_square_error(Sobol{}, samples, 0.5, x) == Approx(variance).epsilon(0.25));
    CHECK(mean_square_error(Sobol{}, samples, 0.5, y) == Approx(variance).epsilon(0.25));
  }
}

TEST_CASE("sobol: a smooth function of a pair has hundreds of times less variance than by independent numbers",
          "[sampler][sobol]") {
  // f = x y, N = 64 = 2⁶. Independent: (1/9 − 1/16) / N = 7/144 / 64 = 7.6e-4. With x = 1/2 + a, y = 1/2 + b:
  // f = 1/4 + a / 2 + b / 2 + a b. The terms linear in a or b have 2 · 1/4 · 1/12 N³ = 1.6e-7. The binary digits j of a
  // and k of b contribute 4^−(j + k) / 16 to the variance of a b; a net is without those of j + k ≤ 6, and at most
  // doubles the others: 2 / N · Σ (s − 1) 4^−s / 16 over s ≥ 7 = 2 / 64 · 4⁻⁷ / 16 · (6 · 4/3 + 4/9) = 1.0e-6.
  // So the ratio is at least 7.6e-4 / 1.2e-6 = 650; we allow for twice that variance.
  const auto product = [](const Vec2<double>& p) { return p.x * p.y; };
  const double independent = mean_square_error(glint::Independent{}, 64, 0.25, product);
  const double sobol = mean_square_error(Sobol{}, 64, 0.25, product);
  CAPTURE(independent, sobol);
  CHECK(independent == Approx(7.0 / 144 / 64).epsilon(0.25));
  CHECK(sobol < independent / 325);
}

}  // namespace test_sampler_sobol
