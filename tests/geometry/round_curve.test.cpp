// SPDX-License-Identifier: MIT
#include <glint/geometry/round_curve.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/geometry/capsule.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/offset.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bounds_laws.hpp>
#include <glint/testing/primitive_laws.hpp>

namespace test_geometry_round_curve {

static_assert(glint::ShadablePrimitive<glint::RoundCurve<float>> &&
              glint::ShadablePrimitive<glint::RoundCurve<double>>);

namespace {

using Vec3d = glint::Vec3<double>;

template <typename T>
std::vector<glint::RoundCurve<T>> curves() {
  using Points = std::array<glint::CurvePoint<T>, 4>;
  return {
      {{Points{{{{0, 0, 0}, T(0.1)}, {{1, 0, 1}, T(0.2)}, {{2, 1, 0}, T(0.2)}, {{3, 1, 1}, T(0.05)}}}}},
      {{Points{{{{0, 0, 0}, T(0.3)}, {{1, 0, 0}, T(0.3)}, {{2, 0, 0}, T(0.3)}, {{3, 0, 0}, T(0.3)}}}}},
      {{Points{{{{5, 5, 5}, T(0.2)}, {{9, 5, 5}, T(0.1)}, {{5, 6, 6}, T(0.1)}, {{8, 8, 5}, T(0.2)}}}}},        // a bend
      {{Points{{{{0, 0, 0}, T(0.02)}, {{0, 2, 0}, T(0.015)}, {{1, 4, 0}, T(0.01)}, {{3, 4, 2}, T(0.005)}}}}},  // a hair
      {{Points{
          {{{-1, 0, 0}, T(0.05)}, {{3, 0, 2}, T(0.05)}, {{-3, 0, 2}, T(0.05)}, {{1, 0, 0}, T(0.05)}}}}}};  // a loop
}

/// The oracle: the first of very many spheres along the curve, in double precision.
template <typename T>
double first_sphere(const glint::RoundCurve<T>& shape, const Vec3d& origin, const Vec3d& direction, double margin) {
  double nearest = glint::infinity<double>;
  constexpr int spheres = 20000;
  glint::BezierCurve<double> curve;
  for (std::size_t i = 0; i < 4; ++i) {
    curve.points[i] = {Vec3d(shape.curve.points[i].position), double(shape.curve.points[i].radius)};
  }
  for (int i = 0; i <= spheres; ++i) {
    const auto p = curve.at(double(i) / spheres);
    const Vec3d o = origin - p.position;
    const double a = glm::dot(direction, direction);
    const double middle = -glm::dot(o, direction) / a;
    const Vec3d gap = o + direction * middle;
    const double radius = p.radius + margin;
    const double f = radius * radius - glm::dot(gap, gap);
    if (f >= 0 && radius > 0) nearest = std::min(nearest, middle - std::sqrt(f / a));
  }
  return nearest;
}

}  // namespace

TEMPLATE_TEST_CASE("round curve: agrees with very many spheres along it", "[geometry][round_curve]", float, double) {
  using T = TestType;
  for (const auto& shape : curves<T>()) {
    const auto box = bounds(shape);
    const double size = double(glm::length(extent(box)));
    glint::Random random(5);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
      const auto center = shape.curve.at(random.template uniform<T>());  // close by the curve, so that most rays hit
      const auto target = center.position + (random.template uniform_vec3<T>() - T(0.5)) * (T(3) * center.radius);
      const auto away = glint::testing::detail::random_unit_vector<T>(random) * T(3 * size);
      const glint::Ray<T> ray{.origin = target + away, .direction = -away};
      const double expected = first_sphere(shape, Vec3d(ray.origin), Vec3d(ray.direction), 0);
      const auto hit = intersect(ray, shape);
      const double rounding = 60 * double(std::numeric_limits<T>::epsilon()) * size;
      if (hit.has_value() != (expected < glint::infinity<double>)) {  // only where the ray grazes
        const double margin = std::max(rounding, 1e-6 * size);        // 1e-8: what 20000 spheres leave between them
        REQUIRE(first_sphere(shape, Vec3d(ray.origin), Vec3d(ray.direction), hit ? margin : -margin) ==
                (hit ? Approx(double(hit->t)).margin(0.1) : Approx(glint::infinity<double>)));
        continue;
      }
      if (!hit) continue;
      ++hits;
      // grazing rays have a soft t: there it must lie between those of slightly thicker and thinner curves
      const double tolerance = rounding / (3 * size) + 1e-6;
      if (std::abs(double(hit->t) - expected) <= tolerance) continue;
      CAPTURE(i, expected, hit->t);
      const double margin = std::max(rounding, 1e-6 * size);
      REQUIRE(double(hit->t) >= first_sphere(shape, Vec3d(ray.origin), Vec3d(ray.direction), margin) - tolerance);
      REQUIRE(double(hit->t) <= first_sphere(shape, Vec3d(ray.origin), Vec3d(ray.direction), -margin) + tolerance);
    }
    CHECK(hits > 150);
  }
}

