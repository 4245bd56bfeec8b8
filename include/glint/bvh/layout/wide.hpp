// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/collapse.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/prefetch.hpp>
#include <glint/core/uninitialized.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {
namespace detail {

/// The boxes of siblings side by side. A child that is there has no lower corner at infinity, even if nothing is left
/// in it.
template <std::floating_point T, int N, std::unsigned_integral I>
[[nodiscard]] BoxPack<T, N> box_pack(std::span<const WideChild<T, I>> children) noexcept {
  std::array<std::array<T, std::size_t(N)>, 6> planes;
  for (std::size_t plane = 0; plane < 6; ++plane) planes[plane].fill(plane < 3 ? infinity<T> : -infinity<T>);
  for (std::size_t i = 0; i != children.size(); ++i) {
    const Aabb<T>& bounds = children[i].bounds;
    const Vec3<T>& upper = bounds.upper;
    const Vec3<T> lower = is_empty(bounds) ? Vec3<T>(std::numeric_limits<T>::max()) : bounds.lower;
    const std::array<T, 6> box{lower.x, lower.y, lower.z, upper.x, upper.y, upper.z};
    for (std::size_t plane = 0; plane < 6; ++plane) planes[plane][i] = box[plane];
  }
  BoxPack<T, N> boxes;
  for (std::size_t plane = 0; plane < 6; ++plane) boxes.planes[plane] = Pack<T, N>::load(planes[plane].data());
  return boxes;
}

}  // namespace detail

/// Nodes of up to N children, whose boxes are stored plane by plane and tested at once.
template <std::floating_point T, std::unsigned_integral I, int N>
class WideNodes {
  using Children = std::span<const WideChild<T, I>>;

 public:
  using Scalar = T;
  using Index = I;
  static constexpr int width = N;

  WideNodes() = default;
  /// Requires: a valid tree.
  /// Ensures:  the same nodes for every executor.
  template <Executor E = Serial>
  explicit WideNodes(const Tree<T, I>& tree, Collapse how = Collapse::Optimal, const E& executor = {})
      : root_(detail::root_of(tree)), is_empty_(tree.nodes.empty()) {
    if (is_empty_ || root_.is_leaf()) return;
    collapse<N>(
        tree, how, executor, [this](std::size_t count) { nodes_.resize(count); },
        [this](I at, const Aabb<T>& /*bounds*/, Children children) { write(nodes_[at], children); });
  }

  [[nodiscard]] bool empty() const noexcept { return is_empty_; }
  [[nodiscard]] Link<I> root() const noexcept { return root_; }
  [[nodiscard]] GLINT_ALWAYS_INLINE const BoxPack<T, N>& children(I node) const noexcept { return nodes_[node].boxes; }
  [[nodiscard]] GLINT_ALWAYS_INLINE const std::array<Link<I>, std::size_t(N)>& links(I node) const noexcept {
    return nodes_[node].links;
  }
  [[nodiscard]] std::size_t child_count(I node) const noexcept {
    const Pack<T, N>& lower = nodes_[node].boxes.planes[0];
    std::size_t count = std::size_t(N);
    while (count > 0 && lower[int(count) - 1] == infinity<T>) --count;
    return count;
  }
  /// New boxes for the children of a node.
  void refit(I node, const Aabb<T>& /*bounds*/, Children children) noexcept {
    nodes_[node].boxes = detail::box_pack<T, N>(children);
  }
  /// Has a node fetched that will be visited soon.
  GLINT_ALWAYS_INLINE void prefetch(I node) const noexcept { glint::prefetch(nodes_[node]); }
  [[nodiscard]] std::size_t bytes() const noexcept { return nodes_.size() * sizeof(Node); }

 private:
  struct alignas(std::min<std::size_t>(64, std::bit_floor(sizeof(BoxPack<T, N>)))) Node {
    BoxPack<T, N> boxes;
    std::array<Link<I>, std::size_t(N)> links;
  };

  static void write(Node& node, Children children) noexcept {
    node.boxes = detail::box_pack<T, N>(children);
    node.links.fill({0, 1});
    for (std::size_t i = 0; i != children.size(); ++i) node.links[i] = children[i].link;
  }

  UninitializedVector<Node> nodes_;
  Link<I> root_;
  bool is_empty_ = true;
};

/// Names the layout, and the leaves that go with it: `Bvh{mesh, BinnedSah{}, wide<8, IndexedBlocks<4>>}`.
/// `Lanes` tells units apart that are built for different registers: what they make has names of its own.
template <int N, typename LeafChoice = DefaultLeaves, int Lanes = register_lanes<float>>
struct WideLayout {
  using Leaves = LeafChoice;
  template <std::floating_point T, std::unsigned_integral I>
  using Nodes = WideNodes<T, I, N>;

  Collapse collapse = Collapse::Optimal;

  template <std::floating_point T, std::unsigned_integral I, Executor E>
  [[nodiscard]] Nodes<T, I> nodes(const Tree<T, I>& tree, const E& executor) const {
    return Nodes<T, I>(tree, collapse, executor);
  }
};
template <int N, typename LeafChoice = DefaultLeaves>
inline constexpr WideLayout<N, LeafChoice> wide{};

static_assert(Layout<WideNodes<float, std::uint32_t, 8>>);

}  // namespace glint
