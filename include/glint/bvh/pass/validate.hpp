// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>

#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

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

/// Cuts a cell at a plane of a box that it meets, if there is one within.
template <std::floating_point T>
[[nodiscard]] bool cut_by(const Aabb<T>& cell, const Aabb<T>& box, std::vector<Aabb<T>>& halves) {
  if (is_empty(overlap(cell, box))) return false;
  for (const Vec3<T>& corner : {box.lower, box.upper}) {
    for (int axis = 0; axis < 3; ++axis) {
      const T plane = component(corner, axis);
      if (!(component(cell.lower, axis) < plane && plane < component(cell.upper, axis))) continue;
      Aabb<T> below = cell;
      Aabb<T> above = cell;
      below.upper[axis] = plane;
      above.lower[axis] = plane;
      halves.insert(halves.end(), {below, above});
      return true;
    }
  }
  return false;
}

/// Checks where the primitives of a set are.
template <BoundedSet S>
class PrimitiveCheck {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;

  PrimitiveCheck(const Tree<T, I>& tree, const S& set, std::vector<std::string>& wrong)
      : set_(set), wrong_(wrong), left_out_(tree.left_out) {
    for (const BinaryNode<T, I>& leaf : tree.nodes)
      for (std::size_t slot = leaf.first; slot < std::size_t(leaf.first) + leaf.count; ++slot)
        places_.emplace_back(tree.order[slot], leaf.bounds);
    std::stable_sort(places_.begin(), places_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  void run() {
    auto place = places_.begin();
    std::size_t left_out = 0;
    for (std::size_t i = 0; i != set_.size(); ++i) {
      std::vector<Aabb<T>> leaves;
      for (; place != places_.end() && place->first == i; ++place) leaves.push_back(place->second);
      const bool bounded = is_bounded(set_.bounds(I(i)));
      left_out += std::size_t(!bounded);
      const std::string name = "primitive " + std::to_string(i);
      if (bounded == leaves.empty())
        wrong_.push_back(name + " has " + std::to_string(leaves.size()) + " slots");
      else if (bounded)
        check(I(i), leaves, name);
    }
    if (place != places_.end()) wrong_.push_back("there is no primitive " + std::to_string(place->first));
    if (left_out != left_out_) wrong_.push_back("the tree left out " + std::to_string(left_out) + " primitives");
  }

 private:
  void check(I i, std::vector<Aabb<T>>& leaves, const std::string& name) {
    const Aabb<T> box = set_.bounds(i);
    if (leaves.size() == 1) {
      if (!contains(leaves[0], box)) wrong_.push_back(name + " sticks out of its leaf");
      return;
    }
    for (Aabb<T>& leaf : leaves) {
      if (is_empty(overlap(leaf, box))) wrong_.push_back(name + " is in a leaf that it does not reach");
      if constexpr (ClippableSet<S>) {  // which rounds
        const T slack = rounding_bound<T>(512) * max_component(glm::max(abs(box.lower), abs(box.upper)));
        leaf = {leaf.lower - slack, leaf.upper + slack};
      }
    }
    if (!covered(i, leaves)) wrong_.push_back(name + " has a part in no leaf");
  }

  /// Whether leaves hold all of a primitive. Cells that none holds are cut at a plane of the leaf that holds most of
  /// them, until nothing is left.
  [[nodiscard]] bool covered(I i, std::span<const Aabb<T>> leaves) const {
    std::vector<Aabb<T>> pending{set_.bounds(i)};
    while (!pending.empty()) {
      Aabb<T> cell = pending.back();
      pending.pop_back();
      if constexpr (ClippableSet<S>) cell = overlap(set_.clip(i, cell), cell);
      if (is_empty(cell)) continue;
      if (std::any_of(leaves.begin(), leaves.end(), [&](const auto& leaf) { return contains(leaf, cell); })) continue;
      const auto share = [&](const Aabb<T>& leaf) { return half_area(overlap(leaf, cell)); };
      const auto less = [&](const Aabb<T>& a, const Aabb<T>& b) { return share(a) < share(b); };
      if (cut_by(cell, *std::max_element(leaves.begin(), leaves.end(), less), pending)) continue;
      if (std::none_of(leaves.begin(), leaves.end(), [&](const auto& leaf) { return cut_by(cell, leaf, pending); }))
        return false;
    }
    return true;
  }

  const S& set_;
  std::vector<std::string>& wrong_;
  std::size_t left_out_;
  std::vector<std::pair<I, Aabb<T>>> places_;
};

}  // namespace detail

/// What is wrong with a tree over a set, in sentences; empty for a valid tree.
///
/// A tree is valid when each node but the root has one parent, boxes hold what is below them, each slot is in one leaf,
/// each primitive with a finite, non-empty box has slots, no other primitive has, and `depth` is right and bounded. The
/// leaf of a primitive with one slot holds it whole; the leaves of one with several hold all of it together, as far as
/// the set's `clip` tells, and it reaches each of them.
///
/// Cost: O(nodes + primitives · log), and for a primitive in k leaves O(k²) or more.
template <BoundedSet S>
[[nodiscard]] std::vector<std::string> violations(const Tree<typename S::Scalar, typename S::Index>& tree,
                                                  const S& set) {
  std::vector<std::string> wrong;
  if (!tree.nodes.empty()) detail::NodeCheck(tree, wrong).run();
  if (tree.nodes.empty() && !(tree.order.empty() && tree.depth == 0))
    wrong.emplace_back("a tree without nodes has an order or a depth");
  if (!wrong.empty()) return wrong;

  detail::PrimitiveCheck<S>(tree, set, wrong).run();
  return wrong;
}

}  // namespace glint
