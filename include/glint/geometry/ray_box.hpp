// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/interval.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A ray made ready for many boxes. It crosses an axis-aligned plane at `(plane - origin) * scale`, per axis, where
/// scale is `entry_scale` for the plane through which it enters a slab and `exit_scale` for the other one.
///
/// It enters through the upper plane where `enters_upper`, which is the sign bit of the direction: −0 counts as
/// negative, to match the infinity that is its reciprocal.
template <std::floating_point T>
struct SlabRay {
  Vec3<T> origin{T(0)};
  Vec3<T> entry_scale{T(0)};
  Vec3<T> exit_scale{T(0)};
  glm::vec<3, bool, glm::packed_highp> enters_upper{false};

  [[nodiscard]] friend bool operator==(const SlabRay&, const SlabRay&) noexcept = default;
};

namespace detail {

/// A ray without a line, by a NaN or a zero direction, becomes one at infinity: all bounded boxes lie wholly beyond it
/// in y and wholly behind it in x, so no box needs a check of its own.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE SlabRay<T> prepare_slabs(const Ray<T>& ray, T exit_growth) noexcept {
  const Vec3<T>& d = ray.direction;
  const bool has_line = is_finite(ray.origin) && is_finite(d) && max_component(abs(d)) > T(0);
  if (!has_line) return {{infinity<T>, -infinity<T>, T(0)}, Vec3<T>(T(1)), Vec3<T>(T(1)), {false, false, false}};
  const Vec3<T> inverse{T(1) / d.x, T(1) / d.y, T(1) / d.z};
  return {ray.origin, inverse, inverse * exit_growth, {std::signbit(d.x), std::signbit(d.y), std::signbit(d.z)}};
}

/// The part of [t_min, t_max] in which the ray is inside the box.
///
/// A ray that lies in a plane of the box makes 0 · ∞ = NaN there and must not be stopped by it. `std::max(a, b)` is
/// `a < b ? b : a`, so a NaN second argument leaves the first alone (and is one machine instruction): what is known
/// comes first, the candidate second. Each plane is told apart by the sign of the direction and not by comparing two
/// distances, for a NaN would spoil that comparison. A NaN t_min or t_max stays, and fails the final test.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE std::optional<Interval<T>> overlap_slabs(const SlabRay<T>& ray, const Aabb<T>& box,
                                                                           T t_min, T t_max) noexcept {
  const auto& upper = ray.enters_upper;
  T entry = t_min;
  entry = std::max(entry, ((upper.x ? box.upper.x : box.lower.x) - ray.origin.x) * ray.entry_scale.x);
  entry = std::max(entry, ((upper.y ? box.upper.y : box.lower.y) - ray.origin.y) * ray.entry_scale.y);
  entry = std::max(entry, ((upper.z ? box.upper.z : box.lower.z) - ray.origin.z) * ray.entry_scale.z);
  T exit = t_max;
  exit = std::min(exit, ((upper.x ? box.lower.x : box.upper.x) - ray.origin.x) * ray.exit_scale.x);
  exit = std::min(exit, ((upper.y ? box.lower.y : box.upper.y) - ray.origin.y) * ray.exit_scale.y);
  exit = std::min(exit, ((upper.z ? box.lower.z : box.upper.z) - ray.origin.z) * ray.exit_scale.z);
  if (!(entry <= exit)) return std::nullopt;
  return Interval<T>{entry, exit};
}

}  // namespace detail

/// The slab test in plain rounding: a ray within a few roundings of an edge may miss.
///
/// Ensures:  faces count as inside, also for rays that lie in them; flat boxes are hit; empty boxes never.
/// Errors:   a ray with a NaN, an infinity or a zero direction meets no bounded box.
/// Source:   Kay, Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986.
struct FastSlab {
  template <std::floating_point T>
  [[nodiscard]] static SlabRay<T> prepare(const Ray<T>& ray) noexcept {
    return detail::prepare_slabs(ray, T(1));
  }
  /// Requires: no NaN in the box.
  template <std::floating_point T>
  [[nodiscard]] GLINT_ALWAYS_INLINE static std::optional<Interval<T>> intersect(const SlabRay<T>& ray,
                                                                                const Aabb<T>& box, T t_min,
                                                                                T t_max) noexcept {
    return detail::overlap_slabs(ray, box, t_min, t_max);
  }

  [[nodiscard]] friend constexpr bool operator==(const FastSlab&, const FastSlab&) noexcept = default;
};

/// The slab test that no ray slips through: it never misses a box that holds a point of the ray at a t ≥ 0.
///
/// A crossing is rounded three times (reciprocal, difference, product), so exits are stretched. The paper multiplies
/// the exit of each box by 1 + 2γ₃; here the reciprocals are stretched once a ray, which costs one rounding more,
/// hence 2γ₄, and nothing a box.
///
/// Ensures:  as FastSlab; the exit may be up to 8 roundings too late.
/// Source:   Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013.
struct ConservativeSlab {
  template <std::floating_point T>
  [[nodiscard]] static SlabRay<T> prepare(const Ray<T>& ray) noexcept {
    return detail::prepare_slabs(ray, T(1) + T(2) * rounding_bound<T>(4));
  }
  /// Requires: no NaN in the box.
  template <std::floating_point T>
  [[nodiscard]] GLINT_ALWAYS_INLINE static std::optional<Interval<T>> intersect(const SlabRay<T>& ray,
                                                                                const Aabb<T>& box, T t_min,
                                                                                T t_max) noexcept {
    return detail::overlap_slabs(ray, box, t_min, t_max);
  }

  [[nodiscard]] friend constexpr bool operator==(const ConservativeSlab&, const ConservativeSlab&) noexcept = default;
};

/// One ray, one box: the part of the ray's interval that is inside the box. For many boxes, prepare the ray once.
///
/// Errors: a box or a ray with a NaN, an empty box, and a zero direction report nothing.
template <std::floating_point T>
[[nodiscard]] std::optional<Interval<T>> intersect(const Ray<T>& ray, const Aabb<T>& box) noexcept {
  if (is_empty(box)) return std::nullopt;
  const T last = std::min(ray.t_max, std::numeric_limits<T>::max());  // a parallel ray outside enters at infinity
  return FastSlab::intersect(FastSlab::prepare(ray), box, ray.t_min, last);
}

}  // namespace glint
