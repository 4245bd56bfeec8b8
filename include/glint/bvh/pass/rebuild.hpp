// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/pass/graft.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint {

/// When a subtree is worth building anew, and how.
struct Rebuilding {
  double growth = 1.2;  ///< of what a ray costs that meets the subtree's box: no less is worth it
  BinnedSah builder{};  ///< also says what nodes and leaves cost
};

/// What a partial rebuild made.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
struct Rebuilt {
  Tree<T, I> tree{};
  std::size_t subtrees = 0;    ///< that were built anew …
  std::size_t primitives = 0;  ///< … and what they hold
};

namespace detail {

/// What rays cost in a tree, node by node: on average, for a random ray that meets the node's box.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] std::vector<double> costs_when_met(const Tree<T, I>& tree, const BinnedSah& prices) {
  std::vector<double> costs(tree.nodes.size());
  const auto measure = [&](const auto& self, std::size_t at) -> double {
    const BinaryNode<T, I>& node = tree.nodes[at];
    if (node.is_leaf())
      return costs[at] = double(prices.intersection_cost) * double(blocks(node.count, prices.block_size));
    const double area = double(half_area(node.bounds));
    costs[at] = double(prices.traversal_cost);
    for (const std::size_t child : {std::size_t(node.first), std::size_t(node.first) + 1}) {
      const double share = area > 0 ? double(half_area(tree.nodes[child].bounds)) / area : 1.0;
      costs[at] += share * self(self, child);
    }
    return costs[at];
  };
  if (!tree.nodes.empty()) measure(measure, 0);
  return costs;
}

/// Finds the subtrees that degraded: the largest ones, but where most of what is wrong with one is in one of its halves
/// and the other is as good as it was, it is that half that counts.
template <std::floating_point T, std::unsigned_integral I>
class DegradedSearch {
 public:
  struct Found {
    std::size_t node;
    int depth;
  };

  DegradedSearch(const Tree<T, I>& tree, const std::vector<double>& now, const std::vector<double>& before,
                 double growth)
      : tree_(tree), now_(now), before_(before), growth_(growth) {
    search(0, 0);
  }

  [[nodiscard]] const std::vector<Found>& found() const noexcept { return found_; }

 private:
  /// Leaves cost what they did.
  [[nodiscard]] bool has_grown(std::size_t at) const noexcept { return now_[at] > growth_ * before_[at]; }
  [[nodiscard]] double excess(std::size_t at) const noexcept {
    return double(half_area(tree_.nodes[at].bounds)) * (now_[at] - before_[at]);
  }
  void search(std::size_t at, int depth) {
    if (tree_.nodes[at].is_leaf()) return;
    const std::size_t first = tree_.nodes[at].first;
    if (!has_grown(at)) {
      search(first, depth + 1);
      search(first + 1, depth + 1);
    } else if (has_grown(first) != has_grown(first + 1)) {
      const std::size_t worse = has_grown(first) ? first : first + 1;
      if (2 * excess(worse) >= excess(at)) return search(worse, depth + 1);
      found_.push_back({at, depth});
    } else {
      found_.push_back({at, depth});
    }
  }

  const Tree<T, I>& tree_;
  const std::vector<double>& now_;
  const std::vector<double>& before_;
  double growth_;
  std::vector<Found> found_;
};

template <BoundedSet S, typename Executor>
class Rebuilder {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;

  Rebuilder(const Tree<T, I>& tree, const S& set, const Rebuilding& options, const Executor& executor)
      : tree_(tree),
        set_(set),
        options_(options),
        executor_(executor),
        repeats_(repeats_of(tree)),
        costs_(costs_when_met(tree, options.builder)) {}

