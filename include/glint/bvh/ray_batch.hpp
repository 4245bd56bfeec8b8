// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/packet_leaves.hpp>
#include <glint/bvh/packet_traverse.hpp>
#include <glint/bvh/query/packet.hpp>
#include <glint/bvh/query/ray.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/core/config.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_packet.hpp>

namespace glint {

/// Casts the rays of a coherent packet together, at a set of primitives, its leaves, and the nodes above them. What is
/// found is what each ray finds alone, to the last bit.
///
/// `reach` is what RayQuery wants to know of the scene, `size` that part which is its size.
template <PrimitiveSet S, LeavesOf<S> L, Layout Nodes, typename Reach,
          int W = RayPacket<typename S::Scalar>::Lanes::width>
class PacketCaster {
 public:
  using T = typename S::Scalar;
  using Index = typename S::Index;

  PacketCaster(const S& set, const L& leaves, const Nodes& nodes, const Reach& reach, T size) noexcept
      : set_(set), leaves_(leaves), nodes_(nodes), reach_(reach), size_(size) {}

  /// Requires: a coherent packet, of one course; as many hits as rays. Those of other rays than its members are left.
  [[nodiscard]] Company closest(const RayPacket<T, W>& packet, std::span<std::optional<Hit<T, Index>>> hits) const {
    PacketQuery<T, W> query(packet, size_);
    LeavesForPacket<L, S, W> leaves(leaves_, set_, packet, query);
    PacketHits<T, Index, W> best(packet);
    const auto visit = [&](Slots<Index> slots, std::uint32_t rays) {
      if (leaves.closest(slots, rays, best) != 0) query.shrink(best.t);
    };
    const auto visit_alone = [&](Link<Index> link, std::uint32_t rays) {
      for (; rays != 0; rays &= rays - 1) {
        const int i = std::countr_zero(rays);
        Hit<T, Index> hit = best[i];
        closest_below(link, packet.rays[std::size_t(i)], hit);
        best.set(i, hit);
      }
      query.shrink(best.t);
    };
    const Company company = traverse_packet(nodes_, query, packet.members, visit, visit_alone, fetch());
    for (std::uint32_t rays = packet.members; rays != 0; rays &= rays - 1) {
      const int i = std::countr_zero(rays);
      hits[std::size_t(i)].reset();
      if (best.primitive[i] != none<Index>) hits[std::size_t(i)] = best[i];
    }
    return company;
  }

  [[nodiscard]] Company occluded(const RayPacket<T, W>& packet, std::span<bool> results) const {
    PacketQuery<T, W> query(packet, size_);
    LeavesForPacket<L, S, W> leaves(leaves_, set_, packet, query);
    std::uint32_t found = 0;
    const auto end = [&](std::uint32_t rays) {
      if (rays == 0) return;
      found |= rays;
      query.drop(rays);
    };
    const auto visit = [&](Slots<Index> slots, std::uint32_t rays) { end(leaves.occluded(slots, rays)); };
    const auto visit_alone = [&](Link<Index> link, std::uint32_t rays) {
      for (; rays != 0; rays &= rays - 1)
        if (occluded_below(link, packet.rays[std::size_t(std::countr_zero(rays))])) end(rays & (~rays + 1));
    };
    const Company company = traverse_packet(nodes_, query, packet.members, visit, visit_alone, fetch());
    for (std::uint32_t rays = packet.members; rays != 0; rays &= rays - 1)
      results[std::size_t(std::countr_zero(rays))] = (found & rays & (~rays + 1)) != 0;
    return company;
  }

 private:
  /// Has a link's node or leaf fetched before its turn: all rays of the packet would wait for it.
  struct Fetch {
    const PacketCaster& caster;

    GLINT_ALWAYS_INLINE void operator()(Link<Index> link) const noexcept {
      if (!link.is_leaf()) {
        if constexpr (requires { caster.nodes_.prefetch(link.first); }) caster.nodes_.prefetch(link.first);
      } else if constexpr (requires { caster.leaves_.prefetch(link.first); }) {
        caster.leaves_.prefetch(link.first);
      }
    }
  };
  [[nodiscard]] Fetch fetch() const noexcept { return {*this}; }

