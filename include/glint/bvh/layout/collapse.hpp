// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/uninitialized.hpp>
#include <glint/geometry/aabb.hpp>

namespace glint {

/// How a binary tree becomes one of wider nodes.
enum class Collapse {
  Greedy,   ///< each node opens its largest child until it is full
  Optimal,  ///< the fewest nodes that a random line visits, by dynamic programming
};

/// A child of a wide node, for the layout to write down.
template <std::floating_point T, std::unsigned_integral I>
struct WideChild {
  Aabb<T> bounds{};
  Link<I> link{};
};

namespace detail {

/// The binary nodes that are the children of one wide node.
template <std::unsigned_integral I, int N>
struct Siblings {
  std::array<I, std::size_t(N)> node;
  std::size_t size = 0;

  void add(I i) noexcept { node[size++] = i; }
};

/// How many levels of a tree are worth tasks of their own: none of a small one, up to 4096 tasks.
[[nodiscard]] constexpr int fork_levels(std::size_t nodes) noexcept {
  return std::min(12, int(std::bit_width(nodes >> 10)));
}

/// Siblings are found on the way: the largest is replaced by its children while there is room.
template <std::floating_point T, std::unsigned_integral I, int N>
class GreedyCollapse {
 public:
  template <Executor E>
  GreedyCollapse(const Tree<T, I>& tree, const E& executor) : tree_(tree), counts_(tree.nodes.size()) {
    count(0, executor, fork_levels(tree.nodes.size()) / 3);
  }

  /// Wide nodes in place of a binary one and what is below it. Requires: the root, or an inner one among siblings.
  [[nodiscard]] I node_count(I at) const noexcept { return counts_[at]; }
  [[nodiscard]] Siblings<I, N> siblings(I at) const noexcept {
    Siblings<I, N> found;
    std::array<T, std::size_t(N)> area;
    const auto add = [&](std::size_t to, I i) {
      found.node[to] = i;
      area[to] = tree_.nodes[i].is_leaf() ? T(-1) : half_area(tree_.nodes[i].bounds);
    };
    add(0, tree_.nodes[at].first);
    add(1, tree_.nodes[at].first + 1);
    for (found.size = 2; found.size < std::size_t(N); ++found.size) {
      const std::size_t largest = std::size_t(std::max_element(&area[0], &area[found.size]) - &area[0]);
      const BinaryNode<T, I>& opened = tree_.nodes[found.node[largest]];
      if (opened.is_leaf()) break;
      add(largest, opened.first);
      add(found.size, opened.first + 1);
    }
    return found;
  }

 private:
  template <Executor E>
  I count(I at, const E& executor, int forks) {
    const Siblings<I, N> children = siblings(at);
    std::array<I, std::size_t(N)> below{};
    const auto count_children = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i)
        if (!tree_.nodes[children.node[i]].is_leaf()) below[i] = count(children.node[i], executor, forks - 1);
    };
    if (forks > 0)
      executor.parallel_for(children.size, 1, count_children);
    else
      count_children(0, children.size);
    I sum = 1;
    for (const I n : below) sum += n;
    return counts_[at] = sum;
  }

  const Tree<T, I>& tree_;
  UninitializedVector<I> counts_;
};

/// Siblings are planned from the leaves up. Let c(n, i) be the least sum of the areas of wide nodes that represent what
/// is below the binary node n by at most i of them. A leaf is no node, so costs nothing; else, with the children l, r
///
///     split(n, i) = min over 0 < k < i of c(l, k) + c(r, i − k)
///     c(n, 1)     = area(n) + split(n, N)
///     c(n, i)     = min(c(n, i − 1), split(n, i))
///
/// Leaves stay as the tree has them, so they cost all collapses the same: what a node costs against a leaf is for
/// builders to weigh.
///
/// Source: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017,
///         section 3.1; without its merging of leaves.
template <std::floating_point T, std::unsigned_integral I, int N>
class OptimalCollapse {
 public:
  template <Executor E>
  OptimalCollapse(const Tree<T, I>& tree, const E& executor) : tree_(tree), plans_(tree.nodes.size()) {
    solve(0, executor, fork_levels(tree.nodes.size()));
  }

  [[nodiscard]] I node_count(I at) const noexcept { return plans_[at].node_count; }
  [[nodiscard]] Siblings<I, N> siblings(I at) const noexcept {
    Siblings<I, N> found;
    const int left = share(at, N);
    gather(tree_.nodes[at].first, left, found);
    gather(tree_.nodes[at].first + 1, N - left, found);
    return found;
  }

 private:
  /// What the left child gets of i places, four bits for each i from 2 to N; 0 where i − 1 places do.
  using Shares = std::conditional_t<(N <= 8), std::uint32_t, std::uint64_t>;
  static_assert(N >= 2 && N <= 16);
  static constexpr std::size_t sizes = std::size_t(N - 1);

  struct Plan {
    Shares shares;
    I node_count;
  };
  /// By the number of places less one.
  struct Forests {
    std::array<T, std::size_t(N)> cost{};
    std::array<I, std::size_t(N)> node_count{};
  };
  struct Split {
    T cost;
    std::size_t left;
  };

  [[nodiscard]] int share(I at, int places) const noexcept {
    return int((plans_[at].shares >> (4 * (places - 2))) & 15);
  }
  void gather(I at, int places, Siblings<I, N>& found) const noexcept {
    if (!tree_.nodes[at].is_leaf())
      while (places > 1 && share(at, places) == 0) --places;
    if (places == 1 || tree_.nodes[at].is_leaf()) return found.add(at);
    const int left = share(at, places);
    gather(tree_.nodes[at].first, left, found);
    gather(tree_.nodes[at].first + 1, places - left, found);
  }

