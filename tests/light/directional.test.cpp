// SPDX-License-Identifier: MIT
#include <glint/light/directional.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/testing/light_laws.hpp>

namespace test_light_directional {

using glint::DirectionalLight;
using glint::Rgb;
using glint::Vec3;

TEST_CASE("directional light: shines from where it does not travel to, everywhere alike", "[light][directional]") {
  const DirectionalLight sun{.direction = {0, -3, 0}, .irradiance = Rgb{5}};
  for (const Vec3<float>& from : {Vec3<float>{0, 0, 0}, Vec3<float>{1e6F, -7, 3}}) {
    const auto sample = sun.sample(from, {0, 0});
    REQUIRE(sample);
    CHECK(sample->wi == Vec3<float>{0, 1, 0});
    CHECK(std::isinf(sample->distance));
    CHECK(sample->radiance == Rgb{5});
    CHECK(sample->is_delta);
  }
}

TEST_CASE("directional light: its power is what falls on the disk around the scene", "[light][directional]") {
  const DirectionalLight sun{.irradiance = Rgb{2}};
  // a cube with edges of 2 lies in a sphere of radius √3: π 3 · 2
  CHECK(sun.power({{-1, -1, -1}, {1, 1, 1}}).r == Approx(6 * glint::pi<float>));
  CHECK(sun.power({}) == Rgb{0});
}

TEST_CASE("directional light: obeys the laws of Light", "[light][directional][laws]") {
  CHECK(glint::testing::violations_of_light_laws(DirectionalLight{.direction = {1, -2, 0.5F}}, {1, 2, 3}, 1).empty());
}

}  // namespace test_light_directional
