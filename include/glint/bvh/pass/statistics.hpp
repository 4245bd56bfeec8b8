// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>

namespace glint {

/// What a tree looks like, in numbers.
struct TreeStatistics {
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t primitives = 0;             ///< in the leaves, each counted once
  std::size_t references = 0;             ///< to them from the leaves: more where a builder cut primitives
  std::size_t left_out = 0;               ///< without a finite, non-empty box
  int depth = 0;                          ///< steps from the root to the deepest leaf
  double sah_cost = 0;                    ///< see `statistics`
  std::size_t bytes = 0;                  ///< of nodes and order
  std::vector<std::size_t> leaf_sizes{};  ///< [n]: the number of leaves of n references

  [[nodiscard]] friend bool operator==(const TreeStatistics&, const TreeStatistics&) = default;
};

namespace detail {

template <std::unsigned_integral I>
[[nodiscard]] std::size_t count_distinct(std::span<const I> indices) {
  if (indices.empty()) return 0;
  std::vector<bool> seen(std::size_t(*std::max_element(indices.begin(), indices.end())) + 1);
  for (const I i : indices) seen[i] = true;
  return std::size_t(std::count(seen.begin(), seen.end(), true));
}

}  // namespace detail

/// What a random line through the root's box costs on average: Σ inner area · traversal_cost + Σ leaf area · count ·
/// intersection_cost, over the root's area. A root without area costs as if every line met every node.
///
/// Cost:   O(nodes + references).
/// Source: Goldsmith, Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", CG&A 1987.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] TreeStatistics statistics(const Tree<T, I>& tree, double traversal_cost = 1,
                                        double intersection_cost = 1) {
  TreeStatistics s{.nodes = tree.nodes.size(),
                   .primitives = detail::count_distinct<I>(tree.order),
                   .references = tree.order.size(),
                   .left_out = tree.left_out,
                   .depth = tree.depth,
                   .bytes = tree.nodes.size() * sizeof(tree.nodes[0]) + tree.order.size() * sizeof(I)};
  if (tree.nodes.empty()) return s;
  const double root_area = double(half_area(tree.nodes.front().bounds));
  for (const BinaryNode<T, I>& node : tree.nodes) {
    const double share = root_area > 0 ? double(half_area(node.bounds)) / root_area : 1.0;
    s.sah_cost += share * (node.is_leaf() ? double(node.count) * intersection_cost : traversal_cost);
    if (!node.is_leaf()) continue;
    ++s.leaves;
    if (s.leaf_sizes.size() <= node.count) s.leaf_sizes.resize(std::size_t(node.count) + 1);
    ++s.leaf_sizes[node.count];
  }
  return s;
}

}  // namespace glint
