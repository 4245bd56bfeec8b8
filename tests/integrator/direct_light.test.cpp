// SPDX-License-Identifier: MIT
#include <glint/integrator/direct_light.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bvh/brute_force.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/light/directional.hpp>
#include <glint/light/point.hpp>
#include <glint/scene/scene.hpp>

namespace test_integrator_direct_light {

using glint::Rgb;

TEST_CASE("direct light: reaches a surface that sees the light, and no other", "[integrator][direct_light]") {
  const std::vector<glint::Sphere<float>> balls{{.center = {0, 0, 2}, .radius = 0.5F}};
  const glint::Scene scene{glint::BruteForce{glint::Elements{balls}}};
  const glint::Interaction<glint::Lambertian> at{.bsdf = {Rgb{1}}};  // a floor at the origin, facing +z
  const glint::Vec3<float> up{0, 0, 1};
  const auto behind_ball = glint::PointLight{{0, 0, 5}, Rgb{1}}.sample({0, 0, 0}, {0, 0});
  const auto before_ball = glint::PointLight{{0, 0, 1}, Rgb{1}}.sample({0, 0, 0}, {0, 0});
  CHECK_FALSE(is_lit(scene, at, *behind_ball));
  CHECK(is_lit(scene, at, *before_ball));
  CHECK(reflected(scene, at, up, *behind_ball) == Rgb{0});
  CHECK(reflected(scene, at, up, *before_ball).r == Approx(glint::inv_pi<float>));  // f · cos · I / 1²
}

TEST_CASE("direct light: light from infinity is stopped by anything on its way", "[integrator][direct_light]") {
  const std::vector<glint::Sphere<float>> balls{{.center = {0, 0, 1000}, .radius = 1}};
  const glint::Scene scene{glint::BruteForce{glint::Elements{balls}}};
  const glint::Interaction<glint::Lambertian> at{};
  CHECK_FALSE(is_lit(scene, at, *glint::DirectionalLight{{0, 0, -1}, Rgb{1}}.sample({0, 0, 0}, {0, 0})));
  CHECK(is_lit(scene, at, *glint::DirectionalLight{{0, -1, -1}, Rgb{1}}.sample({0, 0, 0}, {0, 0})));
}

}  // namespace test_integrator_direct_light
