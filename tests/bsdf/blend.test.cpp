// SPDX-License-Identifier: MIT
#include <glint/bsdf/blend.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/conductor.hpp>
#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_blend {

using glint::Blend;
using glint::Lambertian;
using glint::Rgb;
using glint::Vec3;

namespace {

template <glint::Bsdf B>
void check_laws(const B& bsdf, const glint::testing::BsdfLawOptions& options) {
  const auto broken = glint::testing::violations_of_bsdf_laws(bsdf, 1, options);
  for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
  CHECK(broken.empty());
}

}  // namespace

TEST_CASE("blend: values and densities are means, weighted by the share of the second", "[bsdf][blend]") {
  const glint::RoughConductor<glint::Ggx> rough{.distribution = {0.5F, 0.5F}};
  const Blend blend{Lambertian{0.4F}, rough, 0.25F};
  const Vec3<float> wo{0.48F, 0.36F, 0.8F};
  const Vec3<float> wi{0.0F, -0.8F, 0.6F};
  const float diffuse = 0.4F * 0.6F * glint::inv_pi<float>;  // reflectance / π times the cosine
  CHECK(blend.evaluate(wo, wi).g == Approx(0.75F * diffuse + 0.25F * rough.evaluate(wo, wi).g));
  CHECK(blend.pdf(wo, wi) == Approx(0.75F * 0.6F * glint::inv_pi<float> + 0.25F * rough.pdf(wo, wi)));
}

TEST_CASE("blend: a share of zero or one is one of the two alone", "[bsdf][blend]") {
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  for (const float u : {0.0F, 0.5F, glint::one_minus_epsilon<float>}) {
    const auto first = Blend{Lambertian{0.25F}, glint::Mirror{}, 0.0F}.sample(up, u, {0.3F, 0.6F});
    const auto second = Blend{Lambertian{0.25F}, glint::Mirror{}, 1.0F}.sample(up, u, {0.3F, 0.6F});
    REQUIRE((first && second));
    CHECK(first->weight.g == Approx(0.25F));
    CHECK(first->lobe == glint::Lobe::Diffuse);
    CHECK(second->lobe == glint::Lobe::Specular);
    CHECK(second->pdf == 1.0F);
  }
}

TEST_CASE("blend: it is specular when both are", "[bsdf][blend]") {
  CHECK(Blend<glint::Mirror, glint::Dielectric>{}.is_specular());
  CHECK_FALSE(Blend<glint::Mirror, Lambertian>{}.is_specular());
}

TEST_CASE("blend: obeys the laws of Bsdf", "[bsdf][blend][laws]") {
  using glint::testing::SeenFrom;
  const glint::RoughConductor<glint::Ggx> rough{.distribution = {0.5F, 0.2F}};
  check_laws(Blend{Lambertian{0.8F}, rough, 0.3F}, {.seen_from = SeenFrom::Front});
  check_laws(Blend{glint::Mirror{1.0F}, Lambertian{1.0F}, 0.6F}, {.seen_from = SeenFrom::Front, .least_albedo = 1});
  check_laws(Blend{Lambertian{0.5F}, glint::Dielectric{}, 0.9F}, {.radiance_eta = 1.5F});
  check_laws(Blend{Blend{Lambertian{0.2F}, rough, 0.5F}, glint::Conductor{}, 0.1F}, {.seen_from = SeenFrom::Front});
}

}  // namespace test_bsdf_blend
