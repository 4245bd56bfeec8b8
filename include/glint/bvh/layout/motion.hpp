// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/collapse.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/pass/refit_layout.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/prefetch.hpp>
#include <glint/core/uninitialized.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/motion.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Nodes of up to N children whose boxes move: each plane is where it is at time 0, and how far it goes until time 1.
/// `at(time)` is the layout as a ray of that time meets it; as it stands, for queries without a time, its boxes hold
/// what moves at all times.
///
/// Source: Woop, Áfra, Benthin, "STBVH: A Spatial-Temporal BVH for Efficient Multi-Segment Motion Blur", HPG 2017; its
///         linear bounds, without its splits of time.
template <std::floating_point T, std::unsigned_integral I, int N>
class MotionNodes {
  using Children = std::span<const WideChild<T, I>>;
  struct alignas(64) Node {
    BoxPack<T, N> begin;
    BoxPack<T, N> way;
    std::array<Link<I>, std::size_t(N)> links;
  };

 public:
  using Scalar = T;
  using Index = I;
  static constexpr int width = N;

  /// The boxes of siblings at a time, plane by plane as they are asked for.
  class Boxes {
   public:
    GLINT_ALWAYS_INLINE Boxes(const Node& node, const Pack<T, N>& time) noexcept : node_(node), time_(time) {}
    [[nodiscard]] GLINT_ALWAYS_INLINE Pack<T, N> plane(std::size_t i) const noexcept {
      return node_.begin.planes[i] + node_.way.planes[i] * time_;
    }
    GLINT_ALWAYS_INLINE operator BoxPack<T, N>() const noexcept {
      BoxPack<T, N> boxes;
      for (std::size_t i = 0; i < 6; ++i) boxes.planes[i] = plane(i);
      return boxes;
    }

   private:
    const Node& node_;
    const Pack<T, N>& time_;
  };

  /// All nodes at one time: a layout.
  class Snapshot {
   public:
    using Scalar = T;
    using Index = I;
    static constexpr int width = N;

    GLINT_ALWAYS_INLINE Snapshot(const MotionNodes& nodes, T time) noexcept
        : nodes_(nodes), time_(Pack<T, N>::broadcast(std::min(std::max(time, T(0)), T(1)))) {}
    [[nodiscard]] GLINT_ALWAYS_INLINE bool empty() const noexcept { return nodes_.empty(); }
    [[nodiscard]] GLINT_ALWAYS_INLINE Link<I> root() const noexcept { return nodes_.root(); }
    [[nodiscard]] GLINT_ALWAYS_INLINE Boxes children(I node) const noexcept { return {nodes_.nodes_[node], time_}; }
    [[nodiscard]] GLINT_ALWAYS_INLINE const auto& links(I node) const noexcept { return nodes_.links(node); }

   private:
    const MotionNodes& nodes_;
    Pack<T, N> time_;
  };

  MotionNodes() = default;
  /// What stands still, in the boxes of the tree. Requires: a valid tree.
  /// Ensures:  the same nodes for every executor.
  template <Executor E = Serial>
  explicit MotionNodes(const Tree<T, I>& tree, Collapse how = Collapse::Optimal, const E& executor = {})
      : root_(detail::root_of(tree)), is_empty_(tree.nodes.empty()) {
    if (is_empty_ || root_.is_leaf()) return;
    collapse<N>(
        tree, how, executor, [this](std::size_t count) { nodes_.resize(count); },
        [this](I at, const Aabb<T>& bounds, Children children) {
          nodes_[at].links.fill({0, 1});
          for (std::size_t i = 0; i != children.size(); ++i) nodes_[at].links[i] = children[i].link;
          refit(at, bounds, children);
        });
  }

  [[nodiscard]] bool empty() const noexcept { return is_empty_; }
  [[nodiscard]] Link<I> root() const noexcept { return root_; }
  [[nodiscard]] GLINT_ALWAYS_INLINE Snapshot at(T time) const noexcept { return {*this, time}; }
  /// Of all times.
  [[nodiscard]] BoxPack<T, N> children(I node) const noexcept {
    BoxPack<T, N> boxes = nodes_[node].begin;
    for (std::size_t i = 0; i < 6; ++i) {
      const Pack<T, N> end = boxes.planes[i] + nodes_[node].way.planes[i];
      boxes.planes[i] = i < 3 ? min(boxes.planes[i], end) : max(boxes.planes[i], end);
    }
    return boxes;
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE const std::array<Link<I>, std::size_t(N)>& links(I node) const noexcept {
    return nodes_[node].links;
  }
  [[nodiscard]] std::size_t child_count(I node) const noexcept {
    const Pack<T, N>& lower = nodes_[node].begin.planes[0];
    std::size_t count = std::size_t(N);
    while (count > 0 && lower[int(count) - 1] == infinity<T>) --count;
    return count;
  }
  /// New boxes for the children of a node, which stand still in them.
  void refit(I node, const Aabb<T>& /*bounds*/, Children children) noexcept {
    nodes_[node].begin = detail::box_pack<T, N>(children);
    nodes_[node].way.planes.fill(Pack<T, N>::broadcast(T(0)));
  }
  /// The boxes at time 1 of children whose boxes at time 0 were those of `refit`.
  void refit_end(I node, Children children) noexcept {
    const BoxPack<T, N> end = detail::box_pack<T, N>(children);
    for (std::size_t i = 0; i < 6; ++i)
      set_way(nodes_[node].begin.planes[i], end.planes[i], nodes_[node].way.planes[i], i);
  }
  GLINT_ALWAYS_INLINE void prefetch(I node) const noexcept { glint::prefetch(nodes_[node]); }
  [[nodiscard]] std::size_t bytes() const noexcept { return nodes_.size() * sizeof(Node); }

 private:
  /// Planes move outward by what is rounded until a box stands where it is at a time, and what is in it likewise.
  static void set_way(Pack<T, N>& begin, const Pack<T, N>& end, Pack<T, N>& way, std::size_t plane) noexcept {
    for (int i = 0; i < N; ++i) {
      const T a = begin[i];
      const T b = end[i];
      const bool is_there = std::abs(a) < std::numeric_limits<T>::max() && std::abs(b) < std::numeric_limits<T>::max();
      if (!is_there) continue;
      const T rounded =
          std::max(std::abs(a), std::abs(b)) * (plane < 3 ? -rounding_bound<T>(16) : rounding_bound<T>(16));
      const bool is_far = !std::isfinite(b - a);
      const T outer = plane < 3 ? std::min(a, b) : std::max(a, b);
      begin.set(i, (is_far ? outer : a) + rounded);
      way.set(i, is_far ? T(0) : b - a);
    }
  }

  UninitializedVector<Node> nodes_;
  Link<I> root_;
  bool is_empty_ = true;
};

/// Names the layout, and the leaves that go with it: `Bvh{moving, BinnedSah{}, motion<8>}`.
/// `Lanes` tells units apart that are built for different registers: what they make has names of its own.
template <int N, typename LeafChoice = DefaultLeaves, int Lanes = register_lanes<float>>
struct MotionLayout {
  using Leaves = LeafChoice;
  template <std::floating_point T, std::unsigned_integral I>
  using Nodes = MotionNodes<T, I, N>;

