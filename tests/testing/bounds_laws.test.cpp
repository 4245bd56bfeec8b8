// SPDX-License-Identifier: MIT
#include <glint/testing/bounds_laws.hpp>  // first, so the header proves it stands alone

#include <optional>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/geometry/sphere.hpp>

namespace test_testing_bounds_laws {

namespace {

struct WideAtUpperY {
  glint::Sphere<float> sphere{.center = {1, 2, 3}, .radius = 2};
};
glint::Aabb<float> bounds(const WideAtUpperY& p) {
  auto box = bounds(p.sphere);
  box.upper.y += 0.2F;  // 5 % of the extent; the slice looked at is 2 % below that
  return box;
}
std::optional<glint::Hit<float>> intersect(const glint::Ray<float>& ray, const WideAtUpperY& p) {
  return intersect(ray, p.sphere);
}

}  // namespace

TEST_CASE("bounds laws: the box of a sphere is tight on all sides", "[testing][laws]") {
  CHECK(glint::testing::violations_of_tight_bounds(glint::Sphere<float>{}, 1).empty());
  CHECK(glint::testing::violations_of_tight_bounds(glint::Sphere<double>{.center = {7, 8, 9}}, 2).empty());
}

TEST_CASE("bounds laws: a side that is further out than need be is named", "[testing][laws]") {
  CHECK(glint::testing::violations_of_tight_bounds(WideAtUpperY{}, 1) ==
        std::vector<std::string>{"the bounds are tight at the upper y: nothing was met there"});
  CHECK(glint::testing::violations_of_tight_bounds(WideAtUpperY{}, 1, 0.1F).empty());
}

}  // namespace test_testing_bounds_laws
