// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/reinsert.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/depth_first.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_pass_reinsert {

namespace {

using glint::Aabb;
using glint::BinnedSah;
using glint::Boxes;
using glint::Median;
using glint::Reinsertion;
using glint::SweepSah;
using glint::Tree;

constexpr Reinsertion thorough{.batch = 1, .rounds = 20, .least_gain = 0};

template <typename T>
double inner_cost(const Tree<T>& tree) {
  return statistics(tree, 1, 0).sah_cost;
}

template <typename T>
std::vector<Aabb<T>> sorted_leaves(const Tree<T>& tree) {
  std::vector<Aabb<T>> leaves;
  for (const auto& node : tree.nodes)
    if (node.is_leaf()) leaves.push_back(node.bounds);
  std::sort(leaves.begin(), leaves.end(), [](const auto& a, const auto& b) {
    const auto key = [](const auto& box) {
      return std::array{box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z};
    };
    return key(a) < key(b);
  });
  return leaves;
}

template <typename S>
void check_better(const Tree<typename S::Scalar>& tree, const S& set, const Reinsertion& options) {
  const auto better = reinsert(tree, options);
  for (const std::string& broken : violations(better, set)) FAIL_CHECK(broken);
  CHECK_FALSE(statistics(better).sah_cost > statistics(tree).sah_cost);  // both may be no number
  CHECK(sorted_leaves(better) == sorted_leaves(tree));
  CHECK(depth_first(better) == better);
  CHECK(reinsert(tree, options, glint::testing::Backwards{}) == better);
}

/// A chain of nested boxes as deep as trees may be, and beside it eight small ones that belong to the bottom of it.
struct DeepChain {
  std::vector<Aabb<float>> boxes;
  Tree<float> tree;

  DeepChain() {
    constexpr std::uint32_t steps = Tree<float>::max_depth - 1;
    for (std::uint32_t i = 0; i <= steps; ++i) {
      const float size = 100 - float(i);
      boxes.push_back({glint::Vec3<float>(0.0F), glint::Vec3<float>(size)});
    }
    for (int i = 0; i < 8; ++i) boxes.push_back({glint::Vec3<float>(float(i)), glint::Vec3<float>(float(i) + 1)});
    const auto add = [&](std::uint32_t primitive) {
      tree.order.push_back(primitive);
      tree.nodes.push_back({boxes[primitive], std::uint32_t(tree.order.size() - 1), 1});
    };
    tree.nodes.push_back({boxes[0], 1, 0});
    const Tree<float> small = Median{1}.build(Boxes{std::span(boxes).last(8)});
    tree.nodes.push_back({small.nodes[0].bounds, 0, 0});  // its children come last
    for (std::uint32_t i = 0; i < steps; ++i) {
      tree.nodes.push_back({boxes[i], std::uint32_t(tree.nodes.size() + 1), 0});
      add(i);
    }
    add(steps);
    const auto offset = std::uint32_t(tree.nodes.size() - 1);
    tree.nodes[1].first = small.nodes[0].first + offset;
    for (std::size_t i = 1; i < small.nodes.size(); ++i) {
      auto node = small.nodes[i];
      node.first += node.is_leaf() ? std::uint32_t(tree.order.size()) : offset;
      tree.nodes.push_back(node);
    }
    for (const std::uint32_t i : small.order) tree.order.push_back(steps + 1 + i);
    tree.depth = Tree<float>::max_depth;
  }
};

}  // namespace

TEMPLATE_TEST_CASE("reinsert: any tree stays valid and never costs more", "[bvh][pass]", float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    const Boxes set{boxes};
    for (const Reinsertion& options : {Reinsertion{}, thorough}) {
      check_better(Median{.max_leaf_size = 1}.build(set), set, options);
      check_better(BinnedSah{}.build(set), set, options);
    }
  }
}

