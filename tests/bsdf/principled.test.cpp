// SPDX-License-Identifier: MIT
#include <glint/bsdf/principled.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/math/random.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_principled {

using glint::Ggx;
using glint::Principled;
using glint::Rgb;
using glint::Vec3;
using glint::testing::SeenFrom;

namespace {

void check_laws(const Principled& bsdf, float least_albedo = 0) {
  const bool glass = bsdf.transmission > 0 && bsdf.metallic < 1;
  const auto broken =
      glint::testing::violations_of_bsdf_laws(bsdf, 3,
                                              {.seen_from = glass ? SeenFrom::Anywhere : SeenFrom::Front,
                                               .least_albedo = least_albedo,
                                               .radiance_eta = glass ? bsdf.eta : 1,
                                               .tolerance = 5e-3F});
  for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
  CHECK(broken.empty());
}

/// The mean weight of samples from the outside: what leaves for a unit of light.
double albedo(const Principled& bsdf, const Vec3<float>& wo) {
  constexpr int count = 100'000;
  glint::Random random(5);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const float u = random.uniform<float>();
    const auto s = bsdf.sample(wo, u, random.uniform_vec2());
    if (s) sum += double{s->weight.g} * (s->wi.z < 0 ? double{bsdf.eta} * double{bsdf.eta} : 1.0);
  }
  return sum / count;
}

}  // namespace

TEST_CASE("principled: obeys the laws of Bsdf all over its parameters", "[bsdf][principled][laws]") {
  const auto seed = GENERATE(range(0U, 24U));
  CAPTURE(seed);
  glint::Random random(seed);
  const auto number = [&] { return random.uniform<float>(); };
  const auto sometimes = [&] {
    const float chance = number();
    const float value = number();
    return chance < 0.4F ? 0.0F : chance < 0.6F ? 1.0F : value;
  };
  Principled bsdf;
  for (float* const channel : {&bsdf.base_color.r, &bsdf.base_color.g, &bsdf.base_color.b}) *channel = 0.95F * number();
  for (float* const share : {&bsdf.metallic, &bsdf.transmission, &bsdf.coat, &bsdf.sheen, &bsdf.sheen_tint}) {
    *share = sometimes();
  }
  bsdf.roughness = 0.2F + 0.8F * number();  // smoother facets round more than the laws' tolerance
  bsdf.coat_roughness = 0.2F + 0.8F * number();
  bsdf.sheen_roughness = number();
  bsdf.anisotropy = 0.5F * number();
  bsdf.eta = 1.05F + number();
  CAPTURE(bsdf.metallic, bsdf.transmission, bsdf.coat, bsdf.sheen, bsdf.roughness, bsdf.anisotropy, bsdf.eta);
  check_laws(bsdf);
}

TEST_CASE("principled: each part alone obeys the laws of Bsdf", "[bsdf][principled][laws]") {
  check_laws({.base_color = {1.0F, 0.5F, 0.0F}}, 0.98F);
  check_laws({.base_color = {0.95F, 0.5F, 0.0F}, .metallic = 1, .roughness = 0.6F}, 0.85F);
  check_laws({.base_color = {1.0F, 0.5F, 0.1F}, .roughness = 0.3F, .transmission = 1});
  check_laws({.base_color = Rgb{0}, .coat = 1, .coat_roughness = 0.3F});
  check_laws({.base_color = Rgb{0}, .sheen = 1, .sheen_roughness = 0.7F});
}

TEST_CASE("principled: over white nothing is gained", "[bsdf][principled]") {
  const auto check = [](Principled bsdf, double most) {
    bsdf.base_color = Rgb{1};
    for (const float cos : {0.05F, 0.3F, 1.0F}) {
      const float sine = std::sqrt(1.0F - cos * cos);
      CAPTURE(cos, bsdf.anisotropy, bsdf.roughness, bsdf.metallic, bsdf.transmission, bsdf.coat, bsdf.sheen);
      CHECK(albedo(bsdf, {sine, 0.0F, cos}) <= most);
      CHECK(albedo(bsdf, {0.0F, sine, cos}) <= most);
    }
  };
  for (const float roughness : {0.25F, 0.6F, 1.0F}) {
    for (const Principled& part : {Principled{}, Principled{.metallic = 1}, Principled{.transmission = 1},
                                   Principled{.metallic = 0.5F, .transmission = 0.5F}}) {
      Principled bsdf = part;
      bsdf.roughness = roughness;
      check(bsdf, 1.013);  // 0.01 of the tables, 0.003 for the noise of 1e5 samples
      bsdf.coat = 1;
      check(bsdf, 1.013);
      bsdf.sheen = 1;
      check(bsdf, 1.013);
      bsdf.coat = bsdf.sheen = 0;
      bsdf.anisotropy = 1;
      check(bsdf, 1.053);
    }
  }
}

TEST_CASE("principled: a part alone is the BSDF it is made of", "[bsdf][principled]") {
  const Vec3<float> wo{0.6F, 0.0F, 0.8F};
  const Vec3<float> wi{-0.48F, 0.36F, 0.8F};
  const Rgb color{0.8F, 0.4F, 0.2F};
  const Ggx facets{0.25F, 0.25F};
  CHECK(Principled{.base_color = color}.evaluate(wo, wi) ==
        glint::RoughCoatedDiffuse<Ggx>{color, facets, 1.5F}.evaluate(wo, wi));
  const glint::Metal metal = glint::metal_of_color(color);
  const glint::Compensated<glint::RoughConductor<Ggx>> rough{{Rgb{1}, facets, metal.eta, metal.k}};
  CHECK(Principled{.base_color = color, .metallic = 1}.evaluate(wo, wi) == rough.evaluate(wo, wi));
  CHECK(Principled{.base_color = Rgb{1}, .transmission = 1}.evaluate(wo, -wi) ==
        glint::RoughDielectric<Ggx>{.distribution = facets, .eta = 1.5F}.evaluate(wo, -wi));
}

TEST_CASE("principled: opaque parts and metal are black from inside, glass is not", "[bsdf][principled]") {
  const Vec3<float> below{0.6F, 0.0F, -0.8F};
  CHECK_FALSE(Principled{.metallic = 0.5F, .coat = 1, .sheen = 1}.sample(below, 0.5F, {0.5F, 0.5F}));
  CHECK(Principled{.transmission = 0.5F, .coat = 1, .sheen = 1}.sample(below, 0.5F, {0.5F, 0.5F}));
}

TEST_CASE("principled: anisotropy draws highlights out along the tangent", "[bsdf][principled]") {
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  const Principled brushed{.metallic = 1, .roughness = 0.5F, .anisotropy = 0.8F};
  CHECK(brushed.evaluate(up, {0.6F, 0.0F, 0.8F}).g > 2 * brushed.evaluate(up, {0.0F, 0.6F, 0.8F}).g);
}

TEST_CASE("principled: the fuzz takes the base's hue as far as it is told to", "[bsdf][principled]") {
  const Vec3<float> wo{0.8F, 0.0F, 0.6F};
  const Vec3<float> wi{0.0F, 0.8F, 0.6F};
  const Principled plain{.base_color = {0.5F, 0.0F, 0.0F}, .metallic = 1, .sheen = 1};
  Principled tinted = plain;
  tinted.sheen_tint = 1;
  CHECK(plain.evaluate(wo, wi).b > 0);
  CHECK(tinted.evaluate(wo, wi).b < 1e-3F * plain.evaluate(wo, wi).b);
  CHECK(tinted.evaluate(wo, wi).r == Approx(plain.evaluate(wo, wi).r));
}

}  // namespace test_bsdf_principled
