// SPDX-License-Identifier: MIT
#include <glint/light/light_bounds.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/light/directional.hpp>
#include <glint/light/point.hpp>
#include <glint/light/spot.hpp>
#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>

namespace test_light_light_bounds {

using glint::LightBounds;
using glint::PointLight;
using glint::SpotLight;
using glint::Vec3;

namespace {

/// The cone of `half` degrees around a direction in the x-z plane, `turn` degrees from z.
LightBounds cone(float turn, float half) {
  const float angle = glint::radians(turn);
  return {.box = {Vec3<float>(0), Vec3<float>(0)},
          .axis = {std::sin(angle), 0, std::cos(angle)},
          .cos_theta_o = std::cos(glint::radians(half)),
          .intensity = 1};
}

}  // namespace

TEST_CASE("light bounds: two cones fit into the one between their outer sides", "[light][light_bounds]") {
  const LightBounds both = join(cone(0, 10), cone(50, 30));  // from −10° to 80°: 45° around 35°
  CHECK(both.cos_theta_o == Approx(std::cos(glint::radians(45.0F))).epsilon(1e-5));
  CHECK(glm::dot(both.axis, cone(35, 0).axis) == Approx(1).epsilon(1e-5));
  CHECK(both.intensity == 2);
}

TEST_CASE("light bounds: a cone inside another adds nothing to it", "[light][light_bounds]") {
  CHECK(join(cone(10, 5), cone(0, 40)).axis == cone(0, 40).axis);
  CHECK(join(cone(0, 40), cone(10, 5)).cos_theta_o == cone(0, 40).cos_theta_o);
}

TEST_CASE("light bounds: opposite cones look everywhere", "[light][light_bounds]") {
  CHECK(join(cone(0, 1), cone(180, 1)).cos_theta_o == -1);
  CHECK(join(cone(0, 130), cone(120, 130)).cos_theta_o == -1);
}

TEST_CASE("light bounds: both boxes and every direction of both cones are inside", "[light][light_bounds]") {
  glint::Random random{7};
  for (int i = 0; i < 500; ++i) {
    LightBounds pair[2];
    for (LightBounds& b : pair) {
      const Vec3<float> p = glint::uniform_sphere(random.uniform_vec2());
      b = {.box = {p, p},
           .axis = glint::uniform_sphere(random.uniform_vec2()),
           .cos_theta_o = 1 - 2 * random.uniform<float>() * random.uniform<float>(),
           .cos_theta_e = random.uniform<float>(),
           .intensity = 1};
    }
    const LightBounds both = join(pair[0], pair[1]);
    for (const LightBounds& b : pair) {
      CHECK(contains(both.box, b.box));
      CHECK(both.cos_theta_e <= b.cos_theta_e);
      const glint::Frame<float> frame = glint::Frame<float>::around(b.axis);
      for (int k = 0; k < 20; ++k) {
        const auto w = frame.to_world(glint::uniform_cone(random.uniform_vec2(), 1 - b.cos_theta_o));
        CHECK(glm::dot(w, both.axis) >= both.cos_theta_o - 1e-5F);
      }
    }
  }
}

TEST_CASE("light bounds: without intensity there is nothing to bound", "[light][light_bounds]") {
  LightBounds dark = cone(180, 90);
  dark.intensity = 0;
  CHECK(join(dark, cone(0, 10)) == cone(0, 10));
  CHECK(join(cone(0, 10), dark) == cone(0, 10));
}

TEST_CASE("light bounds: any light can be asked, those at infinity have none", "[light][light_bounds]") {
  using Any = glint::OneOf<PointLight, glint::DirectionalLight>;
  CHECK_FALSE(light_bounds(Any{glint::DirectionalLight{}}));
  const auto bounds = light_bounds(Any{PointLight{.position = {1, 2, 3}, .intensity = glint::Rgb{2}}});
  REQUIRE(bounds);
  CHECK(bounds->box.lower == Vec3<float>{1, 2, 3});
  CHECK(bounds->cos_theta_o == -1);
  CHECK(bounds->intensity == Approx(2));
}

TEST_CASE("light bounds: no light of a spot leaves outside of them", "[light][light_bounds]") {
  const float cone_degrees = GENERATE(20.0F, 80.0F, 170.0F);
  const SpotLight spot{.cone_angle_radians = glint::radians(cone_degrees),
                       .falloff_start_radians = glint::radians(10.0F)};
  const LightBounds bounds = spot.light_bounds();
  const float o = std::acos(bounds.cos_theta_o);
  const float e = std::acos(bounds.cos_theta_e);
  CHECK(o + e >= spot.cone_angle_radians - 1e-4F);
  CHECK(bounds.cos_theta_e >= 0);
}

}  // namespace test_light_light_bounds
