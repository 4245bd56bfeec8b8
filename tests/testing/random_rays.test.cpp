// SPDX-License-Identifier: MIT
#include <glint/testing/random_rays.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <limits>

#include <support/catch.hpp>

#include <glint/geometry/box.hpp>

namespace test_testing_random_rays {

namespace {

namespace rays = glint::testing;

template <typename T>
const glint::Aabb<T> box{{T(-1), T(0), T(2)}, {T(2), T(0.5), T(4)}};

}  // namespace

TEMPLATE_TEST_CASE("random rays: depend on the seed and on nothing else", "[testing][rays]", float, double) {
  using T = TestType;
  CHECK(rays::rays_into(box<T>, 10, 1) == rays::rays_into(box<T>, 10, 1));
  CHECK_FALSE(rays::rays_into(box<T>, 10, 1) == rays::rays_into(box<T>, 10, 2));
  CHECK_FALSE(rays::rays_within(box<T>, 10, 1) == rays::rays_within(box<T>, 10, 2));
  CHECK_FALSE(rays::axis_aligned_rays(box<T>, 10, 1) == rays::axis_aligned_rays(box<T>, 10, 2));
  CHECK_FALSE(rays::rays_in_face_planes(box<T>, 10, 1) == rays::rays_in_face_planes(box<T>, 10, 2));
}

TEMPLATE_TEST_CASE("random rays: those within a box start in it, in all directions alike", "[testing][rays]", float,
                   double) {
  using T = TestType;
  const auto all = rays::rays_within(box<T>, 4000, 1);
  REQUIRE(all.size() == 4000);
  glint::Vec3<double> mean(0.0);
  glint::Vec3<double> squares(0.0);
  for (const auto& ray : all) {
    CHECK(contains(box<T>, ray.origin));
    CHECK(std::abs(glm::length(ray.direction) - T(1)) <= 8 * std::numeric_limits<T>::epsilon());
    const glint::Vec3<double> d(ray.direction);
    mean += d / 4000.0;
    squares += d * d / 4000.0;
  }
  // a component of a uniform direction is uniform in [−1, 1]: variance 1/3, that of its square 4/45; five deviations
  CHECK(glint::max_component(glint::abs(mean)) < 5 * std::sqrt(1.0 / 3 / 4000));
  CHECK(glint::max_component(glint::abs(squares - 1.0 / 3)) < 5 * std::sqrt(4.0 / 45 / 4000));
}

TEMPLATE_TEST_CASE("random rays: those into a box start outside and hit it", "[testing][rays]", float, double) {
  using T = TestType;
  for (const auto& ray : rays::rays_into(box<T>, 1000, 1)) {
    CHECK_FALSE(contains(box<T>, ray.origin));
    CHECK(intersect(ray, glint::Box<T>{box<T>.lower, box<T>.upper}));
  }
}

TEMPLATE_TEST_CASE("random rays: axis-aligned ones cross the box along one axis", "[testing][rays]", float, double) {
  using T = TestType;
  int negative_zeros = 0;
  for (const auto& ray : rays::axis_aligned_rays(box<T>, 1000, 1)) {
    const auto& d = ray.direction;
    CHECK(std::abs(d.x) + std::abs(d.y) + std::abs(d.z) == T(1));
    CHECK(glint::max_component(glint::abs(d)) == T(1));
    const auto hit = intersect(ray, glint::Box<T>{box<T>.lower, box<T>.upper});
    REQUIRE(hit);
    CHECK(hit->t == T(0));
    if ((d.x == T(0) && std::signbit(d.x)) || (d.y == T(0) && std::signbit(d.y))) ++negative_zeros;
  }
  CHECK(negative_zeros > 300);
  CHECK(negative_zeros < 700);
}

TEMPLATE_TEST_CASE("random rays: those in face planes stay in them", "[testing][rays]", float, double) {
  using T = TestType;
  for (const auto& ray : rays::rays_in_face_planes(box<T>, 1000, 1)) {
    const auto in_plane = [&](int axis) {
      const T o = glint::component(ray.origin, axis);
      return glint::component(ray.direction, axis) == T(0) &&
             (o == glint::component(box<T>.lower, axis) || o == glint::component(box<T>.upper, axis));
    };
    CHECK((in_plane(0) || in_plane(1) || in_plane(2)));
  }
}

}  // namespace test_testing_random_rays
