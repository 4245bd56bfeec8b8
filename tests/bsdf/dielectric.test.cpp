// SPDX-License-Identifier: MIT
#include <glint/bsdf/dielectric.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_dielectric {

using glint::Dielectric;
using glint::Rgb;
using glint::Vec3;

namespace {
constexpr Vec3<float> normal{0.0F, 0.0F, 1.0F};
constexpr glint::Vec2<float> middle{0.5F, 0.5F};
}  // namespace

TEST_CASE("dielectric: u chooses reflection with Fresnel's share as the chance", "[bsdf][dielectric]") {
  const Dielectric glass{};  // ((1.5 − 1) / (1.5 + 1))² = 0.04 straight on
  const auto reflected = glass.sample(normal, 0.0399F, middle);
  const auto refracted = glass.sample(normal, 0.0401F, middle);
  REQUIRE(reflected);
  REQUIRE(refracted);
  CHECK(reflected->wi == normal);
  CHECK(reflected->pdf == Approx(0.04));
  CHECK(refracted->wi == -normal);
  CHECK(refracted->pdf == Approx(0.96));
  CHECK(reflected->lobe == glint::Lobe::Specular);
  CHECK(refracted->lobe == glint::Lobe::Specular);
}

TEST_CASE("dielectric: transmitted radiance scales by the squared index ratio, which cancels on leaving",
          "[bsdf][dielectric]") {
  const Dielectric glass{};
  const auto from_outside = glass.sample(normal, 0.5F, middle);
  const auto from_inside = glass.sample(-normal, 0.5F, middle);
  REQUIRE(from_outside);
  REQUIRE(from_inside);
  CHECK(from_outside->weight.g == Approx(1 / 2.25));
  CHECK(from_inside->weight.g == Approx(2.25));
}

TEST_CASE("dielectric: light bends by Snell's law from both sides", "[bsdf][dielectric]") {
  const auto in = Dielectric{}.sample({0.0F, 0.6F, 0.8F}, 0.9F, middle);
  REQUIRE(in);
  CHECK(in->wi.y == Approx(-0.4));  // 0.6 / 1.5
  CHECK(in->wi.z == Approx(-std::sqrt(1 - 0.16)));
  const auto out = Dielectric{}.sample({0.0F, 0.4F, -std::sqrt(1 - 0.16F)}, 0.9F, middle);
  REQUIRE(out);
  CHECK(out->wi.y == Approx(-0.6));
  CHECK(out->wi.z == Approx(0.8));
}

TEST_CASE("dielectric: beyond the critical angle everything is reflected", "[bsdf][dielectric]") {
  const auto s = Dielectric{}.sample({0.8F, 0.0F, -0.6F}, glint::one_minus_epsilon<float>, middle);  // 0.8 · 1.5 > 1
  REQUIRE(s);
  CHECK(s->wi == Vec3<float>{-0.8F, 0.0F, -0.6F});
  CHECK(s->pdf == 1.0F);
  CHECK(s->weight == Rgb{1});
}

TEST_CASE("dielectric: the two colors multiply the two shares", "[bsdf][dielectric]") {
  const Dielectric tinted{.reflectance = {1.0F, 0.5F, 0.0F}, .transmittance = {0.25F, 0.5F, 1.0F}, .eta = 2.0F};
  const auto reflected = tinted.sample(normal, 0.0F, middle);
  const auto refracted = tinted.sample(normal, 0.9F, middle);
  REQUIRE(reflected);
  REQUIRE(refracted);
  CHECK(reflected->weight == Rgb{1.0F, 0.5F, 0.0F});
  CHECK(refracted->weight == Rgb{0.0625F, 0.125F, 0.25F});  // transmittance / 2², exact
}

TEST_CASE("dielectric: obeys the laws of Bsdf, without loss", "[bsdf][dielectric][laws]") {
  const float eta = GENERATE(0.6F, 1.0F, 1.5F, 2.4F);
  CAPTURE(eta);
  CHECK(Dielectric{.eta = eta}.is_specular());
  CHECK(glint::testing::violations_of_bsdf_laws(Dielectric{.eta = eta}, 1, {.least_albedo = 1, .radiance_eta = eta})
            .empty());
}

}  // namespace test_bsdf_dielectric
