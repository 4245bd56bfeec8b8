// SPDX-License-Identifier: MIT
#include <glint/geometry/transform.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

#include <glint/geometry/sphere.hpp>
#include <glint/math/random.hpp>

namespace test_geometry_transform {

namespace {

template <typename T>
glint::Affine<T> random_affine(glint::Random& random) {
  const auto axis = random.uniform_vec3<T>() + T(0.1);
  const T angle = random.uniform(T(0), T(6));
  const auto factors = random.uniform_vec3<T>() * T(3) + T(0.2);
  const auto by = random.uniform_vec3<T>() * T(10) - T(5);
  using A = glint::Affine<T>;
  return A::translate(by) * A::rotate(axis, angle) * A::scale({factors.x, -factors.y, factors.z});
}

}  // namespace

TEMPLATE_TEST_CASE("transform: a ray keeps its t", "[geometry][transform]", float, double) {
  using T = TestType;
  const auto affine = glint::Affine<T>::translate({0, 0, 1}) * glint::Affine<T>::scale({2, 2, 2});
  const glint::Ray<T> ray{{1, 0, 0}, {0, 0, 3}, T(0.5), T(2), T(0.25)};
  const auto moved = transform(affine, ray);
  CHECK(moved == glint::Ray<T>{{2, 0, 1}, {0, 0, 6}, T(0.5), T(2), T(0.25)});
  CHECK(moved.at(1) == affine.point(ray.at(1)));
}

TEMPLATE_TEST_CASE("transform: a box becomes the box of its eight corners", "[geometry][transform]", float, double) {
  using T = TestType;
  glint::Random random(11);
  for (int i = 0; i < 100; ++i) {
    const auto affine = random_affine<T>(random);
    const auto lower = random.template uniform_vec3<T>() - T(0.5);
    const glint::Aabb<T> box{lower, lower + random.template uniform_vec3<T>()};
    glint::Aabb<T> corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
      extend(corners, affine.point({(corner & 1U) != 0 ? box.upper.x : box.lower.x,
                                    (corner & 2U) != 0 ? box.upper.y : box.lower.y,
                                    (corner & 4U) != 0 ? box.upper.z : box.lower.z}));
    }
    const auto image = transform(affine, box);
    const T rounding = T(32) * std::numeric_limits<T>::epsilon() * T(10);
    CHECK(glint::max_component(glint::abs(image.lower - corners.lower)) <= rounding);
    CHECK(glint::max_component(glint::abs(image.upper - corners.upper)) <= rounding);
  }
}

TEMPLATE_TEST_CASE("transform: empty boxes stay empty and unbounded axes stay unbounded", "[geometry][transform]",
                   float, double) {
  using T = TestType;
  const auto affine = glint::Affine<T>::translate({1, 2, 3});
  CHECK(transform(affine, glint::Aabb<T>{}) == glint::Aabb<T>{});
  const T inf = glint::infinity<T>;
  CHECK(transform(affine, glint::Aabb<T>{{-inf, 0, 0}, {inf, 1, 0}}) == glint::Aabb<T>{{-inf, 2, 3}, {inf, 3, 3}});
}

TEMPLATE_TEST_CASE("transform: a carried surface lies within its error bound of the carried sphere",
                   "[geometry][transform]", float, double) {
  using T = TestType;
  glint::Random random(5);
  const glint::Sphere<T> sphere{.center = {1, 2, 3}, .radius = 2};
  for (int i = 0; i < 300; ++i) {
    const auto to_world = random_affine<T>(random);
    const auto to_local = inverse(to_world);
    REQUIRE(to_local);
    const auto local = sample_area(sphere, random.template uniform_vec2<T>()).surface;
    const auto world = transform(to_world, *to_local, local);
    // the oracle: the same map in long double, of the exact point of the sphere nearest to the local position
    using L = long double;
    const glint::Affine<L> exact{glint::Mat3<L>(to_world.linear), glint::Vec3<L>(to_world.translation)};
    const auto outward = glint::Vec3<L>(local.position) - glint::Vec3<L>(sphere.center);
    const auto nearest = glint::Vec3<L>(sphere.center) + glm::normalize(outward) * L(sphere.radius);
    const auto off = glint::abs(exact.point(nearest) - glint::Vec3<L>(world.position));
    CHECK(off.x <= L(world.position_error.x));
    CHECK(off.y <= L(world.position_error.y));
    CHECK(off.z <= L(world.position_error.z));
    CHECK(glint::max_component(world.position_error) < T(100) * std::numeric_limits<T>::epsilon() * T(20));
    CHECK(std::abs(glm::dot(world.normal, world.tangent)) <=
          T(64) * std::numeric_limits<T>::epsilon() * glm::length(world.tangent));
    CHECK(glm::dot(world.normal, to_world.vector(local.normal)) > T(0));
  }
}

TEMPLATE_TEST_CASE("transform: an unknown position error stays unknown", "[geometry][transform]", float, double) {
  const glint::Affine<TestType> identity;
  CHECK(transform(identity, identity, glint::SurfaceOf<TestType>{}) == glint::SurfaceOf<TestType>{});
}

}  // namespace test_geometry_transform
