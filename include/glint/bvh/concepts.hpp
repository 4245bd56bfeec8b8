// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Makes a tree over the boxes of a set.
///
/// Laws (testing/builder_laws.hpp): the tree is valid, and the same for every executor.
template <typename B, typename S>
concept BuilderFor = BoundedSet<S> && requires(const B& builder, const S& set, const Serial& executor) {
  { builder.build(set, executor) } -> std::same_as<Tree<typename S::Scalar, typename S::Index>>;
};

/// A run of leaf slots. Slots are an affair of `bvh/`: nobody outside sees one.
template <std::unsigned_integral I>
struct Slots {
  I first = 0;
  I count = 0;
};

/// Where a child is: an inner node of a layout, or a run of slots.
template <std::unsigned_integral I>
struct Link {
  I first = 0;  ///< the inner node, or the first slot
  I count = 0;  ///< 0: an inner node; else the number of slots

  [[nodiscard]] constexpr bool is_leaf() const noexcept { return count != 0; }
  [[nodiscard]] constexpr Slots<I> slots() const noexcept { return {first, count}; }
  [[nodiscard]] friend bool operator==(const Link&, const Link&) noexcept = default;
};

/// The boxes of N siblings, plane by plane: lower x, y, z, then upper x, y, z. A missing child is an empty box.
template <std::floating_point T, int N>
struct BoxPack {
  std::array<Pack<T, N>, 6> planes;

  [[nodiscard]] GLINT_ALWAYS_INLINE const Pack<T, N>& plane(std::size_t i) const noexcept { return planes[i]; }
};

/// A tree transcoded for traversal: nodes of up to `width` children.
///
///     int width                              // a power of two
///     Link<I> root()                         // a leaf of a tree with one node; requires: not empty()
///     BoxPack<T, width> children(I node)     // a value where boxes are decoded, a reference where they are stored
///     auto links(I node)                     // links(node)[i] -> Link<I>; a missing child's is a leaf that there is,
///                                            // for a ray of infinities may enter its empty box
///
/// Ensures: no path from the root is longer than Tree::max_depth.
template <typename L>
concept Layout = requires(const L& layout, typename L::Index node) {
  typename L::Scalar;
  { L::width } -> std::convertible_to<int>;
  { layout.empty() } -> std::same_as<bool>;
  { layout.root() } -> std::same_as<Link<typename L::Index>>;
  { layout.children(node) } -> std::convertible_to<const BoxPack<typename L::Scalar, L::width>&>;
  { layout.links(node)[std::size_t{}] } -> std::convertible_to<Link<typename L::Index>>;
};

/// The choice of a layout, handed to a Bvh: `binary`, `wide<8>`. It names the layout for any scalar and index, makes it
/// of a tree, the same for every executor, and names how the primitives in the leaves are kept (leaves.hpp).
template <typename C>
concept LayoutChoice = requires(const C& choice, const Tree<float, std::uint32_t>& tree, const Serial& executor) {
  typename C::template Nodes<float, std::uint32_t>;
  typename C::Leaves;
  {
    choice.template nodes<float, std::uint32_t>(tree, executor)
    } -> std::same_as<typename C::template Nodes<float, std::uint32_t>>;
};

/// Which children a query wants to see, one bit each, and the key by which it wants to see the smallest first.
template <std::floating_point T, int N>
struct Entered {
  std::uint32_t mask = 0;
  Pack<T, N> key;
};

/// A question asked of a tree.
///
///     Entered<T, N> enter(const BoxPack<T, N>&)   // the children that may matter
///     T limit()                                   // a child whose key is larger no longer matters
///     bool ordered                                // whether small keys first pays; else limit() is never asked
///
/// A leaf may shrink what `enter` lets pass and what `limit` returns, never widen it.
template <typename Q, typename T, int N>
concept QueryFor = requires(const Q& query, const BoxPack<T, N>& boxes) {
  { query.enter(boxes) } -> std::same_as<Entered<T, N>>;
  { query.limit() } -> std::same_as<T>;
  { Q::ordered } -> std::convertible_to<bool>;
};

/// Whether a visitor of leaves wants more of them.
enum class Walk { Continue, Stop };

}  // namespace glint
