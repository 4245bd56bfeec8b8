// SPDX-License-Identifier: MIT
#include <glint/bsdf/lambertian.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/perfect_refraction.hpp>
#include <glint/core/one_of.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_lambertian {

using glint::Lambertian;
using glint::Rgb;
using glint::Vec3;

static_assert(glint::Bsdf<glint::OneOf<Lambertian, glint::PerfectRefraction>>);

TEST_CASE("lambertian: a gray one is written with one number", "[bsdf][lambertian]") {
  CHECK(Lambertian{{0.7F}}.reflectance == Rgb{0.7F, 0.7F, 0.7F});
  CHECK(Lambertian{}.reflectance == Rgb{0.5F});
}

TEST_CASE("lambertian: the value is reflectance over pi times the cosine at the light", "[bsdf][lambertian]") {
  const Lambertian bsdf{{0.2F, 0.4F, 0.8F}};
  const Rgb value = bsdf.evaluate({0.6F, 0.0F, 0.8F}, {0.0F, 0.8F, 0.6F});
  CHECK(value.r == Approx(0.2 * 0.6 / glint::pi<double>));
  CHECK(value.g == Approx(0.4 * 0.6 / glint::pi<double>));
  CHECK(value.b == Approx(0.8 * 0.6 / glint::pi<double>));
}

TEST_CASE("lambertian: every sample weighs the reflectance exactly, which thus is the albedo", "[bsdf][lambertian]") {
  const Lambertian bsdf{{0.2F, 0.4F, 0.8F}};
  glint::Random random{3};
  for (int i = 0; i < 1000; ++i) {
    const auto s = bsdf.sample({0.6F, 0.0F, 0.8F}, 0.0F, random.uniform_vec2());
    REQUIRE(s);
    CHECK(s->weight == bsdf.reflectance);
    CHECK(s->wi.z > 0.0F);
    CHECK(s->lobe == glint::Lobe::Diffuse);
  }
}

TEST_CASE("lambertian: it is black from behind, and for light from behind", "[bsdf][lambertian]") {
  const Lambertian bsdf{};
  const Vec3<float> front{0.0F, 0.0F, 1.0F};
  CHECK(bsdf.evaluate(-front, front) == Rgb{});
  CHECK(bsdf.evaluate(front, -front) == Rgb{});
  CHECK(bsdf.evaluate(-front, -front) == Rgb{});
  CHECK_FALSE(bsdf.sample(-front, 0.5F, {0.5F, 0.5F}));
}

TEST_CASE("lambertian: obeys the laws of Bsdf", "[bsdf][lambertian][laws]") {
  const auto seed = GENERATE(range(0U, 3U));
  CAPTURE(seed);
  using glint::testing::SeenFrom;
  CHECK(glint::testing::violations_of_bsdf_laws(Lambertian{{0.2F, 0.4F, 0.8F}}, seed, {.seen_from = SeenFrom::Front})
            .empty());
  CHECK(glint::testing::violations_of_bsdf_laws(Lambertian{{1.0F}}, seed,
                                                {.seen_from = SeenFrom::Front, .least_albedo = 1})
            .empty());
}

TEST_CASE("lambertian: obeys the laws of Bsdf as one of several", "[bsdf][lambertian][laws]") {
  using Either = glint::OneOf<Lambertian, glint::PerfectRefraction>;
  CHECK(glint::testing::violations_of_bsdf_laws(Either{Lambertian{}}, 1).empty());
  CHECK(glint::testing::violations_of_bsdf_laws(Either{glint::PerfectRefraction{}}, 1).empty());
}

}  // namespace test_bsdf_lambertian
