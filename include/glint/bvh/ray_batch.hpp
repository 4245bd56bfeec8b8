// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
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
template <PrimitiveSet S, LeavesOf<S> L, Layout Nodes, typename Reach>
class PacketCaster {
 public:
  using T = typename S::Scalar;
  using Index = typename S::Index;

  PacketCaster(const S& set, const L& leaves, const Nodes& nodes, const Reach& reach, T size) noexcept
      : set_(set), leaves_(leaves), nodes_(nodes), reach_(reach), size_(size) {}

  /// Requires: a coherent packet, as many hits as rays, nodes.
  [[nodiscard]] Company closest(const RayPacket<T>& packet, std::span<std::optional<Hit<T, Index>>> hits) const {
    PacketQuery<T, Nodes::width> query(packet, size_);
    LeavesForPacket<L, S> leaves(leaves_, set_, packet);
    PacketHits<T, Index> best(packet);
    const auto visit = [&](Slots<Index> slots, std::uint32_t rays) {
      if (leaves.closest(slots, rays, best) != 0) query.shrink(best.t);
    };
    const auto visit_alone = [&](Link<Index> link, std::uint32_t rays) {
      for (; rays != 0; rays &= rays - 1) {
        const int i = std::countr_zero(rays);
        Hit<T, Index>& hit = best.hit[std::size_t(i)];
        closest_below(link, packet.rays[std::size_t(i)], hit);
        best.t.set(i, hit.t);
      }
      query.shrink(best.t);
    };
    const Company company = traverse_packet(nodes_, query, packet.all(), visit, visit_alone);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      hits[i].reset();
      if (best.hit[i].primitive != none<Index>) hits[i] = best.hit[i];
    }
    return company;
  }

  [[nodiscard]] Company occluded(const RayPacket<T>& packet, std::span<bool> results) const {
    PacketQuery<T, Nodes::width> query(packet, size_);
    LeavesForPacket<L, S> leaves(leaves_, set_, packet);
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
    const Company company = traverse_packet(nodes_, query, packet.all(), visit, visit_alone);
    for (std::size_t i = 0; i < results.size(); ++i) results[i] = ((found >> i) & 1U) != 0;
    return company;
  }

 private:
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

namespace detail {

/// False for most runs that is_coherent refuses, at the price of a look at two or three rays.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE bool in_one_octant(std::span<const Ray<T>> rays) noexcept {
  const auto octant = [](const Ray<T>& ray) {
    return unsigned(std::signbit(ray.direction.x)) | unsigned(std::signbit(ray.direction.y)) << 1U |
           unsigned(std::signbit(ray.direction.z)) << 2U;
  };
  return std::all_of(rays.begin(), rays.end(), [&](const Ray<T>& ray) { return octant(ray) == octant(rays[0]); });
}

}  // namespace detail

/// Parts a batch in runs: those that are coherent go to `together(RayPacket, first) -> Company`, the rays of the others
/// to `alone(i)`. After two runs in a row that had better gone alone, the next ones do so untried, more of them each
/// time: what trying costs stays small, whatever the rays.
///
/// Units: `reach` is the size of the scene.
template <std::floating_point T, typename Together, typename Alone>
void for_each_packet(std::span<const Ray<T>> rays, T reach, const Together& together, const Alone& alone) {
  constexpr auto size = std::size_t(RayPacket<T>::size);
  constexpr unsigned most_failures = 6;
  const auto attempt = [&](std::size_t first, std::span<const Ray<T>> run) -> std::optional<Company> {
    if (run.size() < size / 2 || !detail::in_one_octant(run)) return std::nullopt;
    const RayPacket<T> packet(run);
    if (!is_coherent(packet, reach)) return std::nullopt;
    return together(packet, first);
  };
  unsigned failures = 0;
  unsigned untried = 0;
  for (std::size_t first = 0; first < rays.size(); first += size) {
    const std::size_t end = std::min(first + size, rays.size());
    std::optional<Company> company;
    if (untried != 0) {
      --untried;
    } else {
      company = attempt(first, rays.subspan(first, end - first));
      failures = company && company->was_good() ? 0 : std::min(failures + 1, most_failures);
      untried = failures < 2 ? 0 : 1U << (failures - 1);
    }
    if (!company)
      for (std::size_t i = first; i < end; ++i) alone(i);
  }
}

}  // namespace glint
