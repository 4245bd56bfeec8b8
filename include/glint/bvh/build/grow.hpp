// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/counter.hpp>
#include <glint/core/uninitialized.hpp>

namespace glint::detail {

/// The part of a builder that all builders share: recursion, bound on the depth, forks, numbering.
///
/// A splitter decides and moves references:
///
///     std::optional<std::pair<Part, Part>> split(const Part&, std::size_t capacity, executor)
///                                   nothing: make a leaf; else two parts of 1 to `capacity` references
///     void write(const Part&, I* order)                          the indices of a leaf
///
/// Ensures: the depth is at most `max_depth`. Let L be the largest leaf and r the steps left. If n ≤ L · 2^r holds at
/// a node, each of its children has at most the capacity L · 2^(r−1), so it holds there too, and at r = 0 the node fits
/// a leaf. An equal split always stays within the capacity: ⌈n / 2⌉ ≤ L · 2^(r−1). It holds at the root, for L is
/// enlarged to ⌈n / 2^max_depth⌉ if need be; by itself, n < 2^64 makes it hold for any L ≥ 1 and 64 steps.
template <std::floating_point T, std::unsigned_integral I, typename Splitter, typename Executor>
class Grower {
 public:
  Grower(Splitter& splitter, const Executor& executor, const Part<T>& root, std::size_t max_leaf_size, int max_depth)
      : splitter_(splitter),
        executor_(executor),
        max_depth_(std::clamp(max_depth, 0, Tree<T, I>::max_depth)),
        leaf_(std::max(std::max<std::size_t>(max_leaf_size, 1), shifted_up(root.count, max_depth_))),
        root_(root),
        nodes_(2 * (root.count + root.spare) - 1),  // not initialized: unused pages cost nothing
        order_(root.count + root.spare) {}

  [[nodiscard]] std::size_t max_leaf_size() const noexcept { return leaf_; }

  /// Requires: called once; the root is not empty.
  [[nodiscard]] Tree<T, I> grow() && {
    grow(root_, 0, 0);
    return numbered();
  }

 private:
  struct Node {  // BinaryNode without initializers
    std::array<T, 3> lower, upper;
    I first, count;
  };
  static constexpr std::size_t fork_size = 4096;

  static constexpr std::size_t shifted_up(std::size_t n, int bits) noexcept {
    return bits >= 64 ? std::size_t(n != 0) : (n >> bits) + std::size_t((n & ((std::size_t{1} << bits) - 1)) != 0);
  }
  [[nodiscard]] std::size_t capacity(int depth) const noexcept {
    const int steps = max_depth_ - depth - 1;
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    return steps >= 64 || leaf_ > (most >> steps) ? most : leaf_ << steps;
  }

  void grow(const Part<T>& part, std::size_t at, int depth) {
    std::optional<std::pair<Part<T>, Part<T>>> children;
    if (part.count > 1 && depth < max_depth_) children = splitter_.split(part, capacity(depth), executor_);
    const std::size_t first = children ? used_.take(2) : part.first;
    const Aabb<T> box = part.box.box();
    nodes_[at] = {{box.lower.x, box.lower.y, box.lower.z},
                  {box.upper.x, box.upper.y, box.upper.z},
                  I(first),
                  children ? I(0) : I(part.count)};
    if (!children) return splitter_.write(part, order_.data() + part.first);
    const auto left = [&] { grow(children->first, first, depth + 1); };
    const auto right = [&] { grow(children->second, first + 1, depth + 1); };
    if (part.count >= fork_size) return executor_.invoke(left, right);
    left();
    right();
  }

  /// Threads took nodes as they came; the tree numbers them depth first, which is also good for caches. The slots of
  /// the leaves, in that order, move together over those that were spared.
  [[nodiscard]] Tree<T, I> numbered() {
    Tree<T, I> tree;
    std::size_t slots = 0;
    tree.nodes.reserve(used_.value());
    tree.nodes.push_back(node(0));
    struct Pending {
      std::size_t node;
      int depth;
    };
    std::vector<Pending> pending{{0, 0}};
    while (!pending.empty()) {
      const auto [at, depth] = pending.back();
      pending.pop_back();
      tree.depth = std::max(tree.depth, depth);
      if (tree.nodes[at].is_leaf()) {
        slots = moved_to(slots, tree.nodes[at]);
        continue;
      }
      const std::size_t children = tree.nodes[at].first;
      const std::size_t first = tree.nodes.size();
      tree.nodes[at].first = I(first);
      tree.nodes.push_back(node(children));
      tree.nodes.push_back(node(children + 1));
      pending.push_back({first + 1, depth + 1});
      pending.push_back({first, depth + 1});
    }
    order_.resize(slots);
    tree.order = std::move(order_);
    return tree;
  }
  /// Moves the slots of a leaf down to begin at `first`; where they end then.
  std::size_t moved_to(std::size_t first, BinaryNode<T, I>& leaf) noexcept {
    if (leaf.first != first)
      std::copy_n(order_.begin() + std::ptrdiff_t(leaf.first), leaf.count, order_.begin() + std::ptrdiff_t(first));
    leaf.first = I(first);
    return first + leaf.count;
  }
  [[nodiscard]] BinaryNode<T, I> node(std::size_t i) const noexcept {
    const Node& n = nodes_[i];
    return {{{n.lower[0], n.lower[1], n.lower[2]}, {n.upper[0], n.upper[1], n.upper[2]}}, n.first, n.count};
  }

  Splitter& splitter_;
  const Executor& executor_;
  int max_depth_;
  std::size_t leaf_;
  Part<T> root_;
  UninitializedVector<Node> nodes_;
  std::vector<I> order_;
  Counter used_{1};
};

/// A tree over a set, by references that a splitter, `make_splitter(references, root)`, knows how to split. It
/// may append slots to spare to the references.
template <BoundedSet S, typename Executor, typename MakeSplitter>
[[nodiscard]] Tree<typename S::Scalar, typename S::Index> grow_tree(const S& set, const Executor& executor,
                                                                    const MakeSplitter& make_splitter,
                                                                    std::size_t max_leaf_size, int max_depth) {
  using T = typename S::Scalar;
  using I = typename S::Index;
  References<T> references = gather(set, executor);
  const std::size_t left_out = set.size() - references.size();
  Tree<T, I> tree;
  if (!references.empty()) {
    Part<T> root = whole<T>(references, executor);
    auto splitter = make_splitter(references, root);
    root.spare = references.size() - root.count;
    Grower<T, I, decltype(splitter), Executor> grower(splitter, executor, root, max_leaf_size, max_depth);
    splitter.max_leaf_size = grower.max_leaf_size();
    tree = std::move(grower).grow();
  }
  tree.left_out = left_out;
  return tree;
}

}  // namespace glint::detail