  template <Executor E>
  Forests solve(I at, const E& executor, int forks) {
    const BinaryNode<T, I>& node = tree_.nodes[at];
    Forests left;
    Forests right;
    if (node.is_leaf()) return left;
    const auto solve_left = [&] { left = solve(node.first, executor, forks - 1); };
    const auto solve_right = [&] { right = solve(node.first + 1, executor, forks - 1); };
    if (forks > 0) {
      executor.invoke(solve_left, solve_right);
    } else {
      solve_left();
      solve_right();
    }
    return joined(at, left, right);
  }
  [[nodiscard]] Forests joined(I at, const Forests& left, const Forests& right) noexcept {
    Forests all;
    Shares shares = 0;
    const auto take = [&](std::size_t places, const Split& split, std::size_t to) {
      shares |= Shares(split.left) << (4 * (places - 2));
      all.cost[to] = split.cost;
      all.node_count[to] = left.node_count[split.left - 1] + right.node_count[places - split.left - 1];
    };
    take(std::size_t(N), best_split(left, right, std::size_t(N)), 0);
    all.cost[0] += half_area(tree_.nodes[at].bounds);
    ++all.node_count[0];
    for (std::size_t places = 2; places <= sizes; ++places) {
      const Split split = best_split(left, right, places);
      all.cost[places - 1] = all.cost[places - 2];
      all.node_count[places - 1] = all.node_count[places - 2];
      if (split.cost <= all.cost[places - 2]) take(places, split, places - 1);
    }
    plans_[at] = {shares, all.node_count[0]};
    return all;
  }
  [[nodiscard]] static Split best_split(const Forests& left, const Forests& right, std::size_t places) noexcept {
    Split best{left.cost[0] + right.cost[places - 2], 1};
    for (std::size_t k = 2; k < places; ++k) {
      const T cost = left.cost[k - 1] + right.cost[places - k - 1];
      if (cost < best.cost) best = {cost, k};
    }
    return best;
  }

  const Tree<T, I>& tree_;
  UninitializedVector<Plan> plans_;
};

/// Numbers wide nodes, siblings side by side and each before what is below it, and shows each to the layout.
template <std::floating_point T, std::unsigned_integral I, int N, typename Plan, Executor E, typename Write>
class Emitter {
 public:
  Emitter(const Tree<T, I>& tree, const Plan& plan, const E& executor, const Write& write)
      : tree_(tree), plan_(plan), executor_(executor), write_(write) {}

  /// Writes the node `to` in place of a binary one; what is below it goes to `next` and on.
  void emit(I from, I to, I next, int forks) const {
    const Siblings<I, N> siblings = plan_.siblings(from);
    std::array<WideChild<T, I>, std::size_t(N)> children;
    std::array<I, std::size_t(N)> below;
    for (std::size_t i = 0; i != siblings.size; ++i) {
      const BinaryNode<T, I>& child = tree_.nodes[siblings.node[i]];
      children[i] = {child.bounds, child.is_leaf() ? Link<I>{child.first, child.count} : Link<I>{next++, 0}};
    }
    for (std::size_t i = 0; i != siblings.size; ++i) {
      below[i] = next;
      if (!children[i].link.is_leaf()) next += plan_.node_count(siblings.node[i]) - 1;
    }
    write_(to, tree_.nodes[from].bounds, std::span<const WideChild<T, I>>(children.data(), siblings.size));
    const auto emit_children = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i)
        if (!children[i].link.is_leaf()) emit(siblings.node[i], children[i].link.first, below[i], forks - 1);
    };
    if (forks > 0)
      executor_.parallel_for(siblings.size, 1, emit_children);
    else
      emit_children(0, siblings.size);
  }

 private:
  const Tree<T, I>& tree_;
  const Plan& plan_;
  const E& executor_;
  const Write& write_;
};

/// Where a layout's walks begin, as far as the tree says: an empty tree has no root.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] Link<I> root_of(const Tree<T, I>& tree) noexcept {
  if (tree.nodes.empty() || !tree.nodes.front().is_leaf()) return {0, 0};
  return {tree.nodes.front().first, tree.nodes.front().count};
}

template <typename Plan, int N, std::floating_point T, std::unsigned_integral I, Executor E, typename Resize,
          typename Write>
void collapse_by(const Tree<T, I>& tree, const E& executor, const Resize& resize, const Write& write) {
  const Plan plan(tree, executor);
  resize(std::size_t(plan.node_count(0)));
  Emitter<T, I, N, Plan, E, Write>(tree, plan, executor, write).emit(0, 0, 1, fork_levels(tree.nodes.size()) / 3);
}

}  // namespace detail

/// Shows a tree as nodes of up to N children, each in place of several binary ones: what layouts are made of.
///
///     resize(std::size_t count)                              // once, first
///     write(I node, const Aabb<T>& bounds, std::span<const WideChild<T, I>> children)   // once a node, 0 is the root
///
/// Requires: a valid tree, whose root is not a leaf; `write` may be called for several nodes at once.
/// Ensures:  no path is longer than it was. The same nodes for every executor.
/// Cost:     O(nodes); Optimal does about N² / 2 additions a binary node.
template <int N, std::floating_point T, std::unsigned_integral I, Executor E, typename Resize, typename Write>
void collapse(const Tree<T, I>& tree, Collapse how, const E& executor, const Resize& resize, const Write& write) {
  if (how == Collapse::Greedy)
    detail::collapse_by<detail::GreedyCollapse<T, I, N>, N>(tree, executor, resize, write);
  else
    detail::collapse_by<detail::OptimalCollapse<T, I, N>, N>(tree, executor, resize, write);
}

}  // namespace glint