  /// Requires: the tree has nodes.
  [[nodiscard]] Rebuilt<T, I> run(const Tree<T, I>& before) {
    const std::vector<double> costs_before = costs_when_met(before, options_.builder);
    const DegradedSearch<T, I> search(tree_, costs_, costs_before, options_.growth);
    const auto& found = search.found();
    subtrees_.resize(found.size());
    executor_.parallel_for(found.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) build(found[i], subtrees_[i]);
    });
    std::erase_if(subtrees_, [](const Subtree& subtree) { return subtree.tree.nodes.empty(); });
    std::sort(subtrees_.begin(), subtrees_.end(), [](const auto& a, const auto& b) { return a.node < b.node; });

    Graft<T, I> graft(tree_.nodes.size(), tree_.order.size());
    graft.copy(tree_, 0, 0, 0, [&](std::size_t at, std::size_t to, int depth) {
      const auto subtree = std::lower_bound(subtrees_.begin(), subtrees_.end(), at,
                                            [](const Subtree& s, std::size_t node) { return s.node < node; });
      if (subtree == subtrees_.end() || subtree->node != at) return false;
      graft.copy(subtree->tree, to, depth);
      return true;
    });
    Rebuilt<T, I> result{.tree = std::move(graft).tree(set_.size()), .subtrees = subtrees_.size()};
    for (const Subtree& subtree : subtrees_) result.primitives += subtree.tree.order.size();
    return result;
  }

 private:
  struct Subtree {
    std::size_t node = 0;
    Tree<T, I> tree{};  ///< none where the old one is as good
  };

  void build(const typename DegradedSearch<T, I>::Found& found, Subtree& subtree) const {
    Gathered<T, I> gathered(repeats_);
    gathered.add_below(tree_, found.node, set_);
    subtree.node = found.node;
    Tree<T, I> fresh = gathered.build(options_.builder, found.depth, executor_);
    if (fresh.nodes.empty()) return;
    const auto cost = [](const BinaryNode<T, I>& node, double when_met) {
      return double(half_area(node.bounds)) * when_met;
    };
    const double after = cost(fresh.nodes[0], costs_when_met(fresh, options_.builder)[0]);
    if (after < cost(tree_.nodes[found.node], costs_[found.node])) subtree.tree = std::move(fresh);
  }

  const Tree<T, I>& tree_;
  const S& set_;
  const Rebuilding& options_;
  const Executor& executor_;
  Repeats repeats_;
  std::vector<double> costs_;
  std::vector<Subtree> subtrees_;
};

}  // namespace detail

/// A tree whose subtrees are built anew where they degraded: where refits, since the tree was as `before`, let grow
/// what a ray costs that meets them.
///
///     const auto built = glint::BinnedSah{}.build(mesh);
///     auto tree = built;
///     // … vertices move …
///     glint::refit(tree, mesh);
///     tree = glint::rebuild(tree, mesh, built).tree;
///
/// Requires: valid trees with the same nodes, slots and order, and other boxes; `tree` over the set as it is.
/// Ensures:  a valid tree, numbered depth first, no deeper than Tree::max_depth, that costs no more by the prices of
/// the
///           builder; in subtrees built anew a primitive is in one leaf, and those that lost their box are left out.
/// Cost:     O(nodes), and for the subtrees what building takes.
/// Threads:  subtrees in parallel; the same tree for every executor.
/// Source:   Yoon, Curtis, Manocha, "Ray Tracing Dynamic Scenes using Selective Restructuring", Eurographics Symposium
/// on
///           Rendering 2007: to build anew only where it pays; here by the growth of each subtree's cost.
template <BoundedSet S, Executor E = Serial>
[[nodiscard]] Rebuilt<typename S::Scalar, typename S::Index> rebuild(
    const Tree<typename S::Scalar, typename S::Index>& tree, const S& set,
    const Tree<typename S::Scalar, typename S::Index>& before, const Rebuilding& options = {}, const E& executor = {}) {
  GLINT_ASSERT(tree.nodes.size() == before.nodes.size());
  if (tree.nodes.empty()) return {tree};
  return detail::Rebuilder<S, E>(tree, set, options, executor).run(before);
}

}  // namespace glint
