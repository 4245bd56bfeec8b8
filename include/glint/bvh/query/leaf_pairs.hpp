// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/query/region.hpp>
#include <glint/bvh/query/triangle_block.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/overlap.hpp>
#include <glint/geometry/triangle_triangle.hpp>

namespace glint {
namespace detail {

/// Whether two primitives overlap, as far as they know how to tell. Boxes are asked for where they do not.
template <typename P, typename Q, typename BoxP, typename BoxQ>
[[nodiscard]] bool primitives_overlap(const P& p, const Q& q, const BoxP& box_p, const BoxQ& box_q) {
  if constexpr (requires { overlaps(p, q); })
    return overlaps(p, q);
  else if constexpr (requires { overlaps(q, p); })
    return overlaps(q, p);
  else
    return overlaps_region(p, box_q()) && overlaps_region(q, box_p());
}
/// The same of primitives of one surface.
template <typename P, typename Q, typename BoxP, typename BoxQ>
[[nodiscard]] bool neighbors_overlap(const P& p, const Q& q, const BoxP& box_p, const BoxQ& box_q) {
  if constexpr (requires { overlaps_beyond_corners(p, q); })
    return overlaps_beyond_corners(p, q);
  else
    return primitives_overlap(p, q, box_p, box_q);
}

}  // namespace detail

/// What two leaves have that overlaps: where both keep blocks of triangles, a box of one is tested with a block's boxes
/// of the other at once.
template <PrimitiveSet S, typename LeavesA, PrimitiveSet R, typename LeavesB, typename Visit>
class LeafPairs {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;
  using J = typename R::Index;

  LeafPairs(const S& set_a, const LeavesA& leaves_a, const R& set_b, const LeavesB& leaves_b, const Visit& visit,
            bool is_self) noexcept
      : set_a_(set_a), leaves_a_(leaves_a), set_b_(set_b), leaves_b_(leaves_b), visit_(visit), is_self_(is_self) {}

  [[nodiscard]] Walk between(Slots<I> a, Slots<J> b) const {
    if constexpr (in_blocks)
      return blocks_between(a, b);
    else
      return primitives_between(a, b);
  }
  /// Of one leaf of one tree. Pairs that are seen twice are shown once.
  [[nodiscard]] Walk within(Slots<I> slots) const {
    if constexpr (in_blocks)
      return blocks_within(slots);
    else
      return primitives_within(slots);
  }

 private:
  static constexpr bool in_blocks = requires(const LeavesA& a, const LeavesB& b, Slots<I> slots_a, Slots<J> slots_b) {
    a.blocks(slots_a);
    b.blocks(slots_b);
  };
  static constexpr int lanes_a = int(LeavesA::block_size);
  static constexpr int lanes_b = int(LeavesB::block_size);

  [[nodiscard]] Walk blocks_between(Slots<I> a, Slots<J> b) const {
    for (const auto& block : leaves_a_.blocks(a))
      if (with_blocks(block, leaves_b_.blocks(b)) == Walk::Stop) return Walk::Stop;
    return Walk::Continue;
  }
  [[nodiscard]] Walk primitives_between(Slots<I> a, Slots<J> b) const {
    return leaves_a_.for_each_primitive(a, [&](I i) {
      const Aabb<T> box = set_a_.bounds(i);
      return leaves_b_.for_each_primitive(b, [&](J j) { return test_boxes(i, box, j); });
    });
  }
  [[nodiscard]] Walk blocks_within(Slots<I> slots) const {
    const auto blocks = leaves_a_.blocks(slots);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (within_block(blocks[i]) == Walk::Stop) return Walk::Stop;
      if (with_blocks(blocks[i], blocks.subspan(i + 1)) == Walk::Stop) return Walk::Stop;
    }
    return Walk::Continue;
  }
  [[nodiscard]] Walk primitives_within(Slots<I> slots) const {
    std::size_t at = 0;
    return leaves_a_.for_each_primitive(slots, [&](I i) {
      const Aabb<T> box = set_a_.bounds(i);
      std::size_t skip = ++at;
      return leaves_a_.for_each_primitive(slots, [&](I j) {
        if (skip == 0) return test_boxes(i, box, j);
        --skip;
        return Walk::Continue;
      });
    });
  }

  template <typename Block, typename Blocks>
  [[nodiscard]] Walk with_blocks(const Block& block, const Blocks& others) const {
    const auto boxes =
        block.with_vertices(set_a_, [](const auto& vertex) { return detail::boxes_of<T, lanes_a>(vertex); });
    for (const auto& other : others) {
      const auto against =
          other.with_vertices(set_b_, [](const auto& vertex) { return detail::boxes_of<T, lanes_b>(vertex); });
      const std::uint32_t present = lanes_of_boxes(against);
      for (std::uint32_t from = lanes_of_boxes(boxes); from != 0;) {
        const int i = int(detail::take_lowest(from));
        if (!block.holds(i)) continue;
        if (test_lanes(block.primitive(i), detail::box_in_lane(boxes, i), other, against, present) == Walk::Stop)
          return Walk::Stop;
      }
    }
    return Walk::Continue;
  }
  template <typename Block>
  [[nodiscard]] Walk within_block(const Block& block) const {
    const auto boxes =
        block.with_vertices(set_a_, [](const auto& vertex) { return detail::boxes_of<T, lanes_a>(vertex); });
    for (std::uint32_t rest = lanes_of_boxes(boxes); rest != 0;) {
      const int i = int(detail::take_lowest(rest));
      if (!block.holds(i)) continue;
      if (test_lanes(block.primitive(i), detail::box_in_lane(boxes, i), block, boxes, rest) == Walk::Stop)
        return Walk::Stop;
    }
    return Walk::Continue;
  }
  /// One triangle with those of a block whose bits are set.
  template <typename Block>
  [[nodiscard]] GLINT_ALWAYS_INLINE Walk test_lanes(I i, const Aabb<T>& box, const Block& block,
                                                    const BoxPack<T, lanes_b>& boxes, std::uint32_t asked) const {
    std::uint32_t mask = RegionQuery<Aabb<T>, T, lanes_b>(box).enter(boxes).overlapping & asked;
    while (mask != 0) {
      const int lane = int(detail::take_lowest(mask));
      if (block.holds(lane) && test(i, block.primitive(lane)) == Walk::Stop) return Walk::Stop;
    }
    return Walk::Continue;
  }

  [[nodiscard]] Walk test_boxes(I i, const Aabb<T>& box, J j) const {
    return overlaps(box, set_b_.bounds(j)) ? test(i, j) : Walk::Continue;
  }
  [[nodiscard]] Walk test(I i, J j) const {
    if constexpr (std::same_as<S, R>) {
      if (is_self_) return i != j && overlap(i, j) ? visit_(std::min(i, j), std::max(i, j)) : Walk::Continue;
    }
    return overlap(i, j) ? visit_(i, j) : Walk::Continue;
  }
  [[nodiscard]] bool overlap(I i, J j) const {
    const auto box_a = [&] { return set_a_.bounds(i); };
    const auto box_b = [&] { return set_b_.bounds(j); };
    return detail::with_primitive(set_a_, i, [&](const auto& p) {
      return detail::with_primitive(set_b_, j, [&](const auto& q) {
        return is_self_ ? detail::neighbors_overlap(p, q, box_a, box_b)
                        : detail::primitives_overlap(p, q, box_a, box_b);
      });
    });
  }

  const S& set_a_;
  const LeavesA& leaves_a_;
  const R& set_b_;
  const LeavesB& leaves_b_;
  const Visit& visit_;
  bool is_self_;
};

}  // namespace glint
