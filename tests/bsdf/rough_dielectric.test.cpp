// SPDX-License-Identifier: MIT
#include <glint/bsdf/rough_dielectric.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>

#include <support/catch.hpp>

#include <glint/bsdf/dielectric.hpp>
#include <glint/core/one_of.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_rough_dielectric {

using glint::Beckmann;
using glint::Ggx;
using glint::Rgb;
using glint::RoughDielectric;
using glint::Vec3;

static_assert(glint::Bsdf<glint::OneOf<RoughDielectric<Beckmann>, RoughDielectric<Ggx>>>);

namespace {

constexpr Vec3<float> up{0.0F, 0.0F, 1.0F};

/// Equation 21 of Walter et al. in double precision, times |cos θi|, with η² of wo's side where they scale by that of
/// the light's: radiance is looked for against its flow. Indices: 1 outside, eta inside.
template <typename Distribution>
double refracted(const Distribution& distribution, double eta, const Vec3<double>& wo, const Vec3<double>& wi) {
  const double eta_o = wo.z > 0 ? 1 : eta;
  const double eta_i = wo.z > 0 ? eta : 1;
  Vec3<double> m = glm::normalize(-(wo * eta_o + wi * eta_i));
  if (m.z < 0) m = -m;
  const double o = glm::dot(wo, m);
  const double i = glm::dot(wi, m);
  if (!(o * wo.z > 0 && i * wi.z > 0)) return 0;
  const double sin = eta_o / eta_i * std::sqrt(1 - o * o);
  const double cos = std::sqrt(1 - sin * sin);
  const double across = (eta_o * std::abs(o) - eta_i * cos) / (eta_o * std::abs(o) + eta_i * cos);
  const double along = (eta_i * std::abs(o) - eta_o * cos) / (eta_i * std::abs(o) + eta_o * cos);
  const double fresnel = 0.5 * (across * across + along * along);
  const auto masked = [&](const Vec3<double>& w) {
    return double{masking(distribution, Vec3<float>(Vec3<double>{w.x, w.y, std::abs(w.z)}))};
  };
  const double root = eta_i * i + eta_o * o;
  return std::abs(o * i / wo.z) * eta_o * eta_o * (1 - fresnel) * masked(wo) * masked(wi) *
         double{distribution.density(Vec3<float>(m))} / (root * root);
}

}  // namespace

TEMPLATE_TEST_CASE("rough_dielectric: straight on it reflects F D / 4 from either side", "[bsdf][rough_dielectric]",
                   Beckmann, Ggx) {
  const RoughDielectric<TestType> bsdf{.reflectance = {1.0F, 0.5F, 0.0F}, .distribution = {0.2F, 0.5F}};
  for (const Vec3<float>& w : {up, -up}) {
    const Rgb value = bsdf.evaluate(w, w);  // 0.04 · 1 / (π 0.2 0.5) / 4
    CHECK(value.r == Approx(0.1 / glint::pi<double>));
    CHECK(value.g == Approx(0.05 / glint::pi<double>));
    CHECK(value.b == 0.0F);
  }
}

TEMPLATE_TEST_CASE("rough_dielectric: what passes straight through is scaled by the squared index ratio",
                   "[bsdf][rough_dielectric]", Beckmann, Ggx) {
  const RoughDielectric<TestType> bsdf{.transmittance = {1.0F, 0.5F, 0.0F}, .distribution = {0.2F, 0.5F}};
  // (1 − F) D η² / (η − η')² with η of wo's side: 0.96 · 10 / π · 1 / 0.25, and 2.25 times that from inside
  CHECK(bsdf.evaluate(up, -up).r == Approx(38.4 / glint::pi<double>));
  CHECK(bsdf.evaluate(up, -up).g == Approx(19.2 / glint::pi<double>));
  CHECK(bsdf.evaluate(-up, up).r == Approx(86.4 / glint::pi<double>));
  CHECK(bsdf.evaluate(-up, up).b == 0.0F);
}

TEMPLATE_TEST_CASE("rough_dielectric: refraction is equation 21 of Walter et al.", "[bsdf][rough_dielectric]", Beckmann,
                   Ggx) {
  const float eta = GENERATE(1.5F, 1 / 1.5F, 1.05F);
  CAPTURE(eta);
  const RoughDielectric<TestType> bsdf{.distribution = {0.5F, 0.3F}, .eta = eta};
  glint::Random random{5};
  int lit = 0;
  for (int n = 0; n < 1000; ++n) {
    const Vec3<float> wo = glint::uniform_sphere(random.uniform_vec2());
    const auto s = bsdf.sample(wo, glint::one_minus_epsilon<float>, random.uniform_vec2());
    const Vec3<float> wi = s && n % 4 > 0 ? s->wi : glint::uniform_sphere(random.uniform_vec2());
    if (wi.z * wo.z >= 0) continue;
    const double expected = refracted(bsdf.distribution, double{eta}, Vec3<double>(wo), Vec3<double>(wi));
    CAPTURE(wo.x, wo.y, wo.z, wi.x, wi.y, wi.z);
    CHECK(bsdf.evaluate(wo, wi).g == Approx(expected).epsilon(1e-3).margin(1e-5));
    if (expected > 1e-3) ++lit;
  }
  CHECK(lit > 300);
}

