// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <glint/core/strided.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/motion.hpp>

namespace glint {

/// A set whose primitives are there for some rays only: for those whose `mask` has a bit in common with the
/// primitive's. For objects that throw no shadow, or are seen by one camera; for groups switched on and off.
///
///     const glint::Bvh bvh{glint::Masked{glint::Instanced{stand}, masks}};   // masks: a uint32_t for each instance
///     bvh.occluded({.origin = from, .direction = to, .mask = shadow_bit});
///
/// Rays see everything unless told: all bits are set. A mask of zero is never seen, nor does it see. The set is a view
/// and is held by value; masks may be members of the user's own structs (strided_member).
///
/// Requires: a mask for each primitive; the masks outlive the view. After a change, a tree over it is refitted.
template <PrimitiveSet S>
class Masked {
 public:
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;

  Masked(S set, Strided<std::uint32_t> masks) : set_(std::move(set)), masks_(masks) {}

  [[nodiscard]] constexpr std::size_t size() const noexcept { return set_.size(); }
  [[nodiscard]] constexpr std::size_t inner_values() const noexcept { return glint::inner_values(set_); }
  /// As rays see it that see everything.
  [[nodiscard]] constexpr const S& set() const noexcept { return set_; }
  /// Requires: i < size().
  [[nodiscard]] std::uint32_t mask(Index i) const noexcept { return masks_[i]; }
  [[nodiscard]] bool accepts(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const noexcept {
    return is_seen(ray, hit.primitive);
  }

  [[nodiscard]] Aabb<Scalar> bounds(Index i) const { return set_.bounds(i); }
  /// Points, boxes and all that has no mask see everything.
  template <typename F>
  auto with_primitive(Index i, const F& f) const requires(requires(const S& set) { set.with_primitive(i, f); }) {
    return set_.with_primitive(i, f);
  }
  [[nodiscard]] MotionBounds<Scalar> motion_bounds(Index i) const requires(MovingSet<S>) {
    return set_.motion_bounds(i);
  }
  [[nodiscard]] Aabb<Scalar> clip(Index i, const Aabb<Scalar>& cell) const requires(ClippableSet<S>) {
    return set_.clip(i, cell);
  }
  [[nodiscard]] Vec3<Scalar> closest_point(const Vec3<Scalar>& point, Index i) const requires(ClosestPointSet<S>) {
    return set_.closest_point(point, i);
  }

  [[nodiscard]] auto prepare(const Ray<Scalar>& ray) const requires(PreparedSet<S>) { return set_.prepare(ray); }

  template <typename Prepared>
  [[nodiscard]] std::optional<Hit<Scalar, Index>> intersect(const Ray<Scalar>& ray, const Prepared& prepared,
                                                            Index i) const requires(PreparedSet<S>) {
    return is_seen(ray, i) ? set_.intersect(ray, prepared, i) : std::nullopt;
  }
  [[nodiscard]] std::optional<Hit<Scalar, Index>> intersect(const Ray<Scalar>& ray, Index i) const {
    return is_seen(ray, i) ? set_.intersect(ray, i) : std::nullopt;
  }
  [[nodiscard]] bool occluded(const Ray<Scalar>& ray, Index i) const requires(OccluderSet<S>) {
    return is_seen(ray, i) && set_.occluded(ray, i);
  }

  [[nodiscard]] SurfaceOf<Scalar> surface(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const
      requires(ShadableSet<S>) {
    return set_.surface(ray, hit);
  }

 private:
  [[nodiscard]] bool is_seen(const Ray<Scalar>& ray, Index i) const noexcept { return (ray.mask & masks_[i]) != 0; }

  S set_;
  Strided<std::uint32_t> masks_;
};

}  // namespace glint
