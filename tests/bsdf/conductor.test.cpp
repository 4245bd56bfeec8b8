// SPDX-License-Identifier: MIT
#include <glint/bsdf/conductor.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_conductor {

using glint::Conductor;
using glint::Rgb;
using glint::Vec3;

TEST_CASE("conductor: at normal incidence it reflects ((η − 1)² + k²) / ((η + 1)² + k²)", "[bsdf][conductor]") {
  const Conductor bsdf{.reflectance = {1.0F, 1.0F, 0.5F}, .eta = {1.0F, 0.2F, 0.2F}, .k = {1.0F, 3.9F, 3.9F}};
  const auto s = bsdf.sample({0.0F, 0.0F, 1.0F}, 0.5F, {0.5F, 0.5F});
  REQUIRE(s);
  CHECK(s->wi == Vec3<float>{0.0F, 0.0F, 1.0F});
  CHECK(s->weight.r == Approx(1.0 / 5.0));  // (0 + 1) / (4 + 1)
  CHECK(s->weight.g == Approx((0.64 + 15.21) / (1.44 + 15.21)));
  CHECK(s->weight.b == Approx(0.5 * (0.64 + 15.21) / (1.44 + 15.21)));
  CHECK(s->lobe == glint::Lobe::Specular);
}

TEST_CASE("conductor: the default reflects about nine tenths, as aluminum does", "[bsdf][conductor]") {
  const auto s = Conductor{}.sample({0.6F, 0.0F, 0.8F}, 0.5F, {0.5F, 0.5F});
  REQUIRE(s);
  CHECK(s->wi == Vec3<float>{-0.6F, 0.0F, 0.8F});
  for (const float share : {s->weight.r, s->weight.g, s->weight.b}) CHECK(share == Approx(0.915).margin(0.02));
}

TEST_CASE("conductor: obeys the laws of Bsdf", "[bsdf][conductor][laws]") {
  using glint::testing::SeenFrom;
  CHECK(Conductor{}.is_specular());
  CHECK_FALSE(Conductor{}.sample({0.0F, 0.0F, -1.0F}, 0.5F, {0.5F, 0.5F}));
  CHECK(glint::testing::violations_of_bsdf_laws(Conductor{}, 1, {.seen_from = SeenFrom::Front, .least_albedo = 0.8F})
            .empty());
}

}  // namespace test_bsdf_conductor
