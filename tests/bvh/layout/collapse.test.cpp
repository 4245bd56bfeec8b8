// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/collapse.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_layout_collapse {

namespace {

using glint::Aabb;
using glint::Collapse;
using glint::Link;
using glint::Tree;

template <typename T>
struct Shown {
  int times = 0;
  Aabb<T> bounds{};
  std::vector<std::pair<Aabb<T>, Link<std::uint32_t>>> children{};

  friend bool operator==(const Shown&, const Shown&) = default;
};

template <int N, typename T, typename E = glint::Serial>
std::vector<Shown<T>> shown(const Tree<T>& tree, Collapse how, const E& executor = {}) {
  std::vector<Shown<T>> nodes;
  glint::collapse<N>(
      tree, how, executor, [&](std::size_t count) { nodes.resize(count); },
      [&](std::uint32_t at, const Aabb<T>& bounds, std::span<const glint::WideChild<T, std::uint32_t>> children) {
        ++nodes[at].times;
        nodes[at].bounds = bounds;
        for (const auto& child : children) nodes[at].children.emplace_back(child.bounds, child.link);
      });
  return nodes;
}

template <typename T>
double cost(const std::vector<Shown<T>>& nodes) {
  double sum = 0;
  for (const Shown<T>& node : nodes) sum += double(half_area(node.bounds));
  return sum;
}

/// Steps from a node to the deepest leaf below it.
template <typename T>
int depth(const std::vector<Shown<T>>& nodes, std::size_t at = 0) {
  int deepest = 0;
  for (const auto& [box, link] : nodes[at].children)
    deepest = std::max(deepest, 1 + (link.is_leaf() ? 0 : depth(nodes, link.first)));
  return deepest;
}

/// Every node shown once, with two to N children; every leaf of the tree the child of one node, with its box.
template <int N, typename T>
void check_nodes(const std::vector<Shown<T>>& nodes, const Tree<T>& tree) {
  std::vector<int> parents(nodes.size());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
  bool good = true;
  for (const Shown<T>& node : nodes) {
    good = good && node.times == 1 && node.children.size() >= 2 && node.children.size() <= std::size_t(N);
    for (const auto& [box, link] : node.children) {
      good = good && contains(node.bounds, box);
      if (link.is_leaf()) {
        found.emplace_back(link.first, link.count);
      } else {
        ++parents[link.first];
        good = good && nodes[link.first].bounds == box;
      }
    }
  }
  for (const auto& node : tree.nodes)
    if (node.is_leaf()) expected.emplace_back(node.first, node.count);
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  CHECK(good);
  CHECK(parents[0] == 0);
  CHECK(std::count(parents.begin() + 1, parents.end(), 1) == std::ptrdiff_t(nodes.size()) - 1);
  CHECK(found == expected);
  CHECK(depth(nodes) <= tree.depth);
}

template <int N, typename T>
void check_collapses(const Tree<T>& tree) {
  const auto greedy = shown<N>(tree, Collapse::Greedy);
  const auto optimal = shown<N>(tree, Collapse::Optimal);
  check_nodes<N>(greedy, tree);
  check_nodes<N>(optimal, tree);
  // Each area is rounded the same; the sums are in double precision, those of the program in T.
  const double least = cost(optimal);
  if (std::isfinite(least)) CHECK(least <= cost(greedy) * (1 + 1e3 * double(std::numeric_limits<T>::epsilon())));
}

/// How many children a node has when just the inner nodes of the mask stay.
template <typename T>
int children_of(const Tree<T>& tree, const std::vector<int>& bit, unsigned mask, std::size_t at) {
  int count = 0;
  for (const std::size_t child : {std::size_t(tree.nodes[at].first), std::size_t(tree.nodes[at].first) + 1}) {
    const bool stays = tree.nodes[child].is_leaf() || ((mask >> bit[child]) & 1U) != 0;
    count += stays ? 1 : children_of(tree, bit, mask, child);
  }
  return count;
}

/// The least cost of all ways to keep some inner nodes, and the root, so that none has more than N children.
template <int N, typename T>
double least_cost(const Tree<T>& tree) {
  std::vector<int> bit(tree.nodes.size(), -1);
  std::vector<std::size_t> inner;
  for (std::size_t i = 0; i != tree.nodes.size(); ++i) {
    if (tree.nodes[i].is_leaf()) continue;
    bit[i] = int(inner.size());
    inner.push_back(i);
  }
  double least = std::numeric_limits<double>::infinity();
  for (unsigned mask = 1; mask < 1U << inner.size(); mask += 2) {  // the root is bit 0
    double sum = 0;
    bool allowed = true;
    for (const std::size_t i : inner) {
      if (((mask >> bit[i]) & 1U) == 0) continue;
      sum += double(half_area(tree.nodes[i].bounds));
      allowed = allowed && children_of(tree, bit, mask, i) <= N;
    }
    if (allowed) least = std::min(least, sum);
  }
  return least;
}

}  // namespace

