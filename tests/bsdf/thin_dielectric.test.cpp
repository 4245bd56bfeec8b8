// SPDX-License-Identifier: MIT
#include <glint/bsdf/thin_dielectric.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_thin_dielectric {

using glint::Rgb;
using glint::ThinDielectric;
using glint::Vec3;

namespace {
constexpr Vec3<float> normal{0.0F, 0.0F, 1.0F};
constexpr glint::Vec2<float> middle{0.5F, 0.5F};
}  // namespace

TEST_CASE("thin_dielectric: straight on, a pane of glass reflects 1/13 of the light", "[bsdf][thin_dielectric]") {
  const ThinDielectric glass{};  // R = 0.04 at each face: 2 · 0.04 / 1.04
  const auto reflected = glass.sample(normal, 0.0769F, middle);
  const auto passed = glass.sample(normal, 0.0770F, middle);
  REQUIRE(reflected);
  REQUIRE(passed);
  CHECK(reflected->wi == normal);
  CHECK(reflected->pdf == Approx(1.0 / 13));
  CHECK(passed->wi == -normal);
  CHECK(passed->pdf == Approx(12.0 / 13));
  CHECK(passed->weight == Rgb{1});
  CHECK(passed->lobe == glint::Lobe::Specular);
}

TEST_CASE("thin_dielectric: the share reflected is the sum over all bounces within", "[bsdf][thin_dielectric]") {
  const Vec3<float> wo{0.8F, 0.0F, 0.6F};
  const double face = glint::fresnel_dielectric(0.6F, 1 / 1.5F);
  double sum = face;
  for (double inside = (1 - face) * face; inside > 1e-12; inside *= face * face) sum += inside * (1 - face);
  const auto s = ThinDielectric{}.sample(wo, 0.0F, middle);
  REQUIRE(s);
  CHECK(s->pdf == Approx(sum).epsilon(1e-6));
}

TEST_CASE("thin_dielectric: light passes straight on, from either side", "[bsdf][thin_dielectric]") {
  for (const Vec3<float>& wo : {Vec3<float>{0.48F, 0.36F, 0.8F}, Vec3<float>{0.8F, 0.0F, -0.6F}}) {
    const auto passed = ThinDielectric{.eta = 1.3F}.sample(wo, glint::one_minus_epsilon<float>, middle);
    const auto reflected = ThinDielectric{.eta = 1.3F}.sample(wo, 0.0F, middle);
    REQUIRE(passed);
    REQUIRE(reflected);
    CHECK(passed->wi == -wo);
    CHECK(reflected->wi == Vec3<float>{-wo.x, -wo.y, wo.z});
  }
}

TEST_CASE("thin_dielectric: the two colors multiply the two shares", "[bsdf][thin_dielectric]") {
  const ThinDielectric tinted{.reflectance = {1.0F, 0.5F, 0.0F}, .transmittance = {0.25F, 0.5F, 1.0F}};
  const auto reflected = tinted.sample(normal, 0.0F, middle);
  const auto passed = tinted.sample(normal, 0.9F, middle);
  REQUIRE(reflected);
  REQUIRE(passed);
  CHECK(reflected->weight == tinted.reflectance);
  CHECK(passed->weight == tinted.transmittance);
}

TEST_CASE("thin_dielectric: obeys the laws of Bsdf, without loss", "[bsdf][thin_dielectric][laws]") {
  const float eta = GENERATE(0.6F, 1.0F, 1.5F, 2.4F);
  CAPTURE(eta);
  CHECK(ThinDielectric{.eta = eta}.is_specular());
  CHECK(glint::testing::violations_of_bsdf_laws(ThinDielectric{.eta = eta}, 1, {.least_albedo = 1}).empty());
}

}  // namespace test_bsdf_thin_dielectric
