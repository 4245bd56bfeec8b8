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
#include <glint/bvh/query/packet.hpp>
#include <glint/core/config.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_packet.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The best hits so far of the rays of a packet, side by side.
template <std::floating_point T, std::unsigned_integral I, int W = RayPacket<T>::Lanes::width>
struct PacketHits {
  using Lanes = typename RayPacket<T, W>::Lanes;

  Lanes t;
  Lanes w1, w2, det;  ///< w1 / det and w2 / det are the hit's uv
  Pack<I, RayPacket<T, W>::size> primitive;
  std::array<I, std::size_t(RayPacket<T>::size)> inner;

  /// None yet: rays end at their t_max.
  explicit PacketHits(const RayPacket<T, W>& packet) noexcept
      : t(packet.t_max),
        w1(Lanes::broadcast(T(0))),
        w2(w1),
        det(Lanes::broadcast(T(1))),
        primitive(Pack<I, RayPacket<T>::size>::broadcast(none<I>)) {
    inner.fill(none<I>);
  }
  [[nodiscard]] Hit<T, I> operator[](int i) const noexcept {
    const T scale = T(1) / det[i];
    return {.t = t[i], .uv = {w1[i] * scale, w2[i] * scale}, .primitive = primitive[i], .inner = inner[std::size_t(i)]};
  }
  void set(int i, const Hit<T, I>& hit) noexcept {
    t.set(i, hit.t);
    w1.set(i, hit.uv.x);
    w2.set(i, hit.uv.y);
    det.set(i, T(1));
    primitive.set(i, hit.primitive);
    inner[std::size_t(i)] = hit.inner;
  }
};

/// Leaves that test many rays at once, a bit each; `asked` says which. What they find is what they find for single
/// rays, of primitives whose boxes the query lets pass.
///
///     auto prepare(const S&, const RayPacket<T>&)                                          // once a packet
///     uint32_t closest(const S&, const RayPacket<T>&, prepared, const PacketQuery<T>&, Slots<I>, asked,
///                      PacketHits<T, I>& best)                                             // whose best improved
///     uint32_t occluded(const S&, const RayPacket<T>&, prepared, const PacketQuery<T>&, Slots<I>, asked)
///
/// Requires: a coherent packet, of one course (ray_packet.hpp).
template <typename L, typename S>
concept PacketLeavesOf = LeavesOf<L, S> &&
    requires(const L& leaves, const S& set, const RayPacket<typename S::Scalar>& packet,
             const PacketQuery<typename S::Scalar>& query, Slots<typename S::Index> slots, std::uint32_t asked,
             PacketHits<typename S::Scalar, typename S::Index>& best) {
  {
    leaves.closest(set, packet, leaves.prepare(set, packet), query, slots, asked, best)
    } -> std::same_as<std::uint32_t>;
  { leaves.occluded(set, packet, leaves.prepare(set, packet), query, slots, asked) } -> std::same_as<std::uint32_t>;
};

namespace detail {

/// Of rays that cross a primitive no further than what they hit before, those for which it is closer.
template <typename Crossed, std::floating_point T, std::unsigned_integral I, int W>
GLINT_ALWAYS_INLINE std::uint32_t take_closer(const Crossed& c, std::uint32_t rays, I primitive,
                                              PacketHits<T, I, W>& best) noexcept {
  std::uint32_t closer = rays & less(c.t, best.t);
  for (std::uint32_t same = rays & ~closer; same != 0; same &= same - 1)
    if (primitive < best.primitive[std::countr_zero(same)]) closer |= same & (~same + 1);
  best.t = select(closer, c.t, best.t);
  best.w1 = select(closer, c.w1, best.w1);
  best.w2 = select(closer, c.w2, best.w2);
  best.det = select(closer, c.det, best.det);
  best.primitive = select(closer, best.primitive.broadcast(primitive), best.primitive);
  return closer;
}

/// One primitive, one ray after another.
template <PrimitiveSet S, int W>
GLINT_NO_INLINE std::uint32_t closest_of_rays(std::uint32_t rays, const S& set,
                                              const RayPacket<typename S::Scalar, W>& packet,
                                              typename S::Index primitive,
                                              PacketHits<typename S::Scalar, typename S::Index, W>& best) {
  std::uint32_t closer = 0;
  for (; rays != 0; rays &= rays - 1) {
    const int i = std::countr_zero(rays);
    const auto hit = set.intersect(packet.rays[std::size_t(i)], primitive);
    if (!hit || !is_closer(*hit, best[i])) continue;
    best.set(i, *hit);
    closer |= std::uint32_t{1} << i;
  }
  return closer;
}
template <PrimitiveSet S, int W>
GLINT_NO_INLINE std::uint32_t occluded_of_rays(std::uint32_t rays, const S& set,
                                               const RayPacket<typename S::Scalar, W>& packet,
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
template <typename L, typename S, int W = RayPacket<typename S::Scalar>::Lanes::width>
class LeavesForPacket {
 public:
  using T = typename S::Scalar;
  using Index = typename S::Index;

  LeavesForPacket(const L& leaves, const S& set, const RayPacket<T, W>& packet,
                  const PacketQuery<T, W>& /*query*/) noexcept
      : leaves_(leaves), set_(set), packet_(packet) {}

  std::uint32_t closest(Slots<Index> slots, std::uint32_t asked, PacketHits<T, Index, W>& best) {
    return each(asked, [&](std::size_t i, const Ray<T>& ray, const Prepared& prepared) {
      Hit<T, Index> hit = best[int(i)];
      if (!leaves_.closest(set_, ray, prepared, slots, hit)) return false;
      best.set(int(i), hit);
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
  const RayPacket<T, W>& packet_;
  std::array<std::optional<Prepared>, std::size_t(RayPacket<T, W>::size)> prepared_;
};

/// Leaves that test many rays at once, likewise.
template <typename L, typename S, int W>
  requires PacketLeavesOf<L, S>
class LeavesForPacket<L, S, W> {
 public:
  using T = typename S::Scalar;
  using Index = typename S::Index;

  LeavesForPacket(const L& leaves, const S& set, const RayPacket<T, W>& packet, const PacketQuery<T, W>& query) noexcept
      : leaves_(leaves), set_(set), packet_(packet), query_(query), prepared_(leaves.prepare(set, packet)) {}

  GLINT_ALWAYS_INLINE std::uint32_t closest(Slots<Index> slots, std::uint32_t asked,
                                            PacketHits<T, Index, W>& best) const {
    return leaves_.closest(set_, packet_, prepared_, query_, slots, asked, best);
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t occluded(Slots<Index> slots, std::uint32_t asked) const {
    return leaves_.occluded(set_, packet_, prepared_, query_, slots, asked);
  }

 private:
  using Prepared =
      decltype(std::declval<const L&>().prepare(std::declval<const S&>(), std::declval<const RayPacket<T, W>&>()));

  const L& leaves_;
  const S& set_;
  const RayPacket<T, W>& packet_;
  const PacketQuery<T, W>& query_;
  Prepared prepared_;
};

}  // namespace glint
