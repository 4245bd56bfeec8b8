// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glint/core/config.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Rays side by side, one a lane, for tests of many rays at once. Lanes to spare repeat one of the others.
template <std::floating_point T, int W = Pack<T, 16>::width>
struct RayPacket {
  static constexpr int size = 16;
  using Lanes = Pack<T, size, W>;

  std::span<const Ray<T>> rays;  ///< lane i is of ray i
  std::uint32_t members;         ///< one bit for each ray that is of the packet
  std::array<Lanes, 3> origin;
  std::array<Lanes, 3> direction;
  Lanes t_min;
  Lanes t_max;

  /// Requires: 1 to `size` rays, which outlive the packet.
  GLINT_ALWAYS_INLINE explicit RayPacket(std::span<const Ray<T>> all) noexcept
      : RayPacket(all, ~std::uint32_t{0} >> (32 - all.size())) {}
  /// Requires: up to `size` rays, which outlive the packet; at least one of them a member.
  GLINT_ALWAYS_INLINE RayPacket(std::span<const Ray<T>> run, std::uint32_t some) noexcept : rays(run), members(some) {
    GLINT_ASSERT(rays.size() <= std::size_t(size) && members != 0 && members >> (rays.size() - 1) <= 1);
    const auto first = std::size_t(std::countr_zero(members));
    std::array<std::array<T, std::size_t(size)>, 8> lanes;
    for (std::size_t i = 0; i < std::size_t(size); ++i) {
      const Ray<T>& ray = rays[((members >> i) & 1U) != 0 ? i : first];
      lanes[0][i] = ray.origin.x;
      lanes[1][i] = ray.origin.y;
      lanes[2][i] = ray.origin.z;
      lanes[3][i] = ray.direction.x;
      lanes[4][i] = ray.direction.y;
      lanes[5][i] = ray.direction.z;
      lanes[6][i] = ray.t_min;
      lanes[7][i] = ray.t_max;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin[axis] = Lanes::load(lanes[axis].data());
      direction[axis] = Lanes::load(lanes[3 + axis].data());
    }
    t_min = Lanes::load(lanes[6].data());
    t_max = Lanes::load(lanes[7].data());
  }

  /// The axis along which the first member goes furthest.
  [[nodiscard]] std::size_t longest_axis() const noexcept {
    return std::size_t(max_axis(abs(rays[std::size_t(std::countr_zero(members))].direction)));
  }
};

/// The octant of a ray's direction and its longest axis, as one of 24 numbers.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t course_of(const Ray<T>& ray) noexcept {
  const Vec3<T>& d = ray.direction;
  return std::uint32_t(std::signbit(d.x)) | std::uint32_t(std::signbit(d.y)) << 1U |
         std::uint32_t(std::signbit(d.z)) << 2U | std::uint32_t(max_axis(abs(d))) << 3U;
}

/// Whether the rays of a packet, all of one course, are so alike that tracing them together pays: their slopes and
/// their origins close together. Rays that need care are not: t_min < 0, a component of the direction that is zero or
/// has no reciprocal, a NaN anywhere.
///
/// Units: `reach` is the size of the scene.
template <std::floating_point T, int W>
[[nodiscard]] GLINT_ALWAYS_INLINE bool is_coherent(const RayPacket<T, W>& packet, T reach) noexcept {
  using Lanes = typename RayPacket<T, W>::Lanes;
  constexpr T spread = T(0.25);
  constexpr T least = std::numeric_limits<T>::min();
  const auto all = [](T value) { return Lanes::broadcast(value); };
  const auto size = [&](const Lanes& x) { return max(x, all(0) - x); };
  std::uint32_t good = less_equal(all(0), packet.t_min) & less_equal(packet.t_min, packet.t_max);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Lanes way = size(packet.direction[axis]);
    good &= less_equal(all(least), way) & less_equal(way, all(T(1) / least));
    good &= less_equal(size(packet.origin[axis]), all(std::numeric_limits<T>::max()));
  }
  if ((packet.members & ~good) != 0) return false;
  const Lanes per_step = all(1) / packet.direction[packet.longest_axis()];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Lanes slope = packet.direction[axis] * per_step;
    if (!(highest(packet.origin[axis]) - lowest(packet.origin[axis]) <= spread * reach)) return false;
    if (!(highest(slope) - lowest(slope) <= spread)) return false;
  }
  return true;
}

}  // namespace glint
