// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <utility>

#include <glint/bvh/leaves.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>

namespace glint {

/// Tries every primitive of a set: the oracle that accelerators are tested against, and the fastest ray caster of
/// all for a handful of primitives.
///
/// Ensures: as Bvh: the smallest t, and of equals the smallest index. Primitives without a finite, non-empty box are
///          never hit.
/// Threads: may be shared.
template <PrimitiveSet S>
class BruteForce {
 public:
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;

  explicit BruteForce(S set) : set_(std::move(set)) {
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const Aabb<Scalar> box = set_.bounds(Index(i));
      if (is_bounded(box)) extend(bounds_, box);
    }
  }

  [[nodiscard]] const S& set() const noexcept { return set_; }
  [[nodiscard]] Aabb<Scalar> bounds() const noexcept { return bounds_; }

  [[nodiscard]] std::optional<Hit<Scalar, Index>> closest(const Ray<Scalar>& ray) const {
    std::optional<Hit<Scalar, Index>> best;
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const auto hit = intersect(ray, Index(i));
      if (hit && (!best || is_closer(*hit, *best))) best = hit;
    }
    return best;
  }
  [[nodiscard]] bool occluded(const Ray<Scalar>& ray) const {
    for (std::size_t i = 0; i < set_.size(); ++i)
      if (intersect(ray, Index(i))) return true;
    return false;
  }
  [[nodiscard]] SurfaceOf<Scalar> surface(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const
      requires(ShadableSet<S>) {
    return set_.surface(ray, hit);
  }

 private:
  [[nodiscard]] std::optional<Hit<Scalar, Index>> intersect(const Ray<Scalar>& ray, Index i) const {
    if (!is_bounded(set_.bounds(i))) return std::nullopt;
    return set_.intersect(ray, i);
  }

  S set_;
  Aabb<Scalar> bounds_;
};

}  // namespace glint
