// SPDX-License-Identifier: MIT
#include <glint/bsdf/compensated.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/bsdf/metals.hpp>
#include <glint/material/textured.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bsdf_laws.hpp>
#include <glint/texture/constant.hpp>

namespace test_bsdf_compensated {

using glint::Beckmann;
using glint::Compensated;
using glint::Ggx;
using glint::Rgb;
using glint::RoughConductor;
using glint::Vec3;

namespace {

/// Facets that reflect everything: Fresnel's reflectance is above 1 − 4 eta / k² = 1 − 4e-8.
template <typename Distribution>
Compensated<RoughConductor<Distribution>> white(const Distribution& distribution) {
  return {RoughConductor<Distribution>{.distribution = distribution, .eta = {1.0F}, .k = {1e4F}}};
}

/// The share of light that leaves, by samples.
template <typename B>
double albedo(const B& bsdf, float cos) {
  constexpr int samples = 20'000;
  glint::Random random{11};
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const float u = random.uniform<float>();
    const auto s = bsdf.sample({std::sqrt(1 - cos * cos), 0.0F, cos}, u, random.uniform_vec2());
    if (s) sum += double{s->weight.g};
  }
  return sum / samples;
}

template <typename B>
void check_laws(const B& bsdf) {
  const auto broken = glint::testing::violations_of_bsdf_laws(bsdf, 3, {.seen_from = glint::testing::SeenFrom::Front});
  for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
  CHECK(broken.empty());
}

}  // namespace

TEMPLATE_TEST_CASE("compensated: facets that reflect everything lose nothing at any roughness", "[bsdf][compensated]",
                   Ggx, Beckmann) {
  for (const float alpha : {0.05F, 0.1F, 0.3F, 0.6F, 1.0F}) {
    for (const float cos : {0.06F, 0.2F, 0.6F, 1.0F}) {
      CAPTURE(alpha, cos);
      CHECK(albedo(white(TestType{alpha, alpha}), cos) ==
            Approx(1).margin(0.012));  // 0.01 the tables, 0.002 the samples
    }
  }
}

TEST_CASE("compensated: rough gold is brighter, and its color deeper", "[bsdf][compensated]") {
  using glint::metals::gold;
  const RoughConductor<Ggx> once{.distribution = {0.8F, 0.8F}, .eta = gold.eta, .k = gold.k};
  const Vec3<float> wo{0.6F, 0.0F, 0.8F};
  const Vec3<float> wi{0.0F, 0.6F, 0.8F};
  const Rgb single = once.evaluate(wo, wi);
  const Rgb added = Compensated{once}.evaluate(wo, wi) - single;
  CHECK(added.r > 0.1F * single.r);
  CHECK(added.b / added.r < single.b / single.r);
}

TEST_CASE("compensated: what facets reflect on the mean is close to the integral", "[bsdf][compensated]") {
  for (const glint::Metal& metal : {glint::metals::gold, glint::metals::titanium, glint::metals::aluminum}) {
    double mean = 0;
    for (int i = 0; i < 1000; ++i) {
      const double cos = (i + 0.5) / 1000;
      mean += 2e-3 * cos * glint::fresnel_conductor(cos, double{metal.eta.g}, double{metal.k.g});
    }
    CHECK(RoughConductor<Ggx>{.eta = metal.eta, .k = metal.k}.mean_reflectance().g == Approx(mean).margin(0.011));
  }
}

TEST_CASE("compensated: a texture may color it", "[bsdf][compensated]") {
  const glint::Textured<Compensated<RoughConductor<Ggx>>, glint::ConstantTexture> material{{Rgb{0.25F}}};
  CHECK(material.bsdf({}).reflectance == Rgb{0.25F});
}

TEST_CASE("compensated: obeys the laws of Bsdf", "[bsdf][compensated][laws]") {
  check_laws(Compensated{RoughConductor<Ggx>{.distribution = {0.5F, 0.2F}}});
  check_laws(Compensated{RoughConductor<Beckmann>{.distribution = {0.7F, 0.7F}}});
}

}  // namespace test_bsdf_compensated
