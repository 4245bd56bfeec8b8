// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include <glint/bvh/tree.hpp>

namespace glint {

/// The same tree with its nodes numbered depth first and its slots in that order: parents precede children, siblings
/// lie at odd numbers and the even ones after them, and the slots below any node are one run. Nodes and slots that
/// nothing refers to are dropped, and the depth is measured.
///
/// Passes end with this, and builders number nodes likewise: near in the tree is near in memory.
///
/// Requires: a valid tree, but for nodes and slots without a parent, and a wrong depth.
/// Cost:     O(nodes + primitives).
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] Tree<T, I> depth_first(const Tree<T, I>& tree) {
  Tree<T, I> result{.left_out = tree.left_out};
  if (tree.nodes.empty()) return result;
  result.nodes.reserve(tree.nodes.size());
  result.order.reserve(tree.order.size());
  result.nodes.push_back(tree.nodes.front());
  std::vector<std::pair<std::size_t, int>> pending{{0, 0}};  // of the result; their links are still those of the tree
  while (!pending.empty()) {
    const auto [at, depth] = pending.back();
    pending.pop_back();
    result.depth = std::max(result.depth, depth);
    const std::size_t from = result.nodes[at].first;
    if (result.nodes[at].is_leaf()) {
      result.nodes[at].first = I(result.order.size());
      const auto slot = tree.order.begin() + std::ptrdiff_t(from);
      result.order.insert(result.order.end(), slot, slot + std::ptrdiff_t(result.nodes[at].count));
    } else {
      const std::size_t to = result.nodes.size();
      result.nodes[at].first = I(to);
      result.nodes.push_back(tree.nodes[from]);
      result.nodes.push_back(tree.nodes[from + 1]);
      pending.emplace_back(to + 1, depth + 1);
      pending.emplace_back(to, depth + 1);
    }
  }
  return result;
}

}  // namespace glint