TEMPLATE_TEST_CASE("collapse: every leaf has one place, and no path is longer than it was", "[bvh][layout]", float,
                   double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    for (const auto& tree : {glint::BinnedSah{}.build(glint::Boxes{boxes}),
                             glint::Median{.max_leaf_size = 1}.build(glint::Boxes{boxes})}) {
      if (tree.nodes.size() < 2) continue;
      check_collapses<2>(tree);
      check_collapses<4>(tree);
      check_collapses<8>(tree);
      check_collapses<16>(tree);
    }
  }
}

TEMPLATE_TEST_CASE("collapse: the optimal one costs what the cheapest of all ways costs", "[bvh][layout]", float,
                   double) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    const auto boxes = glint::testing::random_boxes<TestType>(3 + seed % 10, seed);
    const auto tree = glint::Median{.max_leaf_size = 1}.build(glint::Boxes{boxes});  // has many ways to do better
    const double margin = 100 * double(std::numeric_limits<TestType>::epsilon());    // of two dozen additions
    CHECK(cost(shown<2>(tree, Collapse::Optimal)) == Approx(least_cost<2>(tree)).epsilon(margin));
    CHECK(cost(shown<4>(tree, Collapse::Optimal)) == Approx(least_cost<4>(tree)).epsilon(margin));
    CHECK(cost(shown<8>(tree, Collapse::Optimal)) == Approx(least_cost<8>(tree)).epsilon(margin));
  }
}

TEST_CASE("collapse: greed may pay for opening the largest", "[bvh][layout]") {
  // Cubes of the sizes 30 (19 (18 18) 19 (18 18)) in a 20, and beside it a 10 with two leaves; each 18 has two leaves.
  Tree<float> tree;
  const auto cube = [](float size) { return Aabb<float>{{0, 0, 0}, {size, size, size}}; };
  tree.nodes = {{cube(30), 1, 0}, {cube(20), 3, 0}, {cube(10), 5, 0}, {cube(19), 7, 0}, {cube(19), 9, 0}};
  tree.nodes.insert(tree.nodes.end(), {{cube(9), 0, 1}, {cube(9), 1, 1}});
  for (std::uint32_t i = 0; i < 4; ++i) tree.nodes.push_back({cube(18), 11 + 2 * i, 0});
  for (std::uint32_t i = 0; i < 8; ++i) tree.nodes.push_back({cube(17), 2 + i, 1});
  tree.order.resize(10);
  tree.depth = 4;
  // Half the area of a cube is 3 size². Greed opens 20 and a 19: 30 keeps 18, 18, 19, 10.
  CHECK(cost(shown<4>(tree, Collapse::Greedy)) == 3 * (30 * 30 + 2 * 18 * 18 + 19 * 19 + 10 * 10));
  // Better to open 20 and 10, and have two full nodes of 19, whose children are eight leaves.
  CHECK(cost(shown<4>(tree, Collapse::Optimal)) == 3 * (30 * 30 + 2 * 19 * 19));
}

TEST_CASE("collapse: gives the same nodes in the same places for every executor", "[bvh][layout]") {
  const auto tree =
      glint::BinnedSah{.max_leaf_size = 2}.build(glint::Boxes{glint::testing::random_boxes<float>(30'000, 4)});
  for (const Collapse how : {Collapse::Greedy, Collapse::Optimal}) {
    CHECK(shown<8>(tree, how, glint::testing::TwoThreads{}) == shown<8>(tree, how));
    CHECK(shown<4>(tree, how, glint::testing::TwoThreads{}) == shown<4>(tree, how));
  }
}

}  // namespace test_bvh_layout_collapse
