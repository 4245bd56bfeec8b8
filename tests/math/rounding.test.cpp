// SPDX-License-Identifier: MIT
#include <glint/math/rounding.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>
#include <random>

#include <support/catch.hpp>

namespace test_math_rounding {

TEMPLATE_TEST_CASE("rounding: products that round to the same number are still told apart", "[math][rounding]", float,
                   double) {
  using T = TestType;
  // (1 + e)(1 − e) = 1 − e² rounds to 1 = 1 · 1, but is less.
  const T e = std::numeric_limits<T>::epsilon();
  CHECK(glint::exact_difference(T(1) + e, T(1) - e, T(1), T(1)) < 0);
  CHECK(glint::exact_difference(T(1), T(1), T(1) + e, T(1) - e) > 0);
  CHECK(glint::exact_difference(T(0.1), T(0.3), T(0.3), T(0.1)) == 0);
  CHECK(glint::exact_difference(T(3), T(4), T(5), T(2)) == 2);
}

TEMPLATE_TEST_CASE("rounding: an exact difference changes its sign with its products", "[math][rounding]", float,
                   double) {
  using T = TestType;
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> nudge(-2, 2);
  std::uniform_real_distribution<T> uniform(T(0.5), T(2));
  const T e = std::numeric_limits<T>::epsilon();
  int ties = 0;
  int wrong = 0;
  for (int i = 0; i < 100000; ++i) {
    // Two factorizations of nearly the same number: x · y and (x + i ulps)(y + j ulps).
    const T x = uniform(random);
    const T y = uniform(random);
    const T c = x * (T(1) + T(nudge(random)) * e);
    const T d = y * (T(1) + T(nudge(random)) * e);
    const auto there = glint::exact_difference(x, y, c, d);
    const auto back = glint::exact_difference(c, d, x, y);
    // x y − c d = (x − c) y + c (y − d): differences of neighbors are exact, and each product is one ulp of one ulp,
    // so that long double, or double for float, decides unless the two cancel.
    const long double first = (static_cast<long double>(x) - c) * y;
    const long double second = static_cast<long double>(c) * (static_cast<long double>(y) - d);
    const long double exact = first + second;
    const T left = x * y;
    const T right = c * d;
    ties += left == right ? 1 : 0;
    wrong += (there > 0) != (back < 0) || (there > 0) != (exact > 0) || (there < 0) != (exact < 0) ? 1 : 0;
  }
  CHECK(ties > 1000);
  CHECK(wrong == 0);
}

}  // namespace test_math_rounding