TEST_CASE("reinsert: nodes that were paired wrongly find each other", "[bvh][pass]") {
  // Two pairs of unit cubes, far apart along x; the tree joins each cube with one from afar.
  const std::vector<Aabb<float>> boxes{
      {{0, 0, 0}, {1, 1, 1}}, {{100, 0, 0}, {101, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{101, 0, 0}, {102, 1, 1}}};
  Tree<float> tree;
  tree.nodes = {{{{0, 0, 0}, {102, 1, 1}}, 1, 0},
                {{{0, 0, 0}, {101, 1, 1}}, 3, 0},
                {{{1, 0, 0}, {102, 1, 1}}, 5, 0},
                {boxes[0], 0, 1},
                {boxes[1], 1, 1},
                {boxes[2], 2, 1},
                {boxes[3], 3, 1}};
  tree.order = {0, 1, 2, 3};
  tree.depth = 2;
  REQUIRE(violations(tree, Boxes{boxes}).empty());
  const auto better = reinsert(tree, thorough);
  CHECK(violations(better, Boxes{boxes}).empty());
  // Half areas: the root 102 + 102 + 1 = 205, each pair 2 + 2 + 1 = 5.
  CHECK(inner_cost(better) == Approx((205.0 + 5 + 5) / 205));
}

TEST_CASE("reinsert: the place found for a node is the best of all places", "[bvh][pass]") {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const auto boxes = glint::testing::random_boxes<double>(24, seed);
    const auto tree = Median{.max_leaf_size = 1}.build(Boxes{boxes});
    const glint::detail::Reinserter<double, std::uint32_t> reinserter(tree);
    for (std::uint32_t node = 2; node <= tree.nodes.size(); ++node) {
      double best = 0;
      for (std::uint32_t to = 1; to <= tree.nodes.size(); ++to) {
        auto moved = reinserter;
        const double gain = moved.apply({.node = node, .to = to});
        CHECK(reinserter.cost() - moved.cost() == Approx(gain).margin(1e-9));  // what it promised is what it did
        best = std::max(best, gain);
      }
      CHECK(reinserter.best_move(node).gain == Approx(best).margin(1e-9));
    }
  }
}

TEST_CASE("reinsert: a tree that is as deep as trees may be grows no deeper", "[bvh][pass]") {
  const DeepChain deep;
  REQUIRE(violations(deep.tree, Boxes{deep.boxes}).empty());
  check_better(deep.tree, Boxes{deep.boxes}, thorough);
  CHECK(inner_cost(reinsert(deep.tree, thorough)) < inner_cost(deep.tree));
}

TEST_CASE("reinsert: a blind builder's tree comes near a careful builder's", "[bvh][pass]") {
  for (const auto& buffers :
       {glint::testing::scanned_blob<float>(2000, 1), glint::testing::triangle_soup<float>(2000, 2)}) {
    const auto mesh = glint::view(buffers);
    const auto blind = Median{.max_leaf_size = 1}.build(mesh);
    const auto careful = SweepSah{.block_size = 1, .max_leaf_size = 1}.build(mesh);
    const double most_of_the_way = 0.3 * inner_cost(blind) + 0.7 * inner_cost(careful);
    CHECK(inner_cost(reinsert(blind, thorough)) < most_of_the_way);
  }
}

TEST_CASE("reinsert: nothing is done where nothing is asked for", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(500, 2);
  const auto tree = Median{}.build(Boxes{boxes});
  CHECK(reinsert(tree, {.rounds = 0}) == tree);
  CHECK(reinsert(tree, {.batch = 0}) == tree);
  CHECK_FALSE(reinsert(tree, {.batch = 0.2F, .rounds = 1}) == tree);
}

TEST_CASE("reinsert: primitives in several leaves are moved like any other", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(400, 3);
  const auto tree = Median{.max_leaf_size = 2}.build(Boxes{boxes});
  const auto named_twice = [](Tree<float> t) {
    for (auto& primitive : t.order) primitive /= 2;
    return t;
  };
  CHECK(reinsert(named_twice(tree), thorough) == named_twice(reinsert(tree, thorough)));
}

TEST_CASE("reinsert: every executor makes the same tree", "[bvh][pass]") {
  auto boxes = glint::testing::random_boxes<float>(20'000, 4);
  boxes[5] = {};
  const auto tree = Median{.max_leaf_size = 1}.build(Boxes{boxes});
  const auto better = reinsert(tree);
  CHECK(violations(better, Boxes{boxes}).empty());
  CHECK(inner_cost(better) < inner_cost(tree));
  CHECK(reinsert(tree, {}, glint::testing::Backwards{}) == better);
  CHECK(reinsert(tree, {}, glint::testing::TwoThreads{}) == better);
  CHECK(reinsert(tree, {}, glint::TbbExecutor{3}) == better);
}

TEMPLATE_TEST_CASE("reinsert: rays meet what brute force meets", "[bvh][pass][laws]", float, double) {
  for (const auto& buffers :
       {glint::testing::triangle_soup<TestType>(400, 5), glint::testing::diagonal_slivers<TestType>(150, 6),
        glint::testing::degenerate_mix<TestType>(200, 7), glint::testing::scanned_blob<TestType>(500, 8)}) {
    const auto mesh = glint::view(buffers);
    const glint::Bvh bvh(mesh, reinsert(Median{.max_leaf_size = 1}.build(mesh), thorough));
    for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(bvh, glint::BruteForce(mesh), 1)) {
      FAIL_CHECK(broken);
    }
  }
}

}  // namespace test_bvh_pass_reinsert
