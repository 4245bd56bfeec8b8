// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/filtered_leaves.hpp>
#include <glint/bvh/layout/joined_leaves.hpp>
#include <glint/bvh/layout/masked_leaves.hpp>
#include <glint/bvh/layout/motion.hpp>
#include <glint/bvh/layout/moving_blocks.hpp>
#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/pass/refit.hpp>
#include <glint/bvh/pass/refit_layout.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/query/image_bounds.hpp>
#include <glint/bvh/query/ray.hpp>
#include <glint/bvh/ray_batch.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/motion.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_packet.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/geometry/transform.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// What a Bvh is laid out in unless told: nodes of eight boxes, which move along where primitives do.
template <typename S>
using DefaultLayout = std::conditional_t<MovingSet<S>, MotionLayout<8>, WideLayout<8>>;

/// A set of primitives that rays find quickly: the set, a tree over it in some layout, and its leaves. Models
/// RayCaster.
///
///     const glint::Bvh bvh{mesh};                                                         // a good tree, one thread
///     const glint::Bvh bvh{mesh, SweepSah{}, TbbExecutor{}, wide<4, IndexedBlocks<4>>};   // every choice made
///
/// Ensures: of hits at the same t, the one of the smallest index. Primitives without a finite, non-empty box are never
///          hit; statistics().left_out counts them.
/// Threads: const means shareable.
template <PrimitiveSet S, LayoutChoice LayoutName = DefaultLayout<S>>
class Bvh {
 public:
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;
  using Leaves = decltype(make_leaves(std::declval<const S&>(), std::declval<Tree<Scalar, Index>&>(),
                                      typename LayoutName::Leaves{}, Serial{}));
  using Nodes = typename LayoutName::template Nodes<Scalar, Index>;

  /// Leaves suited to what tests them.
  static constexpr BinnedSah default_builder{.block_size = Leaves::block_size};

  /// The set is kept by value: where it is a view, what it views must outlive the Bvh, unchanged.
  template <BuilderFor<S> Builder = BinnedSah, Executor E = Serial>
  explicit Bvh(S set, const Builder& builder = default_builder, const E& executor = {}, LayoutName layout = {})
      : Bvh(set, tree_over(set, builder, executor), layout, executor) {}

  template <BuilderFor<S> Builder>
  Bvh(S set, const Builder& builder, LayoutName layout) : Bvh(set, tree_over(set, builder, Serial{}), layout) {}

  /// Over a tree made before. Requires: a valid tree over this set.
  template <Executor E = Serial>
  Bvh(S set, Tree<Scalar, Index> tree, LayoutName layout = {}, const E& executor = {})
      : set_(std::move(set)),
        statistics_(glint::statistics(tree)),
        bounds_(tree.nodes.empty() ? Aabb<Scalar>{} : tree.nodes.front().bounds),
        reach_(RayReach<Scalar>::of(bounds_)),
        leaves_(make_leaves(set_, tree, typename LayoutName::Leaves{}, executor)),
        nodes_(layout.template nodes<Scalar, Index>(tree, executor)) {
    follow_motion(executor);
  }

  [[nodiscard]] const S& set() const noexcept { return set_; }
  /// Of the tree that was built, before it was laid out.
  [[nodiscard]] const TreeStatistics& statistics() const noexcept { return statistics_; }
  /// Memory in use beside the set's own.
  [[nodiscard]] std::size_t bytes() const noexcept { return nodes_.bytes() + leaves_.bytes(); }
  [[nodiscard]] Aabb<Scalar> bounds() const noexcept { return bounds_; }
  /// A box around all primitives under a map, closer than the image of `bounds()`. Where boxes move, it is that image.
  [[nodiscard]] Aabb<Scalar> image_bounds(const Affine<Scalar>& affine) const {
    if constexpr (boxes_move)
      return transform(affine, bounds_);
    else
      return glint::image_bounds(nodes_, bounds_, affine);
  }

  /// What queries walk through (bvh/query/), the user's own too.
  [[nodiscard]] const Nodes& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const Leaves& leaves() const noexcept { return leaves_; }
  [[nodiscard]] const RayReach<Scalar>& reach() const noexcept { return reach_; }
  /// Whether some primitive is in several leaves, as builders leave it that cut primitives.
  [[nodiscard]] bool has_parts() const noexcept { return statistics_.references > statistics_.primitives; }

