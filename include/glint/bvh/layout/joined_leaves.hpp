// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Leaves over several sets, each of which keeps what it holds in its own way: triangles in blocks beside spheres one
/// by one, as far as they know the choice of leaves. A slot is a leaf, and holds a run of slots for each set.
template <typename Choice, PrimitiveSet... Sets>
class JoinedLeaves {
 public:
  using Set = Joined<Sets...>;
  using Scalar = typename Set::Scalar;
  using Index = typename Set::Index;

  /// Renumbers the leaves of the tree: one slot each. Requires: a valid tree over the set.
  template <Executor E>
  JoinedLeaves(const Set& set, Tree<Scalar, Index>& tree, const E& executor)
      : JoinedLeaves(set, tree, executor, Every{}) {}

  [[nodiscard]] GLINT_ALWAYS_INLINE auto prepare(const Set& set, const Ray<Scalar>& ray) const {
    return prepare(set, ray, Every{});
  }
  template <typename Prepared>
  GLINT_ALWAYS_INLINE bool closest(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared, Slots<Index> slots,
                                   Hit<Scalar, Index>& best) const {
    return [&]<std::size_t... K>(std::index_sequence<K...>) {
      return (std::size_t{0} | ... | std::size_t(closest_of<K>(set, ray, prepared, slots.first, best))) != 0;
    }
    (Every{});
  }
  template <typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE bool occluded(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                                  Slots<Index> slots) const {
    return [&]<std::size_t... K>(std::index_sequence<K...>) {
      return (occluded_of<K>(set, ray, prepared, slots.first) || ...);
    }
    (Every{});
  }
  template <typename F>
  GLINT_ALWAYS_INLINE Walk for_each_primitive(Slots<Index> slots, const F& f) const {
    return for_each_run(slots, [&]<std::size_t K>(At<K>, const auto& leaves, auto run) {
      return leaves.for_each_primitive(run, [&](auto i) { return f(begins_[K] + Index(i)); });
    });
  }
  template <typename Prepared, typename Sink>
  GLINT_ALWAYS_INLINE Walk for_each_hit(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                        Slots<Index> slots, Sink& sink) const {
    return for_each_run(slots, [&]<std::size_t K>(At<K>, const auto& leaves, auto run) {
      JoinedHits<typename SetAt<K>::Index, Sink> joined{begins_[K], sink};
      return leaves.for_each_hit(set.template set<K>(), ray, std::get<K>(prepared), run, joined);
    });
  }
  template <typename Sink>
  GLINT_ALWAYS_INLINE void for_each_near(const Set& set, const Vec3<Scalar>& point, Slots<Index> slots,
                                         Sink& sink) const {
    for_each_run(slots, [&]<std::size_t K>(At<K>, const auto& leaves, auto run) {
      JoinedNear<Sink> joined{begins_[K], sink};
      leaves.for_each_near(set.template set<K>(), point, run, joined);
      return Walk::Continue;
    });
  }
  [[nodiscard]] FittedLeaf<Scalar> refit(const Set& set, Slots<Index> slots) {
    FittedLeaf<Scalar> fitted;
    [&]<std::size_t... K>(std::index_sequence<K...>) {
      (refit_of<K>(set, slots.first, fitted), ...);
    }
    (Every{});
    return fitted;
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return std::apply([](const auto&... l) { return (std::size_t{0} + ... + l.bytes()); }, leaves_) +
           runs_.size() * sizeof(Runs);
  }

 private:
  using Every = std::index_sequence_for<Sets...>;
  template <std::size_t K>
  using SetAt = std::tuple_element_t<K, std::tuple<Sets...>>;
  template <typename S>
  using TreeOf = Tree<typename S::Scalar, typename S::Index>;
  template <typename S>
  using LeavesOfSet = decltype(make_leaves(std::declval<const S&>(), std::declval<TreeOf<S>&>(), Choice{}, Serial{}));
  using Runs = std::tuple<Slots<typename Sets::Index>...>;  // of one leaf

 public:
  static constexpr std::size_t block_size = std::max({LeavesOfSet<Sets>::block_size...});

 private:
  template <std::size_t K>
  using At = std::integral_constant<std::size_t, K>;
  template <typename Local, typename Sink>
  struct JoinedHits {
    Index begin;
    Sink& sink;

    [[nodiscard]] Scalar limit() const { return sink.limit(); }
    Walk operator()(const Hit<Scalar, Local>& hit) { return sink(joined_hit(hit, begin)); }
  };
  template <typename Sink>
  struct JoinedNear {
    Index begin;
    Sink& sink;

    [[nodiscard]] Scalar limit() const { return sink.limit(); }
    template <typename Local>
    GLINT_ALWAYS_INLINE void operator()(Local i) {
      sink(begin + Index(i));
    }
  };
  template <typename Local>
  [[nodiscard]] static Hit<Scalar, Index> joined_hit(const Hit<Scalar, Local>& local, Index begin) noexcept {
    return {.t = local.t,
            .uv = local.uv,
            .primitive = begin + Index(local.primitive),
            .inner = local.inner == none<Local> ? none<Index> : Index(local.inner)};
  }
  /// Shows what a leaf has of each set to `f(At<K>, leaves, run) -> Walk`.
  template <typename F>
  GLINT_ALWAYS_INLINE Walk for_each_run(Slots<Index> slots, const F& f) const {
    return [&]<std::size_t... K>(std::index_sequence<K...>) {
      const auto stops = [&]<std::size_t N>(At<N> at) {
        const auto run = std::get<N>(runs_[slots.first]);
        return run.count != 0 && f(at, std::get<N>(leaves_), run) == Walk::Stop;
      };
      return (stops(At<K>{}) || ...) ? Walk::Stop : Walk::Continue;
    }
    (Every{});
  }

