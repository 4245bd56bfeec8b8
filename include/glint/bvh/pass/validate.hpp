// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint {
namespace detail {

/// Checks what can be seen of a tree alone; appends a sentence per broken rule and place.
template <std::floating_point T, std::unsigned_integral I>
void check_nodes(const Tree<T, I>& tree, std::vector<std::string>& wrong) {
  std::vector<int> visits(tree.nodes.size());
  std::vector<int> slots(tree.order.size());
  std::vector<std::pair<std::size_t, int>> pending{{0, 0}};
  int depth = 0;
  while (!pending.empty()) {
    const auto [at, steps] = pending.back();
    pending.pop_back();
    const BinaryNode<T, I>& node = tree.nodes[at];
    const std::string name = "node " + std::to_string(at);
    depth = std::max(depth, steps);
    if (++visits[at] > 1) {
      wrong.push_back(name + " has two parents");
    } else if (node.is_leaf()) {
      for (std::size_t slot = node.first; slot < std::size_t(node.first) + node.count; ++slot) {
        if (slot < slots.size())
          ++slots[slot];
        else
          wrong.push_back(name + " has a slot beyond the order");
      }
    } else if (node.first == 0 || std::size_t(node.first) + 1 >= tree.nodes.size()) {
      wrong.push_back(name + " has children that do not exist");
    } else {
      for (const std::size_t child : {std::size_t(node.first), std::size_t(node.first) + 1}) {
        if (!contains(node.bounds, tree.nodes[child].bounds)) wrong.push_back(name + " does not hold its children");
        pending.emplace_back(child, steps + 1);
      }
    }
  }
  if (depth != tree.depth) wrong.push_back("the tree's depth is " + std::to_string(depth));
  if (depth > Tree<T, I>::max_depth) wrong.push_back("the tree is too deep");
  if (std::count(visits.begin(), visits.end(), 0) != 0) wrong.push_back("some nodes have no parent");
  if (std::any_of(slots.begin(), slots.end(), [](int n) { return n != 1; }))
    wrong.push_back("some slots are not in one leaf");
}

}  // namespace detail

/// What is wrong with a tree over a set, in sentences; empty for a valid tree.
///
/// A tree is valid when each node but the root has one parent, boxes hold what is below them, each slot is in one leaf,
/// each primitive with a finite, non-empty box has a slot, no other primitive has, and `depth` is right and bounded.
///
/// Cost: O(nodes + primitives).
template <BoundedSet S>
[[nodiscard]] std::vector<std::string> violations(const Tree<typename S::Scalar, typename S::Index>& tree,
                                                  const S& set) {
  std::vector<std::string> wrong;
  if (!tree.nodes.empty()) detail::check_nodes(tree, wrong);
  if (tree.nodes.empty() && !(tree.order.empty() && tree.depth == 0))
    wrong.emplace_back("a tree without nodes has an order or a depth");
  if (!wrong.empty()) return wrong;

  std::vector<int> seen(set.size());
  for (const auto& node : tree.nodes) {
    for (std::size_t slot = node.first; slot < std::size_t(node.first) + node.count; ++slot) {
      const auto primitive = tree.order[slot];
      if (primitive >= set.size()) return {"slot " + std::to_string(slot) + " has no primitive"};
      ++seen[primitive];
      if (!contains(node.bounds, set.bounds(primitive)))
        wrong.push_back("primitive " + std::to_string(primitive) + " sticks out of its leaf");
    }
  }
  std::size_t left_out = 0;
  for (std::size_t i = 0; i != seen.size(); ++i) {
    const auto box = set.bounds(typename S::Index(i));
    const bool bounded = is_finite(box.lower) && is_finite(box.upper) && !is_empty(box);
    if (bounded != (seen[i] == 1))
      wrong.push_back("primitive " + std::to_string(i) + " has " + std::to_string(seen[i]) + " slots");
    left_out += std::size_t(!bounded);
  }
  if (left_out != tree.left_out) wrong.push_back("the tree left out " + std::to_string(left_out) + " primitives");
  return wrong;
}

}  // namespace glint
