// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/pass/graft.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint {
namespace detail {

template <BoundedSet S>
class Remover {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;

  Remover(const Tree<T, I>& tree, const S& set, std::span<const I> primitives)
      : tree_(tree), set_(set), is_removed_(set.size()), slots_(tree.nodes.size()) {
    for (const I i : primitives) {
      GLINT_ASSERT(i < set.size());
      is_removed_[i] = true;
    }
  }

  [[nodiscard]] Tree<T, I> run() {
    if (tree_.nodes.empty() || count(0) == 0) return {.left_out = set_.size()};
    Graft<T, I> graft(tree_.nodes.size(), tree_.order.size());
    graft.copy(tree_, 0, 0, 0, Prune{*this, graft});
    return std::move(graft).tree(set_.size());
  }

 private:
  /// Closes up over what is empty, and writes anew the leaves that lost something.
  struct Prune {
    const Remover& remover;
    Graft<T, I>& graft;

    bool operator()(std::size_t at, std::size_t to, int depth) const {
      const BinaryNode<T, I>& node = remover.tree_.nodes[at];
      if (node.is_leaf()) {
        if (remover.slots_[at] == node.count) return false;
        remover.write_rest(node, to, depth, graft);
        return true;
      }
      const std::size_t first = node.first;
      if (remover.slots_[first] != 0 && remover.slots_[first + 1] != 0) return false;
      graft.copy(remover.tree_, remover.slots_[first] != 0 ? first : first + 1, to, depth, *this);
      return true;
    }
  };

  /// The slots that stay, at a node and below.
  I count(std::size_t at) {
    const BinaryNode<T, I>& node = tree_.nodes[at];
    I n = 0;
    if (!node.is_leaf()) n = I(count(node.first) + count(std::size_t(node.first) + 1));
    for (const I primitive : slots_of(node)) n += I(!is_removed_[primitive]);
    slots_[at] = n;
    return n;
  }
  [[nodiscard]] std::span<const I> slots_of(const BinaryNode<T, I>& node) const noexcept {
    return std::span(tree_.order).subspan(node.is_leaf() ? node.first : 0, node.count);
  }
  void write_rest(const BinaryNode<T, I>& leaf, std::size_t to, int depth, Graft<T, I>& graft) const {
    std::vector<I> rest;
    Aabb<T> bounds;
    for (const I primitive : slots_of(leaf)) {
      if (is_removed_[primitive]) continue;
      rest.push_back(primitive);
      extend(bounds, overlap(set_.bounds(primitive), leaf.bounds));
    }
    graft.write_leaf(to, depth, bounds, rest);
  }

  const Tree<T, I>& tree_;
  const S& set_;
  std::vector<bool> is_removed_;
  std::vector<I> slots_;
};

}  // namespace detail

/// A tree without some of its primitives, whose boxes are as small as what is left allows.
///
/// Indices stay the caller's: the set keeps its size and its numbers, and rays do not find those that were removed. The
/// primitives that are left are asked for their boxes, the others are not; `insert` puts these back.
///
/// Requires: a valid tree over the set; each primitive is one of the set. One that the tree does not have, or that is
///           named twice, is no harm.
/// Ensures:  a valid tree of those that are left, numbered depth first, no deeper than before; `left_out` counts those
///           of the set that it does not have.
/// Cost:     O(nodes + primitives), a small part of what building takes.
template <BoundedSet S>
[[nodiscard]] Tree<typename S::Scalar, typename S::Index> remove(
    const Tree<typename S::Scalar, typename S::Index>& tree, const S& set,
    std::span<const typename S::Index> primitives) {
  return detail::Remover<S>(tree, set, primitives).run();
}

}  // namespace glint