  template <Executor E, std::size_t... K>
  JoinedLeaves(const Set& set, Tree<Scalar, Index>& tree, const E& executor, std::index_sequence<K...>)
      : begins_(begins_of(std::array{set.template set<K>().size()...})),
        runs_(leaf_count(tree)),
        leaves_(leaves_of<K>(set, tree, executor)...) {
    Index slot = 0;
    for (BinaryNode<Scalar, Index>& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      node.first = slot++;
      node.count = 1;
    }
  }

  [[nodiscard]] static std::array<Index, sizeof...(Sets)> begins_of(
      const std::array<std::size_t, sizeof...(Sets)>& sizes) noexcept {
    std::array<Index, sizeof...(Sets)> begins{};
    for (std::size_t i = 1; i < sizes.size(); ++i) begins[i] = begins[i - 1] + Index(sizes[i - 1]);
    return begins;
  }
  [[nodiscard]] static std::size_t leaf_count(const Tree<Scalar, Index>& tree) noexcept {
    std::size_t count = 0;
    for (const BinaryNode<Scalar, Index>& node : tree.nodes) count += std::size_t(node.is_leaf());
    return count;
  }

  /// The leaves of the K-th set alone, made from a tree that has what the leaves of `tree` hold of it.
  template <std::size_t K, Executor E>
  [[nodiscard]] LeavesOfSet<SetAt<K>> leaves_of(const Set& set, const Tree<Scalar, Index>& tree, const E& executor) {
    using Local = typename SetAt<K>::Index;
    const SetAt<K>& own = set.template set<K>();
    TreeOf<SetAt<K>> part;
    for (const BinaryNode<Scalar, Index>& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      BinaryNode<Scalar, Local> leaf{.bounds = node.bounds, .first = Local(part.order.size())};
      for (std::size_t slot = node.first; slot != std::size_t(node.first) + node.count; ++slot) {
        const Index i = tree.order[slot];
        if (i >= begins_[K] && i - begins_[K] < own.size()) part.order.push_back(Local(i - begins_[K]));
      }
      leaf.count = Local(part.order.size() - leaf.first);
      part.nodes.push_back(leaf);
    }
    auto leaves = make_leaves(own, part, Choice{}, executor);
    for (std::size_t i = 0; i < runs_.size(); ++i) std::get<K>(runs_[i]) = {part.nodes[i].first, part.nodes[i].count};
    return leaves;
  }

  template <std::size_t... K>
  [[nodiscard]] GLINT_ALWAYS_INLINE auto prepare(const Set& set, const Ray<Scalar>& ray,
                                                 std::index_sequence<K...>) const {
    return std::tuple{std::get<K>(leaves_).prepare(set.template set<K>(), ray)...};
  }

  /// Indices of one set follow those of the one before, so a hit elsewhere compares like an index that is the least, or
  /// greater than all.
  template <std::size_t K, typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE bool closest_of(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                                    Index slot, Hit<Scalar, Index>& best) const {
    using Local = typename SetAt<K>::Index;
    const auto run = std::get<K>(runs_[slot]);
    if (run.count == 0) return false;
    const SetAt<K>& own = set.template set<K>();
    Hit<Scalar, Local> local{.t = best.t, .primitive = none<Local>};
    if (best.primitive < begins_[K])
      local.primitive = 0;
    else if (best.primitive - begins_[K] < own.size())
      local.primitive = Local(best.primitive - begins_[K]);
    if (!std::get<K>(leaves_).closest(own, ray, std::get<K>(prepared), run, local)) return false;
    best = joined_hit(local, begins_[K]);
    return true;
  }
  template <std::size_t K>
  void refit_of(const Set& set, Index slot, FittedLeaf<Scalar>& fitted) {
    const FittedLeaf<Scalar> own = std::get<K>(leaves_).refit(set.template set<K>(), std::get<K>(runs_[slot]));
    extend(fitted.bounds, own.bounds);
    fitted.lost += own.lost;
  }
  template <std::size_t K, typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE bool occluded_of(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                                     Index slot) const {
    const auto run = std::get<K>(runs_[slot]);
    return run.count != 0 && std::get<K>(leaves_).occluded(set.template set<K>(), ray, std::get<K>(prepared), run);
  }

  std::array<Index, sizeof...(Sets)> begins_;
  std::vector<Runs> runs_;
  std::tuple<LeavesOfSet<Sets>...> leaves_;
};

template <PrimitiveSet... Sets, typename Choice, Executor E>
[[nodiscard]] JoinedLeaves<Choice, Sets...> make_leaves(
    const Joined<Sets...>& set, Tree<typename Joined<Sets...>::Scalar, typename Joined<Sets...>::Index>& tree,
    Choice /*choice*/, const E& executor) {
  return JoinedLeaves<Choice, Sets...>(set, tree, executor);
}

}  // namespace glint
