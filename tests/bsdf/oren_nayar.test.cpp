// SPDX-License-Identifier: MIT
#include <glint/bsdf/oren_nayar.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_oren_nayar {

using glint::OrenNayar;
using glint::Rgb;
using glint::Vec3;

namespace {

constexpr double pi = glint::pi<double>;

/// The directional albedo of the single bounce at reflectance one, as the paper spells it (its equation for E_FON).
double single_albedo(double cos, double roughness) {
  const double theta = std::acos(cos);
  const double sin = std::sin(theta);
  const double g = sin * (theta - sin * cos) + 2.0 / 3 * (sin / cos * (1 - sin * sin * sin) - sin);
  return (1 + roughness * g / pi) / (1 + (0.5 - 2 / (3 * pi)) * roughness);
}

double mean_single_albedo(double roughness) {
  return (1 + (2.0 / 3 - 28 / (15 * pi)) * roughness) / (1 + (0.5 - 2 / (3 * pi)) * roughness);
}

/// The reflectance that all bounces but the first have together.
double multiple_reflectance(double reflectance, double roughness) {
  const double mean = mean_single_albedo(roughness);
  return reflectance * reflectance * mean / (1 - reflectance * (1 - mean));
}

/// The model of the paper, with the cosine, in double precision.
double reference(double reflectance, double roughness, const Vec3<double>& wo, const Vec3<double>& wi) {
  const double s = glm::dot(wo, wi) - wo.z * wi.z;
  const double single =
      reflectance / (1 + (0.5 - 2 / (3 * pi)) * roughness) * (1 + roughness * (s > 0 ? s / std::max(wo.z, wi.z) : s));
  const double missing = (1 - single_albedo(wo.z, roughness)) * (1 - single_albedo(wi.z, roughness));
  return wi.z / pi *
         (single + multiple_reflectance(reflectance, roughness) * missing / (1 - mean_single_albedo(roughness)));
}

/// ∫ f cos dω by the midpoint rule, in √cos θ, where the integrand is smooth.
double albedo(const OrenNayar& bsdf, float cos) {
  constexpr int rows = 200;
  constexpr int columns = 200;
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const double root = (i + 0.5) / rows;
    const double z = root * root;
    const double r = std::sqrt(1 - z * z);
    for (int j = 0; j < columns; ++j) {
      const double phi = (j + 0.5) / columns * 2 * pi;
      const Vec3<float> wi(Vec3<double>{r * std::cos(phi), r * std::sin(phi), z});
      sum += 2 * root * static_cast<double>(bsdf.evaluate({std::sqrt(1 - cos * cos), 0.0F, cos}, wi).g);
    }
  }
  return sum * 2 * pi / (rows * columns);
}

}  // namespace

TEST_CASE("oren_nayar: without roughness it is Lambert's reflection", "[bsdf][oren_nayar]") {
  const OrenNayar bsdf{.reflectance = {0.2F, 0.5F, 1.0F}, .roughness = 0.0F};
  const glint::Lambertian lambertian{bsdf.reflectance};
  const Vec3<float> wo{0.6F, 0.0F, 0.8F};
  const Vec3<float> wi{0.0F, -0.8F, 0.6F};
  CHECK(bsdf.evaluate(wo, wi).r == Approx(lambertian.evaluate(wo, wi).r));
  CHECK(bsdf.evaluate(wo, wi).b == Approx(lambertian.evaluate(wo, wi).b));
  CHECK(bsdf.pdf(wo, wi) == Approx(lambertian.pdf(wo, wi)));
}

TEST_CASE("oren_nayar: it is the model of the paper", "[bsdf][oren_nayar]") {
  glint::Random random{4};
  for (int n = 0; n < 1000; ++n) {
    const Vec3<float> wo = glint::uniform_hemisphere(random.uniform_vec2());
    const Vec3<float> wi = glint::uniform_hemisphere(random.uniform_vec2());
    const float roughness = random.uniform<float>();
    const Rgb value = OrenNayar{{0.1F, 0.6F, 1.0F}, roughness}.evaluate(wo, wi);
    const auto expected = [&](double reflectance) {
      return Approx(reference(reflectance, double{roughness}, Vec3<double>(wo), Vec3<double>(wi))).epsilon(1e-4);
    };
    CAPTURE(wo.z, wi.z, roughness);
    CHECK(value.r == expected(double{0.1F}));
    CHECK(value.g == expected(double{0.6F}));
    CHECK(value.b == expected(1));
  }
}

TEST_CASE("oren_nayar: a white surface loses nothing at any roughness", "[bsdf][oren_nayar]") {
  for (const float roughness : {0.1F, 0.5F, 1.0F}) {
    for (const float cos : {0.02F, 0.3F, 0.7F, 1.0F}) {
      CAPTURE(roughness, cos);
      CHECK(albedo({{1.0F}, roughness}, cos) == Approx(1).margin(2e-4));
    }
  }
}

TEST_CASE("oren_nayar: its albedo is that of the first bounce and of the rest", "[bsdf][oren_nayar]") {
  for (const float cos : {0.1F, 0.5F, 0.9F}) {
    const double first = single_albedo(double{cos}, 1);
    const double expected = 0.5 * first + multiple_reflectance(0.5, 1) * (1 - first);
    CHECK(albedo({{0.5F}, 1.0F}, cos) == Approx(expected).margin(2e-4));
  }
}

TEST_CASE("oren_nayar: it is brighter against the light than with it", "[bsdf][oren_nayar]") {
  const Vec3<float> wo{0.8F, 0.0F, 0.6F};
  CHECK(OrenNayar{}.evaluate(wo, wo).g > 1.5F * OrenNayar{}.evaluate(wo, {-0.8F, 0.0F, 0.6F}).g);
}

TEST_CASE("oren_nayar: it is black from behind, and for light from behind", "[bsdf][oren_nayar]") {
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  CHECK(is_black(OrenNayar{}.evaluate(-up, up)));
  CHECK(is_black(OrenNayar{}.evaluate(up, -up)));
  CHECK_FALSE(OrenNayar{}.sample(-up, 0.5F, {0.5F, 0.5F}));
}

TEST_CASE("oren_nayar: weights stay small, also for grazing eyes", "[bsdf][oren_nayar]") {
  glint::Random random{8};
  for (int n = 0; n < 10'000; ++n) {
    const float cos = random.uniform<float>();
    const float u = random.uniform<float>();
    const auto s = OrenNayar{{1.0F}, 1.0F}.sample({std::sqrt(1 - cos * cos), 0.0F, cos}, u, random.uniform_vec2());
    if (s) CHECK(s->weight.g < 4);
  }
}

TEST_CASE("oren_nayar: obeys the laws of Bsdf", "[bsdf][oren_nayar][laws]") {
  using glint::testing::SeenFrom;
  for (const float roughness : {0.0F, 0.3F, 1.0F}) {
    CAPTURE(roughness);
    const auto broken = glint::testing::violations_of_bsdf_laws(OrenNayar{{1.0F}, roughness}, 1,
                                                                {.seen_from = SeenFrom::Front, .least_albedo = 1});
    for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
    CHECK(broken.empty());
  }
  CHECK(glint::testing::violations_of_bsdf_laws(OrenNayar{{0.2F, 0.4F, 0.8F}}, 2, {.seen_from = SeenFrom::Front})
            .empty());
}

}  // namespace test_bsdf_oren_nayar
