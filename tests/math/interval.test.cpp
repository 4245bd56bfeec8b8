// SPDX-License-Identifier: MIT
#include <glint/math/interval.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

namespace test_math_interval {

TEMPLATE_TEST_CASE("interval: ends are inside, and the default is empty", "[math][interval]", float, double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const glint::Interval<T> unit{T(0), T(1)};
  CHECK_FALSE(is_empty(unit));
  CHECK(contains(unit, T(0)));
  CHECK(contains(unit, T(1)));
  CHECK_FALSE(contains(unit, T(1.5)));
  CHECK_FALSE(contains(unit, nan));
  CHECK(is_empty(glint::Interval<T>{}));
  CHECK(is_empty(glint::Interval<T>{nan, T(1)}));
  CHECK_FALSE(is_empty(glint::Interval<T>{T(2), T(2)}));
}

}  // namespace test_math_interval
