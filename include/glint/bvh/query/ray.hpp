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
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_box.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Whether a ray query needs the nearest boxes first.
enum class RayOrder { NearestFirst, Any };

/// The boxes that a ray passes through within its interval: ConservativeSlab for N boxes at once.
///
/// A ray that lies in a plane of a box makes a NaN there, which `min` and `max` drop because what is known comes
/// second.
///
/// Ensures: no box is left out that holds a point of the ray, t_min < 0 included, nor one whose primitive is hit within
///          the interval by the rounding of its own t.
template <std::floating_point T, int N, RayOrder Order>
class RayQuery {
 public:
  static constexpr bool ordered = Order == RayOrder::NearestFirst;

  /// `reach` is the size of the largest primitive, or more: the t of a hit is rounded in proportion to it, and not to t
  /// alone.
  GLINT_ALWAYS_INLINE explicit RayQuery(const Ray<T>& ray, T reach = 0) noexcept {
    const SlabRay<T> slabs = ConservativeSlab::prepare(ray);
    const Vec3<T> scale = abs(slabs.entry_scale);
    slack_ = rounding_bound<T>(16) * reach * std::min(std::min(scale.x, scale.y), scale.z);
    t_min_ = Pack<T, N>::broadcast(ray.t_min - slack_);
    const Vec3<T> exit_origin = slabs.origin - behind(ray);
    entry_ = Side(slabs.origin, slabs.entry_scale);
    exit_ = Side(exit_origin, slabs.exit_scale);
    entry_plane_ = {slabs.enters_upper.x ? 3U : 0U, slabs.enters_upper.y ? 4U : 1U, slabs.enters_upper.z ? 5U : 2U};
    shrink(ray.t_max);
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE Entered<T, N> enter(const BoxPack<T, N>& boxes) const noexcept {
    Pack<T, N> entry = t_min_;
    Pack<T, N> exit = limits_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t plane = entry_plane_[axis];
      entry = max((boxes.planes[plane] - entry_.origin[axis]) * entry_.scale[axis], entry);
      const std::size_t opposite = 2 * axis + 3 - plane;
      exit = min((boxes.planes[opposite] - exit_.origin[axis]) * exit_.scale[axis], exit);
    }
    return {less_equal(entry, exit), entry};
  }
  /// Just beyond the ray's end.
  [[nodiscard]] T limit() const noexcept { return limit_; }
  /// Ends the ray at t. A box's entry may be rounded up, so the limit is stretched as the exits are. It stays finite,
  /// for parallel rays outside of a slab enter it at infinity.
  void shrink(T t) noexcept {
    limit_ = std::min(t + std::abs(t) * stretch + slack_, std::numeric_limits<T>::max());
    limits_ = Pack<T, N>::broadcast(limit_);
  }

 private:
  static constexpr T stretch = T(2) * rounding_bound<T>(4);

  struct Side {
    std::array<Pack<T, N>, 3> origin;
    std::array<Pack<T, N>, 3> scale;

    Side() = default;
    Side(const Vec3<T>& o, const Vec3<T>& s) noexcept
        : origin{Pack<T, N>::broadcast(o.x), Pack<T, N>::broadcast(o.y), Pack<T, N>::broadcast(o.z)},
          scale{Pack<T, N>::broadcast(s.x), Pack<T, N>::broadcast(s.y), Pack<T, N>::broadcast(s.z)} {}
  };

  /// How far exits are seen from further back: growing by a factor would bring exits at t < 0 forward. Twice the
  /// stretch of the largest |t| there also pays for what the factor took.
  [[nodiscard]] static Vec3<T> behind(const Ray<T>& ray) noexcept {
    if (!(ray.t_min < T(0))) return Vec3<T>(T(0));
    const Vec3<T> d = ray.direction;
    const T t = -ray.t_min * T(2) * stretch;
    const Vec3<T> way = d * t;
    const Vec3<T> lost = abs(ray.origin) * (T(2) * stretch);
    return {d.x == T(0) ? T(0) : way.x + std::copysign(lost.x, d.x),
            d.y == T(0) ? T(0) : way.y + std::copysign(lost.y, d.y),
            d.z == T(0) ? T(0) : way.z + std::copysign(lost.z, d.z)};
  }

  Side entry_;
  Side exit_;
  std::array<std::size_t, 3> entry_plane_{};
  Pack<T, N> t_min_;
  Pack<T, N> limits_;
  T limit_ = 0;
  T slack_ = 0;
};

}  // namespace glint
