// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <set>
#include <span>
#include <tuple>
#include <type_traits>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/motion.hpp>
#include <glint/bvh/query/ray.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>

namespace glint {
namespace detail {

/// The order of all hits along a ray, that of is_closer first.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] constexpr bool precedes(const Hit<T, I>& a, const Hit<T, I>& b) noexcept {
  return std::tie(a.t, a.primitive, a.inner) < std::tie(b.t, b.primitive, b.inner);
}

/// A ray query that sees missing children as they are, empty: it shows no leaf twice.
template <std::floating_point T, int N, RayOrder Order>
class EveryHitQuery {
 public:
  static constexpr bool ordered = Order == RayOrder::NearestFirst;

  GLINT_ALWAYS_INLINE EveryHitQuery(const Ray<T>& ray, const RayReach<T>& reach) noexcept : query_(ray, reach) {}

  [[nodiscard]] GLINT_ALWAYS_INLINE Entered<T, N> enter(const BoxPack<T, N>& boxes) const noexcept {
    return query_.enter(boxes);
  }
  [[nodiscard]] T limit() const noexcept { return query_.limit(); }
  GLINT_ALWAYS_INLINE void shrink(T t) noexcept { query_.shrink(t); }

 private:
  RayQuery<T, N, Order> query_;
};

/// Hands on each hit once.
template <std::floating_point T, std::unsigned_integral I, typename Visit>
class HitsOnce {
 public:
  HitsOnce(T t_max, bool has_parts, const Visit& visit) noexcept
      : t_max_(t_max), has_parts_(has_parts), visit_(visit) {}

  [[nodiscard]] T limit() const noexcept { return t_max_; }
  GLINT_ALWAYS_INLINE Walk operator()(const Hit<T, I>& hit) {
    if (has_parts_ && !seen_.insert(hit).second) return Walk::Continue;
    return visited(visit_, hit);
  }

 private:
  struct Before {
    bool operator()(const Hit<T, I>& a, const Hit<T, I>& b) const noexcept { return precedes(a, b); }
  };
  T t_max_;
  bool has_parts_;
  const Visit& visit_;
  std::set<Hit<T, I>, Before> seen_;
};

/// Keeps the nearest hits behind a given one, as a heap whose top is the farthest.
template <std::floating_point T, std::unsigned_integral I>
class NearestHits {
 public:
  NearestHits(std::span<Hit<T, I>> hits, T t_max, bool has_parts, const Hit<T, I>* behind) noexcept
      : hits_(hits), t_max_(t_max), has_parts_(has_parts), behind_(behind) {}

  [[nodiscard]] bool is_full() const noexcept { return size_ == hits_.size(); }
  [[nodiscard]] T limit() const noexcept { return is_full() ? hits_[0].t : t_max_; }
  GLINT_ALWAYS_INLINE Walk operator()(const Hit<T, I>& hit) noexcept {
    if (is_full() && !precedes(hit, hits_[0])) return Walk::Continue;
    if (behind_ != nullptr && !precedes(*behind_, hit)) return Walk::Continue;
    if (has_parts_ && holds(hit)) return Walk::Continue;
    if (is_full())
      std::pop_heap(hits_.begin(), hits_.end(), precedes<T, I>);
    else
      ++size_;
    hits_[size_ - 1] = hit;
    const auto kept = hits_.first(size_);
    std::push_heap(kept.begin(), kept.end(), precedes<T, I>);
    return Walk::Continue;
  }
  std::size_t sort() noexcept {
    const auto kept = hits_.first(size_);
    std::sort_heap(kept.begin(), kept.end(), precedes<T, I>);
    return size_;
  }

 private:
  [[nodiscard]] bool holds(const Hit<T, I>& hit) const noexcept {
    const auto kept = hits_.first(size_);
    return std::any_of(kept.begin(), kept.end(),
                       [&](const Hit<T, I>& h) { return !precedes(h, hit) && !precedes(hit, h); });
  }

