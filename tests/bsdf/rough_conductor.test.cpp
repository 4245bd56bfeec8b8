// SPDX-License-Identifier: MIT
#include <glint/bsdf/rough_conductor.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/bsdf/conductor.hpp>
#include <glint/core/one_of.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_rough_conductor {

using glint::Beckmann;
using glint::Ggx;
using glint::Rgb;
using glint::RoughConductor;
using glint::Vec3;

static_assert(glint::Bsdf<glint::OneOf<RoughConductor<Beckmann>, RoughConductor<Ggx>>>);

TEMPLATE_TEST_CASE("rough_conductor: straight on and back it is F D / 4, unmasked", "[bsdf][rough_conductor]", Beckmann,
                   Ggx) {
  const RoughConductor<TestType> bsdf{
      .reflectance = {1.0F, 0.5F, 0.0F}, .distribution = {0.2F, 0.5F}, .eta = {1.0F}, .k = {1.0F}};
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  const Rgb value = bsdf.evaluate(up, up);
  // F = (0 + 1) / (4 + 1), D = 1 / (π 0.2 0.5), nothing is hidden from above: 0.2 · 10 / π / 4
  CHECK(value.r == Approx(0.5 / glint::pi<double>));
  CHECK(value.g == Approx(0.25 / glint::pi<double>));
  CHECK(value.b == 0.0F);
}

TEMPLATE_TEST_CASE("rough_conductor: the value is F D G / (4 cos θo cos θi) times the cosine",
                   "[bsdf][rough_conductor]", Beckmann, Ggx) {
  const RoughConductor<TestType> bsdf{.distribution = {0.4F, 0.3F}};
  const Vec3<float> wo{0.48F, 0.36F, 0.8F};
  const Vec3<float> wi{0.0F, -0.8F, 0.6F};
  const Vec3<float> m = glm::normalize(wo + wi);
  const Rgb fresnel = glint::fresnel_conductor(glm::dot(wo, m), bsdf.eta, bsdf.k);
  const float rest = bsdf.distribution.density(m) * masking_shadowing(bsdf.distribution, wo, wi) / (4 * wo.z);
  const Rgb value = bsdf.evaluate(wo, wi);
  CHECK(value.r == Approx(fresnel.r * rest).epsilon(1e-5));
  CHECK(value.g == Approx(fresnel.g * rest).epsilon(1e-5));
  CHECK(value.b == Approx(fresnel.b * rest).epsilon(1e-5));
}

TEMPLATE_TEST_CASE("rough_conductor: it is nearly the smooth conductor when it is nearly smooth",
                   "[bsdf][rough_conductor]", Beckmann, Ggx) {
  const RoughConductor<TestType> rough{.distribution = {0.002F, 0.002F}};
  const Vec3<float> wo{0.6F, 0.0F, 0.8F};
  const auto mirrored = glint::Conductor{}.sample(wo, 0.5F, {0.5F, 0.5F});
  REQUIRE(mirrored);
  glint::Random random{7};
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto s = rough.sample(wo, 0.5F, random.uniform_vec2());
    if (s) sum += double{s->weight.g};
  }
  CHECK(sum / 1000 == Approx(mirrored->weight.g).epsilon(2e-3));  // masking hides about α² of it
}

TEMPLATE_TEST_CASE("rough_conductor: it is black from behind", "[bsdf][rough_conductor]", Beckmann, Ggx) {
  const RoughConductor<TestType> bsdf{};
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  CHECK(is_black(bsdf.evaluate(-up, -up)));
  CHECK(is_black(bsdf.evaluate(up, -up)));
  CHECK_FALSE(bsdf.sample(-up, 0.5F, {0.5F, 0.5F}));
  CHECK_FALSE(bsdf.is_specular());
}

TEMPLATE_TEST_CASE("rough_conductor: obeys the laws of Bsdf", "[bsdf][rough_conductor][laws]", Beckmann, Ggx) {
  const glint::testing::BsdfLawOptions options{.seen_from = glint::testing::SeenFrom::Front};
  for (const TestType& distribution : {TestType{0.1F, 0.1F}, TestType{0.5F, 0.2F}, TestType{1.0F, 1.0F}}) {
    CAPTURE(distribution.alpha_x, distribution.alpha_y);
    const auto broken =
        glint::testing::violations_of_bsdf_laws(RoughConductor<TestType>{.distribution = distribution}, 1, options);
    for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
    CHECK(broken.empty());
  }
}

}  // namespace test_bsdf_rough_conductor
