// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>

namespace glint {

/// The order of hits along a ray: by t, then by the primitive's index. What "closest" means everywhere in the library,
/// so that trees, layouts and executors give the same answer.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] constexpr bool is_closer(const Hit<T, I>& a, const Hit<T, I>& b) noexcept {
  return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
}

/// What a set computes once a ray; empty for sets that do not.
struct Unprepared {};

template <PrimitiveSet S>
[[nodiscard]] GLINT_ALWAYS_INLINE auto prepared_for(const S& set, const Ray<typename S::Scalar>& ray) {
  if constexpr (PreparedSet<S>)
    return set.prepare(ray);
  else
    return Unprepared{};
}

/// Leaves that ask the set for each primitive by its index.
template <PrimitiveSet S>
class IndexedLeaves {
 public:
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;

  IndexedLeaves() = default;
  IndexedLeaves(const S& /*set*/, Tree<Scalar, Index>& tree) : order_(std::move(tree.order)) {}

  /// Shortens the ray to the closest hit of these slots, if there is one.
  template <typename Prepared>
  GLINT_ALWAYS_INLINE bool closest(const S& set, Ray<Scalar>& ray, const Prepared& prepared, Slots<Index> slots,
                                   Hit<Scalar, Index>& best) const {
    bool improved = false;
    for (std::size_t slot = slots.first; slot != std::size_t(slots.first) + slots.count; ++slot) {
      const auto hit = intersect(set, ray, prepared, order_[slot]);
      if (!hit || !is_closer(*hit, best)) continue;
      best = *hit;
      ray.t_max = hit->t;
      improved = true;
    }
    return improved;
  }
  template <typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE bool occluded(const S& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                                  Slots<Index> slots) const {
    for (std::size_t slot = slots.first; slot != std::size_t(slots.first) + slots.count; ++slot)
      if (intersect(set, ray, prepared, order_[slot])) return true;
    return false;
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return order_.size() * sizeof(Index); }

 private:
  template <typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE static std::optional<Hit<Scalar, Index>> intersect(const S& set,
                                                                                       const Ray<Scalar>& ray,
                                                                                       const Prepared& prepared,
                                                                                       Index i) {
    if constexpr (PreparedSet<S>)
      return set.intersect(ray, prepared, i);
    else
      return set.intersect(ray, i);
  }

  std::vector<Index> order_;
};

}  // namespace glint
