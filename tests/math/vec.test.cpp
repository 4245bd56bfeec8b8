// SPDX-License-Identifier: MIT
#include <glint/math/vec.hpp>  // first, so the header proves it stands alone

#include <limits>
#include <type_traits>

#include <support/catch.hpp>

namespace test_math_vec {

using glint::Vec3;

TEMPLATE_TEST_CASE("vec: twelve or 24 bytes, whatever GLM's defaults are", "[math][vec]", float, double) {
  STATIC_REQUIRE(sizeof(Vec3<TestType>) == 3 * sizeof(TestType));
  STATIC_REQUIRE(std::is_convertible_v<glm::vec<3, TestType>, Vec3<TestType>>);
}

TEMPLATE_TEST_CASE("vec: components and axes by number", "[math][vec]", float, double) {
  const Vec3<TestType> v{1, 5, 3};
  CHECK(glint::component(v, 0) == 1);
  CHECK(glint::component(v, 1) == 5);
  CHECK(glint::component(v, 2) == 3);
  CHECK(glint::max_component(v) == 5);
  CHECK(glint::max_axis(v) == 1);
  CHECK(glint::max_axis(Vec3<TestType>{2, 2, 2}) == 0);  // the first of equals
  CHECK(glint::max_axis(Vec3<TestType>{1, 2, 2}) == 1);
  CHECK(glint::max_axis(Vec3<TestType>{1, 2, 3}) == 2);
}

TEMPLATE_TEST_CASE("vec: length, absolute values and unit vectors", "[math][vec]", float, double) {
  const Vec3<TestType> v{3, -4, 12};
  CHECK(glint::length_squared(v) == 169);
  CHECK(glint::abs(v) == Vec3<TestType>{3, 4, 12});
  CHECK(glm::length(glint::normalized(v)) == Approx(1));
  CHECK(glint::normalized(v).x == Approx(TestType(3) / 13));
}

TEMPLATE_TEST_CASE("vec: one bad component makes a vector not finite", "[math][vec]", float, double) {
  using Limits = std::numeric_limits<TestType>;
  CHECK(glint::is_finite(Vec3<TestType>{1, Limits::max(), 0}));
  CHECK_FALSE(glint::is_finite(Vec3<TestType>{1, Limits::infinity(), 0}));
  CHECK_FALSE(glint::is_finite(Vec3<TestType>{1, 0, Limits::quiet_NaN()}));
}

}  // namespace test_math_vec