  void closest_below(Link<Index> link, const Ray<T>& ray, Hit<T, Index>& best) const {
    const auto prepared = leaves_.prepare(set_, ray);
    if (link.is_leaf()) {
      leaves_.closest(set_, ray, prepared, link.slots(), best);
      return;
    }
    Ray<T> rest = ray;
    rest.t_max = best.t;
    RayQuery<T, Nodes::width, RayOrder::NearestFirst> query(rest, reach_);
    traverse(Subtree{nodes_, link}, query, [&](Slots<Index> slots) {
      if (leaves_.closest(set_, ray, prepared, slots, best)) query.shrink(best.t);
      return Walk::Continue;
    });
  }
  [[nodiscard]] bool occluded_below(Link<Index> link, const Ray<T>& ray) const {
    const auto prepared = leaves_.prepare(set_, ray);
    if (link.is_leaf()) return leaves_.occluded(set_, ray, prepared, link.slots());
    const RayQuery<T, Nodes::width, RayOrder::Any> query(ray, reach_);
    return traverse(Subtree{nodes_, link}, query, [&](Slots<Index> slots) {
             return leaves_.occluded(set_, ray, prepared, slots) ? Walk::Stop : Walk::Continue;
           }) == Walk::Stop;
  }

  const S& set_;
  const L& leaves_;
  const Nodes& nodes_;
  const Reach& reach_;
  T size_;
};

template <PrimitiveSet S, LeavesOf<S> L, Layout Nodes, typename Reach>
PacketCaster(const S&, const L&, const Nodes&, const Reach&, typename S::Scalar) -> PacketCaster<S, L, Nodes, Reach>;

namespace detail {

/// Those of some rays that have the course of the first of them.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t of_one_course(std::span<const Ray<T>> rays,
                                                              std::uint32_t some) noexcept {
  const std::uint32_t course = course_of(rays[std::size_t(std::countr_zero(some))]);
  std::uint32_t members = 0;
  for (; some != 0; some &= some - 1) {
    const int i = std::countr_zero(some);
    if (course_of(rays[std::size_t(i)]) == course) members |= std::uint32_t{1} << i;
  }
  return members;
}

}  // namespace detail

/// Parts a batch in runs, and these by the courses of their rays: where several rays of one are coherent, they go to
/// `together(RayPacket, first) -> Company`, all others to `alone(i)`. After two runs in a row that had better gone
/// alone, the next ones do so untried, more of them each time: what trying costs stays small, whatever the rays.
///
/// Units: `reach` is the size of the scene.
template <std::floating_point T, typename Together, typename Alone>
void for_each_packet(std::span<const Ray<T>> rays, T reach, const Together& together, const Alone& alone) {
  constexpr auto size = std::size_t(RayPacket<T>::size);
  constexpr int several = 8;
  constexpr unsigned most_failures = 6;
  unsigned failures = 0;
  unsigned untried = 0;
  const auto attempt = [&](std::size_t first, std::span<const Ray<T>> run, std::uint32_t members) {
    if (std::popcount(members) < several) return std::optional<Company>{};
    const RayPacket<T> packet(run, members);
    return is_coherent(packet, reach) ? std::optional{together(packet, first)} : std::nullopt;
  };
  const auto all_alone = [&](std::size_t first, std::uint32_t members) {
    for (; members != 0; members &= members - 1) alone(first + std::size_t(std::countr_zero(members)));
  };
  for (std::size_t first = 0; first < rays.size(); first += size) {
    const auto run = rays.subspan(first, std::min(size, rays.size() - first));
    std::uint32_t rest = ~std::uint32_t{0} >> (32 - run.size());
    if (untried != 0) {
      --untried;
      all_alone(first, rest);
      continue;
    }
    bool paid = false;
    while (rest != 0) {
      const std::uint32_t members = detail::of_one_course(run, rest);
      const std::optional<Company> company = attempt(first, run, members);
      if (!company) all_alone(first, members);
      paid |= company && company->was_good();
      rest &= ~members;
    }
    failures = paid ? 0 : std::min(failures + 1, most_failures);
    untried = failures < 2 ? 0 : 1U << (failures - 1);
  }
}

}  // namespace glint
