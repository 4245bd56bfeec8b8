// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/math/constants.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Nodes of up to N children, whose boxes are stored plane by plane and tested at once.
template <std::floating_point T, std::unsigned_integral I, int N>
class WideNodes {
 public:
  using Scalar = T;
  using Index = I;
  static constexpr int width = N;

  WideNodes() = default;
  /// Each node takes the place of several binary ones: the largest inner child is opened until N children are there.
  ///
  /// Requires: a valid tree.
  explicit WideNodes(const Tree<T, I>& tree) {
    if (tree.nodes.empty()) return;
    const BinaryNode<T, I>& top = tree.nodes.front();
    root_ = {0, 0};
    is_empty_ = false;
    if (top.is_leaf()) {
      root_ = {top.first, top.count};
      return;
    }
    std::vector<Replacement> pending{{I(0), I(0)}};
    nodes_.resize(1);
    while (!pending.empty()) {
      const Replacement next = pending.back();
      pending.pop_back();
      replace(tree, next, pending);
    }
    nodes_.shrink_to_fit();
  }

  [[nodiscard]] bool empty() const noexcept { return is_empty_; }
  [[nodiscard]] Link<I> root() const noexcept { return root_; }
  [[nodiscard]] GLINT_ALWAYS_INLINE const BoxPack<T, N>& children(I node) const noexcept { return nodes_[node].boxes; }
  [[nodiscard]] GLINT_ALWAYS_INLINE const std::array<Link<I>, std::size_t(N)>& links(I node) const noexcept {
    return nodes_[node].links;
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return nodes_.size() * sizeof(Node); }

 private:
  struct alignas(std::min<std::size_t>(64, std::bit_floor(sizeof(BoxPack<T, N>)))) Node {
    BoxPack<T, N> boxes = empty_boxes();
    std::array<Link<I>, std::size_t(N)> links{};
  };
  /// A node of the binary tree, and the node here that takes its place.
  struct Replacement {
    I from = 0;
    I to = 0;
  };
  struct Children {
    std::array<I, std::size_t(N)> index{};
    int size = 0;
  };

  /// Puts the children in their places; those that are inner nodes wait to be replaced in turn.
  void replace(const Tree<T, I>& tree, Replacement next, std::vector<Replacement>& pending) {
    const Children children = opened(tree, next.from);
    for (int i = 0; i < children.size; ++i) {
      const I index = children.index[std::size_t(i)];
      const BinaryNode<T, I>& child = tree.nodes[index];
      if (child.is_leaf()) {
        place(nodes_[next.to], i, child.bounds, {child.first, child.count});
      } else {
        const auto to = I(nodes_.size());
        pending.push_back({index, to});
        place(nodes_[next.to], i, child.bounds, {to, 0});
        nodes_.emplace_back();
      }
    }
  }

  static BoxPack<T, N> empty_boxes() noexcept {
    const auto low = Pack<T, N>::broadcast(infinity<T>);
    const auto high = Pack<T, N>::broadcast(-infinity<T>);
    return {{low, low, low, high, high, high}};
  }
  static void place(Node& node, int i, const Aabb<T>& box, const Link<I>& link) noexcept {
    const std::array<T, 6> planes{box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z};
    for (std::size_t plane = 0; plane < 6; ++plane) node.boxes.planes[plane].set(i, planes[plane]);
    node.links[std::size_t(i)] = link;
  }
  [[nodiscard]] static Children opened(const Tree<T, I>& tree, I from) noexcept {
    Children children;
    children.index[0] = tree.nodes[from].first;
    children.index[1] = tree.nodes[from].first + 1;
    for (children.size = 2; children.size < N; ++children.size) {
      int largest = -1;
      T area = T(-1);
      for (int i = 0; i < children.size; ++i) {
        const BinaryNode<T, I>& child = tree.nodes[children.index[std::size_t(i)]];
        if (child.is_leaf() || !(half_area(child.bounds) > area)) continue;
        area = half_area(child.bounds);
        largest = i;
      }
      if (largest < 0) break;
      const I first = tree.nodes[children.index[std::size_t(largest)]].first;
      children.index[std::size_t(largest)] = first;
      children.index[std::size_t(children.size)] = first + 1;
    }
    return children;
  }

  std::vector<Node> nodes_;
  Link<I> root_;
  bool is_empty_ = true;
};

/// Names the layout, and the leaves that go with it: `Bvh{mesh, BinnedSah{}, wide<8, IndexedBlocks<4>>}`.
template <int N, typename LeafChoice = CopiedBlocks<4>>
struct WideLayout {
  using Leaves = LeafChoice;
  template <std::floating_point T, std::unsigned_integral I>
  using Nodes = WideNodes<T, I, N>;
};
template <int N, typename LeafChoice = CopiedBlocks<4>>
inline constexpr WideLayout<N, LeafChoice> wide{};

static_assert(Layout<WideNodes<float, std::uint32_t, 8>>);

}  // namespace glint
