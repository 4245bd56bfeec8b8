// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <span>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/collapse.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>

namespace glint {

/// Leaves that are brought up to date in place, where their primitives moved. Different slots may be at once.
///
///     FittedLeaf<T> refit(const S&, Slots<I>)
template <typename L, typename S>
concept RefittableLeaves = requires(L& leaves, const S& set, Slots<typename S::Index> slots) {
  { leaves.refit(set, slots) } -> std::same_as<FittedLeaf<typename S::Scalar>>;
};

/// A layout whose boxes can be written anew. Its links stay.
///
///     std::size_t child_count(I node)                                                     // missing ones are the last
///     void refit(I node, const Aabb<T>& bounds, std::span<const WideChild<T, I>> children)  // all of them, in order
template <typename L>
concept RefittableLayout = Layout<L> &&
    requires(L& layout, typename L::Index node, const Aabb<typename L::Scalar>& bounds,
             std::span<const WideChild<typename L::Scalar, typename L::Index>> children) {
  { layout.child_count(node) } -> std::same_as<std::size_t>;
  layout.refit(node, bounds, children);
};

/// A layout after its boxes were written anew.
template <std::floating_point T>
struct FittedLayout {
  Aabb<T> bounds{};
  std::size_t lost = 0;  ///< as in Refit
  double area = 0;       ///< half of that of all children, leaves times their slots
};

namespace detail {

/// What a child adds: half of its box's area, as often as it has slots to test.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] double child_area(const Aabb<T>& box, const Link<I>& link) noexcept {
  return double(half_area(box)) * (link.is_leaf() ? double(link.count) : 1.0);
}

template <RefittableLayout L>
[[nodiscard]] double area_below(const L& layout, const Link<typename L::Index>& link) {
  using T = typename L::Scalar;
  if (link.is_leaf()) return 0;
  double area = 0;
  const BoxPack<T, L::width> boxes = layout.children(link.first);
  for (std::size_t i = 0; i != layout.child_count(link.first); ++i) {
    const auto at = [&](std::size_t plane) { return boxes.plane(plane)[int(i)]; };
    const Link<typename L::Index> child = layout.links(link.first)[i];
    area += child_area(Aabb<T>{{at(0), at(1), at(2)}, {at(3), at(4), at(5)}}, child) + area_below(layout, child);
  }
  return area;
}

template <RefittableLayout L, Executor E, typename FitLeaf>
class LayoutRefitter {
 public:
  using T = typename L::Scalar;
  using I = typename L::Index;

  LayoutRefitter(L& layout, const E& executor, const FitLeaf& fit_leaf, int forks)
      : layout_(layout), executor_(executor), fit_leaf_(fit_leaf), forks_(forks) {}

  [[nodiscard]] FittedLayout<T> fit(Link<I> link, int depth) const {
    if (!link.is_leaf()) return fit_node(link.first, depth);
    const FittedLeaf<T> leaf = fit_leaf_(link.slots());
    return {leaf.bounds, leaf.lost, 0};
  }

 private:
  [[nodiscard]] FittedLayout<T> fit_node(I node, int depth) const {
    std::array<WideChild<T, I>, std::size_t(L::width)> children;
    std::array<FittedLayout<T>, std::size_t(L::width)> below;
    const std::size_t count = layout_.child_count(node);
    const auto& links = layout_.links(node);
    for (std::size_t i = 0; i != count; ++i) fetch(links[i]);
    const auto fit_children = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        children[i].link = links[i];
        below[i] = fit(children[i].link, depth + 1);
        children[i].bounds = below[i].bounds;
      }
    };
    if (depth < forks_)
      executor_.parallel_for(count, 1, fit_children);
    else
      fit_children(0, count);
    FittedLayout<T> all;
    for (std::size_t i = 0; i != count; ++i) {
      extend(all.bounds, below[i].bounds);
      all.lost += below[i].lost;
      all.area += below[i].area + child_area(below[i].bounds, children[i].link);
    }
    layout_.refit(node, all.bounds, std::span<const WideChild<T, I>>(children.data(), count));
    return all;
  }

  /// What is below a node lies next to it at best: all of it is asked for before the first is used.
  GLINT_ALWAYS_INLINE void fetch(const Link<I>& link) const noexcept {
    if (link.is_leaf()) {
      if constexpr (requires { fit_leaf_.prefetch(link.first); }) fit_leaf_.prefetch(link.first);
    } else {
      if constexpr (requires { layout_.prefetch(link.first); }) layout_.prefetch(link.first);
    }
  }

  L& layout_;
  const E& executor_;
  const FitLeaf& fit_leaf_;
  int forks_;
};

}  // namespace detail

/// Half of the area of all boxes of a layout but the root's, leaves times their slots: what `refit_layout` returns too.
///
/// Cost: O(nodes).
template <RefittableLayout L>
[[nodiscard]] double layout_area(const L& layout) {
  return layout.empty() ? 0.0 : detail::area_below(layout, layout.root());
}

/// Boxes anew, in place, from the leaves up: `fit_leaf(Slots) -> FittedLeaf` says how large a leaf is now, and may
/// offer `prefetch(first slot)`.
///
/// Requires: `fit_leaf` may be called for several leaves at once.
/// Cost:     O(nodes).
/// Threads:  subtrees in parallel; the same boxes for every executor.
template <RefittableLayout L, typename FitLeaf, Executor E = Serial>
FittedLayout<typename L::Scalar> refit_layout(L& layout, const FitLeaf& fit_leaf, const E& executor = {}) {
  if (layout.empty()) return {};
  constexpr std::size_t small = std::size_t{1} << 16;
  constexpr int levels = L::width == 2 ? 8 : 3;
  const int forks = layout.bytes() < small ? 0 : levels;
  return detail::LayoutRefitter<L, E, FitLeaf>(layout, executor, fit_leaf, forks).fit(layout.root(), 0);
}

}  // namespace glint
