// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glint/bvh/concepts.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/ray_packet.hpp>
#include <glint/math/constants.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The boxes that the rays of a packet pass through within their intervals: the slab test of one ray and N boxes turned
/// around. A first test, by intervals that hold the origins and the reciprocal directions, says which boxes some ray
/// may enter; a second one which rays enter a box.
///
/// Differences and products are rounded monotonically, so the ends of the intervals bound what each ray computes, and
/// the first test leaves out no box that the second one finds. Exits are stretched as in ConservativeSlab, once a box.
///
/// Requires: a coherent packet, of one course (ray_packet.hpp).
/// Ensures:  no box is left out that holds a point of a ray, nor one whose primitive is hit within the ray's interval
///           by the rounding of its own t.
/// Source:   Boulos, Wald, Shirley, "Geometric and Arithmetic Culling Methods for Entire Ray Packets", University of
///           Utah report UUCS-06-010, 2006; Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013.
template <std::floating_point T, int W = RayPacket<T>::Lanes::width>
class PacketQuery {
 public:
  using Lanes = typename RayPacket<T, W>::Lanes;

  /// `reach` is the size of the largest primitive, or more: the t of a hit is rounded in proportion to it.
  GLINT_ALWAYS_INLINE PacketQuery(const RayPacket<T, W>& packet, T reach) noexcept : origin_(packet.origin) {
    Lanes least = all(infinity<T>);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scale_[axis] = all(1) / packet.direction[axis];
      least = min(max(scale_[axis], all(0) - scale_[axis]), least);
      const bool forward = scale_[axis][0] > T(0);
      entry_plane_[axis] = forward ? axis : axis + 3;
      const T low = lowest(origin_[axis]);
      const T high = highest(origin_[axis]);
      entry_origin_[axis] = forward ? high : low;
      exit_origin_[axis] = forward ? low : high;
      low_scale_[axis] = lowest(scale_[axis]);
      high_scale_[axis] = highest(scale_[axis]);
    }
    slack_ = all(rounding_bound<T>(16) * reach) * least;
    t_min_ = packet.t_min - slack_;
    first_ = lowest(t_min_);
    shrink(packet.t_max);
  }

  /// The boxes that some ray may enter; keys are no larger than the t at which any ray does.
  template <int N>
  [[nodiscard]] GLINT_ALWAYS_INLINE Entered<T, N> enter(const BoxPack<T, N>& boxes) const noexcept {
    using Boxes = Pack<T, N>;
    Boxes entry = Boxes::broadcast(first_);
    Boxes exit = Boxes::broadcast(infinity<T>);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t plane = entry_plane_[axis];
      const Boxes in = boxes.planes[plane] - Boxes::broadcast(entry_origin_[axis]);
      const Boxes out = boxes.planes[2 * axis + 3 - plane] - Boxes::broadcast(exit_origin_[axis]);
      const Boxes low = Boxes::broadcast(low_scale_[axis]);
      const Boxes high = Boxes::broadcast(high_scale_[axis]);
      entry = max(min(in * low, in * high), entry);
      exit = min(max(out * low, out * high), exit);
    }
    return {less_equal(entry, min(exit * Boxes::broadcast(growth), Boxes::broadcast(last_))), entry};
  }
  /// The rays that enter the i-th box, a bit each.
  template <int N>
  [[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t enter(const BoxPack<T, N>& boxes, int i) const noexcept {
    Lanes entry = t_min_;
    Lanes exit = all(infinity<T>);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t plane = entry_plane_[axis];
      entry = max((all(boxes.planes[plane][i]) - origin_[axis]) * scale_[axis], entry);
      exit = min((all(boxes.planes[2 * axis + 3 - plane][i]) - origin_[axis]) * scale_[axis], exit);
    }
    return less_equal(entry, min(exit * all(growth), limit_));
  }
  /// The rays that do not end before t.
  [[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t reach(T t) const noexcept { return less_equal(all(t), limit_); }

  /// Ends each ray at its t. A box's entry may be rounded up, so the limits are stretched as the exits are. They stay
  /// finite, for empty boxes are entered at infinity.
  GLINT_ALWAYS_INLINE void shrink(const Lanes& t) noexcept {
    set_limit(min(t + t * all(stretch) + slack_, all(std::numeric_limits<T>::max())));
  }
  /// Ends rays that want no more boxes.
  GLINT_ALWAYS_INLINE void drop(std::uint32_t rays) noexcept { set_limit(select(rays, all(-infinity<T>), limit_)); }

 private:
  static constexpr T stretch = T(2) * rounding_bound<T>(4);
  static constexpr T growth = T(1) + stretch;

  [[nodiscard]] GLINT_ALWAYS_INLINE static Lanes all(T value) noexcept { return Lanes::broadcast(value); }
  GLINT_ALWAYS_INLINE void set_limit(const Lanes& limit) noexcept {
    limit_ = limit;
    last_ = highest(limit);
  }

  std::array<Lanes, 3> origin_;
  std::array<Lanes, 3> scale_;
  Lanes t_min_;
  Lanes limit_;
  Lanes slack_;
  std::array<T, 3> entry_origin_;
  std::array<T, 3> exit_origin_;
  std::array<T, 3> low_scale_;
  std::array<T, 3> high_scale_;
  T first_;
  T last_;
  std::array<std::size_t, 3> entry_plane_;
};

}  // namespace glint
