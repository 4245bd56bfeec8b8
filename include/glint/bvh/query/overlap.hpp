// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/query/region.hpp>
#include <glint/bvh/query/triangle_block.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/overlap.hpp>
#include <glint/geometry/region.hpp>
#include <glint/geometry/set/instanced.hpp>
#include <glint/geometry/triangle.hpp>

namespace glint {
namespace detail {

/// Hands on each primitive once.
template <std::unsigned_integral I, typename Visit>
class PrimitivesOnce {
 public:
  PrimitivesOnce(bool has_parts, const Visit& visit) noexcept : has_parts_(has_parts), visit_(visit) {}

  GLINT_ALWAYS_INLINE Walk operator()(I i) {
    if (has_parts_ && !seen_.insert(i).second) return Walk::Continue;
    return visited(visit_, i);
  }

 private:
  bool has_parts_;
  const Visit& visit_;
  std::set<I> seen_;
};

/// What leaves hold, as for_each_overlapping asks for it: in blocks of triangles, where leaves are such, else one
/// primitive after another.
template <PrimitiveSet S, typename Leaves, typename Region, typename Sink>
class LeafOverlaps {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;

  LeafOverlaps(const S& set, const Leaves& leaves, const Region& region, Sink& sink) noexcept
      : set_(set), leaves_(leaves), region_(region), query_(region), sink_(sink) {}

  /// Of a leaf that may overlap the region.
  [[nodiscard]] Walk test(Slots<I> slots) {
    if constexpr (has_blocks)
      return test_blocks(slots);
    else
      return test_primitives(slots);
  }
  /// Of a leaf in the region: what triangles without a NaN are in blocks need not be tested.
  [[nodiscard]] Walk take(Slots<I> slots) {
    if constexpr (has_blocks)
      return take_blocks(slots);
    else
      return test_primitives(slots);
  }

 private:
  static constexpr int lanes = int(Leaves::block_size);
  static constexpr bool has_blocks = requires(const Leaves& leaves, Slots<I> slots) { leaves.blocks(slots); };

  [[nodiscard]] Walk test_blocks(Slots<I> slots) {
    return for_each_block(slots, [&](const auto& block, const BoxPack<T, lanes>& boxes, std::uint32_t /*known*/) {
      const std::uint32_t may = query_.enter(boxes).overlapping | points_of(boxes);
      return for_each_lane(block, may, [&](I i) { return test_one(i); });
    });
  }
  [[nodiscard]] Walk take_blocks(Slots<I> slots) {
    return for_each_block(slots, [&](const auto& block, const BoxPack<T, lanes>& /*boxes*/, std::uint32_t known) {
      if (for_each_lane(block, known, [&](I i) { return sink_(i); }) == Walk::Stop) return Walk::Stop;
      return for_each_lane(block, ~known & all_lanes<lanes>, [&](I i) { return test_one(i); });
    });
  }
  [[nodiscard]] Walk test_primitives(Slots<I> slots) {
    return leaves_.for_each_primitive(slots, [&](I i) { return test_one(i); });
  }
  [[nodiscard]] Walk test_one(I i) { return overlaps(set_, i, region_) ? sink_(i) : Walk::Continue; }

  /// Triangles without area may be put down as points.
  [[nodiscard]] static std::uint32_t points_of(const BoxPack<T, lanes>& boxes) noexcept {
    const auto& p = boxes.planes;
    return less_equal(p[3], p[0]) & less_equal(p[4], p[1]) & less_equal(p[5], p[2]);
  }
  /// Blocks with the boxes of their triangles, and where these have no NaN.
  template <typename F>
  [[nodiscard]] Walk for_each_block(Slots<I> slots, const F& f) {
    for (const auto& block : leaves_.blocks(slots)) {
      const Walk walk = block.with_vertices(set_, [&](const auto& vertex) {
        auto sum = Pack<T, lanes>::broadcast(T(0));
        for (int i = 0; i < 9; ++i) sum = sum + vertex(i / 3, i % 3);
        return f(block, boxes_of<T, lanes>(vertex), less_equal(sum, sum));
      });
      if (walk == Walk::Stop) return Walk::Stop;
    }
    return Walk::Continue;
  }
  template <typename Block, typename F>
  [[nodiscard]] static Walk for_each_lane(const Block& block, std::uint32_t mask, const F& f) {
    while (mask != 0) {
      const int lane = int(take_lowest(mask));
      if (block.holds(lane) && f(block.primitive(lane)) == Walk::Stop) return Walk::Stop;
    }
    return Walk::Continue;
  }

