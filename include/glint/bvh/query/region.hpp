// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/fixed_stack.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/region.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Which of N boxes may overlap a region, and which lie in it, one bit each. A box with a NaN may overlap; whether a
/// box is empty is not looked at.
struct RegionEntered {
  std::uint32_t overlapping = 0;
  std::uint32_t within = 0;
};

/// The bits of N lanes.
template <int N>
inline constexpr std::uint32_t all_lanes = ~std::uint32_t{0} >> (32 - N);

/// Where the boxes are that are not empty, nor have a NaN.
template <std::floating_point T, int N>
[[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t lanes_of_boxes(const BoxPack<T, N>& boxes) noexcept {
  return less_equal(boxes.planes[0], boxes.planes[3]) & less_equal(boxes.planes[1], boxes.planes[4]) &
         less_equal(boxes.planes[2], boxes.planes[5]);
}

namespace detail {

template <std::floating_point T, int N>
[[nodiscard]] GLINT_ALWAYS_INLINE std::array<Pack<T, N>, 3> lanes_of(const Vec3<T>& v) noexcept {
  return {Pack<T, N>::broadcast(v.x), Pack<T, N>::broadcast(v.y), Pack<T, N>::broadcast(v.z)};
}
template <std::floating_point T, int N>
[[nodiscard]] Aabb<T> box_in_lane(const BoxPack<T, N>& boxes, int lane) noexcept {
  const auto& p = boxes.planes;
  return {{p[0][lane], p[1][lane], p[2][lane]}, {p[3][lane], p[4][lane], p[5][lane]}};
}

}  // namespace detail

/// A region as trees are asked for it. Any region is asked about one box after another; those of the library about N at
/// once.
template <typename Region, std::floating_point T, int N>
class RegionQuery {
 public:
  explicit RegionQuery(const Region& region) noexcept : region_(region) {}

  [[nodiscard]] RegionEntered enter(const BoxPack<T, N>& boxes) const {
    RegionEntered entered;
    for (int lane = 0; lane < N; ++lane) {
      const Aabb<T> box = detail::box_in_lane(boxes, lane);
      const bool may = is_empty(box) || overlaps(box, region_);
      entered.overlapping |= std::uint32_t(may) << lane;
      entered.within |= std::uint32_t(!is_empty(box) && contains(region_, box)) << lane;
    }
    return entered;
  }

 private:
  const Region& region_;
};

template <std::floating_point T, int N>
class RegionQuery<Aabb<T>, T, N> {
 public:
  explicit RegionQuery(const Aabb<T>& box) noexcept
      : lower_(detail::lanes_of<T, N>(box.lower)), upper_(detail::lanes_of<T, N>(box.upper)) {}

  [[nodiscard]] GLINT_ALWAYS_INLINE RegionEntered enter(const BoxPack<T, N>& boxes) const noexcept {
    std::uint32_t outside = 0;
    std::uint32_t within = all_lanes<N>;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      outside |= less(upper_[axis], boxes.planes[axis]) | less(boxes.planes[axis + 3], lower_[axis]);
      within &= less_equal(lower_[axis], boxes.planes[axis]) & less_equal(boxes.planes[axis + 3], upper_[axis]);
    }
    return {~outside & all_lanes<N>, within};
  }

 private:
  std::array<Pack<T, N>, 3> lower_;
  std::array<Pack<T, N>, 3> upper_;
};

template <std::floating_point T, int N>
class RegionQuery<Ball<T>, T, N> {
 public:
  explicit RegionQuery(const Ball<T>& ball) noexcept
      : center_(detail::lanes_of<T, N>(ball.center)),
        overlap_limit_(P::broadcast(ball.radius * ball.radius * (T(1) + rounding_bound<T>(16)))),
        within_limit_(P::broadcast(ball.radius * ball.radius * (T(1) - rounding_bound<T>(16)))) {}

  [[nodiscard]] GLINT_ALWAYS_INLINE RegionEntered enter(const BoxPack<T, N>& boxes) const noexcept {
    P nearest = P::broadcast(T(0));
    P farthest = nearest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const P below = boxes.planes[axis] - center_[axis];
      const P above = center_[axis] - boxes.planes[axis + 3];
      const P outside = max(max(below, above), P::broadcast(T(0)));
      const P past = min(below, above);
      nearest = nearest + outside * outside;
      farthest = farthest + past * past;
    }
    return {~less(overlap_limit_, nearest) & all_lanes<N>, less_equal(farthest, within_limit_)};
  }

 private:
  using P = Pack<T, N>;

  std::array<P, 3> center_;
  P overlap_limit_;
  P within_limit_;
};

