// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/merge_leaves.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/depth_first.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_pass_merge_leaves {

namespace {

using glint::Aabb;
using glint::BinnedSah;
using glint::Boxes;
using glint::LeafMerging;
using glint::Median;
using glint::Tree;

/// By definition: ⌈n / block_size⌉.
double tests_of(std::size_t n, const LeafMerging& options) {
  return double(n / options.block_size + std::size_t(n % options.block_size != 0)) * double(options.intersection_cost);
}

template <typename T>
double cost(const Tree<T>& tree, const LeafMerging& options) {
  double sum = 0;
  for (const auto& node : tree.nodes) {
    const double factor = node.is_leaf() ? tests_of(node.count, options) : double(options.traversal_cost);
    sum += double(half_area(node.bounds)) * factor;
  }
  return sum;
}

/// What every way of merging below a node costs.
struct Ways {
  std::vector<double> costs;
  std::size_t primitives = 0;
};

Ways ways(const Tree<double>& tree, std::size_t at, const LeafMerging& options) {
  const auto& node = tree.nodes[at];
  const double area = half_area(node.bounds);
  if (node.is_leaf()) return {{area * tests_of(node.count, options)}, node.count};
  const Ways left = ways(tree, node.first, options);
  const Ways right = ways(tree, std::size_t(node.first) + 1, options);
  Ways all{{}, left.primitives + right.primitives};
  if (all.primitives <= options.max_leaf_size) all.costs.push_back(area * tests_of(all.primitives, options));
  for (const double l : left.costs)
    for (const double r : right.costs) all.costs.push_back(area * double(options.traversal_cost) + l + r);
  return all;
}

}  // namespace

TEST_CASE("merge leaves: no other choice of leaves is cheaper", "[bvh][pass]") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto boxes = glint::testing::random_boxes<double>(12, seed);
    const auto tree = glint::SweepSah{.block_size = 1, .max_leaf_size = 1}.build(Boxes{boxes});
    for (const std::size_t block_size : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
      for (const float traversal_cost : {0.1F, 0.7F, 3.0F}) {
        const LeafMerging options{.traversal_cost = traversal_cost, .block_size = block_size, .max_leaf_size = 7};
        CAPTURE(seed, block_size, traversal_cost);
        const auto costs = ways(tree, 0, options).costs;
        const auto merged = merge_leaves(tree, options);
        CHECK(cost(merged, options) == Approx(*std::min_element(costs.begin(), costs.end())));
        CHECK(violations(merged, Boxes{boxes}).empty());
      }
    }
  }
}

TEMPLATE_TEST_CASE("merge leaves: any tree stays valid and never costs more", "[bvh][pass]", float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    const Boxes set{boxes};
    for (const auto& tree : {Median{.max_leaf_size = 1}.build(set), BinnedSah{}.build(set)}) {
      const auto merged = merge_leaves(tree);
      for (const std::string& broken : violations(merged, set)) FAIL_CHECK(broken);
      CHECK_FALSE(cost(merged, {}) > cost(tree, {}));  // both may be infinite or no number
      CHECK(depth_first(merged) == merged);
      CHECK(merge_leaves(merged) == merged);
    }
  }
}

TEST_CASE("merge leaves: neighbors share a leaf, strangers do not, and no leaf is larger than allowed", "[bvh][pass]") {
  std::vector<Aabb<float>> boxes;  // four unit cubes in a row here, four there
  for (int i = 0; i < 8; ++i) {
    const float x = float(i % 4) + (i < 4 ? 0.0F : 1000.0F);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  const auto tree = Median{.max_leaf_size = 1}.build(Boxes{boxes});
  const auto by_place = merge_leaves(tree);  // a block each
  CHECK(by_place.nodes.size() == 3);
  CHECK(by_place.nodes[1].count == 4);
  CHECK(by_place.depth == 1);
  CHECK(merge_leaves(tree, {.max_leaf_size = 2}).nodes.size() == 7);
  CHECK(merge_leaves(tree, {.max_leaf_size = 0}) == tree);
  CHECK(merge_leaves(tree, {.traversal_cost = 100}).nodes.size() == 1);
  CHECK(merge_leaves(by_place, {.max_leaf_size = 2}) == by_place);  // larger ones stay
}

TEST_CASE("merge leaves: a primitive that a subtree holds several times is in its leaf once", "[bvh][pass]") {
  const auto halves = glint::testing::random_boxes<float>(400, 1);
  auto tree = Median{.max_leaf_size = 1}.build(Boxes{halves});
  for (auto& primitive : tree.order) primitive /= 40;  // ten primitives of forty pieces each
  const auto merged = merge_leaves(tree);
  std::set<unsigned> seen;
  for (const auto& node : merged.nodes) {
    if (!node.is_leaf()) continue;
    const std::set<unsigned> distinct(merged.order.begin() + std::ptrdiff_t(node.first),
                                      merged.order.begin() + std::ptrdiff_t(node.first + node.count));
    CHECK(distinct.size() == node.count);
    seen.insert(distinct.begin(), distinct.end());
  }
  CHECK(seen.size() == 10);
  CHECK(merged.nodes.size() < tree.nodes.size());
  CHECK(merged.order.size() < tree.order.size());
  // Each piece still is in the box of a leaf that names its primitive.
  for (std::size_t i = 0; i < halves.size(); ++i) {
    CHECK(std::any_of(merged.nodes.begin(), merged.nodes.end(), [&](const auto& node) {
      const auto begin = merged.order.begin() + std::ptrdiff_t(node.first);
      return node.is_leaf() && contains(node.bounds, halves[i]) &&
             std::find(begin, begin + std::ptrdiff_t(node.count), i / 40) != begin + std::ptrdiff_t(node.count);
    }));
  }
}

TEMPLATE_TEST_CASE("merge leaves: rays meet what brute force meets", "[bvh][pass][laws]", float, double) {
  for (const auto& buffers :
       {glint::testing::triangle_soup<TestType>(400, 5), glint::testing::degenerate_mix<TestType>(200, 7),
        glint::testing::scanned_blob<TestType>(500, 8)}) {
    const auto mesh = glint::view(buffers);
    const glint::Bvh bvh(mesh, merge_leaves(Median{.max_leaf_size = 1}.build(mesh)));
    for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(bvh, glint::BruteForce(mesh), 1))
      FAIL_CHECK(broken);
  }
}

}  // namespace test_bvh_pass_merge_leaves