TEMPLATE_TEST_CASE("rough_dielectric: it is nearly the smooth dielectric when it is nearly smooth",
                   "[bsdf][rough_dielectric]", Beckmann, Ggx) {
  const RoughDielectric<TestType> rough{.distribution = {0.002F, 0.002F}};
  glint::Random random{7};
  for (const Vec3<float>& wo : {Vec3<float>{0.6F, 0.0F, 0.8F}, Vec3<float>{0.4F, 0.0F, -std::sqrt(0.84F)}}) {
    for (const float u : {0.0F, 0.9F}) {
      const auto smooth = glint::Dielectric{}.sample(wo, u, {0.5F, 0.5F});
      REQUIRE(smooth);
      Vec3<double> sum{0.0};
      double weights = 0;
      for (int n = 0; n < 1000; ++n) {
        const auto s = rough.sample(wo, u, random.uniform_vec2());
        REQUIRE(s);
        sum += Vec3<double>(s->wi);
        weights += double{s->weight.g};
      }
      CHECK(glm::length(sum * 1e-3 - Vec3<double>(smooth->wi)) < 1e-3);
      CHECK(weights * 1e-3 == Approx(smooth->weight.g).epsilon(2e-3));  // masking hides about α² of it
    }
  }
}

TEMPLATE_TEST_CASE("rough_dielectric: values stay finite where it is nearly smooth or nearly nothing",
                   "[bsdf][rough_dielectric]", Beckmann, Ggx) {
  glint::Random random{9};
  for (const float eta : {1.5F, 1.0001F, 1 / 1.0001F}) {
    const RoughDielectric<TestType> bsdf{.distribution = {1e-3F, 1e-3F}, .eta = eta};
    CAPTURE(eta);
    for (int n = 0; n < 1000; ++n) {
      const Vec3<float> wo = glint::uniform_sphere(random.uniform_vec2());
      const float u = random.uniform<float>();
      const auto s = bsdf.sample(wo, u, random.uniform_vec2());
      if (!s) continue;
      CHECK((s->pdf > 0 && std::isfinite(s->pdf)));
      CHECK(is_finite(s->weight));
      CHECK((std::isfinite(bsdf.pdf(wo, s->wi)) && std::isfinite(bsdf.pdf(wo, -wo))));
      CHECK((is_finite(bsdf.evaluate(wo, s->wi)) && is_finite(bsdf.evaluate(wo, -wo))));
    }
  }
}

TEMPLATE_TEST_CASE("rough_dielectric: with nothing to refract, light passes straight on", "[bsdf][rough_dielectric]",
                   Beckmann, Ggx) {
  const RoughDielectric<TestType> air{.eta = 1.0F};
  const Vec3<float> wo{0.6F, 0.0F, -0.8F};
  const auto s = air.sample(wo, 0.5F, {0.3F, 0.7F});
  REQUIRE(s);
  CHECK(s->wi == -wo);
  CHECK(s->weight == Rgb{1});
  CHECK(s->lobe == glint::Lobe::Specular);
  CHECK(is_black(air.evaluate(wo, -wo)));
}

TEMPLATE_TEST_CASE("rough_dielectric: obeys the laws of Bsdf on both sides", "[bsdf][rough_dielectric][laws]", Beckmann,
                   Ggx) {
  struct Trial {
    TestType distribution;
    float eta;
  };
  for (const auto& [distribution, eta] :
       std::array{Trial{{0.05F, 0.05F}, 1.5F}, Trial{{0.3F, 0.3F}, 1.5F}, Trial{{0.8F, 0.8F}, 1 / 1.5F},
                  Trial{{0.3F, 0.8F}, 1.05F}, Trial{{0.05F, 0.3F}, 1 / 1.5F}, Trial{{0.05F, 0.05F}, 1.05F}}) {
    CAPTURE(distribution.alpha_x, distribution.alpha_y, eta);
    const auto broken = glint::testing::violations_of_bsdf_laws(
        RoughDielectric<TestType>{.distribution = distribution, .eta = eta}, 2, {.radiance_eta = eta});
    for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
    CHECK(broken.empty());
  }
}

}  // namespace test_bsdf_rough_dielectric
