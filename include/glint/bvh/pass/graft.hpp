// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint::detail {

/// Whether a primitive may be in several leaves.
enum class Repeats { None, Possible };

template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] Repeats repeats_of(const Tree<T, I>& tree) {
  return count_distinct<I>(tree.order) == tree.order.size() ? Repeats::None : Repeats::Possible;
}

/// Some primitives of a set, to build a tree over: each with its box, or with the box of the part of it that matters.
template <std::floating_point T, std::unsigned_integral I>
class Gathered {
 public:
  explicit Gathered(Repeats repeats) : repeats_(repeats) {}

  void add(I primitive, const Aabb<T>& box) {
    primitives_.push_back(primitive);
    boxes_.push_back(box);
  }

  /// What a leaf has of its primitives.
  template <BoundedSet S>
  void add(const Tree<T, I>& tree, const BinaryNode<T, I>& leaf, const S& set) {
    for (std::size_t slot = leaf.first; slot != std::size_t(leaf.first) + leaf.count; ++slot)
      add(tree.order[slot], overlap(set.bounds(tree.order[slot]), leaf.bounds));
  }
  /// Likewise, of all leaves below a node.
  template <BoundedSet S>
  void add_below(const Tree<T, I>& tree, std::size_t at, const S& set) {
    std::vector<std::size_t> pending{at};
    while (!pending.empty()) {
      const BinaryNode<T, I>& node = tree.nodes[pending.back()];
      pending.pop_back();
      if (node.is_leaf()) {
        add(tree, node, set);
      } else {
        pending.push_back(std::size_t(node.first) + 1);
        pending.push_back(node.first);
      }
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return primitives_.size(); }

  /// Its order has the set's indices.
  template <typename Executor>
  [[nodiscard]] Tree<T, I> build(BinnedSah builder, int depth_above, const Executor& executor) {
    builder.max_depth = std::min(builder.max_depth, Tree<T, I>::max_depth - depth_above);
    if (repeats_ == Repeats::Possible) join_parts();
    Tree<T, I> tree = builder.build(Boxes<T, I>(boxes_), executor);
    for (I& primitive : tree.order) primitive = primitives_[primitive];
    return tree;
  }

 private:
  /// Parts of one primitive become one, so that no leaf has it twice.
  void join_parts() {
    std::vector<std::size_t> sorted(size());
    std::iota(sorted.begin(), sorted.end(), std::size_t{0});
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](std::size_t a, std::size_t b) { return primitives_[a] < primitives_[b]; });
    Gathered joined(Repeats::None);
    for (const std::size_t i : sorted) {
      if (joined.size() != 0 && joined.primitives_.back() == primitives_[i])
        extend(joined.boxes_.back(), boxes_[i]);
      else
        joined.add(primitives_[i], boxes_[i]);
    }
    *this = std::move(joined);
  }

  Repeats repeats_;
  std::vector<I> primitives_;
  std::vector<Aabb<T>> boxes_;
};

/// A tree that is put together of parts of others. Whoever writes left subtrees first numbers it depth first.
template <std::floating_point T, std::unsigned_integral I>
class Graft {
 public:
  /// Makes the root, at 0.
  Graft(std::size_t nodes, std::size_t slots) {
    result_.nodes.reserve(nodes);
    result_.order.reserve(slots);
    result_.nodes.emplace_back();
  }

  /// Makes room for two siblings: the place of the first.
  [[nodiscard]] std::size_t add_siblings() {
    result_.nodes.resize(result_.nodes.size() + 2);
    return result_.nodes.size() - 2;
  }
  void write_leaf(std::size_t to, int depth, const Aabb<T>& bounds, std::span<const I> primitives) {
    result_.nodes[to] = {bounds, I(result_.order.size()), I(primitives.size())};
    result_.order.insert(result_.order.end(), primitives.begin(), primitives.end());
    result_.depth = std::max(result_.depth, depth);
  }
  /// Requires: both children are written.
  void write_inner(std::size_t to, std::size_t first) {
    const Aabb<T> bounds = join(result_.nodes[first].bounds, result_.nodes[first + 1].bounds);
    result_.nodes[to] = {bounds, I(first), 0};
  }

  /// Writes what stands at node `at` of a tree, and below, to node `to`. `replace(at, to, depth)` may write something
  /// else there, and then returns true.
  template <typename Replace>
  void copy(const Tree<T, I>& tree, std::size_t at, std::size_t to, int depth, const Replace& replace) {
    if (!replace(at, to, depth)) copy_node(tree, at, to, depth, replace);
  }
  /// The same, where the node itself is not replaced.
  template <typename Replace>
  void copy_node(const Tree<T, I>& tree, std::size_t at, std::size_t to, int depth, const Replace& replace) {
    const BinaryNode<T, I>& node = tree.nodes[at];
    if (node.is_leaf())
      return write_leaf(to, depth, node.bounds, std::span(tree.order).subspan(node.first, node.count));
    const std::size_t first = add_siblings();
    copy(tree, node.first, first, depth + 1, replace);
    copy(tree, std::size_t(node.first) + 1, first + 1, depth + 1, replace);
    write_inner(to, first);
  }
  void copy(const Tree<T, I>& tree, std::size_t to, int depth) {
    copy(tree, 0, to, depth, [](std::size_t, std::size_t, int) { return false; });
  }

  /// Over a set of so many primitives, of which the tree leaves out those that it does not have.
  [[nodiscard]] Tree<T, I> tree(std::size_t set_size) && {
    result_.left_out = set_size - count_distinct<I>(result_.order);
    return std::move(result_);
  }

 private:
  Tree<T, I> result_;
};

}  // namespace glint::detail