  [[nodiscard]] std::optional<Hit<Scalar, Index>> closest(const Ray<Scalar>& ray) const {
    RayQuery<Scalar, Nodes::width, RayOrder::NearestFirst> query(ray, reach_);
    const auto prepared = leaves_.prepare(set_, ray);
    Hit<Scalar, Index> best{.t = ray.t_max};
    traverse(nodes_at(nodes_, ray.time), query, ClosestVisit{*this, ray, prepared, query, best});
    if (best.primitive == none<Index>) return std::nullopt;
    return best;
  }

  [[nodiscard]] bool occluded(const Ray<Scalar>& ray) const {
    const RayQuery<Scalar, Nodes::width, RayOrder::Any> query(ray, reach_);
    const auto prepared = leaves_.prepare(set_, ray);
    return traverse(nodes_at(nodes_, ray.time), query, OccludedVisit{*this, ray, prepared}) == Walk::Stop;
  }

  /// Many rays: what each finds alone, to the last bit. Sooner where successive rays are alike, as those of a tile of
  /// pixels or toward one light are; no later where they are not.
  ///
  /// Requires: as many hits as rays.
  /// Cost:     no allocation.
  void closest(std::span<const Ray<Scalar>> rays, std::span<std::optional<Hit<Scalar, Index>>> hits) const {
    GLINT_ASSERT(rays.size() == hits.size());
    if constexpr (boxes_move) {  // rays of many times share no boxes
      for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
      return;
    }
    const PacketCaster caster(set_, leaves_, nodes_, reach_, reach_.size);
    const auto together = [&](const RayPacket<Scalar>& packet, std::size_t first) {
      return caster.closest(packet, hits.subspan(first, packet.rays.size()));
    };
    for_each_packet(rays, reach_.size, together, [&](std::size_t i) { hits[i] = closest(rays[i]); });
  }
  /// Likewise. Requires: as many results as rays.
  void occluded(std::span<const Ray<Scalar>> rays, std::span<bool> results) const {
    GLINT_ASSERT(rays.size() == results.size());
    if constexpr (boxes_move) {
      for (std::size_t i = 0; i < rays.size(); ++i) results[i] = occluded(rays[i]);
      return;
    }
    const PacketCaster caster(set_, leaves_, nodes_, reach_, reach_.size);
    const auto together = [&](const RayPacket<Scalar>& packet, std::size_t first) {
      return caster.occluded(packet, results.subspan(first, packet.rays.size()));
    };
    for_each_packet(rays, reach_.size, together, [&](std::size_t i) { results[i] = occluded(rays[i]); });
  }

