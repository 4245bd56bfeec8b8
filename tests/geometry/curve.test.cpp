// SPDX-License-Identifier: MIT
#include <glint/geometry/curve.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <limits>

#include <support/catch.hpp>

#include <glint/math/random.hpp>

namespace test_geometry_curve {

namespace {

template <typename T>
std::array<glint::CurvePoint<T>, 4> random_points(glint::Random& random) {
  std::array<glint::CurvePoint<T>, 4> points;
  for (auto& p : points) {
    p.position = random.uniform_vec3<T>() * T(2) - T(1);
    p.radius = random.uniform(T(0), T(0.3));
  }
  return points;
}

}  // namespace

TEMPLATE_TEST_CASE("curve: begins at its first point and ends at its last, along the polygon", "[geometry][curve]",
                   float, double) {
  using T = TestType;
  glint::Random random(1);
  const glint::BezierCurve<T> curve{random_points<T>(random)};
  CHECK(curve.at(0) == curve.points[0]);
  CHECK(curve.at(1) == curve.points[3]);
  CHECK(curve.slope(0) == (curve.points[1] - curve.points[0]) * T(3));
  CHECK(curve.slope(1) == (curve.points[3] - curve.points[2]) * T(3));
}

TEMPLATE_TEST_CASE("curve: the slope is the derivative", "[geometry][curve]", float, double) {
  using T = TestType;
  glint::Random random(2);
  for (int i = 0; i < 100; ++i) {
    const glint::BezierCurve<T> curve{random_points<T>(random)};
    const T s = random.uniform(T(0.1), T(0.9));
    const T h = T(0.01);  // the central difference of a cubic is off by h² / 6 times a constant third derivative
    const auto difference = (curve.at(s + h) - curve.at(s - h)) * (T(0.5) / h);
    CHECK(glm::length(difference.position - curve.slope(s).position) < T(5e-3));
    CHECK(std::abs(difference.radius - curve.slope(s).radius) < T(5e-3));
  }
}

TEMPLATE_TEST_CASE("curve: its halves are the curve", "[geometry][curve]", float, double) {
  using T = TestType;
  glint::Random random(3);
  const glint::BezierCurve<T> curve{random_points<T>(random)};
  const auto [left, right] = halves(curve);
  for (int i = 0; i <= 16; ++i) {
    const T s = T(i) / 16;
    const T rounding = T(16) * std::numeric_limits<T>::epsilon();
    CHECK(glm::length(left.at(s).position - curve.at(s / 2).position) <= rounding);
    CHECK(glm::length(right.at(s).position - curve.at((s + 1) / 2).position) <= rounding);
    CHECK(std::abs(right.at(s).radius - curve.at((s + 1) / 2).radius) <= rounding);
  }
}

TEMPLATE_TEST_CASE("curve: segments of a B-spline meet in one point, with one slope and one curvature",
                   "[geometry][curve]", float, double) {
  using T = TestType;
  glint::Random random(4);
  for (int i = 0; i < 100; ++i) {
    const auto p = random_points<T>(random);
    const auto q = random_points<T>(random);
    const auto before = glint::bezier_of_b_spline<T>({p[0], p[1], p[2], p[3]});
    const auto after = glint::bezier_of_b_spline<T>({p[1], p[2], p[3], q[0]});
    CHECK(before.points[3] == after.points[0]);
    const T rounding = T(32) * std::numeric_limits<T>::epsilon();
    CHECK(glm::length(before.slope(1).position - after.slope(0).position) <= rounding);
    const auto bend = [](const auto& a, const auto& b, const auto& c) { return (a - b * T(2) + c).position; };
    CHECK(glm::length(bend(before.points[1], before.points[2], before.points[3]) -
                      bend(after.points[0], after.points[1], after.points[2])) <= rounding);
  }
}

TEMPLATE_TEST_CASE("curve: the box holds the spheres along it, and no more", "[geometry][curve]", float, double) {
  using T = TestType;
  glint::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const glint::BezierCurve<T> curve{random_points<T>(random)};
    glint::Aabb<T> box;  // the oracle: between 4096 spheres a curve with |p″| ≤ 24 reaches 24 / (8 · 4096²) further
    for (int k = 0; k <= 4096; ++k) {
      const auto p = curve.at(T(k) / 4096);
      extend(box, p.position - p.radius);
      extend(box, p.position + p.radius);
    }
    const auto swept = swept_bounds(curve);
    CHECK(contains(swept, box));
    CHECK(glint::max_component(glint::abs(swept.lower - box.lower)) < T(4e-6));
    CHECK(glint::max_component(glint::abs(swept.upper - box.upper)) < T(4e-6));
  }
}

}  // namespace test_geometry_curve
