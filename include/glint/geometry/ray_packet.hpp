// SPDX-License-Identifier: MIT
#pragma once
#include <array>
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

/// Rays side by side, one a lane, for tests of many rays at once. Lanes to spare repeat the last ray.
template <std::floating_point T>
struct RayPacket {
  static constexpr int size = 16;
  using Lanes = Pack<T, size>;

  std::span<const Ray<T>> rays;
  std::array<Lanes, 3> origin;
  std::array<Lanes, 3> direction;
  Lanes t_min;
  Lanes t_max;
  std::size_t longest;  ///< the axis along which the first ray goes furthest

  /// Requires: 1 to `size` rays, which outlive the packet.
  GLINT_ALWAYS_INLINE explicit RayPacket(std::span<const Ray<T>> some) noexcept
      : rays(some), longest(std::size_t(max_axis(abs(some.front().direction)))) {
    GLINT_ASSERT(rays.size() <= std::size_t(size));
    std::array<std::array<T, std::size_t(size)>, 8> lanes;
    for (std::size_t i = 0; i < std::size_t(size); ++i) {
      const Ray<T>& ray = rays[i < rays.size() ? i : rays.size() - 1];
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

  /// One bit a ray.
  [[nodiscard]] std::uint32_t all() const noexcept { return ~std::uint32_t{0} >> (32 - rays.size()); }
};

/// Whether rays are so alike that tracing them together pays: of one octant and one longest axis, their slopes and
/// their origins close together. Rays that need care are not: t_min < 0, a component of the direction that is zero or
/// has no reciprocal, a NaN anywhere.
///
/// Units: `reach` is the size of the scene.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE bool is_coherent(const RayPacket<T>& packet, T reach) noexcept {
  using Lanes = typename RayPacket<T>::Lanes;
  constexpr T spread = T(0.25);
  const auto all = [](T value) { return Lanes::broadcast(value); };
  const auto size = [&](const Lanes& x) { return max(x, all(0) - x); };
  const auto width = [](const Lanes& x) { return highest(x) - lowest(x); };
  const Lanes along = packet.direction[packet.longest];
  std::uint32_t good = less_equal(all(0), packet.t_min) & less_equal(packet.t_min, packet.t_max);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Lanes& d = packet.direction[axis];
    good &= less_equal(all(std::numeric_limits<T>::min()), size(d)) &
            less_equal(size(d), all(T(1) / std::numeric_limits<T>::min()));
    good &= less_equal(size(packet.origin[axis]), all(std::numeric_limits<T>::max()));
    good &= axis < packet.longest ? less(size(d), size(along)) : less_equal(size(d), size(along));
    good &= component(packet.rays[0].direction, int(axis)) < T(0) ? less(d, all(0)) : less(all(0), d);
  }
  if ((~good & packet.all()) != 0) return false;
  const Lanes per_step = all(1) / along;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(width(packet.origin[axis]) <= spread * reach)) return false;
    if (!(width(packet.direction[axis] * per_step) <= spread)) return false;
  }
  return true;
}

}  // namespace glint
