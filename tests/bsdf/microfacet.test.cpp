// SPDX-License-Identifier: MIT
#include <glint/bsdf/microfacet.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include <support/catch.hpp>

#include <glint/math/random.hpp>
#include <glint/testing/chi_square.hpp>

namespace test_bsdf_microfacet {

using glint::Beckmann;
using glint::Ggx;
using glint::Vec3;

namespace {

/// The integral over the upper hemisphere, by the midpoint rule in angles.
template <typename F>
double over_hemisphere(const F& f) {
  constexpr int rows = 400;
  constexpr int columns = 400;
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const double theta = (i + 0.5) / rows * glint::pi<double> / 2;
    for (int j = 0; j < columns; ++j) {
      const double phi = (j + 0.5) / columns * 2 * glint::pi<double>;
      const Vec3<double> m{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
      sum += std::sin(theta) * static_cast<double>(f(Vec3<float>(m)));
    }
  }
  return sum * glint::pi<double> * glint::pi<double> / (rows * columns);
}

Vec3<float> direction(double theta_degrees, double phi) {
  const double theta = glint::radians(theta_degrees);
  return Vec3<float>(Vec3<double>{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
}

template <typename Distribution>
std::vector<Distribution> distributions() {
  return {{0.2F, 0.2F}, {0.5F, 0.15F}, {1.0F, 1.0F}, {0.3F, 0.8F}};
}

const std::vector<double> polar_angles{0, 20, 60, 80, 89};

}  // namespace

TEMPLATE_TEST_CASE("microfacet: the facets over a unit of surface project onto a unit", "[bsdf][microfacet]", Beckmann,
                   Ggx) {
  for (const auto& d : distributions<TestType>()) {
    CAPTURE(d.alpha_x, d.alpha_y);
    CHECK(over_hemisphere([&](const Vec3<float>& m) { return d.density(m) * m.z; }) == Approx(1).epsilon(1e-3));
  }
}

TEMPLATE_TEST_CASE("microfacet: projected_area is the area of the facets facing a direction", "[bsdf][microfacet]",
                   Beckmann, Ggx) {
  for (const auto& d : distributions<TestType>()) {
    for (const double theta : polar_angles) {
      const Vec3<float> w = direction(theta, 0.7);
      CAPTURE(d.alpha_x, d.alpha_y, theta);
      const double area =
          over_hemisphere([&](const Vec3<float>& m) { return std::max(0.0F, glm::dot(w, m)) * d.density(m); });
      CHECK(d.projected_area(w) == Approx(area).epsilon(2e-3));
    }
  }
}

TEST_CASE("microfacet: the peak of either density is 1 / (π alpha_x alpha_y)", "[bsdf][microfacet]") {
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  CHECK(Beckmann{0.2F, 0.5F}.density(up) == Approx(10 / glint::pi<double>));
  CHECK(Ggx{0.2F, 0.5F}.density(up) == Approx(10 / glint::pi<double>));
  CHECK(Beckmann{}.density({1.0F, 0.0F, 0.0F}) == 0.0F);
  CHECK(Ggx{}.density(-up) == 0.0F);
}

TEST_CASE("microfacet: the masking of GGX is 2 / (1 + √(1 + α² tan² θ))", "[bsdf][microfacet]") {
  for (const double theta : polar_angles) {
    const double tan = std::tan(glint::radians(theta));
    const double expected = 2 / (1 + std::sqrt(1 + 0.09 * tan * tan));
    CHECK(masking(Ggx{0.3F, 0.3F}, direction(theta, 1.0)) == Approx(expected).epsilon(1e-4));
  }
}

TEST_CASE("microfacet: Beckmann's Λ is (erf a − 1) / 2 + exp(−a²) / (2 a √π), a = 1 / (α tan θ)",
          "[bsdf][microfacet]") {
  for (const double theta : polar_angles) {
    CAPTURE(theta);
    const double a = 1 / (0.3 * std::tan(glint::radians(theta)));
    const double expected = 0.5 * (std::erf(a) - 1) + std::exp(-a * a) / (2 * a * std::sqrt(glint::pi<double>));
    CHECK(smith_lambda(Beckmann{0.3F, 0.3F}, direction(theta, 1.0)) == Approx(expected).epsilon(1e-3).margin(1e-6));
  }
}

TEMPLATE_TEST_CASE("microfacet: along the roughness axes, each alpha alone decides", "[bsdf][microfacet]", Beckmann,
                   Ggx) {
  const TestType both{0.2F, 0.6F};
  CHECK(both.projected_area(direction(70, 0)) == Approx(TestType{0.2F, 0.2F}.projected_area(direction(70, 0))));
  const double quarter = glint::pi<double> / 2;
  CHECK(both.projected_area(direction(70, quarter)) ==
        Approx(TestType{0.6F, 0.6F}.projected_area(direction(70, quarter))));
}

TEMPLATE_TEST_CASE("microfacet: correlated masking hides less than independent masking, and not less than either",
                   "[bsdf][microfacet]", Beckmann, Ggx) {
  const TestType d{0.6F, 0.4F};
  const Vec3<float> wo = direction(70, 0.2);
  const Vec3<float> wi = direction(50, 2.0);
  const float both = masking_shadowing(d, wo, wi);
  CHECK(both > masking(d, wo) * masking(d, wi));
  CHECK(both < std::min(masking(d, wo), masking(d, wi)));
  CHECK(both == masking_shadowing(d, wi, wo));
}

TEMPLATE_TEST_CASE("microfacet: visible normals are a probability density", "[bsdf][microfacet]", Beckmann, Ggx) {
  for (const auto& d : distributions<TestType>()) {
    for (const double theta : polar_angles) {
      const Vec3<float> w = direction(theta, 2.5);
      CAPTURE(d.alpha_x, d.alpha_y, theta);
      CHECK(over_hemisphere([&](const Vec3<float>& m) { return visible_density(d, w, m); }) == Approx(1).epsilon(2e-3));
    }
  }
}

TEMPLATE_TEST_CASE("microfacet: sampled normals are distributed as they are visible", "[bsdf][microfacet][chi_square]",
                   Beckmann, Ggx) {
  const auto ds = distributions<TestType>();
  const int tests = static_cast<int>(ds.size() * polar_angles.size());
  std::uint64_t seed = 0;
  for (const auto& d : ds) {
    for (const double theta : polar_angles) {
      const Vec3<float> w = direction(theta, 0.9);
      CAPTURE(d.alpha_x, d.alpha_y, theta);
      const auto result = glint::testing::chi_square_sphere(
          [&](float, const glint::Vec2<float>& uv) { return std::optional(d.sample_visible(w, uv)); },
          [&](const Vec3<float>& m) { return visible_density(d, w, m); },
          {.samples = 50'000, .seed = ++seed, .tests = tests});
      INFO(result.message);
      CHECK(result.passed);
    }
  }
}

TEST_CASE("microfacet: slopes are where the distribution function takes the value u", "[bsdf][microfacet]") {
  // Integrated by hand: 2 ∫ (cos − t sin) exp(−t²) / √π dt = cos erfc(−x) + sin exp(−x²) / √π, over its value at the
  // last visible slope, cot θ.
  const auto area = [](double x, double cos, double sin) {
    return cos * std::erfc(-x) + sin * std::exp(-x * x) / std::sqrt(glint::pi<double>);
  };
  for (const double theta : {0.0, 1.0, 14.0, 45.0, 80.0, 89.9}) {
    const double cos = std::cos(glint::radians(theta));
    const double sin = std::sin(glint::radians(theta));
    const double total = sin > 0 ? area(cos / sin, cos, sin) : 2 * cos;
    for (int i = 0; i <= 1000; ++i) {
      const float u = std::min(static_cast<float>(i) / 1000, glint::one_minus_epsilon<float>);
      const float x = glint::detail::visible_gaussian_slope(u, static_cast<float>(cos), static_cast<float>(sin));
      CAPTURE(theta, u, x);
      CHECK(area(double{x}, cos, sin) / total == Approx(double{u}).margin(1e-6));
    }
  }
}

TEMPLATE_TEST_CASE("microfacet: sampled normals are unit vectors up, also at the ends of the random range",
                   "[bsdf][microfacet]", Beckmann, Ggx) {
  for (const float u : {0.0F, 0.5F, glint::one_minus_epsilon<float>}) {
    for (const float v : {0.0F, 0.5F, glint::one_minus_epsilon<float>}) {
      for (const float z : {1.0F, 0.5F, 1e-3F, 1e-6F}) {
        const Vec3<float> m = TestType{0.1F, 0.4F}.sample_visible({0.0F, std::sqrt(1 - z * z), z}, {u, v});
        CAPTURE(u, v, z);
        CHECK(glm::length(m) == Approx(1).epsilon(1e-6));
        CHECK(m.z >= 0.0F);
      }
    }
  }
}

}  // namespace test_bsdf_microfacet
