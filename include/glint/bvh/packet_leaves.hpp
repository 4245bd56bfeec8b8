// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_packet.hpp>

namespace glint {

/// The best hits so far of the rays of a packet, and their t once more, side by side.
template <std::floating_point T, std::unsigned_integral I>
struct PacketHits {
  typename RayPacket<T>::Lanes t;
  std::array<Hit<T, I>, std::size_t(RayPacket<T>::size)> hit;

  explicit PacketHits(const RayPacket<T>& packet) noexcept : t(packet.t_max) {
    for (std::size_t i = 0; i < packet.rays.size(); ++i) hit[i].t = packet.rays[i].t_max;
  }
};

/// Leaves that test many rays at once, a bit each; `asked` says which. What they find is what they find for single
/// rays.
///
///     auto prepare(const S&, const RayPacket<T>&)                                              // once a packet
///     uint32_t closest(const S&, const RayPacket<T>&, prepared, Slots<I>, asked, PacketHits<T, I>& best)   // improved
///     uint32_t occluded(const S&, const RayPacket<T>&, prepared, Slots<I>, asked)              // occluded
///
/// Requires: a coherent packet (ray_packet.hpp).
template <typename L, typename S>
concept PacketLeavesOf = LeavesOf<L, S> &&
    requires(const L& leaves, const S& set, const RayPacket<typename S::Scalar>& packet, Slots<typename S::Index> slots,
             std::uint32_t asked, PacketHits<typename S::Scalar, typename S::Index>& best) {
  { leaves.closest(set, packet, leaves.prepare(set, packet), slots, asked, best) } -> std::same_as<std::uint32_t>;
  { leaves.occluded(set, packet, leaves.prepare(set, packet), slots, asked) } -> std::same_as<std::uint32_t>;
};

namespace detail {

/// Of rays that cross a primitive no further than what they hit before, those for which it is closer.
template <typename Crossed, std::floating_point T, std::unsigned_integral I>
GLINT_ALWAYS_INLINE std::uint32_t take_closer(const Crossed& c, std::uint32_t rays, I primitive,
                                              PacketHits<T, I>& best) noexcept {
  std::uint32_t closer = 0;
  for (; rays != 0; rays &= rays - 1) {
    const int i = std::countr_zero(rays);
    Hit<T, I>& hit = best.hit[std::size_t(i)];
    const T t = c.t[i];
    if (!(t < hit.t || primitive < hit.primitive)) continue;
    const T scale = T(1) / c.det[i];
    hit = {.t = t, .uv = {c.w1[i] * scale, c.w2[i] * scale}, .primitive = primitive};
    closer |= std::uint32_t{1} << i;
  }
  if (closer != 0) best.t = select(closer, c.t, best.t);
  return closer;
}

/// One primitive, one ray after another.
template <PrimitiveSet S>
GLINT_NO_INLINE std::uint32_t closest_of_rays(std::uint32_t rays, const S& set,
                                              const RayPacket<typename S::Scalar>& packet, typename S::Index primitive,
                                              PacketHits<typename S::Scalar, typename S::Index>& best) {
  std::uint32_t closer = 0;
  for (; rays != 0; rays &= rays - 1) {
    const int i = std::countr_zero(rays);
    const auto hit = set.intersect(packet.rays[std::size_t(i)], primitive);
    if (!hit || !is_closer(*hit, best.hit[std::size_t(i)])) continue;
    best.hit[std::size_t(i)] = *hit;
    best.t.set(i, hit->t);
    closer |= std::uint32_t{1} << i;
  }
  return closer;
}
template <PrimitiveSet S>
GLINT_NO_INLINE std::uint32_t occluded_of_rays(std::uint32_t rays, const S& set,
                                               const RayPacket<typename S::Scalar>& packet,
                                               typename S::Index primitive) {
  std::uint32_t found = 0;
  for (; rays != 0; rays &= rays - 1) {
    const int i = std::countr_zero(rays);
    if (set.intersect(packet.rays[std::size_t(i)], primitive)) found |= std::uint32_t{1} << i;
  }
  return found;
}

}  // namespace detail

/// The leaves as a packet of rays sees them: asked for one ray after another, each made ready when it first comes to
/// a leaf.
template <typename L, typename S>
class LeavesForPacket {
 public:
  using T = typename S::Scalar;
  using Index = typename S::Index;

  LeavesForPacket(const L& leaves, const S& set, const RayPacket<T>& packet) noexcept
      : leaves_(leaves), set_(set), packet_(packet) {}

  std::uint32_t closest(Slots<Index> slots, std::uint32_t asked, PacketHits<T, Index>& best) {
    return each(asked, [&](std::size_t i, const Ray<T>& ray, const Prepared& prepared) {
      if (!leaves_.closest(set_, ray, prepared, slots, best.hit[i])) return false;
      best.t.set(int(i), best.hit[i].t);
      return true;
    });
  }
  [[nodiscard]] std::uint32_t occluded(Slots<Index> slots, std::uint32_t asked) {
    return each(asked, [&](std::size_t /*i*/, const Ray<T>& ray, const Prepared& prepared) {
      return leaves_.occluded(set_, ray, prepared, slots);
    });
  }

 private:
  using Prepared = decltype(std::declval<const L&>().prepare(std::declval<const S&>(), std::declval<const Ray<T>&>()));

  template <typename Test>
  [[nodiscard]] std::uint32_t each(std::uint32_t asked, const Test& test) {
    std::uint32_t found = 0;
    for (; asked != 0; asked &= asked - 1) {
      const auto i = std::size_t(std::countr_zero(asked));
      const Ray<T>& ray = packet_.rays[i];
      if (!prepared_[i]) prepared_[i].emplace(leaves_.prepare(set_, ray));
      if (test(i, ray, *prepared_[i])) found |= std::uint32_t{1} << i;
    }
    return found;
  }

  const L& leaves_;
  const S& set_;
  const RayPacket<T>& packet_;
  std::array<std::optional<Prepared>, std::size_t(RayPacket<T>::size)> prepared_;
};

/// Leaves that test many rays at once, likewise.
template <typename L, typename S>
  requires PacketLeavesOf<L, S>
class LeavesForPacket<L, S> {
 public:
  using T = typename S::Scalar;
  using Index = typename S::Index;

  LeavesForPacket(const L& leaves, const S& set, const RayPacket<T>& packet) noexcept
      : leaves_(leaves), set_(set), packet_(packet), prepared_(leaves.prepare(set, packet)) {}

  GLINT_ALWAYS_INLINE std::uint32_t closest(Slots<Index> slots, std::uint32_t asked, PacketHits<T, Index>& best) const {
    return leaves_.closest(set_, packet_, prepared_, slots, asked, best);
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t occluded(Slots<Index> slots, std::uint32_t asked) const {
    return leaves_.occluded(set_, packet_, prepared_, slots, asked);
  }

 private:
  using Prepared =
      decltype(std::declval<const L&>().prepare(std::declval<const S&>(), std::declval<const RayPacket<T>&>()));

  const L& leaves_;
  const S& set_;
  const RayPacket<T>& packet_;
  Prepared prepared_;
};

}  // namespace glint
