// SPDX-License-Identifier: MIT
#include <glint/math/solve.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>

#include <glint/math/random.hpp>

namespace test_math_solve {

TEMPLATE_TEST_CASE("difference of products: stays exact to an ulp where the products are nearly equal", "[math][solve]",
                   float, double) {
  using T = TestType;
  // (1 + e)² − (1 + 2e) · 1 = e², below half an ulp of either product.
  const T e = std::numeric_limits<T>::epsilon();
  CHECK(glint::difference_of_products(T(1) + e, T(1) + e, T(1) + 2 * e, T(1)) == e * e);
}

TEST_CASE("difference of products: is within 1.5 ulp in single precision", "[math][solve]") {
  glint::Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const float a = random.uniform(-1.0F, 1.0F);
    const float b = random.uniform(-1.0F, 1.0F);
    const float c = random.uniform(-1.0F, 1.0F);
    const float d = a * b / c;                                           // so that the products nearly agree
    const double exact = double(a) * double(b) - double(c) * double(d);  // exact but for one rounding in double
    const double ulp = std::abs(exact) * std::numeric_limits<float>::epsilon();
    REQUIRE(std::abs(double(glint::difference_of_products(a, b, c, d)) - exact) <= 1.5 * ulp);
  }
}

TEMPLATE_TEST_CASE("accurate cross product: of vectors with one more ulp is not lost", "[math][solve]", float, double) {
  using T = TestType;
  const T e = std::numeric_limits<T>::epsilon();
  const auto c = glint::accurate_cross<T>({1, 1 + e, 0}, {1 + e, 1 + 2 * e, 0});
  CHECK(c == glint::Vec3<T>(0, 0, -e * e));  // 1 · (1 + 2e) − (1 + e)²
}

TEMPLATE_TEST_CASE("quadratic: finds the roots of (x − 1)(x + 3), the smaller first", "[math][solve]", float, double) {
  const auto roots = glint::solve_quadratic<TestType>(1, 2, -3);
  REQUIRE(roots);
  CHECK((*roots)[0] == TestType(-3));
  CHECK((*roots)[1] == TestType(1));
  const auto negated = glint::solve_quadratic<TestType>(-1, -2, 3);
  CHECK(negated == roots);
}

TEMPLATE_TEST_CASE("quadratic: keeps the small root where the school formula loses it", "[math][solve]", float,
                   double) {
  using T = TestType;
  // (x − 1)(e x − 1): roots 1 and 1 / e; −b − √(b² − 4ac) has no digits left of the small one.
  const T e = std::numeric_limits<T>::epsilon() / 4;
  const auto roots = glint::solve_quadratic<T>(e, -1, 1);
  REQUIRE(roots);
  CHECK(std::abs((*roots)[0] - T(1)) <= 2 * std::numeric_limits<T>::epsilon());
  CHECK(std::abs((*roots)[1] * e - T(1)) <= 2 * std::numeric_limits<T>::epsilon());
}

TEMPLATE_TEST_CASE("quadratic: tells nearly equal roots apart", "[math][solve]", float, double) {
  using T = TestType;
  // (x − 1)(x − 1 − 2e) up to e²: half its discriminant is e² − …; with b²/4 rounded it would be 0 or negative.
  const T e = std::numeric_limits<T>::epsilon();
  const auto roots = glint::solve_quadratic<T>(1, -2 * (1 + e), 1 + 2 * e);
  REQUIRE(roots);
  CHECK((*roots)[0] == T(1));
  CHECK((*roots)[1] == T(1) + 2 * e);
}

TEMPLATE_TEST_CASE("quadratic: has defined answers where it degenerates", "[math][solve]", float, double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  using Roots = std::array<T, 2>;
  CHECK(glint::solve_quadratic<T>(1, 0, 1) == std::nullopt);
  CHECK(glint::solve_quadratic<T>(0, 0, 1) == std::nullopt);
  CHECK(glint::solve_quadratic<T>(0, 2, -4) == Roots{2, 2});
  CHECK(glint::solve_quadratic<T>(3, 0, 0) == Roots{0, 0});
  CHECK(glint::solve_quadratic<T>(1, -2, 1) == Roots{1, 1});
  CHECK(glint::solve_quadratic<T>(nan, 1, 1) == std::nullopt);
  CHECK(glint::solve_quadratic<T>(1, nan, 1) == std::nullopt);
  CHECK(glint::solve_quadratic<T>(1, 1, nan) == std::nullopt);
  CHECK(glint::solve_quadratic<T>(0, nan, 1) == std::nullopt);
  CHECK(glint::solve_quadratic<T>(0, 1, nan) == std::nullopt);
}

}  // namespace test_math_solve
