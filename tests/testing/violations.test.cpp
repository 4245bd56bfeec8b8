// SPDX-License-Identifier: MIT
#include <glint/testing/violations.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_testing_violations {

using Sentences = std::vector<std::string>;

TEST_CASE("violations: what is kept is not mentioned", "[testing]") {
  glint::testing::Violations violations;
  violations.expect(true, "all is well", glint::Ray<float>{});
  violations.expect(true, "all is well", 1.0, 2.0);
  CHECK(violations.take() == Sentences{});
}

TEST_CASE("violations: a law is mentioned once, with the first that broke it", "[testing]") {
  glint::testing::Violations violations;
  violations.expect(false, "law one", glint::Ray<double>{.origin = {1, 2, 3}, .t_max = 4});
  violations.expect(false, "law one", glint::Ray<double>{});
  violations.expect(false, "law two", 0.5, 2.0);
  CHECK(violations.take() == Sentences{"law one: broken for the ray from (1, 2, 3) along (0, 0, -1), t in [0, 4]",
                                       "law two: measured 0.5, expected 2"});
}

TEST_CASE("violations: a law about directions names both", "[testing]") {
  glint::testing::Violations violations;
  violations.expect(false, "law", glint::Vec3<float>(0, 0, 1), glint::Vec3<float>(1, 0, 0));
  violations.expect(false, "other", std::string("what was found"));
  CHECK(violations.take() == Sentences{"law: broken for wo = (0, 0, 1), wi = (1, 0, 0)", "other: what was found"});
}

}  // namespace test_testing_violations