  std::span<Hit<T, I>> hits_;
  std::size_t size_ = 0;
  T t_max_;
  bool has_parts_;
  const Hit<T, I>* behind_;
};

template <PrimitiveSet S, LayoutChoice L>
std::size_t nearest_hits_behind(const Bvh<S, L>& bvh, const Ray<typename S::Scalar>& ray,
                                std::span<Hit<typename S::Scalar, typename S::Index>> hits,
                                const Hit<typename S::Scalar, typename S::Index>* behind) {
  using T = typename S::Scalar;
  using I = typename S::Index;
  if (hits.empty()) return 0;
  EveryHitQuery<T, Bvh<S, L>::Nodes::width, RayOrder::NearestFirst> query(ray, bvh.reach());
  NearestHits<T, I> nearest(hits, ray.t_max, bvh.has_parts(), behind);
  const auto prepared = bvh.leaves().prepare(bvh.set(), ray);
  traverse(nodes_at(bvh.nodes(), ray.time), query, [&](Slots<I> slots) {
    bvh.leaves().for_each_hit(bvh.set(), ray, prepared, slots, nearest);
    if (nearest.is_full()) query.shrink(nearest.limit());
    return Walk::Continue;
  });
  return nearest.sort();
}

}  // namespace detail

/// The nearest hits along a ray, as many as there is room for, the nearest first. Returns how many there are.
///
///     std::array<glint::Hit<float>, 4> hits;
///     const std::size_t count = nearest_hits(bvh, ray, hits);
///
/// Ensures: ordered by t, then by index; the first is that of Bvh::closest. A primitive that the ray crosses several
///          times, as a sphere, gives each crossing. Each is there once, though the tree may have primitives in parts.
/// Cost:    no allocation; about that of Bvh::closest where the hits are close to each other.
/// Threads: may be called by many at once.
template <PrimitiveSet S, LayoutChoice L>
std::size_t nearest_hits(const Bvh<S, L>& bvh, const Ray<typename S::Scalar>& ray,
                         std::type_identity_t<std::span<Hit<typename S::Scalar, typename S::Index>>> hits) {
  return detail::nearest_hits_behind(bvh, ray, hits, nullptr);
}

/// Shows all hits along a ray to `visit(const Hit&)`, in no order. It may return a Walk: Stop ends the search.
///
/// Ensures: each hit once, as for nearest_hits. Walk::Stop if a visit said so.
/// Cost:    no allocation, unless the tree has primitives in parts: then a set of the hits seen.
/// Threads: may be called by many at once.
template <PrimitiveSet S, LayoutChoice L, typename Visit>
Walk for_each_hit(const Bvh<S, L>& bvh, const Ray<typename S::Scalar>& ray, const Visit& visit) {
  using T = typename S::Scalar;
  using I = typename S::Index;
  const detail::EveryHitQuery<T, Bvh<S, L>::Nodes::width, RayOrder::Any> query(ray, bvh.reach());
  detail::HitsOnce<T, I, Visit> once(ray.t_max, bvh.has_parts(), visit);
  const auto prepared = bvh.leaves().prepare(bvh.set(), ray);
  return traverse(nodes_at(bvh.nodes(), ray.time), query,
                  [&](Slots<I> slots) { return bvh.leaves().for_each_hit(bvh.set(), ray, prepared, slots, once); });
}

/// Likewise, the nearest first: for rays that go on until something is opaque.
///
/// Cost: no allocation; a search for every 16 hits.
template <PrimitiveSet S, LayoutChoice L, typename Visit>
Walk for_each_hit_in_order(const Bvh<S, L>& bvh, const Ray<typename S::Scalar>& ray, const Visit& visit) {
  std::array<Hit<typename S::Scalar, typename S::Index>, 16> hits;
  Ray<typename S::Scalar> rest = ray;
  std::size_t count = nearest_hits(bvh, rest, hits);
  while (true) {
    for (std::size_t i = 0; i < count; ++i)
      if (detail::visited(visit, hits[i]) == Walk::Stop) return Walk::Stop;
    if (count < hits.size()) return Walk::Continue;
    const auto last = hits.back();
    rest.t_min = last.t;
    count = detail::nearest_hits_behind(bvh, rest, std::span(hits), &last);
  }
}

}  // namespace glint
