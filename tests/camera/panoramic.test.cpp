// SPDX-License-Identifier: MIT
#include <glint/camera/panoramic.hpp>  // first, so the header proves it stands alone

#include <glm/geometric.hpp>

#include <support/catch.hpp>

namespace test_camera_panoramic {

TEST_CASE("panoramic: the target is in the middle, right to the right, up at the top", "[camera][panoramic]") {
  const auto rays = glint::Panoramic{.eye = {0, 0, 5}}.rays(2);
  const auto misses = [&](float x, float y, const glint::Vec3<float>& expected) {
    return glm::length(rays.ray({x, y}, {0, 0}).direction - expected);
  };
  CHECK(rays.ray({0.2F, 0.7F}, {0, 0}).origin == glint::Vec3<float>(0, 0, 5));
  CHECK(misses(0.5F, 0.5F, {0, 0, -1}) < 1e-6F);
  CHECK(misses(0.75F, 0.5F, {1, 0, 0}) < 1e-6F);
  CHECK(misses(0.25F, 0.5F, {-1, 0, 0}) < 1e-6F);
  CHECK(misses(0, 0.5F, {0, 0, 1}) < 1e-6F);  // behind, at both borders
  CHECK(misses(1, 0.5F, {0, 0, 1}) < 1e-6F);
  CHECK(misses(0.3F, 1, {0, 1, 0}) < 1e-6F);
  CHECK(misses(0.3F, 0, {0, -1, 0}) < 1e-6F);
}

}  // namespace test_camera_panoramic