  /// Requires: a hit that this returned for this ray.
  [[nodiscard]] SurfaceOf<Scalar> surface(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const
      requires(ShadableSet<S>) {
    return set_.surface(ray, hit);
  }

  /// Follows primitives that moved: boxes anew, and what leaves copy of the primitives; the tree stays as it is.
  ///
  /// Requires: as many primitives, in the same order; those that the builder left out are not looked at again. Nobody
  ///           casts rays meanwhile.
  /// Ensures:  `growth` is the cost now over the cost when built, of what rays meet here: half of the area of all
  ///           nodes, leaves times their slots, over that of the root. It is 1 where a root has no area.
  /// Errors:   as refit of a tree.
  /// Cost:     O(nodes + primitives), next to no memory.
  /// Threads:  subtrees in parallel; the same for every executor.
  template <Executor E = Serial>
  Refit refit(const E& executor = {}) requires(RefittableLeaves<Leaves, S>&& RefittableLayout<Nodes>) {
    if (built_cost_ < 0) built_cost_ = cost(bounds_, layout_area(nodes_));
    const FittedLayout<Scalar> fitted = refit_layout(nodes_, LeafFit{leaves_, set_}, executor);
    follow_motion(executor);
    bounds_ = fitted.bounds;
    reach_ = RayReach<Scalar>::of(bounds_);
    const double now = cost(bounds_, fitted.area);
    return {.growth = now > 0 && built_cost_ > 0 ? now / built_cost_ : 1, .lost = fitted.lost};
  }
  /// Likewise, where the set itself is a new one: a view of other buffers, say.
  template <Executor E = Serial>
  Refit refit(S set, const E& executor = {}) requires(RefittableLeaves<Leaves, S>&& RefittableLayout<Nodes>) {
    set_ = std::move(set);
    return refit(executor);
  }

 private:
  static constexpr bool boxes_move = MovingSet<S> && MovingLayout<Nodes>;

  /// A good tree for all times where boxes will move along, and for a box each where they will not.
  template <BuilderFor<S> Builder, Executor E>
  [[nodiscard]] static Tree<Scalar, Index> tree_over(const S& set, const Builder& builder, const E& executor) {
    if constexpr (boxes_move) {
      auto tree = builder.build(Midway<S>{set}, executor);
      glint::refit(tree, set, executor);
      return tree;
    } else {
      return builder.build(set, executor);
    }
  }
  template <Executor E>
  void follow_motion(const E& executor) {
    if constexpr (boxes_move) fit_motion(nodes_, leaves_, set_, executor);
  }

  struct LeafFit {
    Leaves& leaves;
    const S& set;

    [[nodiscard]] FittedLeaf<Scalar> operator()(Slots<Index> slots) const { return leaves.refit(set, slots); }
    void prefetch(Index slot) const noexcept {
      if constexpr (requires { leaves.prefetch(slot); }) leaves.prefetch(slot);
    }
  };

  [[nodiscard]] static double cost(const Aabb<Scalar>& bounds, double area) noexcept {
    const double root_area = double(half_area(bounds));
    return root_area > 0 ? area / root_area : 0.0;
  }

  // Visitors are types of their own and not lambdas, which no standard attribute can have inlined.
  template <typename Prepared, typename Query>
  struct ClosestVisit {
    const Bvh& bvh;
    const Ray<Scalar>& ray;
    const Prepared& prepared;
    Query& query;
    Hit<Scalar, Index>& best;

    GLINT_ALWAYS_INLINE Walk operator()(Slots<Index> slots) const {
      if (bvh.leaves_.closest(bvh.set_, ray, prepared, slots, best)) query.shrink(best.t);
      return Walk::Continue;
    }
  };
  template <typename Prepared, typename Query>
  ClosestVisit(const Bvh&, const Ray<Scalar>&, const Prepared&, Query&, Hit<Scalar, Index>&)
      -> ClosestVisit<Prepared, Query>;
  template <typename Prepared>
  struct OccludedVisit {
    const Bvh& bvh;
    const Ray<Scalar>& ray;
    const Prepared& prepared;

    GLINT_ALWAYS_INLINE Walk operator()(Slots<Index> slots) const {
      return bvh.leaves_.occluded(bvh.set_, ray, prepared, slots) ? Walk::Stop : Walk::Continue;
    }
  };
  template <typename Prepared>
  OccludedVisit(const Bvh&, const Ray<Scalar>&, const Prepared&) -> OccludedVisit<Prepared>;

  S set_;
  TreeStatistics statistics_;
  Aabb<Scalar> bounds_;
  RayReach<Scalar> reach_;
  Leaves leaves_;  // before the nodes, for it may renumber slots
  Nodes nodes_;
  double built_cost_ = -1;  // measured when it is first asked for
};

template <PrimitiveSet S>
explicit Bvh(S) -> Bvh<S>;
template <PrimitiveSet S, BuilderFor<S> Builder>
Bvh(S, Builder) -> Bvh<S>;
template <PrimitiveSet S, BuilderFor<S> Builder, Executor E>
Bvh(S, Builder, const E&) -> Bvh<S>;
template <PrimitiveSet S, BuilderFor<S> Builder, LayoutChoice LayoutName>
Bvh(S, Builder, LayoutName) -> Bvh<S, LayoutName>;
template <PrimitiveSet S, BuilderFor<S> Builder, Executor E, LayoutChoice LayoutName>
Bvh(S, Builder, const E&, LayoutName) -> Bvh<S, LayoutName>;
template <PrimitiveSet S>
Bvh(S, Tree<typename S::Scalar, typename S::Index>) -> Bvh<S>;
template <PrimitiveSet S, LayoutChoice LayoutName>
Bvh(S, Tree<typename S::Scalar, typename S::Index>, LayoutName) -> Bvh<S, LayoutName>;

}  // namespace glint
