// SPDX-License-Identifier: MIT
#include <glint/geometry/boxes.hpp>  // first, so the header proves it stands alone

#include <array>
#include <span>
#include <vector>

#include <support/catch.hpp>

namespace test_geometry_boxes {

TEMPLATE_TEST_CASE("boxes: view the user's boxes", "[geometry]", float, double) {
  using Box = glint::Aabb<TestType>;
  std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}};
  const glint::Boxes view{boxes};
  static_assert(glint::BoundedSet<std::remove_const_t<decltype(view)>>);
  CHECK(view.size() == 2);
  CHECK(view.bounds(1) == boxes[1]);
  boxes[1].upper.x = 9;
  CHECK(view.bounds(1).upper.x == 9);
  CHECK(glint::Boxes{std::span{boxes}}.size() == 2);
  CHECK(glint::Boxes<TestType>{}.size() == 0);
}

}  // namespace test_geometry_boxes
