// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include <glint/geometry/concepts.hpp>
#include <glint/geometry/motion.hpp>

namespace glint {

/// Says which hits count: `bool accept(ray, hit)`, for a hit of the set on this ray. Its answer depends on nothing but
/// the two; of the ray, the interval may have been shortened.
///
/// Threads: called by many at once.
template <typename F, typename S>
concept HitFilter = requires(const F& accept, const Ray<typename S::Scalar>& ray,
                             const Hit<typename S::Scalar, typename S::Index>& hit) {
  { accept(ray, hit) } -> std::same_as<bool>;
};

/// A set of which only those hits count that a filter accepts: for leaves cut out of textures, surfaces seen from one
/// side, rays that skip where they began. All rays obey it, those that ask for occlusion too.
///
///     const glint::Bvh bvh{glint::Filtered{mesh, [](const auto& ray, const auto& hit) { return hit.uv.x < 0.5F; }}};
///
/// Behind a rejected hit the same primitive is asked again, so that the far side of a sphere is seen through its near
/// one. Sets are views and are held by value, and so is the filter.
///
/// Cost:    the filter for each hit that is the closest so far; another intersection for each that it rejects.
template <PrimitiveSet S, HitFilter<S> Accept>
class Filtered {
 public:
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;

  constexpr Filtered(S set, Accept accept) : set_(std::move(set)), accept_(std::move(accept)) {}

  [[nodiscard]] constexpr std::size_t size() const noexcept { return set_.size(); }
  [[nodiscard]] constexpr std::size_t inner_values() const noexcept { return glint::inner_values(set_); }
  /// All hits, those too that do not count.
  [[nodiscard]] constexpr const S& set() const noexcept { return set_; }
  [[nodiscard]] bool accepts(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const { return accept_(ray, hit); }

  [[nodiscard]] Aabb<Scalar> bounds(Index i) const { return set_.bounds(i); }
  /// Whole primitives: the filter is for rays.
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

  [[nodiscard]] auto prepare(const Ray<Scalar>& ray) const requires(PreparedSet<S>) { return set_.prepare(ray); }

  template <typename Prepared>
  [[nodiscard]] std::optional<Hit<Scalar, Index>> intersect(const Ray<Scalar>& ray, const Prepared& prepared,
                                                            Index i) const requires(PreparedSet<S>) {
    return first_accepted(ray, [&](const Ray<Scalar>& rest) { return set_.intersect(rest, prepared, i); });
  }
  [[nodiscard]] std::optional<Hit<Scalar, Index>> intersect(const Ray<Scalar>& ray, Index i) const {
    return first_accepted(ray, [&](const Ray<Scalar>& rest) { return set_.intersect(rest, i); });
  }

  [[nodiscard]] SurfaceOf<Scalar> surface(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const
      requires(ShadableSet<S>) {
    return set_.surface(ray, hit);
  }

 private:
  template <typename Intersect>
  [[nodiscard]] std::optional<Hit<Scalar, Index>> first_accepted(const Ray<Scalar>& ray,
                                                                 const Intersect& intersect) const {
    auto hit = intersect(ray);
    if (!hit || accept_(ray, *hit)) return hit;
    Ray<Scalar> rest = ray;
    do {
      rest.t_min = std::nextafter(hit->t, std::numeric_limits<Scalar>::infinity());
      hit = intersect(rest);
    } while (hit && !accept_(rest, *hit));
    return hit;
  }

  S set_;
  Accept accept_;
};

}  // namespace glint
