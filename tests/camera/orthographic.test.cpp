// SPDX-License-Identifier: MIT
#include <glint/camera/orthographic.hpp>  // first, so the header proves it stands alone

#include <glm/geometric.hpp>

#include <support/catch.hpp>

namespace test_camera_orthographic {

TEST_CASE("orthographic: rays are parallel and start in the plane through the eye", "[camera][orthographic]") {
  const glint::Orthographic camera{.eye = {0, 0, 4}, .height = 2};
  const auto rays = camera.rays(1.5F);  // a window of 3 × 2
  const glint::Vec3<float> forward{0, 0, -1};
  CHECK(rays.ray({0.5F, 0.5F}, {0, 0}) == glint::Ray<float>{.origin = {0, 0, 4}, .direction = forward});
  CHECK(rays.ray({0, 0}, {0, 0}) == glint::Ray<float>{.origin = {-1.5F, -1, 4}, .direction = forward});
  CHECK(rays.ray({1, 0}, {0, 0}) == glint::Ray<float>{.origin = {1.5F, -1, 4}, .direction = forward});
  CHECK(rays.ray({0, 1}, {0.5F, 0.5F}) == glint::Ray<float>{.origin = {-1.5F, 1, 4}, .direction = forward});
}

TEST_CASE("orthographic: the middle of the film looks at the target", "[camera][orthographic]") {
  const auto ray =
      glint::Orthographic{.eye = {1, 2, 3}, .target = {4, 6, 3}, .height = 7}.rays(2).ray({0.5F, 0.5F}, {});
  CHECK(glm::length(ray.at(5) - glint::Vec3<float>(4, 6, 3)) < 1e-5F);  // |(3, 4, 0)| = 5
}

}  // namespace test_camera_orthographic
