// SPDX-License-Identifier: MIT
#include <glint/math/constants.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>

namespace test_math_constants {

TEMPLATE_TEST_CASE("constants: the number below one is the last before it", "[math][constants]", float, double) {
  CHECK(glint::one_minus_epsilon<TestType> == std::nextafter(TestType(1), TestType(0)));
}

TEMPLATE_TEST_CASE("constants: degrees become radians", "[math][constants]", float, double) {
  CHECK(glint::radians(TestType(180)) == glint::pi<TestType>);
  CHECK(glint::pi<TestType> * glint::inv_pi<TestType> == Approx(1));
}

TEMPLATE_TEST_CASE("constants: the bound of n roundings holds for n multiplications", "[math][constants]", float,
                   double) {
  const TestType third = TestType(1) / TestType(3);  // rounded once
  TestType product = 1;
  for (int i = 0; i < 10; ++i) product *= third;  // ten more
  long double exact = 1;
  for (int i = 0; i < 10; ++i) exact /= 3;
  const long double error = std::abs(static_cast<long double>(product) / exact - 1);
  CHECK(error <= static_cast<long double>(glint::rounding_bound<TestType>(20)));
  CHECK(glint::rounding_bound<TestType>(1) > std::numeric_limits<TestType>::epsilon() / 2);
  CHECK(glint::rounding_bound<TestType>(3) > 3 * (std::numeric_limits<TestType>::epsilon() / 2));
}

}  // namespace test_math_constants
