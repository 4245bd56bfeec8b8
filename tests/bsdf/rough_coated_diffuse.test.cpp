// SPDX-License-Identifier: MIT
#include <glint/bsdf/rough_coated_diffuse.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/bsdf/coated_diffuse.hpp>
#include <glint/material/textured.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bsdf_laws.hpp>
#include <glint/texture/constant.hpp>

namespace test_bsdf_rough_coated_diffuse {

using glint::Beckmann;
using glint::Ggx;
using glint::Rgb;
using glint::RoughCoatedDiffuse;
using glint::Vec3;

namespace {

template <typename D>
void check_laws(const RoughCoatedDiffuse<D>& bsdf, float least_albedo) {
  const auto broken = glint::testing::violations_of_bsdf_laws(
      bsdf, 3, {.seen_from = glint::testing::SeenFrom::Front, .least_albedo = least_albedo, .tolerance = 5e-3F});
  for (const auto& sentence : broken) UNSCOPED_INFO(sentence);
  CHECK(broken.empty());
}

/// The mean weight of samples: what leaves for a unit of light.
template <typename D>
double albedo(const RoughCoatedDiffuse<D>& bsdf, float cos) {
  const Vec3<float> wo{std::sqrt(1.0F - cos * cos), 0.0F, cos};
  constexpr int count = 200'000;
  glint::Random random(5);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const float u = random.uniform<float>();
    const auto s = bsdf.sample(wo, u, random.uniform_vec2());
    if (s) sum += double{s->weight.g};
  }
  return sum / count;
}

}  // namespace

TEST_CASE("rough_coated_diffuse: over white nothing is gained, and little lost", "[bsdf][rough_coated_diffuse]") {
  for (const float alpha : {0.05F, 0.25F, 0.6F, 1.0F}) {
    for (const float eta : {1.3F, 1.5F, 1.7F, 2.5F}) {
      for (const float cos : {0.1F, 0.5F, 1.0F}) {
        CAPTURE(alpha, eta, cos);
        // as promised, and 0.002 for the noise of 2e5 weights between zero and about one
        const double leaves = albedo(RoughCoatedDiffuse<Ggx>{Rgb{1}, {alpha, alpha}, eta}, cos);
        CHECK(leaves <= 1.012);
        CHECK(leaves >= (eta == 1.5F ? 0.988 : 0.948));
      }
    }
  }
}

TEST_CASE("rough_coated_diffuse: the albedo it states is the share that leaves", "[bsdf][rough_coated_diffuse]") {
  const RoughCoatedDiffuse<Ggx> grey{Rgb{0.5F}, {0.3F, 0.3F}, 1.5F};
  CHECK(double{grey.albedo(0.7F)} == Approx(albedo(grey, 0.7F)).margin(0.01));
}

TEST_CASE("rough_coated_diffuse: as the coat gets smooth, the base looks as under a smooth coat",
          "[bsdf][rough_coated_diffuse]") {
  // Far from the mirror direction only the base is left.
  const Vec3<float> wo{0.6F, 0.0F, 0.8F};
  const Vec3<float> wi{0.0F, 0.6F, 0.8F};
  const Rgb smooth = glint::CoatedDiffuse{{0.7F, 0.3F, 0.1F}, 1.5F}.evaluate(wo, wi);
  const Rgb rough = RoughCoatedDiffuse<Ggx>{{0.7F, 0.3F, 0.1F}, {0.003F, 0.003F}, 1.5F}.evaluate(wo, wi);
  CHECK(rough.r == Approx(smooth.r).epsilon(0.01));
  CHECK(rough.b == Approx(smooth.b).epsilon(0.01));
}

TEST_CASE("rough_coated_diffuse: over black, facets alone reflect", "[bsdf][rough_coated_diffuse]") {
  // Straight on: F = 0.04, D = 1 / (π alpha²), G₂ = 1, over 4.
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  const RoughCoatedDiffuse<Ggx> black{Rgb{0}, {0.5F, 0.5F}, 1.5F};
  CHECK(black.evaluate(up, up).g == Approx(0.04 / (4 * glint::pi<double> * 0.25)));
}

TEST_CASE("rough_coated_diffuse: a texture may color the base", "[bsdf][rough_coated_diffuse]") {
  const glint::Textured<RoughCoatedDiffuse<Ggx>, glint::ConstantTexture> material{{Rgb{0.25F}}, {.eta = 1.33F}};
  CHECK(material.bsdf({}) == RoughCoatedDiffuse<Ggx>{Rgb{0.25F}, {}, 1.33F});
}

TEST_CASE("rough_coated_diffuse: obeys the laws of Bsdf", "[bsdf][rough_coated_diffuse][laws]") {
  check_laws(RoughCoatedDiffuse<Ggx>{Rgb{1}, {0.25F, 0.25F}, 1.5F}, 0.98F);
  check_laws(RoughCoatedDiffuse<Ggx>{{0.8F, 0.4F, 0.0F}, {0.5F, 0.2F}, 1.33F}, 0);
  check_laws(RoughCoatedDiffuse<Beckmann>{{0.8F, 0.4F, 0.1F}, {0.4F, 0.4F}, 1.5F}, 0);
}

}  // namespace test_bsdf_rough_coated_diffuse
