// SPDX-License-Identifier: MIT
#include <glint/camera/importance.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/camera/orthographic.hpp>
#include <glint/camera/panoramic.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/camera/thin_lens.hpp>
#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>
#include <glint/testing/camera_laws.hpp>

namespace test_camera_importance {

using glint::Vec2;
using glint::Vec3;
using glint::testing::violations_of_camera_laws;

namespace {

const Vec3<float> eye{1, 2, 3};
const Vec3<float> target{-1, 1, -2};

/// The importance of all directions from a part of the lens, at unit distance from it.
template <typename G>
double total_importance(const G& rays, const Vec3<float>& lens_point, const Vec2<float>& lens) {
  glint::Random random{3};
  constexpr int n = 400'000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const auto seen = sample_toward(rays, lens_point + glint::uniform_sphere(random.uniform_vec2()), lens);
    if (seen) sum += static_cast<double>(seen->importance) * 4 * glint::pi<double> / n;
  }
  return sum;
}

/// Rays, and no more.
struct OneWay {
  [[nodiscard]] glint::Ray<float> ray(const Vec2<float>& /*film*/, const Vec2<float>& /*lens*/) const { return {}; }
};

}  // namespace

TEST_CASE("importance: all cameras obey the laws", "[camera][importance][laws]") {
  const glint::ThinLens lens{
      .eye = eye, .target = target, .fov_y_radians = 1, .lens_radius = 0.2F, .focus_distance = 3};
  CHECK(violations_of_camera_laws(glint::Perspective{.eye = eye, .target = target}.rays(1.6F), 1).empty());
  CHECK(violations_of_camera_laws(lens.rays(0.7F), 2).empty());
  CHECK(
      violations_of_camera_laws(glint::Orthographic{.eye = eye, .target = target, .height = 3}.rays(1.6F), 3).empty());
  CHECK(violations_of_camera_laws(glint::Panoramic{.eye = eye, .target = target}.rays(2), 4).empty());
}

TEST_CASE("importance: over all directions it integrates to one", "[camera][importance]") {
  // On the unit sphere around the lens's point, importance is the density by solid angle.
  const auto pinhole = glint::Perspective{.eye = eye, .target = target, .fov_y_radians = 1.5F}.rays(1.5F);
  CHECK(total_importance(pinhole, eye, {}) == Approx(1).epsilon(0.02));  // error of the mean: 0.4 %
  const auto lens =
      glint::ThinLens{.eye = eye, .target = target, .fov_y_radians = 1.5F, .lens_radius = 0.3F, .focus_distance = 4}
          .rays(1);
  const Vec2<float> u{0.9F, 0.2F};
  CHECK(total_importance(lens, lens.ray({}, u).origin, u) == Approx(1).epsilon(0.02));
  CHECK(total_importance(glint::Panoramic{.eye = eye, .target = target}.rays(2), eye, {}) == Approx(1).epsilon(0.02));
}

TEST_CASE("importance: what is behind the camera or beside the picture is not seen", "[camera][importance]") {
  const auto rays = glint::Perspective{.eye = {0, 0, 0}, .target = {0, 0, -1}, .fov_y_radians = 1}.rays(1);
  CHECK(rays.sample_toward({0, 0, -2}, {}));
  CHECK_FALSE(rays.sample_toward({0, 0, 2}, {}));
  CHECK_FALSE(rays.sample_toward({2, 0, -2}, {}));  // at 45°, and the picture ends at 0.5 rad
  CHECK_FALSE(rays.sample_toward({0, 0, 0}, {}));
  const auto parallel = glint::Orthographic{.eye = {0, 0, 0}, .target = {0, 0, -1}, .height = 2}.rays(1);
  CHECK(parallel.sample_toward({0.9F, -0.9F, -5}, {}));
  CHECK_FALSE(parallel.sample_toward({0, 0, 1}, {}));
  CHECK_FALSE(parallel.sample_toward({1.1F, 0, -5}, {}));
}

TEST_CASE("importance: one of several cameras answers as itself, and one without answers shows nothing",
          "[camera][importance]") {
  const glint::Perspective pinhole{.eye = eye, .target = target};
  const glint::OneOf<glint::Panoramic, glint::Perspective> any{pinhole};
  const Vec3<float> point{-1, 1.1F, -2};
  CHECK(sample_toward(any.rays(1.5F), point, {}) == pinhole.rays(1.5F).sample_toward(point, {}));
  const glint::Ray<float> ray = pinhole.rays(1.5F).ray({0.3F, 0.3F}, {});
  CHECK(importance(any.rays(1.5F), ray, 2) == pinhole.rays(1.5F).importance(ray, 2));
  CHECK_FALSE(glint::sample_toward(OneWay{}, point, {}));
  CHECK(importance(OneWay{}, ray, 2) == 0);
}

}  // namespace test_camera_importance
