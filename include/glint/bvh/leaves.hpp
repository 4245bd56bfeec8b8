// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The order of hits along a ray: by t, then by the primitive's index. What "closest" means everywhere in the library,
/// so that trees, layouts and executors give the same answer.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] constexpr bool is_closer(const Hit<T, I>& a, const Hit<T, I>& b) noexcept {
  return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
}

/// A choice of leaves: blocks of N primitives that are tested at once, from copies of what the test needs. The fastest.
template <int N>
struct CopiedBlocks {};
/// A choice of leaves: blocks of N primitives that are tested at once, and look up the user's own data by index. Small.
template <int N>
struct IndexedBlocks {};
/// What layouts choose unless told: copies, in blocks as wide as a register of numbers, but no wider than eight, where
/// leaves would grow past what is good for trees.
using DefaultLeaves = CopiedBlocks<(register_lanes<float> < 8) ? 4 : 8>;

/// What a set without `prepare` computes once a ray.
struct Unprepared {};

/// How a Bvh keeps what its leaves hold. A set that is tested faster in a way of its own overloads
///
///     L make_leaves(const S& set, Tree<T, I>& tree, choice, executor)      // found by argument-dependent lookup
///
/// for the choices it knows, as a layout names them: CopiedBlocks<4>, IndexedBlocks<4>, a type of the user's. A set
/// that knows none is asked for one primitive after another. Leaves may renumber the slots of the tree, to suit blocks
/// say; hits still carry the caller's indices.
///
///     auto prepare(const S&, const Ray<T>&)                                       // once a ray
///     bool closest(const S&, const Ray<T>&, prepared, Slots<I>, Hit<T, I>& best)  // whether it improved `best`
///     bool occluded(const S&, const Ray<T>&, prepared, Slots<I>)
///     std::size_t bytes()
///     std::size_t block_size      // primitives tested at the price of one, which is what builders want to know
///
/// For `closest` the ray ends at best.t, which begins as the ray's t_max, with no primitive.
///
/// For queries other than rays' first hits (query/), leaves also offer
///
///     Walk for_each_primitive(Slots<I>, f)                             // f(I) -> Walk
///     Walk for_each_hit(const S&, const Ray<T>&, prepared, Slots<I>, sink)
///     void for_each_near(const S&, const Vec3<T>& point, Slots<I>, sink)
///
/// where sink(const Hit<T, I>&) -> Walk sees all hits with t ≤ sink.limit(), or sink(I) at least the primitives whose
/// squared distance from the point is no larger. The limit may shrink meanwhile.
template <typename L, typename S>
concept LeavesOf = requires(const L& leaves, const S& set, const Ray<typename S::Scalar>& ray,
                            Slots<typename S::Index> slots, Hit<typename S::Scalar, typename S::Index>& best) {
  { leaves.closest(set, ray, leaves.prepare(set, ray), slots, best) } -> std::same_as<bool>;
  { leaves.occluded(set, ray, leaves.prepare(set, ray), slots) } -> std::same_as<bool>;
  { L::block_size } -> std::convertible_to<std::size_t>;
  { leaves.bytes() } -> std::same_as<std::size_t>;
};

/// What a leaf holds, after its primitives moved.
template <std::floating_point T>
struct FittedLeaf {
  Aabb<T> bounds{};
  std::size_t lost = 0;  ///< primitives that have no finite, non-empty box any more

  void add(const Aabb<T>& box) noexcept {
    if (is_bounded(box))
      extend(bounds, box);
    else
      ++lost;
  }
};

/// Leaves that ask the set for each primitive by its index.
template <PrimitiveSet S>
class IndexedLeaves {
 public:
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;
  static constexpr std::size_t block_size = 1;

  explicit IndexedLeaves(std::vector<Index> order) noexcept : order_(std::move(order)) {}

  [[nodiscard]] GLINT_ALWAYS_INLINE auto prepare(const S& set, const Ray<Scalar>& ray) const {
    if constexpr (PreparedSet<S>)
      return set.prepare(ray);
    else
      return Unprepared{};
  }
  template <typename Prepared>
  GLINT_ALWAYS_INLINE bool closest(const S& set, const Ray<Scalar>& ray, const Prepared& prepared, Slots<Index> slots,
                                   Hit<Scalar, Index>& best) const {
    bool improved = false;
    Ray<Scalar> shortened = ray;
    shortened.t_max = best.t;
    for (std::size_t slot = slots.first; slot != std::size_t(slots.first) + slots.count; ++slot) {
      const auto hit = intersect(set, shortened, prepared, order_[slot]);
      if (!hit || !is_closer(*hit, best)) continue;
      best = *hit;
      shortened.t_max = hit->t;
      improved = true;
    }
    return improved;
  }
  template <typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE bool occluded(const S& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                                  Slots<Index> slots) const {
    for (std::size_t slot = slots.first; slot != std::size_t(slots.first) + slots.count; ++slot)
      if (meets(set, ray, prepared, order_[slot])) return true;
    return false;
  }
  template <typename F>
  GLINT_ALWAYS_INLINE Walk for_each_primitive(Slots<Index> slots, const F& f) const {
    for (std::size_t slot = slots.first; slot != std::size_t(slots.first) + slots.count; ++slot)
      if (f(order_[slot]) == Walk::Stop) return Walk::Stop;
    return Walk::Continue;
  }
  /// Behind a hit, the same primitive is asked again.
  template <typename Prepared, typename Sink>
  GLINT_ALWAYS_INLINE Walk for_each_hit(const S& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                        Slots<Index> slots, Sink& sink) const {
    return for_each_primitive(slots, [&](Index i) {
      Ray<Scalar> rest = ray;
      for (rest.t_max = sink.limit(); rest.t_min <= rest.t_max; rest.t_max = sink.limit()) {
        const auto hit = intersect(set, rest, prepared, i);
        if (!hit) break;
        if (sink(*hit) == Walk::Stop) return Walk::Stop;
        rest.t_min = std::nextafter(hit->t, infinity<Scalar>);
      }
      return Walk::Continue;
    });
  }
  template <typename Sink>
  GLINT_ALWAYS_INLINE void for_each_near(const S& /*set*/, const Vec3<Scalar>& /*point*/, Slots<Index> slots,
                                         Sink& sink) const {
    for (std::size_t slot = slots.first; slot != std::size_t(slots.first) + slots.count; ++slot) sink(order_[slot]);
  }
  [[nodiscard]] FittedLeaf<Scalar> refit(const S& set, Slots<Index> slots) const {
    FittedLeaf<Scalar> fitted;
    for (std::size_t slot = slots.first; slot != std::size_t(slots.first) + slots.count; ++slot)
      fitted.add(set.bounds(order_[slot]));
    return fitted;
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return order_.size() * sizeof(Index); }

 private:
  template <typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE static auto intersect(const S& set, const Ray<Scalar>& ray,
                                                          const Prepared& prepared, Index i) {
    if constexpr (PreparedSet<S>)
      return set.intersect(ray, prepared, i);
    else
      return set.intersect(ray, i);
  }
  template <typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE static bool meets(const S& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                                      Index i) {
    if constexpr (OccluderSet<S>)
      return set.occluded(ray, i);
    else
      return intersect(set, ray, prepared, i).has_value();
  }

  std::vector<Index> order_;
};

template <PrimitiveSet S, typename Choice, Executor E>
[[nodiscard]] IndexedLeaves<S> make_leaves(const S& /*set*/, Tree<typename S::Scalar, typename S::Index>& tree,
                                           Choice /*choice*/, const E& /*executor*/) {
  return IndexedLeaves<S>(std::move(tree.order));
}

}  // namespace glint
