// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>

#include <glint/bvh/leaves.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint {

/// What became of a tree whose primitives moved.
struct Refit {
  double growth = 1;     ///< the SAH cost, over what it was before; a tree that grew much is worth building anew
  std::size_t lost = 0;  ///< slots of primitives that have no finite, non-empty box any more

  [[nodiscard]] friend bool operator==(const Refit&, const Refit&) = default;
};

namespace detail {

template <typename S, typename Executor>
class Refitter {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;
  using Fitted = FittedLeaf<T>;

  Refitter(Tree<T, I>& tree, const S& set, const Executor& executor) : tree_(tree), set_(set), executor_(executor) {}

  Fitted fit(std::size_t at, int depth) const {
    BinaryNode<T, I>& node = tree_.nodes[at];
    const Fitted fitted = node.is_leaf() ? of_leaf(node) : of_children(node.first, depth + 1);
    node.bounds = fitted.bounds;
    return fitted;
  }

 private:
  /// Deep enough that lopsided trees make work for all threads too, shallow enough that tasks are not tiny.
  static constexpr int fork_depth = 12;
  static constexpr std::size_t fork_size = 4096;

  [[nodiscard]] Fitted of_leaf(const BinaryNode<T, I>& node) const {
    Fitted fitted;
    for (std::size_t slot = node.first; slot != std::size_t(node.first) + node.count; ++slot)
      fitted.add(set_.bounds(tree_.order[slot]));
    return fitted;
  }
  [[nodiscard]] Fitted of_children(std::size_t first, int depth) const {
    Fitted left;
    Fitted right;
    const auto fit_left = [&] { left = fit(first, depth); };
    const auto fit_right = [&] { right = fit(first + 1, depth); };
    if (depth <= fork_depth && tree_.nodes.size() >= fork_size) {
      executor_.invoke(fit_left, fit_right);
    } else {
      fit_left();
      fit_right();
    }
    return {join(left.bounds, right.bounds), left.lost + right.lost};
  }

  Tree<T, I>& tree_;
  const S& set_;
  const Executor& executor_;
};

}  // namespace detail

/// Boxes anew, in place, for primitives that moved since the tree was built; nodes, slots and depth stay.
///
/// Leaves take whole boxes: where the builder cut primitives, the tree is valid after, but a looser one.
///
/// Requires: a valid tree over as many primitives; those that the builder left out are not looked at again.
/// Errors:   a primitive whose box is empty, infinite or NaN takes no room in the boxes and keeps its slot. `lost`
///           counts them; where it is not zero, rays may or may not find what these primitives say of themselves, and
///           violations() complains: build anew.
/// Cost:     O(nodes + primitives).
/// Threads:  subtrees in parallel; the same boxes for every executor.
template <BoundedSet S, Executor E = Serial>
Refit refit(Tree<typename S::Scalar, typename S::Index>& tree, const S& set, const E& executor = {}) {
  if (tree.nodes.empty()) return {};
  const double before = statistics(tree).sah_cost;
  const auto fitted = detail::Refitter<S, E>(tree, set, executor).fit(0, 0);
  return {.growth = statistics(tree).sah_cost / before, .lost = fitted.lost};
}

}  // namespace glint