  Collapse collapse = Collapse::Optimal;

  template <std::floating_point T, std::unsigned_integral I, Executor E>
  [[nodiscard]] Nodes<T, I> nodes(const Tree<T, I>& tree, const E& executor) const {
    return Nodes<T, I>(tree, collapse, executor);
  }
};
template <int N, typename LeafChoice = DefaultLeaves>
inline constexpr MotionLayout<N, LeafChoice> motion{};

/// A layout whose boxes can be where they are at a time.
template <typename L>
concept MovingLayout = RefittableLayout<L> &&
    requires(L& layout, typename L::Index node,
             std::span<const WideChild<typename L::Scalar, typename L::Index>> children) {
  { layout.at(typename L::Scalar{}) } -> Layout;
  layout.refit_end(node, children);
};

/// The nodes as rays of a time meet them.
template <Layout L>
[[nodiscard]] GLINT_ALWAYS_INLINE decltype(auto) nodes_at(const L& nodes, typename L::Scalar time) noexcept {
  if constexpr (MovingLayout<L>) {
    return nodes.at(time);
  } else {
    return (nodes);
  }
}

namespace detail {

/// A moving layout whose boxes at time 1 are written anew.
template <MovingLayout L>
struct EndOf {
  using Scalar = typename L::Scalar;
  using Index = typename L::Index;
  static constexpr int width = L::width;
  L& layout;

  [[nodiscard]] bool empty() const noexcept { return layout.empty(); }
  [[nodiscard]] Link<Index> root() const noexcept { return layout.root(); }
  [[nodiscard]] auto children(Index node) const noexcept { return layout.children(node); }
  [[nodiscard]] const auto& links(Index node) const noexcept { return layout.links(node); }
  [[nodiscard]] std::size_t child_count(Index node) const noexcept { return layout.child_count(node); }
  void refit(Index node, const Aabb<Scalar>& /*bounds*/, std::span<const WideChild<Scalar, Index>> children) noexcept {
    layout.refit_end(node, children);
  }
  GLINT_ALWAYS_INLINE void prefetch(Index node) const noexcept { layout.prefetch(node); }
  [[nodiscard]] std::size_t bytes() const noexcept { return layout.bytes(); }
};

/// What a leaf holds, at one end of time.
template <typename T, typename Leaves, MovingSet S>
[[nodiscard]] FittedLeaf<T> fit_leaf(const Leaves& leaves, const S& set, Slots<typename S::Index> slots,
                                     Aabb<T> MotionBounds<T>::*end) {
  FittedLeaf<T> fitted;
  leaves.for_each_primitive(slots, [&](typename S::Index i) {
    fitted.add(set.motion_bounds(i).*end);
    return Walk::Continue;
  });
  return fitted;
}

}  // namespace detail

/// Gives a layout the motion of a set: boxes anew, in place, at time 0 and then at time 1.
///
/// Requires: `leaves` that the layout's slots are of.
/// Cost:     O(nodes + primitives).
/// Threads:  subtrees in parallel; the same boxes for every executor.
template <MovingLayout L, typename Leaves, MovingSet S, Executor E = Serial>
void fit_motion(L& layout, const Leaves& leaves, const S& set, const E& executor = {}) {
  using LeafSlots = Slots<typename S::Index>;
  using Bounds = MotionBounds<typename S::Scalar>;
  const auto at_begin = [&](LeafSlots slots) { return detail::fit_leaf(leaves, set, slots, &Bounds::begin); };
  const auto at_end = [&](LeafSlots slots) { return detail::fit_leaf(leaves, set, slots, &Bounds::end); };
  refit_layout(layout, at_begin, executor);
  detail::EndOf<L> end{layout};
  refit_layout(end, at_end, executor);
}

static_assert(MovingLayout<MotionNodes<float, std::uint32_t, 8>>);

}  // namespace glint
