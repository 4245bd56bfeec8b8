// SPDX-License-Identifier: MIT
#include <glint/camera/thin_lens.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <random>

#include <support/catch.hpp>

namespace test_camera_thin_lens {

namespace {

constexpr glint::ThinLens camera{
    .eye = {1, 2, 8}, .target = {0, 1, -2}, .up = {0.1F, 1, 0}, .lens_radius = 0.5F, .focus_distance = 6};

/// Where a ray meets the plane at some distance along the view.
glint::Vec3<float> at_distance(const glint::Ray<float>& ray, float distance) {
  const auto forward = glm::normalize(camera.target - camera.eye);
  const float ahead = distance - glm::dot(ray.origin - camera.eye, forward);
  return ray.at(ahead / glm::dot(ray.direction, forward));
}

}  // namespace

TEST_CASE("thin lens: a point in the plane of focus is sharp through every part of the lens", "[camera][thin_lens]") {
  const auto rays = camera.rays(1.5F);
  const auto pinhole = glint::Perspective{.eye = camera.eye, .target = camera.target, .up = camera.up}.rays(1.5F);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int i = 0; i < 200; ++i) {
    const glint::Vec2<float> film{unit(random), unit(random)};
    const glint::Vec2<float> lens{unit(random), unit(random)};
    const auto sharp = at_distance(pinhole.ray(film, {0, 0}), 6);
    const auto ray = rays.ray(film, lens);
    CHECK(glm::length(at_distance(ray, 6) - sharp) < 1e-5F);
    CHECK(glm::length(ray.direction) == Approx(1).epsilon(3e-7));
  }
}

TEST_CASE("thin lens: the blur of a point is as wide as similar triangles say", "[camera][thin_lens]") {
  // At twice the distance of focus the lens of radius ½ throws a disk of radius ½ · |12 − 6| / 6 = ½; rays from the
  // rim of the lens (lens at the border of the unit square) reach its rim.
  const auto rays = camera.rays(1);
  const auto center = at_distance(rays.ray({0.3F, 0.6F}, {0.5F, 0.5F}), 12);
  for (const float x : {0.0F, 0.25F, 0.5F, 1.0F}) {
    const auto rim = at_distance(rays.ray({0.3F, 0.6F}, {x, 0}), 12);
    CHECK(glm::length(rim - center) == Approx(0.5).epsilon(1e-4));
  }
}

TEST_CASE("thin lens: origins fill the lens evenly, across the view", "[camera][thin_lens]") {
  // Of a disk of radius R, half of the area lies within R / √2, and the mean is the center.
  const auto rays = camera.rays(1);
  const auto forward = glm::normalize(camera.target - camera.eye);
  constexpr int n = 100;
  glint::Vec3<float> mean{0};
  int inner = 0;
  for (int i = 0; i < n * n; ++i) {
    const glint::Vec2<float> lens{(static_cast<float>(i % n) + 0.5F) / n, (static_cast<float>(i / n) + 0.5F) / n};
    const auto shift = rays.ray({0.5F, 0.5F}, lens).origin - camera.eye;
    CHECK(std::abs(glm::dot(shift, forward)) < 1e-5F);
    CHECK(glm::length(shift) <= 0.50001F);
    mean += shift / static_cast<float>(n * n);
    inner += glm::length(shift) < 0.5F / std::sqrt(2.0F) ? 1 : 0;
  }
  CHECK(glm::length(mean) < 1e-5F);
  CHECK(static_cast<double>(inner) / (n * n) ==
        Approx(0.5).margin(0.01));  // cells cut by the circle: about 4 · 71 / 10⁴
}

TEST_CASE("thin lens: without a radius it is the pinhole camera", "[camera][thin_lens]") {
  const glint::ThinLens closed{.eye = {0, 0, 3}, .lens_radius = 0, .focus_distance = 4};
  const glint::Perspective pinhole{.eye = {0, 0, 3}};
  const auto a = closed.rays(1.25F).ray({0.2F, 0.9F}, {0.3F, 0.8F});
  const auto b = pinhole.rays(1.25F).ray({0.2F, 0.9F}, {0.3F, 0.8F});
  CHECK(a.origin == b.origin);
  CHECK(glm::length(a.direction - b.direction) < 3e-7F);
}

}  // namespace test_camera_thin_lens
