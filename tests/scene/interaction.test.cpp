// SPDX-License-Identifier: MIT
#include <glint/scene/interaction.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>

namespace test_scene_interaction {

TEST_CASE("interaction: rays leave on the side they go to", "[scene][interaction]") {
  const glint::Interaction<glint::Lambertian> at{
      .surface = {.position = {1, 2, 3}, .position_error = glint::Vec3<float>(1e-6F), .normal = {0, 0, 1}}};
  CHECK(at.leave({0, 0, 1}).origin.z > 3);
  CHECK(at.leave({0, 0, -1}).origin.z < 3);
  CHECK(at.leave({0, 0, 1}).origin.x == 1);
}

TEST_CASE("interaction: a ray that is there becomes the one that leaves, whatever it was", "[scene][interaction]") {
  const glint::Interaction<glint::Lambertian> at{
      .surface = {.position = {1, 2, 3}, .position_error = glint::Vec3<float>(1e-6F), .normal = {0, 0, 1}}};
  glint::Ray<float> ray{.origin = {7, 7, 7}, .direction = {1, 0, 0}, .t_min = 2, .t_max = 3, .time = 0.5F, .mask = 1};
  at.leave({0, 0.6F, -0.8F}, ray);
  CHECK(ray == at.leave({0, 0.6F, -0.8F}));
}

TEST_CASE("interaction: a ray to a point is there at t = 1", "[scene][interaction]") {
  const glint::Interaction<glint::Lambertian> at{.surface = {.position = {0, 0, 0}}};
  const auto ray = at.leave_to({1, 2, 3});
  CHECK(ray.t_max <= 1);
  CHECK(ray.t_max > 0.9999F);
  CHECK(glm::length(ray.at(1) - glint::Vec3<float>{1, 2, 3}) < 1e-5F);
}

}  // namespace test_scene_interaction
