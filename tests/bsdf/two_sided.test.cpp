// SPDX-License-Identifier: MIT
#include <glint/bsdf/two_sided.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_two_sided {

using glint::Lambertian;
using glint::Mirror;
using glint::TwoSided;
using glint::Vec3;

static_assert(glint::Bsdf<TwoSided<Lambertian>> && glint::Bsdf<TwoSided<Mirror>>);

TEST_CASE("two_sided: from behind it is the mirror image of the front", "[bsdf][two_sided]") {
  const glint::RoughConductor<> front{.distribution = {.alpha_x = 0.2F, .alpha_y = 0.5F}};
  const TwoSided bsdf{front};
  const Vec3<float> wo{0.48F, 0.36F, 0.8F};
  const Vec3<float> wi{-0.6F, 0.0F, 0.8F};
  const Vec3<float> wo_behind{0.48F, 0.36F, -0.8F};
  const Vec3<float> wi_behind{-0.6F, 0.0F, -0.8F};
  CHECK(bsdf.evaluate(wo, wi) == front.evaluate(wo, wi));
  CHECK(bsdf.evaluate(wo_behind, wi_behind) == front.evaluate(wo, wi));
  CHECK(bsdf.pdf(wo_behind, wi_behind) == front.pdf(wo, wi));
  const auto sample = front.sample(wo, 0.1F, {0.2F, 0.3F});
  const auto behind = bsdf.sample(wo_behind, 0.1F, {0.2F, 0.3F});
  REQUIRE(sample);
  REQUIRE(behind);
  CHECK(behind->wi == Vec3<float>{sample->wi.x, sample->wi.y, -sample->wi.z});
  CHECK(behind->weight == sample->weight);
  CHECK(behind->pdf == sample->pdf);
}

TEST_CASE("two_sided: no light passes through", "[bsdf][two_sided]") {
  const TwoSided bsdf{Lambertian{}};
  CHECK(is_black(bsdf.evaluate({0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F})));
  CHECK(is_black(bsdf.evaluate({0.0F, 0.0F, -1.0F}, {0.0F, 0.0F, 1.0F})));
}

TEST_CASE("two_sided: it is specular where its front is", "[bsdf][two_sided]") {
  CHECK(TwoSided{Mirror{}}.is_specular());
  CHECK_FALSE(TwoSided{Lambertian{}}.is_specular());
}

TEST_CASE("two_sided: obeys the laws of Bsdf, without loss from either side", "[bsdf][two_sided][laws]") {
  const auto seed = GENERATE(range(0U, 3U));
  CAPTURE(seed);
  CHECK(glint::testing::violations_of_bsdf_laws(TwoSided{Lambertian{{1.0F}}}, seed, {.least_albedo = 1}).empty());
  CHECK(glint::testing::violations_of_bsdf_laws(TwoSided{Mirror{}}, seed, {.least_albedo = 1}).empty());
}

}  // namespace test_bsdf_two_sided
