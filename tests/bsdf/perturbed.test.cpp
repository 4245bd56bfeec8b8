// SPDX-License-Identifier: MIT
#include <glint/bsdf/perturbed.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_perturbed {

using glint::Lambertian;
using glint::Perturbed;
using glint::Rgb;
using glint::Vec3;

namespace {

template <glint::Bsdf B>
void check_laws(const B& bsdf) {
  const auto broken = glint::testing::violations_of_bsdf_laws(bsdf, 1, {.seen_from = glint::testing::SeenFrom::Front});
  for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
  CHECK(broken.empty());
}

}  // namespace

TEST_CASE("perturbed: a normal that stays changes nothing", "[bsdf][perturbed]") {
  const Perturbed bsdf{Lambertian{0.5F}, {0.0F, 0.0F, 1.0F}};
  const Vec3<float> wo{0.6F, 0.0F, 0.8F};
  const Vec3<float> wi{0.0F, -0.8F, 0.6F};
  CHECK(bsdf.evaluate(wo, wi) == Lambertian{0.5F}.evaluate(wo, wi));
  CHECK(bsdf.pdf(wo, wi) == Lambertian{0.5F}.pdf(wo, wi));
}

TEST_CASE("perturbed: a facet is lit by its own cosine, and twice where a mirror shows it the light",
          "[bsdf][perturbed]") {
  const Perturbed bsdf{Lambertian{1.0F}, {0.6F, 0.0F, 0.8F}};
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  // From above the facet alone is seen. Its cosine to (0.6, 0, 0.8) is 1, and stairs hide 1 − 0.8 · 0.8 of that light.
  CHECK(bsdf.evaluate(up, {0.6F, 0.0F, 0.8F}).g == Approx(0.64 / glint::pi<double>));
  // Toward (−0.6, 0, 0.8) it is 0.28, nothing is hidden; a mirror adds (0.6, 0, 0.8) times 0.36 / (0.64 + 0.36).
  CHECK(bsdf.evaluate(up, {-0.6F, 0.0F, 0.8F}).g == Approx(0.64 / glint::pi<double>));
}

TEST_CASE("perturbed: a mirror is bent, and sends nothing below the surface", "[bsdf][perturbed]") {
  const Perturbed bsdf{glint::Mirror{1.0F}, {0.6F, 0.0F, 0.8F}};
  const auto s = bsdf.sample({0.6F, 0.0F, 0.8F}, 0.5F, {0.5F, 0.5F});
  REQUIRE(s);
  CHECK(s->wi.x == Approx(0.6F));
  CHECK(s->weight.g == Approx(0.64F));                                      // what the stairs do not hide, as above
  const auto below = bsdf.sample({-0.6F, 0.0F, 0.8F}, 0.1F, {0.5F, 0.5F});  // toward (0.936, 0, −0.352)
  CHECK_FALSE(below);
  CHECK(bsdf.is_specular());
}

TEST_CASE("perturbed: obeys the laws of Bsdf", "[bsdf][perturbed][laws]") {
  check_laws(Perturbed{Lambertian{1.0F}, {0.6F, 0.0F, 0.8F}});
  check_laws(Perturbed{Lambertian{1.0F}, {-0.48F, 0.64F, 0.6F}});
  check_laws(Perturbed{glint::RoughConductor<glint::Ggx>{.distribution = {0.6F, 0.6F}}, {0.0F, -0.28F, 0.96F}});
}

}  // namespace test_bsdf_perturbed
