// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/collapse.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The nodes of a tree as they are: the smallest to write, and with 32 bytes a node the smallest of the plain layouts.
template <std::floating_point T, std::unsigned_integral I>
class BinaryNodes {
 public:
  using Scalar = T;
  using Index = I;
  static constexpr int width = 2;

  BinaryNodes() = default;
  /// Requires: a valid tree.
  explicit BinaryNodes(const Tree<T, I>& tree) : nodes_(tree.nodes) {}

  [[nodiscard]] bool empty() const noexcept { return nodes_.empty(); }
  [[nodiscard]] Link<I> root() const noexcept {
    return {nodes_[0].is_leaf() ? nodes_[0].first : I(0), nodes_[0].count};
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE BoxPack<T, 2> children(I node) const noexcept {
    const Aabb<T>& a = nodes_[nodes_[node].first].bounds;
    const Aabb<T>& b = nodes_[nodes_[node].first + 1].bounds;
    return {{pair(a.lower.x, b.lower.x), pair(a.lower.y, b.lower.y), pair(a.lower.z, b.lower.z),
             pair(a.upper.x, b.upper.x), pair(a.upper.y, b.upper.y), pair(a.upper.z, b.upper.z)}};
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE std::array<Link<I>, 2> links(I node) const noexcept {
    const I first = nodes_[node].first;
    return {link(first), link(first + 1)};
  }
  [[nodiscard]] static std::size_t child_count(I /*node*/) noexcept { return 2; }
  /// New boxes for the children of a node, and for itself.
  void refit(I node, const Aabb<T>& bounds, std::span<const WideChild<T, I>> children) noexcept {
    for (std::size_t i = 0; i != children.size(); ++i) nodes_[nodes_[node].first + i].bounds = children[i].bounds;
    nodes_[node].bounds = bounds;
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return nodes_.size() * sizeof(nodes_[0]); }

 private:
  [[nodiscard]] GLINT_ALWAYS_INLINE static Pack<T, 2> pair(T a, T b) noexcept {
    const std::array<T, 2> both{a, b};
    return Pack<T, 2>::load(both.data());
  }
  [[nodiscard]] Link<I> link(I node) const noexcept {
    return {nodes_[node].is_leaf() ? nodes_[node].first : node, nodes_[node].count};
  }

  std::vector<BinaryNode<T, I>> nodes_;
};

/// Names the layout, and the leaves that go with it: `Bvh{mesh, BinnedSah{}, binary}`.
/// `Lanes` tells units apart that are built for different registers: what they make has names of its own.
template <typename LeafChoice = DefaultLeaves, int Lanes = register_lanes<float>>
struct BinaryLayout {
  using Leaves = LeafChoice;
  template <std::floating_point T, std::unsigned_integral I>
  using Nodes = BinaryNodes<T, I>;

  template <std::floating_point T, std::unsigned_integral I, Executor E>
  [[nodiscard]] Nodes<T, I> nodes(const Tree<T, I>& tree, const E& /*executor*/) const {
    return Nodes<T, I>(tree);
  }
};
inline constexpr BinaryLayout<> binary{};

static_assert(Layout<BinaryNodes<float, std::uint32_t>>);

}  // namespace glint
