// SPDX-License-Identifier: MIT
#include <glint/camera/perspective.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <nlohmann/json.hpp>

#include <support/catch.hpp>
#include <support/shared.hpp>

namespace test_camera_perspective {

namespace {

glint::Vec3<float> point(const nlohmann::json& xyz) {
  return {xyz.at(0).get<float>(), xyz.at(1).get<float>(), xyz.at(2).get<float>()};
}

}  // namespace

TEST_CASE("perspective: the middle of the film looks at the target", "[camera][perspective]") {
  const auto rays = glint::Perspective{.eye = {1, 2, 3}, .target = {4, 6, 3}}.rays(1.5F);
  const auto ray = rays.ray({0.5F, 0.5F}, {0, 0});
  CHECK(ray.origin == glint::Vec3<float>(1, 2, 3));
  CHECK(glm::length(ray.direction - glint::Vec3<float>(0.6F, 0.8F, 0)) < 3e-7F);  // (3, 4, 0) / 5
}

TEST_CASE("perspective: the field of view is the full vertical angle", "[camera][perspective]") {
  const float fov = glint::radians(60.0F);
  const auto rays = glint::Perspective{.fov_y_radians = fov}.rays(2);
  const auto top = rays.ray({0.5F, 1}, {0, 0}).direction;
  const auto bottom = rays.ray({0.5F, 0}, {0, 0}).direction;
  CHECK(std::acos(glm::dot(top, bottom)) == Approx(fov).epsilon(1e-5));
  CHECK(top.y > 0);  // film y points up
  // The window is twice as wide as high: tan of half the horizontal angle is 2 tan 30°.
  const auto right = rays.ray({1, 0.5F}, {0, 0}).direction;
  CHECK(right.x / -right.z == Approx(2 / std::sqrt(3.0)).epsilon(1e-6));
}

TEST_CASE("perspective: directions have unit length and ignore the lens", "[camera][perspective]") {
  const auto rays = glint::Perspective{.eye = {5, -2, 7}, .fov_y_radians = 2.5F}.rays(1.7F);
  for (const float x : {0.0F, 0.3F, 1.0F}) {
    for (const float y : {0.0F, 0.9F, 1.0F}) {
      const auto ray = rays.ray({x, y}, {0, 0});
      CHECK(glm::length(ray.direction) == Approx(1).epsilon(3e-7));
      CHECK(ray == rays.ray({x, y}, {0.7F, 0.1F}));
    }
  }
}

TEST_CASE("perspective: agrees with directions worked out in double precision", "[camera][perspective][vectors]") {
  const auto text = glint::testing::shared_file("vectors/camera.json");
  if (!text) return;
  const auto vectors = nlohmann::json::parse(*text);
  for (const auto& expected : vectors.at("cases")) {
    CAPTURE(expected.dump());
    const float width = expected.at("resolution").at(0).get<float>();
    const float height = expected.at("resolution").at(1).get<float>();
    const glint::Perspective camera{.eye = point(expected.at("position")),
                                    .target = point(expected.at("look_at")),
                                    .up = point(expected.at("ref_up")),
                                    .fov_y_radians = glint::radians(expected.at("fov").get<float>())};
    const glint::Vec2<float> film{expected.at("film_xy").at(0).get<float>() / width,
                                  expected.at("film_xy").at(1).get<float>() / height};
    const auto ray = camera.rays(width / height).ray(film, {0, 0});
    CHECK(glm::length(ray.direction - point(expected.at("direction"))) <= vectors.at("tolerance").get<float>());
  }
}

}  // namespace test_camera_perspective
