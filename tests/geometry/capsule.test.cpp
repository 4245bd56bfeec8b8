// SPDX-License-Identifier: MIT
#include <glint/geometry/capsule.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/closest_points.hpp>
#include <support/solids.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bounds_laws.hpp>
#include <glint/testing/primitive_laws.hpp>

namespace test_geometry_capsule {

static_assert(glint::ShadablePrimitive<glint::Capsule<float>> && glint::SampleablePrimitive<glint::Capsule<double>> &&
              glint::ClosestPointPrimitive<glint::Capsule<float>>);

namespace {

using Vec3d = glint::Vec3<double>;

template <typename T>
std::vector<glint::Capsule<T>> capsules() {
  return {{},
          {.start = {1, 2, 3}, .end = {3, 1, 5}, .radius = T(0.5)},
          {.start = {1, 2, 3}, .end = {1, 2, 3}, .radius = T(0.5)},
          {.start = {0, -4, 0}, .end = {0, 4, 0}, .radius = T(0.1)},
          {.start = {0, 0, 0}, .end = {T(0.1), 0, 0}, .radius = 2},
          {.start = {T(1e-6), 0, 0}, .end = {0, T(3e-6), 0}, .radius = T(1e-6)},
          {.start = {T(1e6), 0, 0}, .end = {0, T(3e6), 0}, .radius = T(1e6)}};
}

/// The signed distance, from the definition, in double precision.
template <typename T>
double solid(const glint::Capsule<T>& capsule, const Vec3d& p) {
  const Vec3d axis = Vec3d(capsule.end) - Vec3d(capsule.start);
  const Vec3d local = p - Vec3d(capsule.start);
  const double squared = glm::dot(axis, axis);
  const double f = squared > 0 ? std::clamp(glm::dot(local, axis) / squared, 0.0, 1.0) : 0.0;
  return glm::length(local - axis * f) - double(capsule.radius);
}

}  // namespace

TEMPLATE_TEST_CASE("capsule: is hit on its side and on its round ends", "[geometry][capsule]", float, double) {
  using T = TestType;
  const glint::Capsule<T> capsule{.start = {0, 0, 0}, .end = {0, 0, 4}, .radius = 1};
  const auto t = [&](const glint::Ray<T>& ray) {
    const auto hit = intersect(ray, capsule);
    return hit ? hit->t : T(-1);
  };
  CHECK(t({.origin = {3, 0, 2}, .direction = {-2, 0, 0}}) == T(1));
  CHECK(t({.origin = {0, 0, 9}, .direction = {0, 0, -1}}) == T(4));
  CHECK(t({.origin = {0, 0, 2}, .direction = {0, 0, -1}}) == T(3));
  CHECK(t({.origin = {0, 0, 2}, .direction = {0, 1, 0}}) == T(1));
  CHECK(t({.origin = {T(0.6), 0, 9}, .direction = {0, 0, -1}}) == Approx(4.2));  // the ball at z = 4 is 0.8 high there
  CHECK(t({.origin = {3, 0, T(4.6)}, .direction = {-1, 0, 0}}) == Approx(2.2));
  CHECK(t({.origin = {3, 0, T(5.1)}, .direction = {-1, 0, 0}}) == T(-1));
  CHECK(t({.origin = {3, 0, 4}, .direction = {-1, 0, T(0.99)}}) == T(-1));  // within the endless tube beyond the end
}

TEMPLATE_TEST_CASE("capsule: agrees with a walk along the ray in small steps", "[geometry][capsule]", float, double) {
  using T = TestType;
  for (const auto& capsule : capsules<T>()) {
    const auto box = bounds(capsule);
    const T size = glm::length(extent(box));
    int hits = 0;
    for (const auto& ray : glint::testing::rays_into(box, 300, 5)) {
      const glint::Ray<double> exact{Vec3d(ray.origin), Vec3d(ray.direction)};
      const double t_max = 3 * double(size) / glm::length(exact.direction);
      const auto expected =
          glint::testing::first_sign_change(exact, t_max, [&](const Vec3d& p) { return solid(capsule, p); });
      const auto hit = intersect(ray, capsule);
      if (expected.has_value() != hit.has_value()) {  // the walk may step over a chord that is shorter than a step
        REQUIRE(hit);
        REQUIRE(std::abs(solid(capsule, exact.at(double(hit->t)))) < 1e-5 * double(size));
      }
      if (!hit || !expected) continue;
      ++hits;
      const double rounding = double(std::numeric_limits<T>::epsilon()) * double(size);
      if (std::abs(double(hit->t) - *expected) * glm::length(exact.direction) < 100 * rounding) continue;
      REQUIRE(std::abs(solid(capsule, exact.at(double(hit->t)))) < 30 * rounding);  // grazing: t is soft
    }
    CHECK(hits > 20);
  }
}

TEMPLATE_TEST_CASE("capsule: of equal ends it is the sphere", "[geometry][capsule]", float, double) {
  using T = TestType;
  const glint::Capsule<T> capsule{.start = {1, 2, 3}, .end = {1, 2, 3}, .radius = T(0.5)};
  const glint::Sphere<T> sphere{.center = {1, 2, 3}, .radius = T(0.5)};
  CHECK(area(capsule) == Approx(area(sphere)));
  CHECK(bounds(capsule) == bounds(sphere));
  int hits = 0;
  for (const auto& ray : glint::testing::rays_into(bounds(sphere), 2000, 1)) {
    const auto hit = intersect(ray, capsule);
    const auto expected = intersect(ray, sphere);
    if (!hit || !expected) continue;
    ++hits;
    CHECK(std::abs(double(hit->t) - double(expected->t)) <=
          2e4 * double(std::numeric_limits<T>::epsilon()));  // grazing rays are soft
  }
  CHECK(hits > 1000);
}

TEMPLATE_TEST_CASE("capsule: is not hit without radius, or with a NaN", "[geometry][capsule]", float, double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const glint::Ray<T> ray{.origin = {0, 0, 9}, .direction = {0, 0, -1}};
  REQUIRE(intersect(ray, glint::Capsule<T>{}));
  CHECK_FALSE(intersect(ray, glint::Capsule<T>{.radius = 0}));
  CHECK_FALSE(intersect(ray, glint::Capsule<T>{.radius = -1}));
  CHECK_FALSE(intersect(ray, glint::Capsule<T>{.radius = nan}));
  CHECK_FALSE(intersect(ray, glint::Capsule<T>{.start = {nan, 0, 0}}));
  CHECK_FALSE(intersect(ray, glint::Capsule<T>{.end = {0, 0, nan}}));
}

TEMPLATE_TEST_CASE("capsule: the error bound holds, and rays that leave do not come back", "[geometry][capsule]", float,
                   double) {
  using T = TestType;
  glint::Random random(9);
  for (const auto& capsule : capsules<T>()) {
    for (int i = 0; i < 2000; ++i) {
      const auto at = sample_area(capsule, random.template uniform_vec2<T>()).surface;
      const double off = std::abs(solid(capsule, Vec3d(at.position)));
      // the oracle itself rounds in double precision
      REQUIRE(off <= double(glm::dot(glint::abs(at.normal), at.position_error)) * 1.01);
    }
    const auto count = glint::testing::count_wrong_departures<T>(
        capsule, [&](const glint::Vec2<T>& u) { return sample_area(capsule, u).surface; });
    CHECK(count == 0);
  }
}

TEMPLATE_TEST_CASE("capsule: uv runs around the axis and from pole to pole", "[geometry][capsule]", float, double) {
  using T = TestType;
  const glint::Capsule<T> capsule{.start = {0, 0, 0}, .end = {0, 0, 2}, .radius = 1};  // its frame: the world's
  const double way = glint::pi<double> + 2;  // two quarter circles and the side
  CHECK(surface(capsule, glint::Vec3<T>(0, 0, -1)).uv.y == T(0));
  CHECK(surface(capsule, glint::Vec3<T>(0, 0, 3)).uv.y == Approx(1));
  const auto side = surface(capsule, glint::Vec3<T>(0, 1, T(0.5)));
  CHECK(side.uv.x == Approx(0.25));
  CHECK(side.uv.y == Approx((glint::pi<double> / 2 + 0.5) / way));
  CHECK(side.tangent.x == Approx(-2 * glint::pi<double>));
  CHECK(surface(capsule, glint::Vec3<T>(0, 0, 1)).normal == glint::Vec3<T>(1, 0, 0));  // on the axis
}

TEMPLATE_TEST_CASE("capsule: obeys the laws of Primitive, in tight bounds", "[geometry][capsule][laws]", float,
                   double) {
  const auto seed = GENERATE(range(0U, 8U));
  CAPTURE(seed);
  for (const auto& shape : capsules<TestType>()) {
    CAPTURE(shape.start.x, shape.radius);
    CHECK(glint::testing::violations_of_primitive_laws(shape, seed) == std::vector<std::string>{});
    if (seed == 0) CHECK(glint::testing::violations_of_tight_bounds(shape, seed) == std::vector<std::string>{});
  }
}

TEMPLATE_TEST_CASE("capsule: no point of it is closer than its closest point", "[geometry][capsule]", float, double) {
  using T = TestType;
  const glint::Capsule<T> shape{.start = {T(0.5), 0, -1}, .end = {0, 1, T(0.25)}, .radius = T(0.5)};
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
}

}  // namespace test_geometry_capsule
