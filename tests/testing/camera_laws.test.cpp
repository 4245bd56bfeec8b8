// SPDX-License-Identifier: MIT
#include <glint/testing/camera_laws.hpp>  // first, so the header proves it stands alone

#include <optional>

#include <support/catch.hpp>

#include <glint/camera/perspective.hpp>

namespace test_testing_camera_laws {

namespace {

/// A pinhole camera with a slip.
struct Broken {
  glint::PerspectiveRays rays = glint::Perspective{}.rays(1.5F);
  float scale = 1;
  float shift = 0;

  [[nodiscard]] glint::Ray<float> ray(const glint::Vec2<float>& film, const glint::Vec2<float>& lens) const {
    return rays.ray(film, lens);
  }
  [[nodiscard]] std::optional<glint::CameraSample> sample_toward(const glint::Vec3<float>& point,
                                                                 const glint::Vec2<float>& lens) const {
    auto seen = rays.sample_toward(point, lens);
    if (!seen) return seen;
    seen->film.x += shift;
    seen->importance *= scale;
    return seen;
  }
  [[nodiscard]] float importance(const glint::Ray<float>& ray, float distance) const {
    return rays.importance(ray, distance) * scale;
  }
};

}  // namespace

TEST_CASE("camera laws: find a wrong density and a wrong film position, each by one sentence",
          "[testing][camera_laws]") {
  CHECK(glint::testing::violations_of_camera_laws(Broken{}, 1).empty());
  CHECK(glint::testing::violations_of_camera_laws(Broken{.scale = 1.05F}, 1).size() == 1);
  CHECK(glint::testing::violations_of_camera_laws(Broken{.shift = 0.01F}, 1).size() == 1);
}

}  // namespace test_testing_camera_laws
