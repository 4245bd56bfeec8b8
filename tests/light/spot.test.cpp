// SPDX-License-Identifier: MIT
#include <glint/light/spot.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/math/random.hpp>
#include <glint/testing/light_laws.hpp>

namespace test_light_spot {

using glint::Rgb;
using glint::SpotLight;

namespace {

const SpotLight spot{.position = {0, 0, 4},
                     .direction = {0, 0, -2},  // any length
                     .intensity = Rgb{16},
                     .cone_angle_radians = glint::radians(60.0F),
                     .falloff_start_radians = 0};

}  // namespace

TEST_CASE("spot light: the axis gets the full intensity", "[light][spot]") {
  const auto sample = spot.sample({0, 0, 0}, {0, 0});
  REQUIRE(sample);
  CHECK(sample->radiance.r == Approx(1));  // 16 / 4²
}

TEST_CASE("spot light: half the smooth step is passed midway between the cosines", "[light][spot]") {
  // cos 0 = 1 and cos 60° = 1/2: midway is 3/4, where x² (3 − 2x) at x = 1/2 is 1/2.
  const float tangent = std::sqrt(1 / (0.75F * 0.75F) - 1);
  const auto sample = spot.sample({4 * tangent, 0, 0}, {0, 0});
  REQUIRE(sample);
  const float squared = 16 * (1 + tangent * tangent);
  CHECK(sample->radiance.r == Approx(0.5F * 16 / squared).epsilon(1e-4));
}

TEST_CASE("spot light: outside the cone it is dark", "[light][spot]") {
  CHECK_FALSE(spot.sample({4 * std::tan(glint::radians(61.0F)), 0, 0}, {0, 0}));
  CHECK_FALSE(spot.sample({0, 0, 9}, {0, 0}));
  CHECK_FALSE(spot.sample({0, 0, 4}, {0, 0}));
}

TEST_CASE("spot light: its power is the integral of its intensity", "[light][spot]") {
  glint::Random random{7};
  double sum = 0;
  constexpr int n = 200'000;
  for (int i = 0; i < n; ++i) {
    const float z = 1 - 2 * random.uniform<float>();
    const float phi = 2 * glint::pi<float> * random.uniform<float>();
    const float r = std::sqrt(1 - z * z);
    const auto sample = spot.sample({r * std::cos(phi), r * std::sin(phi), 4 + z}, {0, 0});
    if (sample) sum += static_cast<double>(sample->radiance.r) * 4 * glint::pi<double> / n;  // distance 1
  }
  CHECK(spot.power({}).r == Approx(sum).epsilon(0.02));  // standard error below 0.6 %
}

TEST_CASE("spot light: obeys the laws of Light", "[light][spot][laws]") {
  CHECK(glint::testing::violations_of_light_laws(spot, {0.5F, 0, 0}, 1).empty());
}

}  // namespace test_light_spot
