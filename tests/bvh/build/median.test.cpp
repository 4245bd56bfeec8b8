// SPDX-License-Identifier: MIT
#include <glint/bvh/build/median.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <glint/bvh/pass/statistics.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_median {

using glint::Aabb;
using glint::Boxes;
using glint::Median;

TEMPLATE_TEST_CASE("median: obeys the laws of builders whatever the boxes", "[bvh][build][laws]", float, double) {
  glint::testing::check_builder(TestType{}, Median{});
  glint::testing::check_builder(TestType{}, Median{.max_leaf_size = 1});
}

TEST_CASE("median: large sets are cut alike for every executor", "[bvh][build]") {
  glint::testing::check_large_builds(Median{});
}

TEST_CASE("median: the depth stays within its limit", "[bvh][build]") {
  glint::testing::check_depth([](int depth) { return Median{.max_leaf_size = 1, .max_depth = depth}; });
}

TEST_CASE("median: a power of two of boxes makes a complete tree along the longest axis", "[bvh][build]") {
  std::vector<Aabb<float>> boxes;
  for (int i = 0; i < 16; ++i) boxes.push_back({{0, float(i), 0}, {1, float(i) + 0.5F, 1}});
  const auto tree = Median{.max_leaf_size = 1}.build(Boxes{boxes});
  CHECK(tree.depth == 4);
  CHECK(tree.nodes.size() == 31);
  CHECK(tree.nodes[1].bounds == Aabb<float>{{0, 0, 0}, {1, 7.5F, 1}});
  for (unsigned i = 0; i < 16; ++i) CHECK(tree.order[i] == i);  // one axis, in order
  CHECK(statistics(Median{.max_leaf_size = 1, .max_depth = 2}.build(Boxes{boxes})).leaf_sizes[4] == 4);
  CHECK(Median{.max_leaf_size = 16}.build(Boxes{boxes}).nodes.size() == 1);
}

}  // namespace test_bvh_build_median