TEMPLATE_TEST_CASE("round curve: a straight one of constant width is the capsule", "[geometry][round_curve]", float,
                   double) {
  using T = TestType;
  const auto shape = curves<T>()[1];
  const glint::Capsule<T> capsule{.start = {0, 0, 0}, .end = {3, 0, 0}, .radius = T(0.3)};
  int hits = 0;
  for (const auto& ray : glint::testing::rays_into(bounds(capsule), 2000, 1)) {
    const auto hit = intersect(ray, shape);
    const auto expected = intersect(ray, capsule);
    if (!hit || !expected) {
      REQUIRE(hit.has_value() == expected.has_value());
      continue;
    }
    ++hits;
    const auto position = ray.at(expected->t);
    const auto normal = surface(capsule, position).normal;
    const T facing = std::abs(glm::dot(normal, glm::normalize(ray.direction)));
    const T rounding = T(200) * std::numeric_limits<T>::epsilon() / (facing * glm::length(ray.direction));
    CHECK(std::abs(hit->t - expected->t) <= rounding);
    if (facing < T(0.1)) continue;
    CHECK(glm::length(surface(shape, ray.at(hit->t), *hit).normal - normal) <=
          T(3e3) * std::numeric_limits<T>::epsilon());
  }
  CHECK(hits > 500);
}

TEMPLATE_TEST_CASE("round curve: from inside, the way out is found, whatever the pieces are", "[geometry][round_curve]",
                   float, double) {
  using T = TestType;
  for (const auto& shape : curves<T>()) {
    const auto depth = [&](const Vec3d& p) {  // below 0 inside
      double least = glint::infinity<double>;
      for (int i = 0; i <= 10000; ++i) {
        const auto center = shape.curve.at(T(i) / 10000);
        least = std::min(least, glm::length(p - Vec3d(center.position)) - double(center.radius));
      }
      return least;
    };
    glint::Random random(6);
    for (int i = 0; i < 50; ++i) {
      const auto inside = shape.curve.at(random.uniform(T(0), T(0.9)));
      const auto direction = glint::testing::detail::random_unit_vector<T>(random);
      const auto hit = intersect(glint::Ray<T>{.origin = inside.position, .direction = direction}, shape);
      REQUIRE(hit);
      REQUIRE(hit->t >= inside.radius * T(0.999));  // the sphere there is within
      REQUIRE(std::abs(depth(Vec3d(inside.position + direction * hit->t))) < 2e-5);
      for (int k = 1; k < 8; ++k) {
        REQUIRE(depth(Vec3d(inside.position + direction * (hit->t * T(k) / 8))) < 2e-6);
      }
    }
  }
}

TEMPLATE_TEST_CASE("round curve: may end in a point", "[geometry][round_curve]", float, double) {
  using T = TestType;
  auto shape = curves<T>()[1];
  shape.curve.points[3].radius = 0;
  const auto at_height = [&](T x, T y) { return intersect(glint::Ray<T>{.origin = {x, y, 4}}, shape).has_value(); };
  // halfway the cubic radius is 7/8 of 0.3, and the envelope is a little thicker than the sphere there
  CHECK(at_height(T(1.5), T(0.262)));
  CHECK_FALSE(at_height(T(1.5), T(0.28)));
  CHECK(at_height(T(2.999), 0));
  CHECK_FALSE(at_height(T(3.001), 0));
  CHECK(glint::testing::violations_of_primitive_laws(shape, 1) == std::vector<std::string>{});
}

TEMPLATE_TEST_CASE("round curve: is not hit without width, or with a NaN", "[geometry][round_curve]", float, double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const glint::Ray<T> ray{.origin = {T(1.5), 0, 4}, .direction = {0, 0, -1}};
  const auto straight = curves<T>()[1];
  REQUIRE(intersect(ray, straight));
  auto broken = straight;
  for (auto& p : broken.curve.points) p.radius = 0;
  CHECK_FALSE(intersect(ray, broken));
  for (std::size_t i = 0; i < 4; ++i) {
    broken = straight;
    broken.curve.points[i].radius = nan;
    CHECK_FALSE(intersect(ray, broken));
    broken = straight;
    broken.curve.points[i].position.y = nan;
    CHECK_FALSE(intersect(ray, broken));
  }
}

TEMPLATE_TEST_CASE("round curve: the surface is as far from the center line as the radius says, and rays leave it",
                   "[geometry][round_curve]", float, double) {
  using T = TestType;
  for (const auto& shape : {curves<T>()[0], curves<T>()[1], curves<T>()[3]}) {
    glint::Random random(7);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const auto center = shape.curve.at(random.template uniform<T>());
      const auto away = glint::testing::detail::random_unit_vector<T>(random) * T(4);
      const glint::Ray<T> ray{.origin = center.position + away, .direction = -away};
      const auto hit = intersect(ray, shape);
      if (!hit) continue;
      ++hits;
      const auto at = surface(shape, ray.at(hit->t), *hit);
      // steep enough to get away from the hollow of a bend; another bend may be in the way further on
      const auto direction = at.normal + glint::testing::detail::random_unit_vector<T>(random) * T(0.5);
      const auto again = intersect(spawn_ray(at, direction), shape);
      if (again) REQUIRE(again->t > center.radius * T(0.1));
      const auto inward = intersect(spawn_ray(at, -at.normal), shape);
      REQUIRE(inward);
    }
    CHECK(hits > 1500);
  }
}

TEMPLATE_TEST_CASE("round curve: obeys the laws of Primitive, in tight bounds", "[geometry][round_curve][laws]", float,
                   double) {
  const auto seed = GENERATE(range(0U, 6U));
  CAPTURE(seed);
  for (std::size_t i = 0; i < curves<TestType>().size(); ++i) {
    CAPTURE(i);
    const auto shape = curves<TestType>()[i];
    if (i == 3 && sizeof(TestType) == 4) continue;  // the steps to neighbors, 4 √ε of its size, are as wide as the hair
    CHECK(glint::testing::violations_of_primitive_laws(shape, seed) == std::vector<std::string>{});
    if (seed == 0) CHECK(glint::testing::violations_of_tight_bounds(shape, seed) == std::vector<std::string>{});
  }
}

}  // namespace test_geometry_round_curve
