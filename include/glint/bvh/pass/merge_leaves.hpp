// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/pass/depth_first.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>

namespace glint {

/// What leaves cost, as builders see it.
struct LeafMerging {
  float traversal_cost = 0.7F;  ///< of visiting an inner node …
  float intersection_cost = 1;  ///< … against testing a primitive
  std::size_t block_size = 4;   ///< primitives that a leaf tests at the price of one: a Bvh's Leaves::block_size
  std::size_t max_leaf_size = 8;
};

/// The same tree with those of its subtrees made leaves that cost no less as they are: of all choices, the cheapest by
/// the surface area heuristic.
///
/// Meant for trees that were built, and had nodes reinserted, with a primitive or two a leaf. A primitive that a
/// subtree holds several times is in its leaf once.
///
/// Requires: a valid tree; block_size ≥ 1.
/// Ensures:  nodes are numbered depth first; leaves that were larger than max_leaf_size stay.
/// Cost:     O(nodes + primitives · log max_leaf_size · steps between a leaf and its largest merged ancestor).
/// Source:   Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies", TOG
///           2007, section 4: the cost of a leaf against that of a split; here bottom-up, over a tree that is there.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] Tree<T, I> merge_leaves(const Tree<T, I>& tree, const LeafMerging& options = {}) {
  struct Below {  // of a node: its cost, and its run of slots
    T cost;
    I first;
    I count;
  };
  Tree<T, I> result = depth_first(tree);
  std::vector<Below> below(result.nodes.size());
  std::vector<I> primitives;
  const auto leaf_cost = [&](const BinaryNode<T, I>& node, std::size_t count) {
    return half_area(node.bounds) * T(options.intersection_cost) * T(detail::blocks(count, options.block_size));
  };
  for (std::size_t i = result.nodes.size(); i-- > 0;) {  // children first
    BinaryNode<T, I>& node = result.nodes[i];
    if (node.is_leaf()) {
      below[i] = {leaf_cost(node, node.count), node.first, node.count};
      continue;
    }
    const Below& left = below[node.first];
    const Below& right = below[std::size_t(node.first) + 1];
    const T split = half_area(node.bounds) * T(options.traversal_cost) + left.cost + right.cost;
    below[i] = {split, left.first, I(left.count + right.count)};
    if (below[i].count > options.max_leaf_size) continue;
    const auto begin = result.order.begin() + std::ptrdiff_t(left.first);
    const auto end = begin + std::ptrdiff_t(below[i].count);
    primitives.assign(begin, end);
    std::sort(primitives.begin(), primitives.end());
    primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
    const T merged = leaf_cost(node, primitives.size());
    if (!(merged <= split)) continue;
    std::fill(std::copy(primitives.begin(), primitives.end(), begin), end, primitives.back());  // all still in the run
    node.first = left.first;
    node.count = I(primitives.size());
    below[i].cost = merged;
  }
  return depth_first(result);
}

}  // namespace glint
