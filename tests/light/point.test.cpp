// SPDX-License-Identifier: MIT
#include <glint/light/point.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/testing/light_laws.hpp>

namespace test_light_point {

using glint::PointLight;
using glint::Rgb;
using glint::Vec3;

TEST_CASE("point light: irradiance falls with the square of the distance", "[light][point]") {
  const PointLight light{.position = {0, 0, 2}, .intensity = Rgb{8, 4, 2}};
  const auto sample = light.sample({0, 0, 0}, {0.5F, 0.5F});
  REQUIRE(sample);
  CHECK(sample->wi == Vec3<float>{0, 0, 1});
  CHECK(sample->distance == 2);
  CHECK(sample->radiance == Rgb{2, 1, 0.5F});  // 8 / 2², 4 / 2², 2 / 2²
  CHECK(sample->pdf == 1);
  CHECK(sample->is_delta);
}

TEST_CASE("point light: a flux of 4π watts is an intensity of one", "[light][point]") {
  const PointLight light = PointLight::from_flux({1, 2, 3}, Rgb{4 * glint::pi<float>});
  CHECK(light.intensity.r == Approx(1).epsilon(1e-6));
  CHECK(light.power({}).g == Approx(4 * glint::pi<float>).epsilon(1e-6));
}

TEST_CASE("point light: a point does not light itself", "[light][point]") {
  CHECK_FALSE(PointLight{.position = {1, 1, 1}}.sample({1, 1, 1}, {0, 0}));
}

TEST_CASE("point light: obeys the laws of Light", "[light][point][laws]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(range(0, 4)));
  CAPTURE(seed);
  CHECK(glint::testing::violations_of_light_laws(PointLight{.position = {3, 1, -2}}, {0.5F, 0, 7}, seed).empty());
}

}  // namespace test_light_point
