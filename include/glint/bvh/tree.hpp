// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glint/geometry/aabb.hpp>

namespace glint {

/// A node of a binary tree of boxes: 32 bytes for `float`.
///
/// `count` = 0: an inner node with the children `first` and `first + 1`. Otherwise a leaf of the slots
/// [first, first + count) of the tree's order.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
struct BinaryNode {
  Aabb<T> bounds{};
  I first = 0;
  I count = 0;

  [[nodiscard]] constexpr bool is_leaf() const noexcept { return count != 0; }
  [[nodiscard]] friend bool operator==(const BinaryNode&, const BinaryNode&) noexcept = default;
};
static_assert(sizeof(BinaryNode<float>) == 32);

/// A hierarchy of boxes over somebody's primitives, which it knows by index alone: what builders make, passes improve
/// and layouts transcode. Where a builder cuts primitives, the parts of one may be in several leaves.
///
/// Laws: pass/validate.hpp.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
struct Tree {
  using Scalar = T;
  using Index = I;
  /// No leaf lies further than this many steps below the root: it sizes the stack of every traversal.
  static constexpr int max_depth = 64;

  std::vector<BinaryNode<T, I>> nodes{};  ///< the root first; none for an empty set
  std::vector<I> order{};                 ///< slot → the caller's index
  int depth = 0;                          ///< steps from the root to the deepest leaf
  std::size_t left_out = 0;               ///< primitives without a finite, non-empty box: no ray can hit them

  [[nodiscard]] friend bool operator==(const Tree&, const Tree&) = default;
};

}  // namespace glint
