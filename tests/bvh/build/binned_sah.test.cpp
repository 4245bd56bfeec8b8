// SPDX-License-Identifier: MIT
#include <glint/bvh/build/binned_sah.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <vector>

#include <glint/bvh/pass/statistics.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_binned_sah {

using glint::Aabb;
using glint::BinnedSah;
using glint::Boxes;

TEMPLATE_TEST_CASE("binned sah: obeys the laws of builders whatever the boxes", "[bvh][build][laws]", float, double) {
  glint::testing::check_builder(TestType{}, BinnedSah{});
  glint::testing::check_builder(TestType{}, BinnedSah{.bins = 2, .block_size = 1, .max_leaf_size = 1});
  glint::testing::check_builder(TestType{}, BinnedSah{.bins = 1000, .max_leaf_size = 0, .max_depth = 1000});
}

TEST_CASE("binned sah: large sets are cut alike for every executor", "[bvh][build]") {
  glint::testing::check_large_builds(BinnedSah{});
}

TEST_CASE("binned sah: the depth stays within its limit", "[bvh][build]") {
  glint::testing::check_depth([](int depth) { return BinnedSah{.max_leaf_size = 1, .max_depth = depth}; });
}

TEST_CASE("binned sah: two clusters are told apart by the first split", "[bvh][build]") {
  std::vector<Aabb<float>> boxes;
  for (int i = 0; i < 30; ++i) {
    const float x = float(i % 10) + (i < 10 ? 0.0F : 1000.0F);  // 10 boxes here, 20 there
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  const auto tree = BinnedSah{}.build(Boxes{boxes});
  CHECK(tree.nodes[1].bounds == Aabb<float>{{0, 0, 0}, {10, 1, 1}});
  CHECK(tree.nodes[2].bounds == Aabb<float>{{1000, 0, 0}, {1010, 1, 1}});
}

TEST_CASE("binned sah: a leaf is split where that is cheaper, and no smaller", "[bvh][build]") {
  // Two unit cubes, far apart. Split: 1 node + 2 · 1 test · area ratio; not split: 2 tests. With the gap, the ratio of
  // areas is small, so the split pays; a costly traversal makes the leaf pay.
  const std::vector<Aabb<float>> boxes{{{0, 0, 0}, {1, 1, 1}}, {{100, 0, 0}, {101, 1, 1}}};
  CHECK(BinnedSah{.block_size = 1}.build(Boxes{boxes}).nodes.size() == 3);
  CHECK(BinnedSah{.traversal_cost = 9, .block_size = 1}.build(Boxes{boxes}).nodes.size() == 1);
  CHECK(BinnedSah{.traversal_cost = 1, .block_size = 2}.build(Boxes{boxes}).nodes.size() ==
        1);  // one block: both at the price of one
  CHECK(BinnedSah{.traversal_cost = 9, .max_leaf_size = 1}.build(Boxes{boxes}).nodes.size() == 3);
}

}  // namespace test_bvh_build_binned_sah
