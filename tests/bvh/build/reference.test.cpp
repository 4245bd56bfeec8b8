// SPDX-License-Identifier: MIT
#include <glint/bvh/build/reference.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_reference {

using glint::Aabb;
using glint::Vec3;
using glint::detail::Part;
using glint::detail::Reference;

TEMPLATE_TEST_CASE("reference: keeps box, index and center", "[bvh][build]", float, double) {
  using T = TestType;
  for (const std::size_t index : {std::size_t{0}, std::size_t{1}, std::size_t{0x7F800001}, std::size_t{0xFFFFFFFE}}) {
    const Reference<T> r({{1, 2, 3}, {3, 6, 9}}, index);  // 0x7F800001: the bits of a signaling NaN
    CHECK(r.index() == index);
    CHECK(r.center(0) == 2);
    CHECK(r.center()[1] == 4);
    CHECK(r.center()[2] == 6);
    CHECK(r.center()[3] == 0);
    Part<T> part;
    part.extend(r);
    CHECK(part.box.box() == Aabb<T>{{1, 2, 3}, {3, 6, 9}});
    CHECK(part.box.half_area() == 2 * 4 + 4 * 6 + 6 * 2);
  }
}

TEST_CASE("reference: boxes near the largest number have a center", "[bvh][build]") {
  constexpr float huge = std::numeric_limits<float>::max();
  const Reference<float> r({Vec3<float>(huge), Vec3<float>(huge)}, 0);
  CHECK(r.center(1) == huge);
}

TEST_CASE("reference: gathering keeps the order of what has a box, over many chunks", "[bvh][build]") {
  auto boxes = glint::testing::random_boxes<float>(3 * glint::detail::chunk_size + 5, 3);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % 3 == 0)
      boxes[i] = {};
    else
      kept.push_back(i);
  }
  const auto references = glint::detail::gather(glint::Boxes{boxes}, glint::testing::Backwards{});
  REQUIRE(references.size() == kept.size());
  bool same = true;
  for (std::size_t i = 0; i < kept.size(); ++i) same = same && references[i].index() == kept[i];
  CHECK(same);
}

TEST_CASE("reference: halves differ in count by one at most, and split at the middle center", "[bvh][build]") {
  std::vector<Reference<float>> references;
  for (int i = 0; i < 7; ++i) references.emplace_back(Aabb<float>{{0, float(i), 0}, {1, float(i), 1}}, std::size_t(i));
  std::swap(references[0], references[6]);
  const auto whole = glint::detail::whole<float>(references, glint::Serial{});
  CHECK(whole.longest_axis() == 1);
  const auto [left, right] = glint::detail::halve<float>(references, whole);
  CHECK(left.count == 3);
  CHECK(right.count == 4);
  CHECK(left.box.box() == Aabb<float>{{0, 0, 0}, {1, 2, 1}});
  CHECK(right.box.box() == Aabb<float>{{0, 3, 0}, {1, 6, 1}});
}

TEST_CASE("reference: a leaf costs its blocks", "[bvh][build]") {
  CHECK(glint::detail::blocks(0, 4) == 0);
  CHECK(glint::detail::blocks(1, 4) == 1);
  CHECK(glint::detail::blocks(4, 4) == 1);
  CHECK(glint::detail::blocks(5, 4) == 2);
  CHECK(glint::detail::blocks(5, 1) == 5);
}

}  // namespace test_bvh_build_reference
