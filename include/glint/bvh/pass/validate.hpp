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

/// Checks what can be seen of a tree alone; gathers a sentence per broken rule and place.
template <std::floating_point T, std::unsigned_integral I>
class NodeCheck {
 public:
  NodeCheck(const Tree<T, I>& tree, std::vector<std::string>& wrong)
      : tree_(tree), wrong_(wrong), visits_(tree.nodes.size()), slots_(tree.order.size()) {}

  /// Requires: the tree has nodes.
  void run() {
    while (!pending_.empty()) {
      const auto [at, steps] = pending_.back();
      pending_.pop_back();
      depth_ = std::max(depth_, steps);
      visit(at, steps, "node " + std::to_string(at));
    }
    if (depth_ != tree_.depth) wrong_.push_back("the tree's depth is " + std::to_string(depth_));
    if (depth_ > Tree<T, I>::max_depth) wrong_.push_back("the tree is too deep");
    if (std::count(visits_.begin(), visits_.end(), 0) != 0) wrong_.push_back("some nodes have no parent");
    if (std::any_of(slots_.begin(), slots_.end(), [](int n) { return n != 1; })) {
      wrong_.push_back("some slots are not in one leaf");
    }
  }

 private:
  void visit(std::size_t at, int steps, const std::string& name) {
    const BinaryNode<T, I>& node = tree_.nodes[at];
    if (++visits_[at] > 1) {
      wrong_.push_back(name + " has two parents");
    } else if (node.is_leaf()) {
      count_slots(node, name);
    } else if (node.first == 0 || std::size_t(node.first) + 1 >= tree_.nodes.size()) {
      wrong_.push_back(name + " has children that do not exist");
    } else {
      for (const std::size_t child : {std::size_t(node.first), std::size_t(node.first) + 1}) {
        if (!contains(node.bounds, tree_.nodes[child].bounds)) wrong_.push_back(name + " does not hold its children");
        pending_.emplace_back(child, steps + 1);
      }
    }
  }

  void count_slots(const BinaryNode<T, I>& leaf, const std::string& name) {
    for (std::size_t slot = leaf.first; slot < std::size_t(leaf.first) + leaf.count; ++slot) {
      if (slot < slots_.size()) {
        ++slots_[slot];
      } else {
        wrong_.push_back(name + " has a slot beyond the order");
      }
    }
  }

  const Tree<T, I>& tree_;
  std::vector<std::string>& wrong_;
  std::vector<int> visits_;
  std::vector<int> slots_;
  std::vector<std::pair<std::size_t, int>> pending_{{0, 0}};
  int depth_ = 0;
};

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
  if (!tree.nodes.empty()) detail::NodeCheck(tree, wrong).run();
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