  const S& set_;
  const Leaves& leaves_;
  const Region& region_;
  RegionQuery<Region, T, lanes> query_;
  Sink& sink_;
};

}  // namespace detail

/// Shows the primitives that overlap a region, an Aabb, a Ball, a Frustum or one of the user's, to `visit(Index)`, in
/// no order. It may return a Walk: Stop ends the search.
///
///     for_each_overlapping(bvh, glint::Ball<float>{center, 2}, [&](std::uint32_t i) { touched.push_back(i); });
///
/// Which overlap is for `overlaps(primitive, region)` to say; without one, for the primitive's box. What a Filtered set
/// does not let rays hit overlaps all the same.
///
/// Ensures: each primitive once. Walk::Stop if a visit said so. Those without a finite, non-empty box are not there.
/// Cost:    below a node that lies in the region no box is asked, and no triangle in a block. No allocation, unless the
/// tree has primitives in
///          parts: then a set of those seen.
/// Threads: may be called by many at once.
template <PrimitiveSet S, LayoutChoice L, typename Region, typename Visit>
Walk for_each_overlapping(const Bvh<S, L>& bvh, const Region& region, const Visit& visit) {
  using I = typename S::Index;
  using Query = RegionQuery<Region, typename S::Scalar, Bvh<S, L>::Nodes::width>;
  detail::PrimitivesOnce<I, Visit> once(bvh.has_parts(), visit);
  detail::LeafOverlaps<S, typename Bvh<S, L>::Leaves, Region, decltype(once)> leaf(bvh.set(), bvh.leaves(), region,
                                                                                   once);
  return traverse_region(
      bvh.nodes(), Query(region), [&](Slots<I> slots) { return leaf.test(slots); },
      [&](Slots<I> slots) { return leaf.take(slots); });
}
/// Likewise, in the order of their indices, by trying each.
template <PrimitiveSet S, typename Region, typename Visit>
Walk for_each_overlapping(const BruteForce<S>& all, const Region& region, const Visit& visit) {
  using I = typename S::Index;
  for (I i = 0; i < all.set().size(); ++i) {
    if (!is_bounded(all.set().bounds(i)) || !overlaps(all.set(), i, region)) continue;
    if (detail::visited(visit, i) == Walk::Stop) return Walk::Stop;
  }
  return Walk::Continue;
}

/// The primitives that overlap a region, in the order of their indices.
template <RayCaster G, typename Region>
[[nodiscard]] std::vector<typename G::Index> overlapping(const G& geometry, const Region& region) {
  std::vector<typename G::Index> found;
  for_each_overlapping(geometry, region, [&](typename G::Index i) { found.push_back(i); });
  std::sort(found.begin(), found.end());
  return found;
}

/// Whether any primitive overlaps a region.
template <RayCaster G, typename Region>
[[nodiscard]] bool overlaps(const G& geometry, const Region& region) {
  return for_each_overlapping(geometry, region, [](typename G::Index) { return Walk::Stop; }) == Walk::Stop;
}

/// Whether anything of an object that was placed overlaps a region: asked of the object, by the frustum that the region
/// is where the object is at home.
template <Placeable G>
[[nodiscard]] bool overlaps(const Instance<G>& instance, const Frustum<typename G::Scalar>& frustum) {
  return overlaps(instance.bounds, frustum) &&
         overlaps(*instance.object, transform_by_inverse(instance.to_world, frustum));
}
template <Placeable G>
[[nodiscard]] bool overlaps(const Instance<G>& instance, const Aabb<typename G::Scalar>& box) {
  const auto part = overlap(box, instance.bounds);
  return !is_empty(part) && overlaps(*instance.object, transform_by_inverse(instance.to_world, frustum_of(part)));
}
/// A ball is the box around it.
template <Placeable G>
[[nodiscard]] bool overlaps(const Instance<G>& instance, const Ball<typename G::Scalar>& ball) {
  return overlaps(instance.bounds, ball) &&
         overlaps(instance, Aabb<typename G::Scalar>{ball.center - ball.radius, ball.center + ball.radius});
}

}  // namespace glint
