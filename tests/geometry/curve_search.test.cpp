// SPDX-License-Identifier: MIT
#include <glint/geometry/curve_search.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>

#include <glint/math/random.hpp>

namespace test_geometry_curve_search {

TEMPLATE_TEST_CASE("curve search: a rising zero is found to the last places", "[geometry][curve_search]", float,
                   double) {
  using T = TestType;
  for (const T root : {T(0.001), T(0.25), T(0.5), T(0.9)}) {
    int calls = 0;
    const auto steep = [&](T s) {
      ++calls;
      return std::tanh(T(20) * (s - root));
    };
    CHECK(std::abs(glint::detail::rising_zero<T>(steep) - root) <= 4 * std::numeric_limits<T>::epsilon());
    CHECK(calls < 30);
  }
  const auto also_zero_at_the_end = [](T s) { return (s - T(0.25)) * (T(1) - s); };
  CHECK(std::abs(glint::detail::rising_zero<T>(also_zero_at_the_end) - T(0.25)) < T(1e-6));
  CHECK(glint::detail::rising_zero<T>([](T s) { return s + T(1); }) == T(0));
  CHECK(glint::detail::rising_zero<T>([](T s) { return s - T(2); }) == T(1));
}

TEMPLATE_TEST_CASE("curve search: every place of a curve that touches the ray is in a piece that is visited",
                   "[geometry][curve_search]", float, double) {
  using T = TestType;
  glint::Random random(3);
  for (int i = 0; i < 500; ++i) {
    glint::BezierCurve<T> curve;
    for (auto& p : curve.points) {
      p = {random.template uniform_vec3<T>() * T(4) - T(2), random.uniform(T(0.01), T(0.2))};
    }
    const auto on_curve = curve.at(random.template uniform<T>());
    const glint::Ray<T> ray{.origin = on_curve.position + glint::Vec3<T>(0, 0, 5), .direction = {0, 0, -2}};
    const glint::detail::SeenCurve<T> seen(ray, curve);
    bool is_covered[64] = {};
    int pieces = 0;
    glint::detail::for_each_near_piece(seen.curve, [&](const auto& piece) {
      ++pieces;
      for (int k = 0; k < 64; ++k) {
        const T s = (T(k) + T(0.5)) / 64;
        if (s >= piece.first && s <= piece.first + piece.length) is_covered[k] = true;
      }
    });
    CHECK(pieces <= 64);
    for (int k = 0; k < 64; ++k) {
      const auto p = seen.curve.at((T(k) + T(0.5)) / 64);
      const T distance = std::sqrt(p.position.x * p.position.x + p.position.y * p.position.y);
      if (distance < p.radius * T(0.999)) CHECK(is_covered[k]);
    }
  }
}

TEMPLATE_TEST_CASE("curve search: t is told from where the ray sees the curve", "[geometry][curve_search]", float,
                   double) {
  using T = TestType;
  glint::BezierCurve<T> curve;
  for (std::size_t i = 0; i < 4; ++i) curve.points[i] = {glint::Vec3<T>(T(i), 0, -8), T(0.5)};
  const glint::detail::SeenCurve<T> seen(glint::Ray<T>{.direction = {0, 0, -2}}, curve);
  for (const auto& p : seen.curve.points) {
    CHECK(seen.t + p.position.z * seen.per_unit == Approx(4));
    CHECK(p.radius == T(0.5));
  }
}

}  // namespace test_geometry_curve_search
