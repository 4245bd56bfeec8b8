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
#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/pass/graft.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/fixed_stack.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>

namespace glint {
namespace detail {

/// Where in a tree something new belongs, and what it adds there to the areas of all nodes.
template <std::floating_point T>
struct InsertionPlace {
  std::size_t node = 0;  ///< whose sibling it becomes
  int depth = 0;         ///< of that node
  T cost = infinity<T>;
};

/// The cheapest place for a box; where costs are beyond all numbers, beside the root.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] InsertionPlace<T> insertion_place(const Tree<T, I>& tree, const Aabb<T>& bounds) noexcept {
  struct Candidate {
    std::size_t node;
    int depth;
    T above;  ///< what the nodes above it grow by
    T below;  ///< the same, of those above its children
  };
  const PackedBox<T> box(bounds);
  const T least = box.half_area();  // of any node that holds the box
  InsertionPlace<T> best;
  FixedStack<Candidate, std::size_t(Tree<T, I>::max_depth) + 2> pending;
  const auto consider = [&](std::size_t at, int depth, T above) {
    const PackedBox<T> alone(tree.nodes[at].bounds);
    PackedBox<T> both = alone;
    both.extend(box);
    const T area = both.half_area();
    if (above + area < best.cost) best = {at, depth, above + area};
    return Candidate{at, depth, above, above + (area - alone.half_area())};
  };
  const auto add = [&](const Candidate& candidate) {
    if (!tree.nodes[candidate.node].is_leaf() && candidate.below + least < best.cost) pending.push(candidate);
  };
  add(consider(0, 0, T(0)));
  while (!pending.empty()) {
    const Candidate next = pending.pop();
    if (!(next.below + least < best.cost)) continue;
    const std::size_t first = tree.nodes[next.node].first;
    const Candidate a = consider(first, next.depth + 1, next.below);
    const Candidate b = consider(first + 1, next.depth + 1, next.below);
    add(a.below < b.below ? b : a);
    add(a.below < b.below ? a : b);  // looked at first
  }
  return best;
}

/// Finds the places of a batch: of its subtrees as a whole, where that costs no more than to part them.
template <std::floating_point T, std::unsigned_integral I, typename Executor>
class BatchPlacer {
 public:
  /// Requires: the tree and the batch have nodes.
  BatchPlacer(const Tree<T, I>& tree, const Tree<T, I>& batch, const Executor& executor)
      : tree_(tree), batch_(batch), executor_(executor), places_(batch.order.size()) {
    place(0, 0);
  }

  /// Of the slots of the batch.
  [[nodiscard]] const std::vector<InsertionPlace<T>>& places() const noexcept { return places_; }

 private:
  static constexpr int fork_depth = 10;

  struct Costs {
    T placed;  ///< of a subtree, in areas of nodes: of those it adds to the tree, and of its own that are left
    T inner;   ///< of its inner nodes, as it is
  };

  Costs place(std::size_t at, int depth) {
    const BinaryNode<T, I>& node = batch_.nodes[at];
    const InsertionPlace<T> whole = insertion_place(tree_, node.bounds);
    if (node.is_leaf()) {
      fill(at, whole);
      return {whole.cost, T(0)};
    }
    Costs left{};
    Costs right{};
    const auto place_left = [&] { left = place(node.first, depth + 1); };
    const auto place_right = [&] { right = place(std::size_t(node.first) + 1, depth + 1); };
    if (depth < fork_depth) {
      executor_.invoke(place_left, place_right);
    } else {
      place_left();
      place_right();
    }
    const T inner = PackedBox<T>(node.bounds).half_area() + left.inner + right.inner;
    const T parted = left.placed + right.placed;
    if (parted < whole.cost + inner) return {parted, inner};
    fill(at, whole);
    return {whole.cost + inner, inner};
  }
  void fill(std::size_t at, const InsertionPlace<T>& place) {
    const BinaryNode<T, I>& node = batch_.nodes[at];
    if (node.is_leaf()) {
      std::fill_n(places_.begin() + std::ptrdiff_t(node.first), node.count, place);
    } else {
      fill(node.first, place);
      fill(std::size_t(node.first) + 1, place);
    }
  }

  const Tree<T, I>& tree_;
  const Tree<T, I>& batch_;
  const Executor& executor_;
  std::vector<InsertionPlace<T>> places_;
};

template <BoundedSet S, typename Executor>
class Inserter {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;

  Inserter(const Tree<T, I>& tree, const S& set, std::span<const I> primitives, const BinnedSah& builder,
           const Executor& executor)
      : tree_(tree),
        set_(set),
        primitives_(primitives),
        builder_(builder),
        executor_(executor),
        repeats_(repeats_of(tree)) {}

