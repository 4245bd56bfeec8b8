// SPDX-License-Identifier: MIT
#include <glint/bvh/build/morton.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_morton {

using glint::Aabb;
using glint::Boxes;
using glint::Morton;

TEMPLATE_TEST_CASE("morton: obeys the laws of builders whatever the boxes", "[bvh][build][laws]", float, double) {
  glint::testing::check_builder(TestType{}, Morton{});
  glint::testing::check_builder(TestType{}, Morton{.block_size = 1, .max_leaf_size = 1});
  glint::testing::check_builder(TestType{}, Morton{.max_leaf_size = 0, .max_depth = 1000});
  glint::testing::check_builder(TestType{}, Morton{.max_leaf_size = 100});
}

TEST_CASE("morton: large sets are cut alike for every executor", "[bvh][build]") {
  glint::testing::check_large_builds(Morton{});
  const auto boxes = glint::testing::random_boxes<float>(50'000, 9);
  CHECK(Morton{}.build(Boxes{boxes}, glint::TbbExecutor{3}) == Morton{}.build(Boxes{boxes}));
}

TEST_CASE("morton: the depth stays within its limit", "[bvh][build]") {
  glint::testing::check_depth([](int depth) { return Morton{.max_leaf_size = 1, .max_depth = depth}; });
}

namespace {

/// Points at 2⁻ⁱ on each axis, `copies` of each: every bit of a code tells one of them from those nearer to the
/// origin, so that cells nest as deep as a code has bits.
[[nodiscard]] std::vector<Aabb<double>> nested_cells(int copies) {
  std::vector<Aabb<double>> boxes;
  for (int i = 0; i < 19; ++i) {
    const double x = std::ldexp(1.0, -i);
    for (const glint::Vec3<double> p : {glint::Vec3<double>{x, 0, 0}, {0, x, 0}, {0, 0, x}})
      boxes.insert(boxes.end(), std::size_t(copies), {p, p});
  }
  return boxes;
}

}  // namespace

TEST_CASE("morton: cells nest as deep as keys do, and no deeper than the limit", "[bvh][build]") {
  // 57 points are one run, and their codes have 19 bits an axis. The first three steps take off two points each (1 is
  // in the last cell, which begins below 1, and shares its first bit with ½), the other 50 one each, the last of which
  // leaves one: 57 = 3 · 2 + 50 + 1.
  const auto boxes = nested_cells(1);
  const auto tree = Morton{.block_size = 1, .max_leaf_size = 1}.build(Boxes{boxes});
  CHECK(tree.depth == 53);
  CHECK(violations(tree, Boxes{boxes}).empty());
  const auto lower = Morton{.block_size = 1, .max_leaf_size = 1, .max_depth = 52}.build(Boxes{boxes});
  CHECK(lower.depth <= 52);
  CHECK(violations(lower, Boxes{boxes}).empty());
}

TEST_CASE("morton: the depth stays within its limit where runs are nested", "[bvh][build]") {
  const auto boxes = nested_cells(70);  // too many for a run each
  for (const int depth : {3, 12, 13, 20, 40, 64}) {
    CAPTURE(depth);
    const auto tree = Morton{.max_leaf_size = 1, .max_depth = depth}.build(Boxes{boxes});
    CHECK(tree.depth <= depth);
    CHECK(violations(tree, Boxes{boxes}).empty());
  }
}

TEST_CASE("morton: nodes are numbered depth first, and slots follow them", "[bvh][build]") {
  const auto boxes = glint::testing::random_boxes<float>(3000, 4);
  const auto tree = Morton{}.build(Boxes{boxes});
  std::vector<std::size_t> pending{0};
  std::size_t nodes = 1;
  std::size_t slots = 0;
  bool in_order = true;
  while (!pending.empty()) {
    const auto& node = tree.nodes[pending.back()];
    pending.pop_back();
    in_order = in_order && node.first == (node.is_leaf() ? slots : nodes);
    if (node.is_leaf()) {
      slots += node.count;
    } else {
      pending.insert(pending.end(), {nodes + 1, nodes});
      nodes += 2;
    }
  }
  CHECK(in_order);
  CHECK(nodes == tree.nodes.size());
  CHECK(slots == boxes.size());
}

TEST_CASE("morton: a leaf is split where that is cheaper, and no smaller", "[bvh][build]") {
  // As for the binned tree: two unit cubes, far apart.
  const std::vector<Aabb<float>> boxes{{{0, 0, 0}, {1, 1, 1}}, {{100, 0, 0}, {101, 1, 1}}};
  CHECK(Morton{.block_size = 1}.build(Boxes{boxes}).nodes.size() == 3);
  CHECK(Morton{.traversal_cost = 9, .block_size = 1}.build(Boxes{boxes}).nodes.size() == 1);
  CHECK(Morton{.traversal_cost = 1, .block_size = 2}.build(Boxes{boxes}).nodes.size() == 1);
  CHECK(Morton{.traversal_cost = 9, .max_leaf_size = 1}.build(Boxes{boxes}).nodes.size() == 3);
}

TEST_CASE("morton: rays cost little more than in a binned tree", "[bvh][build]") {
  // Of a surface, by the surface area heuristic. A tenth more is what was measured; a quarter is the alarm.
  const auto mesh = glint::testing::scanned_blob<float>(20'000, 1);
  const auto cost = [&](const auto& builder) { return statistics(builder.build(view(mesh))).sah_cost; };
  CHECK(cost(Morton{}) < 1.25 * cost(glint::BinnedSah{}));
}

TEMPLATE_TEST_CASE("morton: rays find what brute force finds", "[bvh][build]", float, double) {
  using T = TestType;
  const auto check = [](const glint::MeshBuffers<T>& buffers) {
    const auto mesh = view(buffers);
    const glint::Bvh bvh(mesh, Morton{});
    for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(bvh, glint::BruteForce(mesh), 3))
      FAIL_CHECK(broken);
  };
  check(glint::testing::triangle_soup<T>(2000, 1));
  check(glint::testing::diagonal_slivers<T>(500, 2));
  check(glint::testing::identical_triangles<T>(300));
  check(glint::testing::coincident_centroids<T>(300, 3));
  check(glint::testing::degenerate_mix<T>(1000, 4));
}

}  // namespace test_bvh_build_morton