template <std::floating_point T, int N>
class RegionQuery<Frustum<T>, T, N> {
 public:
  explicit RegionQuery(const Frustum<T>& frustum) noexcept : frustum_(frustum) {}

  [[nodiscard]] GLINT_ALWAYS_INLINE RegionEntered enter(const BoxPack<T, N>& boxes) const noexcept {
    const P zero = P::broadcast(T(0));
    std::uint32_t outside = 0;
    std::uint32_t within = all_lanes<N>;
    for (const HalfSpace<T>& side : frustum_.sides) {
      P highest = P::broadcast(side.offset);
      P lowest = highest;
      P size = P::broadcast(std::abs(side.offset));
      for (int axis = 0; axis < 3; ++axis) {
        const T along = component(side.normal, axis);
        const P a = boxes.planes[std::size_t(axis) + (along < T(0) ? 0U : 3U)] * P::broadcast(along);
        const P b = boxes.planes[std::size_t(axis) + (along < T(0) ? 3U : 0U)] * P::broadcast(along);
        highest = highest + a;
        lowest = lowest + b;
        size = size + max(max(a, zero - a), max(b, zero - b));
      }
      const P rounding = size * P::broadcast(rounding_bound<T>(8));
      outside |= less(highest + rounding, zero);
      within &= less_equal(rounding, lowest);
    }
    return {~outside & all_lanes<N>, within};
  }

 private:
  using P = Pack<T, N>;

  const Frustum<T>& frustum_;
};

namespace detail {

template <std::unsigned_integral I>
struct PendingRegion {
  Link<I> link;
  bool is_within;  ///< nothing below need be tested
};

}  // namespace detail

/// Walks the leaves that may overlap a region: shows those that lie in it to `take(Slots) -> Walk`, and the others to
/// `test(Slots) -> Walk`. It is a loop of its own, for below a node within the region nothing is asked any more.
///
/// Cost: no allocation.
template <Layout L, typename Query, typename Test, typename Take>
Walk traverse_region(const L& layout, const Query& query, const Test& test, const Take& take) {
  using Entry = detail::PendingRegion<typename L::Index>;
  if (layout.empty()) return Walk::Continue;
  FixedStack<Entry, std::size_t(Tree<typename L::Scalar, typename L::Index>::max_depth * (L::width - 1) + 1)> pending;
  pending.push({layout.root(), false});
  while (!pending.empty()) {
    const Entry at = pending.pop();
    if (at.link.is_leaf()) {
      if ((at.is_within ? take(at.link.slots()) : test(at.link.slots())) == Walk::Stop) return Walk::Stop;
      continue;
    }
    const BoxPack<typename L::Scalar, L::width>& boxes = layout.children(at.link.first);
    const auto& links = layout.links(at.link.first);
    const RegionEntered entered =
        at.is_within ? RegionEntered{all_lanes<L::width>, all_lanes<L::width>} : query.enter(boxes);
    std::uint32_t mask = entered.overlapping & lanes_of_boxes(boxes);
    while (mask != 0) {
      const std::size_t i = detail::take_lowest(mask);
      pending.push({links[i], (entered.within >> i & 1U) != 0});
    }
  }
  return Walk::Continue;
}

}  // namespace glint