  [[nodiscard]] Tree<T, I> run() {
    if (tree_.nodes.empty() || primitives_.size() > tree_.order.size() / largest_share) return built_anew();
    Gathered<T, I> gathered(Repeats::None);
    add(gathered);
    const BinnedSah single{.block_size = 1, .max_leaf_size = 1};
    const Tree<T, I> batch = gathered.build(single, 0, executor_);
    if (!batch.nodes.empty()) find_groups(batch);
    executor_.parallel_for(groups_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) groups_[i].tree = subtree(batch, groups_[i]);
    });
    Graft<T, I> graft(tree_.nodes.size() + 2 * batch.nodes.size(), tree_.order.size() + batch.order.size());
    graft.copy(tree_, 0, 0, 0, Attach{*this, graft});
    Tree<T, I> result = std::move(graft).tree(set_.size());
    return result.depth <= Tree<T, I>::max_depth ? result : built_anew();
  }

 private:
  /// One in so many: inserting more takes longer than building anew.
  static constexpr std::size_t largest_share = 16;

  /// What goes to one place.
  struct Group {
    InsertionPlace<T> place;
    std::span<const std::size_t> slots;  ///< of the batch
    Tree<T, I> tree{};                   ///< over these, and over what is in the leaf where the place is one
  };
  struct Attach {
    const Inserter& inserter;
    Graft<T, I>& graft;

    bool operator()(std::size_t at, std::size_t to, int depth) const {
      const Group* const group = inserter.group_of(at);
      if (group == nullptr) return false;
      if (inserter.tree_.nodes[at].is_leaf()) {
        graft.copy(group->tree, to, depth);
        return true;
      }
      const std::size_t first = graft.add_siblings();
      graft.copy_node(inserter.tree_, at, first, depth + 1, *this);
      graft.copy(group->tree, first + 1, depth + 1);
      graft.write_inner(to, first);
      return true;
    }
  };

  void find_groups(const Tree<T, I>& batch) {
    const BatchPlacer placer(tree_, batch, executor_);
    const auto& places = placer.places();
    slots_.resize(places.size());
    std::iota(slots_.begin(), slots_.end(), std::size_t{0});
    std::stable_sort(slots_.begin(), slots_.end(),
                     [&](std::size_t a, std::size_t b) { return places[a].node < places[b].node; });
    for (std::size_t begin = 0, end = 0; begin != slots_.size(); begin = end) {
      while (end != slots_.size() && places[slots_[end]].node == places[slots_[begin]].node) ++end;
      groups_.push_back({places[slots_[begin]], std::span(slots_).subspan(begin, end - begin)});
    }
  }
  [[nodiscard]] const Group* group_of(std::size_t node) const noexcept {
    const auto group = std::lower_bound(groups_.begin(), groups_.end(), node,
                                        [](const Group& g, std::size_t n) { return g.place.node < n; });
    return group != groups_.end() && group->place.node == node ? &*group : nullptr;
  }
  [[nodiscard]] Tree<T, I> subtree(const Tree<T, I>& batch, const Group& group) const {
    Gathered<T, I> gathered(repeats_);
    const BinaryNode<T, I>& node = tree_.nodes[group.place.node];
    if (node.is_leaf()) gathered.add(tree_, node, set_);
    for (const std::size_t slot : group.slots) gathered.add(batch.order[slot], set_.bounds(batch.order[slot]));
    return gathered.build(builder_, group.place.depth + int(!node.is_leaf()), executor_);
  }
  void add(Gathered<T, I>& gathered) const {
    for (const I primitive : primitives_) {
      GLINT_ASSERT(primitive < set_.size());
      gathered.add(primitive, set_.bounds(primitive));
    }
  }
  [[nodiscard]] Tree<T, I> built_anew() const {
    Gathered<T, I> gathered(repeats_);
    if (!tree_.nodes.empty()) gathered.add_below(tree_, 0, set_);
    add(gathered);
    Tree<T, I> result = gathered.build(builder_, 0, executor_);
    result.left_out = set_.size() - count_distinct<I>(result.order);
    return result;
  }

  const Tree<T, I>& tree_;
  const S& set_;
  std::span<const I> primitives_;
  const BinnedSah& builder_;
  const Executor& executor_;
  Repeats repeats_;
  std::vector<std::size_t> slots_;
  std::vector<Group> groups_;
};

}  // namespace detail

/// A tree with some more primitives of its set.
///
/// The batch is first made a tree of its own. From the top, each of its subtrees looks for the cheapest place in the
/// tree as it was, and goes there as a whole, or in parts, whichever costs less. What meets in a leaf is built into a
/// subtree together with that leaf's primitives; what meets above becomes a subtree beside the node.
///
/// Indices are the caller's: those of primitives that were added to the end of the set, or that the tree left out, or
/// that `remove` took out. Removing and inserting what moved far is how to move it.
///
/// Requires: a valid tree over the set, which may have grown at its end; primitives that the tree does not have, each
///           once.
/// Ensures:  a valid tree of all of them, numbered depth first; `left_out` counts those of the set that it does not
///           have, also those of the batch without a finite, non-empty box.
/// Cost:     O(nodes + primitives) to copy, and about O(batch · log nodes) for places. For more than a sixteenth of the
///           tree, and where the depth does not suffice, all is built anew.
/// Threads:  places are looked for, and subtrees built, in parallel; the same tree for every executor.
/// Source:   the search for a place: Bittner, Hapala, Havran, "Incremental BVH Construction for Ray Tracing", Computers
///           & Graphics 47, 2015; here for subtrees at once, in a tree that stays as it is meanwhile.
template <BoundedSet S, Executor E = Serial>
[[nodiscard]] Tree<typename S::Scalar, typename S::Index> insert(
    const Tree<typename S::Scalar, typename S::Index>& tree, const S& set,
    std::span<const typename S::Index> primitives, const BinnedSah& builder = {}, const E& executor = {}) {
  return detail::Inserter<S, E>(tree, set, primitives, builder, executor).run();
}

}  // namespace glint
