// SPDX-License-Identifier: MIT
#include <glint/bsdf/sheen.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/math/random.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_sheen {

using glint::Rgb;
using glint::Sheen;
using glint::Vec3;

namespace {

Vec3<float> at_cosine(float cos) {
  return {std::sqrt(1.0F - cos * cos), 0.0F, cos};
}

/// The mean weight of samples: what leaves for a unit of light.
double albedo(const Sheen& sheen, float cos) {
  constexpr int count = 400'000;
  glint::Random random(5);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const auto s = sheen.sample(at_cosine(cos), 0.0F, random.uniform_vec2());
    if (s) sum += double{s->weight.g};
  }
  return sum / count;
}

}  // namespace

TEST_CASE("sheen: the albedo it states is the share that leaves", "[bsdf][sheen]") {
  for (const float roughness : {0.5F, 0.55F, 0.7F, 0.8F, 1.0F}) {
    for (const float cos : {0.03F, 0.2F, 0.5F, 1.0F}) {
      CAPTURE(roughness, cos);
      const Sheen sheen{.roughness = roughness};
      // 0.005 as promised, and 0.004 for the noise of 4e5 weights with a deviation below 0.8
      CHECK(double{sheen.albedo(cos)} == Approx(albedo(sheen, cos)).margin(0.009));
    }
  }
}

TEST_CASE("sheen: smooth fuzz glows at its rim and is black where it is seen from above", "[bsdf][sheen]") {
  // Straight on and straight back the half vector is the normal, whose sine is zero.
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  CHECK(is_black(Sheen{}.evaluate(up, up)));
  CHECK(Sheen{.roughness = 0.5F}.albedo(0.05F) > Sheen{.roughness = 1}.albedo(0.05F));
  CHECK(Sheen{.roughness = 0.5F}.albedo(1) < Sheen{.roughness = 1}.albedo(1));
}

TEST_CASE("sheen: it has the value of its formula", "[bsdf][sheen]") {
  // Both directions at 45° in one plane but opposite: the half vector is the normal. Turned by 90°, for roughness 1:
  // |o + i|² = 1/2 + 1/2 + 2 = 3, sin² = 1/3, D = 3 sin / 2π, V = 1 / (4 (√2 − 1/2)), times the cosine 1/√2.
  const float h = std::sqrt(0.5F);
  const double expected = 3 * std::sqrt(1.0 / 3) / (2 * glint::pi<double>) / (4 * (std::sqrt(2.0) - 0.5)) * double{h};
  const Rgb value = Sheen{Rgb{1, 0.5F, 0}, 1.0F}.evaluate({h, 0, h}, {0, h, h});
  CHECK(double{value.r} == Approx(expected));
  CHECK(double{value.g} == Approx(expected / 2));
  CHECK(value.b == 0);
}

TEST_CASE("sheen: below its range roughness counts as the least", "[bsdf][sheen]") {
  CHECK(Sheen{.roughness = 0}.evaluate(at_cosine(0.3F), at_cosine(0.6F)) ==
        Sheen{.roughness = 0.5F}.evaluate(at_cosine(0.3F), at_cosine(0.6F)));
}

TEST_CASE("sheen: obeys the laws of Bsdf", "[bsdf][sheen][laws]") {
  for (const float roughness : {0.0F, 0.5F, 0.7F, 1.0F}) {
    const auto broken = glint::testing::violations_of_bsdf_laws(Sheen{{1, 0.5F, 0.2F}, roughness}, 3,
                                                                {.seen_from = glint::testing::SeenFrom::Front});
    for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
    CHECK(broken.empty());
  }
}

}  // namespace test_bsdf_sheen
