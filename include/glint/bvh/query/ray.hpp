// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include <glint/bvh/concepts.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/rounding.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Whether a ray query needs the nearest boxes first.
enum class RayOrder { NearestFirst, Any };

/// Where the boxes lie that a ray query will see.
template <std::floating_point T>
struct RayReach {
  T size = 0;      ///< of the largest primitive, or more: a hit's t is rounded in proportion to it, and not to t alone
  T farthest = 0;  ///< the largest coordinate, by its absolute value

  [[nodiscard]] static RayReach of(const Aabb<T>& box) noexcept {
    if (is_empty(box)) return {};
    return {max_component(extent(box)), std::max(max_component(abs(box.lower)), max_component(abs(box.upper)))};
  }
};

/// The boxes that a ray passes through within its interval, N at once and with one multiply-add a plane.
///
/// A plane p is crossed at p · scale + offset, with offset = −origin · scale. Three roundings are relative to the
/// crossing, so exits are stretched by 2γ₄ (Ize's bound, with one rounding for the stretching itself); the others are
/// relative to the offset, and offsets give way by that. Fused or not, no box is lost. Where infinities meet, the NaN
/// is dropped by `min` and `max`, as what is known comes second, and the plane cuts nothing off.
///
/// Ensures: no box is left out that holds a point of the ray, t_min < 0 included, nor one whose primitive is hit within
///          the interval by the rounding of its own t. Parallel rays are cut off beside a box all the same.
/// Errors:  a ray without a line, by a NaN, an infinity or a zero direction, enters nothing.
/// Source:  Kay, Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986; Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013.
/// W tells units apart that are built for different registers: each has a query of its own.
template <std::floating_point T, int N, RayOrder Order, int W = Pack<T, N>::width>
class RayQuery {
 public:
  static constexpr bool ordered = Order == RayOrder::NearestFirst;

  GLINT_ALWAYS_INLINE RayQuery(const Ray<T>& ray, const RayReach<T>& reach) noexcept {
    const Vec3<T>& d = ray.direction;
    Vec3<T> scale{T(1) / d.x, T(1) / d.y, T(1) / d.z};
    const Vec3<T> size = abs(scale);
    const T least = std::min(std::min(size.x, size.y), size.z);
    const T most = std::max(std::max(size.x, size.y), size.z);
    slack_ = rounding_bound<T>(16) * reach.size * least;
    T last = std::numeric_limits<T>::max();
    Vec3<T> leeway(T(0));
    if (!(most <= least * parallel)) last = straighten(ray, reach, scale, leeway);
    const bool has_line = is_finite(ray.origin) && is_finite(d) && max_component(abs(d)) > T(0);
    const Vec3<T> exit_scale = scale * (T(1) + stretch);
    const Vec3<T> entry_offset = -(ray.origin * scale);
    const Vec3<T> exit_offset = (behind(ray) - ray.origin) * exit_scale;
    leeway += abs(entry_offset) * rounding_bound<T>(8);
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = std::size_t(axis);
      entry_plane_[at] = at + 3 * std::size_t(std::signbit(d[axis]));
      scale_[at] = P::broadcast(scale[axis]);
      offset_[at] = P::broadcast(entry_offset[axis] - leeway[axis]);
      scale_[at + 3] = P::broadcast(exit_scale[axis]);
      offset_[at + 3] = P::broadcast(exit_offset[axis] + leeway[axis]);
    }
    t_min_ = P::broadcast(has_line ? ray.t_min - slack_ : infinity<T>);
    shrink(ray.t_max);
    set_limit(has_line ? std::min(limit_, last) : -infinity<T>);
  }

  template <typename Boxes>
  [[nodiscard]] GLINT_ALWAYS_INLINE Entered<T, N> enter(const Boxes& boxes) const noexcept {
    const P first = max(max(entry(boxes, 0), entry(boxes, 1)), max(entry(boxes, 2), t_min_));
    const P last = min(min(departure(boxes, 0), departure(boxes, 1)), min(departure(boxes, 2), limits_));
    return {less_equal(first, last), first};
  }
  /// Just beyond the ray's end.
  [[nodiscard]] T limit() const noexcept { return limit_; }
  /// Ends the ray at t. A box's entry may be rounded up, so the limit is stretched as the exits are. It stays finite,
  /// for empty boxes are entered at infinity.
  GLINT_ALWAYS_INLINE void shrink(T t) noexcept {
    set_limit(std::min(t + std::abs(t) * stretch + slack_, std::numeric_limits<T>::max()));
  }

 private:
  using P = Pack<T, N, W>;
  static constexpr T stretch = T(2) * rounding_bound<T>(4);
  /// A ray that goes this much less along an axis than along another is taken to be parallel.
  static constexpr T parallel = T(1 << 30);

  template <typename Boxes>
  [[nodiscard]] GLINT_ALWAYS_INLINE P entry(const Boxes& boxes, std::size_t axis) const noexcept {
    return boxes.plane(entry_plane_[axis]) * scale_[axis] + offset_[axis];
  }
  template <typename Boxes>
  [[nodiscard]] GLINT_ALWAYS_INLINE P departure(const Boxes& boxes, std::size_t axis) const noexcept {
    return boxes.plane(2 * axis + 3 - entry_plane_[axis]) * scale_[axis + 3] + offset_[axis + 3];
  }

  GLINT_ALWAYS_INLINE void set_limit(T limit) noexcept {
    limit_ = limit;
    limits_ = P::broadcast(limit);
  }

  /// Makes the scales of parallel axes finite. Where a ray may be at all, |t| ≤ last, it moves along such an axis by at
  /// most last / scale: that is the leeway. Returns `last`.
  [[nodiscard]] GLINT_NO_INLINE static T straighten(const Ray<T>& ray, const RayReach<T>& reach, Vec3<T>& scale,
                                                    Vec3<T>& leeway) noexcept {
    const T least = T(1) / max_component(abs(ray.direction));
    const T last = (max_component(abs(ray.origin)) + reach.farthest) * least * T(2);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(scale[axis]) <= least * parallel) continue;
      scale[axis] = std::copysign(least * parallel, ray.direction[axis]);
      leeway[axis] = T(2) * last;
    }
    return last;
  }

  /// How far exits are seen from further back: growing by a factor would bring exits at t < 0 forward. Twice the
  /// stretch of the largest |t| there also pays for what the factor took.
  [[nodiscard]] GLINT_ALWAYS_INLINE static Vec3<T> behind(const Ray<T>& ray) noexcept {
    if (!(ray.t_min < T(0))) return Vec3<T>(T(0));
    return further_back(ray);
  }
  [[nodiscard]] GLINT_NO_INLINE static Vec3<T> further_back(const Ray<T>& ray) noexcept {
    const Vec3<T> d = ray.direction;
    const T t = -ray.t_min * T(2) * stretch;
    const Vec3<T> way = d * t;
    const Vec3<T> lost = abs(ray.origin) * (T(2) * stretch);
    return {d.x == T(0) ? T(0) : way.x + std::copysign(lost.x, d.x),
            d.y == T(0) ? T(0) : way.y + std::copysign(lost.y, d.y),
            d.z == T(0) ? T(0) : way.z + std::copysign(lost.z, d.z)};
  }

  std::array<P, 6> scale_;   ///< of entries, then of exits
  std::array<P, 6> offset_;  ///< likewise
  std::array<std::size_t, 3> entry_plane_;
  P t_min_;
  P limits_;
  T limit_;
  T slack_;
};

}  // namespace glint
