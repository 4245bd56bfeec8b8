// SPDX-License-Identifier: MIT
#include <glint/testing/chi_square.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <glint/math/frame.hpp>
#include <glint/math/warp.hpp>
#include <support/catch.hpp>

namespace test_testing_chi_square {

using glint::pi;
using glint::Vec2;
using glint::Vec3;
using glint::testing::chi_square;
using glint::testing::chi_square_p_value;
using glint::testing::chi_square_sphere;
using glint::testing::chi_square_square;
using glint::testing::regularized_gamma_q;

namespace {

Vec3<float> cosine(float /*u*/, const Vec2<float>& uv) {
  return glint::cosine_hemisphere(uv);
}
float cosine_pdf(const Vec3<float>& w) {
  return glint::cosine_hemisphere_pdf(w.z);
}

/// A lobe cosⁿ around an axis with its density.
struct PowerLobe {
  Vec3<float> axis;
  float exponent;

  [[nodiscard]] Vec3<float> sample(const Vec2<float>& uv) const {
    const float z = std::pow(uv.x, 1 / (exponent + 1));
    const float r = std::sqrt(std::max(0.0F, 1 - z * z));
    const float phi = 2 * pi<float> * uv.y;
    return glint::Frame<float>::around(axis).to_world({r * std::cos(phi), r * std::sin(phi), z});
  }
  [[nodiscard]] float pdf(const Vec3<float>& w) const {
    const float z = glm::dot(w, axis);
    return z > 0 ? (exponent + 1) / (2 * pi<float>)*std::pow(z, exponent) : 0;
  }
};

}  // namespace

TEST_CASE("chi_square: the incomplete gamma function has its closed forms", "[testing][chi_square]") {
  for (const double x : {0.01, 0.3, 1.0, 2.5, 7.0, 30.0}) {
    CAPTURE(x);
    CHECK(regularized_gamma_q(1, x) == Approx(std::exp(-x)).epsilon(1e-12));
    CHECK(regularized_gamma_q(0.5, x) == Approx(std::erfc(std::sqrt(x))).epsilon(1e-12));
    // For whole a: the chance of fewer than a Poisson events of mean x.
    CHECK(regularized_gamma_q(4, x) == Approx(std::exp(-x) * (1 + x + x * x / 2 + x * x * x / 6)).epsilon(1e-12));
  }
  CHECK(regularized_gamma_q(3, 0) == 1);
}

TEST_CASE("chi_square: the incomplete gamma function obeys its recurrence on both sides of the mean",
          "[testing][chi_square]") {
  for (const double a : {2.5, 50.0, 500.0, 5000.0}) {
    for (const double ratio : {0.9, 0.99, 1.0, 1.01, 1.1}) {
      const double x = a * ratio;
      CAPTURE(a, x);
      const double step = std::exp(a * std::log(x) - x - std::lgamma(a + 1));  // x^a e^−x / Γ(a + 1)
      CHECK(regularized_gamma_q(a + 1, x) == Approx(regularized_gamma_q(a, x) + step).epsilon(1e-9));
    }
  }
}

TEST_CASE("chi_square: critical values are those of the printed tables", "[testing][chi_square]") {
  CHECK(chi_square_p_value(3.841, 1) == Approx(0.05).epsilon(1e-3));
  CHECK(chi_square_p_value(18.307, 10) == Approx(0.05).epsilon(1e-3));
  CHECK(chi_square_p_value(135.807, 100) == Approx(0.01).epsilon(1e-3));
}

TEST_CASE("chi_square: many tests share one significance", "[testing][chi_square]") {
  CHECK(glint::testing::sidak(0.01, 1) == Approx(0.01));
  const double each = glint::testing::sidak(0.01, 50);
  CHECK(1 - std::pow(1 - each, 50) == Approx(0.01));
}

TEST_CASE("chi_square: counts near the expectation pass, far ones fail", "[testing][chi_square]") {
  const std::array expected{100.0, 100.0, 100.0, 100.0};
  CHECK(chi_square(std::array{90.0, 105.0, 110.0, 95.0}, expected).passed);  // χ² = 2.5, three degrees of freedom
  CHECK(chi_square(std::array{90.0, 105.0, 110.0, 95.0}, expected).p_value == Approx(0.4753).epsilon(1e-3));
  CHECK_FALSE(chi_square(std::array{50.0, 150.0, 100.0, 100.0}, expected).passed);
}

TEST_CASE("chi_square: counts where none are expected fail", "[testing][chi_square]") {
  const std::array expected{1000.0, 0.0};
  CHECK(chi_square(std::array{1000.0, 0.0}, expected).passed);
  CHECK_FALSE(chi_square(std::array{1000.0, 3.0}, expected).passed);
  CHECK_FALSE(chi_square(std::array{1000.0, 0.0}, std::array{1000.0, std::nan("")}).passed);
}

TEST_CASE("chi_square: rare cells are pooled, not divided by", "[testing][chi_square]") {
  // A hundred cells of mean 0.1 make one of mean 10.
  std::array<double, 101> expected{};
  std::array<double, 101> observed{};
  expected.fill(0.1);
  expected[0] = 1000;
  observed[0] = 1000;
  observed[7] = 9;
  CHECK(chi_square(observed, expected).passed);  // as a cell of its own: 8.9² / 0.1 = 792
  observed[8] = 40;
  CHECK_FALSE(chi_square(observed, expected).passed);
}

TEST_CASE("chi_square: under the null hypothesis p is uniform", "[testing][chi_square]") {
  int below_half = 0;
  int below_tenth = 0;
  constexpr int runs = 200;
  for (int seed = 0; seed < runs; ++seed) {
    const auto result =
        chi_square_sphere(cosine, cosine_pdf, {.samples = 10'000, .resolution = {8, 8}, .seed = std::uint64_t(seed)});
    below_half += result.p_value < 0.5 ? 1 : 0;
    below_tenth += result.p_value < 0.1 ? 1 : 0;
  }
  CHECK(std::abs(below_half - 100) < 4 * 7.1);  // σ = √(200 / 4)
  CHECK(std::abs(below_tenth - 20) < 4 * 4.3);  // σ = √(200 · 0.09)
}

TEST_CASE("chi_square: the warps of directions have their densities", "[testing][chi_square]") {
  const auto cosine_result = chi_square_sphere(cosine, cosine_pdf, {.tests = 3});
  INFO(cosine_result.message);
  CHECK(cosine_result.passed);
  const auto sphere =
      chi_square_sphere([](float, const Vec2<float>& uv) { return glint::uniform_sphere(uv); },
                        [](const Vec3<float>&) { return glint::uniform_sphere_pdf<float>(); }, {.tests = 3});
  INFO(sphere.message);
  CHECK(sphere.passed);
  constexpr float extent = 0.29289322F;  // 1 − cos 45°, a border of cells
  const auto cone = chi_square_sphere(
      [](float, const Vec2<float>& uv) { return glint::uniform_cone(uv, extent); },
      [](const Vec3<float>& w) { return 1 - w.z <= extent ? glint::uniform_cone_pdf(extent) : 0.0F; }, {.tests = 3});
  INFO(cone.message);
  CHECK(cone.passed);
}

TEST_CASE("chi_square: a wrong density is found out", "[testing][chi_square]") {
  const auto uniform = [](const Vec3<float>& w) { return w.z > 0 ? glint::uniform_hemisphere_pdf<float>() : 0.0F; };
  CHECK_FALSE(chi_square_sphere(cosine, uniform).passed);  // right integral, wrong shape
  const auto scaled = [](const Vec3<float>& w) { return 1.05F * cosine_pdf(w); };
  CHECK_FALSE(chi_square_sphere(cosine, scaled).passed);  // right shape, wrong integral
  const auto empty = [](const Vec3<float>&) { return 0.0F; };
  CHECK_FALSE(chi_square_sphere(cosine, empty).passed);
  const auto nan = [](const Vec3<float>&) { return std::numeric_limits<float>::quiet_NaN(); };
  CHECK_FALSE(chi_square_sphere(cosine, nan, {.samples = 1000, .resolution = {4, 4}}).passed);
}

TEST_CASE("chi_square: a sample that is not finite is found out", "[testing][chi_square]") {
  const auto bad = [](float u, const Vec2<float>& uv) {
    return u < 0.001F ? Vec3<float>(std::nanf("")) : glint::cosine_hemisphere(uv);
  };
  CHECK_FALSE(chi_square_sphere(bad, cosine_pdf).passed);
}

TEST_CASE("chi_square: samples may fail as often as the density leaves out", "[testing][chi_square]") {
  const auto seldom = [](float u, const Vec2<float>& uv) -> std::optional<Vec3<float>> {
    if (u < 0.3F) return std::nullopt;
    return glint::cosine_hemisphere(uv);
  };
  const auto result = chi_square_sphere(seldom, [](const Vec3<float>& w) { return 0.7F * cosine_pdf(w); });
  INFO(result.message);
  CHECK(result.passed);
  CHECK_FALSE(chi_square_sphere(seldom, cosine_pdf).passed);
}

TEST_CASE("chi_square: narrow lobes in any direction are integrated", "[testing][chi_square]") {
  const float exponent = GENERATE(30.0F, 1000.0F, 10'000.0F);  // the last: 0.6° wide, cells are 11°
  const int turn = GENERATE(range(0, 4));
  CAPTURE(exponent, turn);
  const PowerLobe lobe{glm::normalize(Vec3<float>{std::cos(float(turn)), std::sin(float(turn)), 0.3F * float(turn)}),
                       exponent};
  const auto result = chi_square_sphere([&](float, const Vec2<float>& uv) { return lobe.sample(uv); },
                                        [&](const Vec3<float>& w) { return lobe.pdf(w); }, {.tests = 12});
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("chi_square: a narrow lobe that is shifted or too wide is found out", "[testing][chi_square]") {
  const PowerLobe drawn{glm::normalize(Vec3<float>{1, 2, 3}), 300};
  const PowerLobe wider{drawn.axis, 270};
  const PowerLobe shifted{glm::normalize(Vec3<float>{1, 2, 3.05F}), 300};
  for (const PowerLobe& claimed : {wider, shifted}) {
    CHECK_FALSE(chi_square_sphere([&](float, const Vec2<float>& uv) { return drawn.sample(uv); },
                                  [&](const Vec3<float>& w) { return claimed.pdf(w); })
                    .passed);
  }
}

TEST_CASE("chi_square: densities over the unit square", "[testing][chi_square]") {
  // p(x, y) = 4 x y, by inversion of x²
  const auto sample = [](const Vec2<float>& uv) { return Vec2<float>{std::sqrt(uv.x), std::sqrt(uv.y)}; };
  const auto result = chi_square_square(sample, [](const Vec2<float>& p) { return 4 * p.x * p.y; });
  INFO(result.message);
  CHECK(result.passed);
  CHECK_FALSE(chi_square_square(sample, [](const Vec2<float>&) { return 1.0F; }).passed);
}

}  // namespace test_testing_chi_square
