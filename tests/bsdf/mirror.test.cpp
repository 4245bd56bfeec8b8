// SPDX-License-Identifier: MIT
#include <glint/bsdf/mirror.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_mirror {

using glint::Mirror;
using glint::Rgb;
using glint::Vec3;

TEST_CASE("mirror: light comes from the mirror direction, times the reflectance", "[bsdf][mirror]") {
  const Mirror bsdf{.reflectance = {0.9F, 0.8F, 0.7F}};
  const auto s = bsdf.sample({0.48F, 0.36F, 0.8F}, 0.5F, {0.5F, 0.5F});
  REQUIRE(s);
  CHECK(s->wi == Vec3<float>{-0.48F, -0.36F, 0.8F});
  CHECK(s->weight == Rgb{0.9F, 0.8F, 0.7F});
  CHECK(s->pdf == 1.0F);
  CHECK(s->lobe == glint::Lobe::Specular);
}

TEST_CASE("mirror: it is black from behind", "[bsdf][mirror]") {
  CHECK_FALSE(Mirror{}.sample({0.0F, 0.0F, -1.0F}, 0.5F, {0.5F, 0.5F}));
}

TEST_CASE("mirror: obeys the laws of Bsdf", "[bsdf][mirror][laws]") {
  using glint::testing::SeenFrom;
  CHECK(Mirror{}.is_specular());
  CHECK(
      glint::testing::violations_of_bsdf_laws(Mirror{}, 1, {.seen_from = SeenFrom::Front, .least_albedo = 1}).empty());
}

}  // namespace test_bsdf_mirror
