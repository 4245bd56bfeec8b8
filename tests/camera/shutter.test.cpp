// SPDX-License-Identifier: MIT
#include <glint/camera/shutter.hpp>  // first, so the header proves it stands alone

#include <glint/camera/panoramic.hpp>
#include <glint/camera/perspective.hpp>

#include <support/catch.hpp>

namespace test_camera_shutter {

using glint::Perspective;
using glint::Ray;
using glint::Shutter;

TEST_CASE("shutter: rays are the camera's, at times from opening to closing", "[camera]") {
  const Perspective camera{.eye = {1, 2, 3}};
  const auto rays = Shutter{camera, 0.25F, 0.75F}.rays(1.5F);
  static_assert(glint::Camera<Shutter<Perspective>> && glint::TimedRayGenerator<decltype(rays)>);
  static_assert(!glint::TimedRayGenerator<glint::PerspectiveRays>);
  Ray<float> expected = camera.rays(1.5F).ray({0.1F, 0.7F}, {0.5F, 0.5F});
  for (const float moment : {0.0F, 0.5F}) {  // 0.25 + 0.5 · moment: exact
    expected.time = moment == 0.0F ? 0.25F : 0.5F;
    CHECK(rays.ray({0.1F, 0.7F}, {0.5F, 0.5F}, moment) == expected);
  }
  expected.time = 0.25F;
  CHECK(rays.ray({0.1F, 0.7F}, {0.5F, 0.5F}) == expected);
}

TEST_CASE("shutter: paths from lights find the camera behind it", "[camera]") {
  const Perspective camera{.eye = {0, 0, 3}};
  const auto rays = Shutter{camera}.rays(1.0F);
  static_assert(glint::ImportanceGenerator<decltype(rays)>);
  CHECK(rays.sample_toward({0.1F, 0, 0}, {0.5F, 0.5F}) == camera.rays(1.0F).sample_toward({0.1F, 0, 0}, {0.5F, 0.5F}));
  const auto ray = rays.ray({0.5F, 0.5F}, {0.5F, 0.5F}, 0.3F);
  CHECK(rays.importance(ray, 2.0F) == camera.rays(1.0F).importance(ray, 2.0F));
}

}  // namespace test_camera_shutter
