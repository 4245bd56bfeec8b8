// SPDX-License-Identifier: MIT
#include <glint/bsdf/coated_diffuse.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/material/textured.hpp>
#include <glint/testing/bsdf_laws.hpp>
#include <glint/texture/constant.hpp>

namespace test_bsdf_coated_diffuse {

using glint::CoatedDiffuse;
using glint::Rgb;
using glint::Vec3;

namespace {

constexpr Vec3<float> up{0.0F, 0.0F, 1.0F};

/// 1 − 2 ∫ F cos d(cos), by the midpoint rule.
double mean_transmittance(double eta) {
  constexpr int steps = 20'000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double cos = (i + 0.5) / steps;
    sum += 2 * cos * glint::fresnel_dielectric(cos, 1 / eta) / steps;
  }
  return 1 - sum;
}

void check_laws(const CoatedDiffuse& bsdf, float least_albedo) {
  const auto broken = glint::testing::violations_of_bsdf_laws(
      bsdf, 3, {.seen_from = glint::testing::SeenFrom::Front, .least_albedo = least_albedo});
  for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
  CHECK(broken.empty());
}

}  // namespace

TEST_CASE("coated_diffuse: the mean transmittance of a coat is one minus the mean of Fresnel's reflectance",
          "[bsdf][coated_diffuse]") {
  for (const float eta : {1.03F, 1.33F, 1.5F, 2.0F, 3.0F}) {
    CAPTURE(eta);
    CHECK(glint::detail::mean_transmittance(eta) == Approx(mean_transmittance(double{eta})).margin(6e-5));
  }
}

TEST_CASE("coated_diffuse: light bounces between base and coat until it leaves", "[bsdf][coated_diffuse]") {
  // Straight on 0.96 enters. Of what the base scatters, the inner side returns F = 1 − (1 − outer mean) / 2.25 each
  // time: 0.96 · ρ (1 + ρ F + …) · 0.96 / 2.25 / π.
  const double inner = 1 - mean_transmittance(1.5) / 2.25;
  double sum = 0;
  double bounce = 0.5;
  for (int i = 0; i < 100; ++i) {
    sum += bounce;
    bounce *= 0.5 * inner;
  }
  CHECK(CoatedDiffuse{{0.5F}}.evaluate(up, up).g == Approx(0.96 * 0.96 / 2.25 * sum / glint::pi<double>).epsilon(1e-4));
}

TEST_CASE("coated_diffuse: the coat mirrors Fresnel's share", "[bsdf][coated_diffuse]") {
  const Vec3<float> wo{0.6F, 0.0F, 0.8F};
  const auto s = CoatedDiffuse{{0.5F}}.sample(wo, 0.0F, {0.5F, 0.5F});
  REQUIRE(s);
  CHECK(s->lobe == glint::Lobe::Specular);
  CHECK(s->wi == Vec3<float>{-0.6F, 0.0F, 0.8F});
  CHECK(s->weight.g * s->pdf == Approx(glint::fresnel_dielectric(0.8, 1 / 1.5)));
}

TEST_CASE("coated_diffuse: over black, the coat alone is left", "[bsdf][coated_diffuse]") {
  CHECK(is_black(CoatedDiffuse{Rgb{0}}.evaluate(up, up)));
  const auto s = CoatedDiffuse{Rgb{0}}.sample(up, 0.9F, {0.5F, 0.2F});
  REQUIRE(s);
  CHECK(s->pdf == 1.0F);
  CHECK(s->weight.g == Approx(0.04));
}

TEST_CASE("coated_diffuse: a texture may color the base", "[bsdf][coated_diffuse]") {
  const glint::Textured<CoatedDiffuse, glint::ConstantTexture> material{{Rgb{0.25F}}, {.eta = 1.33F}};
  CHECK(material.bsdf({}) == CoatedDiffuse{Rgb{0.25F}, 1.33F});
}

TEST_CASE("coated_diffuse: obeys the laws of Bsdf, and loses nothing over white", "[bsdf][coated_diffuse][laws]") {
  check_laws({{1.0F}, 1.5F}, 0.9999F);
  check_laws({{1.0F}, 2.0F}, 0.9999F);
  check_laws({{0.8F, 0.4F, 0.1F}, 1.33F}, 0);
}

}  // namespace test_bsdf_coated_diffuse
