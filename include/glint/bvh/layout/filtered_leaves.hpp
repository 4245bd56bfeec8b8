// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/set/filtered.hpp>

namespace glint {

/// Leaves of a set that `accepts` some hits of another, its `set`: tested in the way of that, in blocks say, as if
/// every hit counted. Only a leaf whose closest hit is rejected is asked again, one primitive after another. A slot is
/// a leaf.
template <typename Choice, PrimitiveSet FilteredSet>
class FilteredLeaves {
 public:
  using Set = FilteredSet;
  using Scalar = typename Set::Scalar;
  using Index = typename Set::Index;

 private:
  using S = std::remove_cvref_t<decltype(std::declval<const Set&>().set())>;
  using TreeOfSet = Tree<Scalar, Index>;
  using AllLeaves = decltype(make_leaves(std::declval<const S&>(), std::declval<TreeOfSet&>(), Choice{}, Serial{}));
  struct Runs {
    Slots<Index> all;
    Slots<Index> single;
  };

 public:
  static constexpr std::size_t block_size = AllLeaves::block_size;

  /// Renumbers the leaves of the tree: one slot each. Requires: a valid tree over the set.
  template <Executor E>
  FilteredLeaves(const Set& set, TreeOfSet& tree, const E& executor)
      : single_(tree.order), runs_(runs_of(tree)), all_(make_leaves(set.set(), tree, Choice{}, executor)) {
    Index slot = 0;
    for (BinaryNode<Scalar, Index>& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      runs_[slot].all = {node.first, node.count};
      node.first = slot++;
      node.count = 1;
    }
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE auto prepare(const Set& set, const Ray<Scalar>& ray) const {
    return all_.prepare(set.set(), ray);
  }
  template <typename Prepared>
  GLINT_ALWAYS_INLINE bool closest(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared, Slots<Index> slots,
                                   Hit<Scalar, Index>& best) const {
    const Runs& runs = runs_[slots.first];
    Hit<Scalar, Index> hit = best;
    if (!all_.closest(set.set(), ray, prepared, runs.all, hit)) return false;
    if (!set.accepts(ray, hit)) return single_.closest(set, ray, single_.prepare(set, ray), runs.single, best);
    best = hit;
    return true;
  }
  template <typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE bool occluded(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                                  Slots<Index> slots) const {
    const Runs& runs = runs_[slots.first];
    return all_.occluded(set.set(), ray, prepared, runs.all) &&
           single_.occluded(set, ray, single_.prepare(set, ray), runs.single);
  }
  template <typename F>
  GLINT_ALWAYS_INLINE Walk for_each_primitive(Slots<Index> slots, const F& f) const {
    return single_.for_each_primitive(runs_[slots.first].single, f);
  }
  template <typename Prepared, typename Sink>
  GLINT_ALWAYS_INLINE Walk for_each_hit(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                        Slots<Index> slots, Sink& sink) const {
    AcceptedHits<Sink> accepted{set, ray, sink};
    return all_.for_each_hit(set.set(), ray, prepared, runs_[slots.first].all, accepted);
  }
  [[nodiscard]] FittedLeaf<Scalar> refit(const Set& set, Slots<Index> slots) requires(requires(AllLeaves& all) {
    all.refit(set.set(), slots);
  }) {
    return all_.refit(set.set(), runs_[slots.first].all);
  }
  /// The leaves as if every hit counted, and what of them is in these slots.
  [[nodiscard]] GLINT_ALWAYS_INLINE const AllLeaves& unfiltered() const noexcept { return all_; }
  [[nodiscard]] GLINT_ALWAYS_INLINE Slots<Index> unfiltered(Slots<Index> slots) const noexcept {
    return runs_[slots.first].all;
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return single_.bytes() + runs_.size() * sizeof(Runs) + all_.bytes();
  }

 private:
  template <typename Sink>
  struct AcceptedHits {
    const Set& set;
    const Ray<Scalar>& ray;
    Sink& sink;

    [[nodiscard]] Scalar limit() const { return sink.limit(); }
    Walk operator()(const Hit<Scalar, Index>& hit) { return set.accepts(ray, hit) ? sink(hit) : Walk::Continue; }
  };

  [[nodiscard]] static std::vector<Runs> runs_of(const TreeOfSet& tree) {
    std::vector<Runs> runs;
    for (const BinaryNode<Scalar, Index>& node : tree.nodes)
      if (node.is_leaf()) runs.push_back({{}, {node.first, node.count}});
    return runs;
  }

  IndexedLeaves<Set> single_;
  std::vector<Runs> runs_;
  AllLeaves all_;  // last, for it may renumber slots
};

template <PrimitiveSet S, typename Accept, typename Choice, Executor E>
[[nodiscard]] FilteredLeaves<Choice, Filtered<S, Accept>> make_leaves(const Filtered<S, Accept>& set,
                                                                      Tree<typename S::Scalar, typename S::Index>& tree,
                                                                      Choice /*choice*/, const E& executor) {
  return FilteredLeaves<Choice, Filtered<S, Accept>>(set, tree, executor);
}

}  // namespace glint
