// SPDX-License-Identifier: MIT
#include <glint/io/scene_surfaces.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/two_sided.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_io_scene_surfaces {

using glint::Lambertian;
using glint::Rgb;
using glint::SceneLayerBsdf;
using glint::Vec3;

TEST_CASE("scene surfaces: a layer is its plain BSDF, or that on both sides", "[io][scene]") {
  const glint::RoughDielectric<glint::Ggx> frosted{.distribution = {0.3F, 0.3F}};
  const glint::TwoSided both{frosted};
  const Vec3<float> above{0.6F, 0.0F, 0.8F};
  for (const Vec3<float>& wo : {above, -above}) {
    for (const Vec3<float>& wi : {Vec3<float>{0, 0.6F, 0.8F}, Vec3<float>{0, 0.6F, -0.8F}}) {
      CHECK(SceneLayerBsdf(frosted, false).evaluate(wo, wi) == frosted.evaluate(wo, wi));
      CHECK(SceneLayerBsdf(frosted, true).evaluate(wo, wi) == both.evaluate(wo, wi));
      CHECK(SceneLayerBsdf(frosted, true).pdf(wo, wi) == both.pdf(wo, wi));
    }
  }
  const auto sample = SceneLayerBsdf(frosted, true).sample(-above, 0.01F, {0.3F, 0.4F});
  const auto expected = both.sample(-above, 0.01F, {0.3F, 0.4F});
  REQUIRE((sample && expected));
  CHECK(sample->wi == expected->wi);
  CHECK(sample->wi.z < 0);
}

TEST_CASE("scene surfaces: layers obey the laws of Bsdf", "[io][scene][laws]") {
  const auto broken =
      glint::testing::violations_of_bsdf_laws(SceneLayerBsdf(Lambertian{Rgb{1}}, true), 3, {.least_albedo = 1});
  for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
  CHECK(broken.empty());
}

}  // namespace test_io_scene_surfaces
