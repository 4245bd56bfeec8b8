// SPDX-License-Identifier: MIT
#include <glint/camera/neighbor_rays.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <glm/geometric.hpp>

#include <support/catch.hpp>

#include <glint/camera/orthographic.hpp>
#include <glint/camera/panoramic.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/camera/thin_lens.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>

namespace test_camera_neighbor_rays {

namespace {

using glint::RayDifferential;
using glint::Vec2;
using glint::Vec3;

constexpr Vec2<float> step{1.0F / 400, 1.0F / 300};

/// The derivative of a normalized vector: (d′ − n (n · d′)) / |d|.
Vec3<float> derivative_of_unit(const Vec3<float>& d, const Vec3<float>& rate) {
  const Vec3<float> n = glm::normalize(d);
  return (rate - n * glm::dot(n, rate)) / glm::length(d);
}

/// Finite steps differ from derivatives by the second order: about the step, relatively.
void check_close(const Vec3<float>& found, const Vec3<float>& expected) {
  CHECK(glm::distance(found, expected) <= 0.02F * glm::length(expected) + 1e-6F);
}

template <typename F>
void for_each_place(const F& f) {
  glint::Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec2<float> film{random.uniform<float>(), random.uniform<float>()};
    f(film, Vec2<float>{random.uniform<float>(), random.uniform<float>()});
  }
}

}  // namespace

TEST_CASE("neighbor rays: a pinhole's turn as the derivative of their direction says", "[camera][neighbor_rays]") {
  const auto rays = glint::Perspective{.eye = {1, 2, 3}, .target = {0, 1, 0}}.rays(4.0F / 3);
  for_each_place([&](const Vec2<float>& film, const Vec2<float>& lens) {
    const RayDifferential found = ray_differential(rays, film, lens, step);
    const Vec3<float> d = rays.corner + film.x * rays.across + film.y * rays.upward;
    check_close(found.direction_x, derivative_of_unit(d, rays.across * step.x));
    check_close(found.direction_y, derivative_of_unit(d, rays.upward * step.y));
    CHECK(found.origin_x == Vec3<float>(0.0F));
    CHECK(found.origin_y == Vec3<float>(0.0F));
  });
}

TEST_CASE("neighbor rays: a thin lens's start at the same point of the lens", "[camera][neighbor_rays]") {
  const auto rays =
      glint::ThinLens{.eye = {1, 2, 3}, .target = {0, 1, 0}, .lens_radius = 0.3F, .focus_distance = 2}.rays(4.0F / 3);
  for_each_place([&](const Vec2<float>& film, const Vec2<float>& lens) {
    const RayDifferential found = ray_differential(rays, film, lens, step);
    const Vec2<float> at = glint::concentric_disk(lens);
    const Vec3<float> d = rays.focus.corner + film.x * rays.focus.across + film.y * rays.focus.upward -
                          at.x * rays.lens_x - at.y * rays.lens_y;
    check_close(found.direction_x, derivative_of_unit(d, rays.focus.across * step.x));
    check_close(found.direction_y, derivative_of_unit(d, rays.focus.upward * step.y));
    CHECK(found.origin_x == Vec3<float>(0.0F));
  });
}

TEST_CASE("neighbor rays: parallel ones move by a pixel of the view", "[camera][neighbor_rays]") {
  const auto rays = glint::Orthographic{.height = 3}.rays(4.0F / 3);
  for_each_place([&](const Vec2<float>& film, const Vec2<float>& lens) {
    const RayDifferential found = ray_differential(rays, film, lens, step);
    check_close(found.origin_x, {4 * step.x, 0, 0});  // the view is 4 by 3
    check_close(found.origin_y, {0, 3 * step.y, 0});
    CHECK(found.direction_x == Vec3<float>(0.0F));
    CHECK(found.direction_y == Vec3<float>(0.0F));
  });
}

TEST_CASE("neighbor rays: a panorama's turn by 2π a width and π a height", "[camera][neighbor_rays]") {
  const auto rays = glint::Panoramic{}.rays(2);
  for_each_place([&](const Vec2<float>& film, const Vec2<float>& lens) {
    const RayDifferential found = ray_differential(rays, film, lens, step);
    const float sine = std::sin(glint::pi<float> * film.y);  // of the angle from the pole
    CHECK(glm::length(found.direction_x) == Approx(2 * glint::pi<double> * step.x * sine).epsilon(0.01).margin(1e-6));
    CHECK(glm::length(found.direction_y) == Approx(glint::pi<double> * step.y).epsilon(0.01));
    CHECK(std::abs(glm::dot(found.direction_x, found.direction_y)) < 1e-6F);
  });
}

}  // namespace test_camera_neighbor_rays
