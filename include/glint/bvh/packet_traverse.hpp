// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/query/packet.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/fixed_stack.hpp>
#include <glint/geometry/ray_packet.hpp>

namespace glint {

/// What hangs on one link of a layout, as a layout of its own.
template <Layout L>
struct Subtree {
  using Scalar = typename L::Scalar;
  using Index = typename L::Index;
  static constexpr int width = L::width;

  const L& layout;
  Link<Index> top;

  [[nodiscard]] bool empty() const noexcept { return false; }
  [[nodiscard]] Link<Index> root() const noexcept { return top; }
  [[nodiscard]] GLINT_ALWAYS_INLINE decltype(auto) children(Index node) const noexcept { return layout.children(node); }
  [[nodiscard]] GLINT_ALWAYS_INLINE decltype(auto) links(Index node) const noexcept { return layout.links(node); }
};
template <Layout L>
Subtree(const L&, Link<typename L::Index>) -> Subtree<L>;

/// How well the rays of a packet kept together.
struct Company {
  int visits = 0;
  int rays = 0;  ///< that took part, summed over the visits

  /// Whether it was worth it: below this, the rays would have been faster alone.
  [[nodiscard]] bool was_good() const noexcept { return rays >= 5 * visits; }
};

namespace detail {

/// The links still to be followed, and the rays that do. As full as PendingOf may be.
template <Layout L>
struct PendingRays {
  Link<typename L::Index> link;
  typename L::Scalar key;
  std::uint32_t rays;
};
template <Layout L>
using PendingRaysOf =
    FixedStack<PendingRays<L>, std::size_t(Tree<typename L::Scalar, typename L::Index>::max_depth*(L::width - 1) + 1)>;

/// Leaves the children that some of the rays enter on the stack, the nearest on top.
template <Layout L, int W, typename Fetch>
GLINT_ALWAYS_INLINE void push_children(const L& layout, const PacketQuery<typename L::Scalar, W>& query,
                                       typename L::Index node, std::uint32_t rays, PendingRaysOf<L>& pending,
                                       const Fetch& fetch) noexcept {
  using T = typename L::Scalar;
  const BoxPack<T, L::width>& boxes = layout.children(node);
  const auto& links = layout.links(node);
  const Entered<T, L::width> entered = query.enter(boxes);
  std::array<T, std::size_t(L::width)> key;
  entered.key.store(key.data());
  std::array<PendingRays<L>, std::size_t(L::width)> found;
  std::size_t count = 0;
  for (std::uint32_t mask = entered.mask; mask != 0; mask &= mask - 1) {
    const int i = std::countr_zero(mask);
    fetch(links[std::size_t(i)]);
    const std::uint32_t entering = query.enter(boxes, i) & rays;
    found[count] = {links[std::size_t(i)], key[std::size_t(i)], entering};
    count += std::size_t(entering != 0);  // not a branch, for nobody could foresee it
  }
  const std::size_t base = pending.size();
  for (std::size_t i = 0; i < count; ++i) push_sorted(pending, base, found[i]);
}

}  // namespace detail

/// Walks a tree with the rays of a packet together, a bit each, and shows the leaves that may matter to
/// `visit(Slots, rays)`. Where hardly a ray is left that goes down a branch, `visit_alone(Link, rays)` is to follow it
/// to its end with each. Both may improve the query meanwhile. `fetch(Link)` hears of the links below the root before
/// their turn comes.
///
/// Cost:     no allocation.
/// Source:   Wald, Slusallek, Benthin, Wagner, "Interactive Rendering with Coherent Ray Tracing", Eurographics 2001.
template <Layout L, int W, typename Visit, typename VisitAlone, typename Fetch>
GLINT_ALWAYS_INLINE Company traverse_packet(const L& layout, const PacketQuery<typename L::Scalar, W>& query,
                                            std::uint32_t rays, const Visit& visit, const VisitAlone& visit_alone,
                                            const Fetch& fetch) {
  constexpr int few = 2;
  detail::PendingRaysOf<L> pending;
  Company company;
  if (layout.empty()) return company;
  Link<typename L::Index> link = layout.root();
  while (true) {
    const int count = std::popcount(rays);
    ++company.visits;
    company.rays += count;
    if (count <= few)
      visit_alone(link, rays);
    else if (link.is_leaf())
      visit(link.slots(), rays);
    else
      detail::push_children(layout, query, link.first, rays, pending, fetch);
    do {
      if (pending.empty()) return company;
      const auto next = pending.pop();
      link = next.link;
      rays = next.rays & query.reach(next.key);
    } while (rays == 0);
  }
}

}  // namespace glint
