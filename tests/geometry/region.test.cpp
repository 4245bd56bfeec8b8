// SPDX-License-Identifier: MIT
#include <glint/geometry/region.hpp>  // first, so the header proves it stands alone

#include <cstddef>

#include <glm/gtc/matrix_transform.hpp>

#include <glint/math/random.hpp>

#include <support/catch.hpp>

namespace test_geometry_region {

namespace {

using glint::Aabb;
using glint::Ball;
using glint::Frustum;
using glint::Vec3;

template <typename T>
bool holds(const Frustum<T>& frustum, const Vec3<T>& p) {
  bool inside = true;
  for (const auto& side : frustum.sides) inside &= glm::dot(side.normal, p) + side.offset >= T(0);
  return inside;
}

template <typename T>
bool holds(const Ball<T>& ball, const Vec3<T>& p) {
  return glint::length_squared(p - ball.center) <= ball.radius * ball.radius;
}

template <typename T>
Vec3<T> anywhere(glint::Random& random, T reach) {
  return (random.uniform_vec3<T>() * T(2) - T(1)) * reach;
}

/// Random boxes that a region says it does not overlap, or that it contains, though a point of theirs says otherwise.
template <typename Region, typename T>
std::size_t contradictions(const Region& region, T reach) {
  glint::Random random(4);
  std::size_t wrong = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3<T> center = anywhere(random, reach);
    const Vec3<T> half = random.uniform_vec3<T>() * reach * T(0.3);
    const Aabb<T> box{center - half, center + half};
    for (int k = 0; k < 20; ++k) {
      const Vec3<T> p = center + half * anywhere(random, T(0.999));
      wrong += std::size_t(holds(region, p) ? !overlaps(box, region) : contains(region, box));
    }
  }
  return wrong;
}

}  // namespace

TEMPLATE_TEST_CASE("region: no point of a box contradicts what is said of the box", "[geometry][region]", float,
                   double) {
  using T = TestType;
  CHECK(contradictions(Ball<T>{{T(0.2), 0, 0}, T(0.7)}, T(1)) == 0);
  const auto view = glm::perspective(T(1), T(1.5), T(0.5), T(20)) *
                    glm::lookAt(glm::vec<3, T>(1, 2, 3), glm::vec<3, T>(0, 0, 0), glm::vec<3, T>(0, 1, 0));
  CHECK(contradictions(glint::frustum_of(view), T(10)) == 0);
}

TEMPLATE_TEST_CASE("region: a ball touches a box at its nearest point and holds it by its farthest corner",
                   "[geometry][region]", float, double) {
  using T = TestType;
  const Aabb<T> box{{1, 1, 1}, {2, 3, 3}};  // from the origin: √3 to 1 1 1, √22 to 2 3 3
  CHECK(overlaps(box, Ball<T>{{0, 0, 0}, T(1.7321)}));
  CHECK_FALSE(overlaps(box, Ball<T>{{0, 0, 0}, T(1.7320)}));
  CHECK(contains(Ball<T>{{0, 0, 0}, T(4.6905)}, box));
  CHECK_FALSE(contains(Ball<T>{{0, 0, 0}, T(4.6904)}, box));
  CHECK_FALSE(overlaps(Aabb<T>{}, Ball<T>{}));
  CHECK(contains(Ball<T>{}, Aabb<T>{}));
}

TEMPLATE_TEST_CASE("region: a camera's frustum holds what is in front of it between near and far", "[geometry][region]",
                   float, double) {
  using T = TestType;
  // A right angle of view, looking down −z from the origin: |x|, |y| ≤ −z, 1 ≤ −z ≤ 10.
  const Frustum<T> frustum = glint::frustum_of(glm::perspective(glint::pi<T> / 2, T(1), T(1), T(10)));
  CHECK(holds(frustum, Vec3<T>{T(4.9), T(-4.9), -5}));
  CHECK_FALSE(holds(frustum, Vec3<T>{T(5.1), 0, -5}));
  CHECK_FALSE(holds(frustum, Vec3<T>{0, 0, T(-0.9)}));
  CHECK_FALSE(holds(frustum, Vec3<T>{0, 0, T(-10.1)}));
  CHECK(holds(frustum, Vec3<T>{0, 0, T(-9.9)}));
}

TEMPLATE_TEST_CASE("region: a box's frustum is the box, and follows a map", "[geometry][region]", float, double) {
  using T = TestType;
  const Aabb<T> box{{-1, 0, 2}, {1, 3, 4}};
  const auto map = glint::Affine<T>::translate({5, 0, 0}) * glint::Affine<T>::rotate({0, 1, 1}, T(0.7)) *
                   glint::Affine<T>::scale({2, 1, T(-0.5)});
  const Frustum<T> image = transform_by_inverse(*inverse(map), glint::frustum_of(box));
  glint::Random random(9);
  std::size_t wrong = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3<T> p = anywhere(random, T(5));
    wrong += std::size_t(contains(box, p) != holds(image, map.point(p)));
  }
  CHECK(wrong == 0);
}

TEMPLATE_TEST_CASE("region: boxes overlap where they touch, and empty ones nowhere", "[geometry][region]", float,
                   double) {
  using T = TestType;
  const Aabb<T> unit{{0, 0, 0}, {1, 1, 1}};
  CHECK(overlaps(unit, Aabb<T>{{1, 1, 1}, {2, 2, 2}}));
  CHECK_FALSE(overlaps(unit, Aabb<T>{{T(1.5), 0, 0}, {2, 2, 2}}));
  CHECK_FALSE(overlaps(unit, Aabb<T>{}));
  CHECK(overlaps(unit, Frustum<T>{}));  // all of space
}

}  // namespace test_geometry_region
