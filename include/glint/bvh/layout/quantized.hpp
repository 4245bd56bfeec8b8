// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/collapse.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/uninitialized.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {
namespace detail {

/// 256 marks along an axis, the first at the origin, a power of two apart: a multiple of the spacing is exact, so a
/// mark is rounded once, with and without fused operations.
template <std::floating_point T>
struct Ruler {
  static_assert(std::numeric_limits<T>::is_iec559 && sizeof(T) <= 8);
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  using Exponent = std::conditional_t<sizeof(T) == 4, std::uint8_t, std::uint16_t>;  // as the number's bits have it
  static constexpr int mantissa_bits = std::numeric_limits<T>::digits - 1;

  T origin = 0;
  Exponent exponent = 1;

  /// The finest that reaches from `lower` to `upper`. Requires: lower ≤ upper, both finite.
  [[nodiscard]] static Ruler over(T lower, T upper) noexcept {
    const T wanted = std::abs(upper * T(0.5) - lower * T(0.5)) / T(127.5);  // for −0 − 0 has a sign
    Ruler ruler{lower, Exponent(std::max<Bits>(1, std::bit_cast<Bits>(wanted) >> mantissa_bits))};
    const auto reaches = [&] {  // halved, too, for a multiple may be too large for a number
      return ruler.mark(255) >= upper && lower * T(0.5) + T(127.5) * spacing(ruler.exponent) >= upper * T(0.5);
    };
    while (!reaches()) ++ruler.exponent;
    return ruler;
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE static T spacing(Exponent exponent) noexcept {
    return std::bit_cast<T>(Bits(exponent) << mantissa_bits);
  }
  /// Multiples of the spacing are too large for numbers: just the ends are sure to be told apart.
  [[nodiscard]] bool is_endless() const noexcept { return T(255) * spacing(exponent) > std::numeric_limits<T>::max(); }
  [[nodiscard]] T mark(int i) const noexcept { return origin + T(i) * spacing(exponent); }

  /// The last mark not above x. Requires: x ≥ origin.
  [[nodiscard]] std::uint8_t at_or_below(T x) const noexcept {
    if (is_endless()) return 0;
    int i = near(x);
    while (i > 0 && mark(i) > x) --i;
    while (i < 255 && mark(i + 1) <= x) ++i;
    return std::uint8_t(i);
  }
  /// The first mark not below x. Requires: there is one.
  [[nodiscard]] std::uint8_t at_or_above(T x) const noexcept {
    if (is_endless()) return 255;
    int i = near(x);
    while (mark(i) < x) ++i;
    while (i > 0 && mark(i - 1) >= x) --i;
    return std::uint8_t(i);
  }

 private:
  [[nodiscard]] int near(T x) const noexcept { return int(std::min((x - origin) / spacing(exponent), T(255))); }
};

}  // namespace detail

/// Nodes of up to N children, whose boxes are rounded outward to 256 marks an axis of the box around them: 96 bytes for
/// eight, where plain boxes take 256.
///
/// Ensures: a child's box holds what it held, and is less than a mark larger on each side: a power of two between
///          1/255 and 2/255 of the node's extent, or what numbers there can tell apart. Along an axis on which a node
///          is about as long as there are numbers, its children are as long.
/// Source:  Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017,
///          section 3.2. Links are stored one by one, for leaves keep the order that their set wants.
template <std::floating_point T, std::unsigned_integral I, int N>
class QuantizedNodes {
  /// Four bits of count over the rest of `first`; a count of 15 refers to a list of what does not fit.
  static constexpr I count_bits = 4;
  static constexpr I far = (I(1) << count_bits) - 1;
  static constexpr I first_end = std::numeric_limits<I>::max() >> count_bits;

  using Ruler = detail::Ruler<T>;
  struct alignas(32) Node {
    std::array<T, 3> origin;
    std::array<typename Ruler::Exponent, 3> exponent;
    std::array<std::array<std::uint8_t, std::size_t(N)>, 6> marks;  // as the planes of a BoxPack
    std::array<I, std::size_t(N)> links;
  };

 public:
  using Scalar = T;
  using Index = I;
  static constexpr int width = N;

  /// Decodes the planes that are asked for. Those of a missing child are the node's own, swapped, which rays from afar
  /// may take for a box; in the whole BoxPack they are an empty one.
  class Boxes {
   public:
    explicit Boxes(const Node& node) noexcept : node_(node) {}
    [[nodiscard]] GLINT_ALWAYS_INLINE Pack<T, N> plane(std::size_t i) const noexcept {
      const std::size_t axis = i < 3 ? i : i - 3;
      const auto spacing = Pack<T, N>::broadcast(Ruler::spacing(node_.exponent[axis]));
      return Pack<T, N>::broadcast(node_.origin[axis]) + marks(i) * spacing;
    }
    GLINT_ALWAYS_INLINE operator BoxPack<T, N>() const noexcept {
      BoxPack<T, N> boxes;
      for (std::size_t i = 0; i < 6; ++i) {
        const auto missing = Pack<T, N>::broadcast(i < 3 ? infinity<T> : -infinity<T>);
        boxes.planes[i] = where_less_equal(marks(0), marks(3), plane(i), missing);
      }
      return boxes;
    }

   private:
    [[nodiscard]] GLINT_ALWAYS_INLINE Pack<T, N> marks(std::size_t i) const noexcept {
      return Pack<T, N>::load(node_.marks[i].data());
    }
    const Node& node_;
  };
  /// Decodes the link that is asked for.
  class Links {
   public:
    Links(const std::array<I, std::size_t(N)>& packed, const std::vector<Link<I>>& far_links) noexcept
        : packed_(packed), far_links_(far_links) {}
    [[nodiscard]] GLINT_ALWAYS_INLINE Link<I> operator[](std::size_t i) const noexcept {
      const Link<I> link{packed_[i] >> count_bits, packed_[i] & far};
      return link.count == far ? far_links_[link.first] : link;
    }

   private:
    const std::array<I, std::size_t(N)>& packed_;
    const std::vector<Link<I>>& far_links_;
  };

  QuantizedNodes() = default;
  /// Requires: a valid tree; fewer than 2²⁸ nodes here where I has 32 bits.
  /// Ensures:  the same nodes for every executor.
  template <Executor E = Serial>
  explicit QuantizedNodes(const Tree<T, I>& tree, Collapse how = Collapse::Optimal, const E& executor = {})
      : root_(detail::root_of(tree)), is_empty_(tree.nodes.empty()) {
    if (is_empty_ || root_.is_leaf()) return;
    for (const BinaryNode<T, I>& node : tree.nodes)
      if (node.is_leaf() && !fits({node.first, node.count})) far_links_.push_back({node.first, node.count});
    std::sort(far_links_.begin(), far_links_.end(), before);
    collapse<N>(
        tree, how, executor, [this](std::size_t count) { nodes_.resize(count); },
        [this](I at, const Aabb<T>& bounds, Children children) { write(nodes_[at], bounds, children); });
  }

  [[nodiscard]] bool empty() const noexcept { return is_empty_; }
  [[nodiscard]] Link<I> root() const noexcept { return root_; }
  [[nodiscard]] GLINT_ALWAYS_INLINE Boxes children(I node) const noexcept { return Boxes(nodes_[node]); }
  [[nodiscard]] GLINT_ALWAYS_INLINE Links links(I node) const noexcept { return {nodes_[node].links, far_links_}; }
  [[nodiscard]] std::size_t child_count(I node) const noexcept {
    const auto& marks = nodes_[node].marks;
    std::size_t count = std::size_t(N);
    while (count > 0 && marks[0][count - 1] > marks[3][count - 1]) --count;
    return count;
  }
  /// New boxes for the children of a node. One in which nothing is left becomes a point.
  void refit(I node, const Aabb<T>& bounds, std::span<const WideChild<T, I>> children) noexcept {
    const Aabb<T> around = is_empty(bounds) ? Aabb<T>{Vec3<T>(T(0)), Vec3<T>(T(0))} : bounds;
    std::array<WideChild<T, I>, std::size_t(N)> whole;
    for (std::size_t i = 0; i != children.size(); ++i) {
      whole[i] = children[i];
      if (is_empty(whole[i].bounds)) whole[i].bounds = {around.lower, around.lower};
    }
    write(nodes_[node], around, std::span<const WideChild<T, I>>(whole.data(), children.size()));
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return nodes_.size() * sizeof(Node) + far_links_.size() * sizeof(Link<I>);
  }

 private:
  using Children = std::span<const WideChild<T, I>>;

  [[nodiscard]] static bool fits(const Link<I>& link) noexcept { return link.count < far && link.first <= first_end; }
  [[nodiscard]] static bool before(const Link<I>& a, const Link<I>& b) noexcept { return a.first < b.first; }
  [[nodiscard]] I packed(const Link<I>& link) const noexcept {
    if (fits(link)) return I(link.first << count_bits) | link.count;
    const auto at = std::lower_bound(far_links_.begin(), far_links_.end(), link, before) - far_links_.begin();
    return I(I(at) << count_bits) | far;
  }

  void write(Node& node, const Aabb<T>& bounds, Children children) const noexcept {
    node.links.fill(packed({0, 1}));
    for (std::size_t i = 0; i != children.size(); ++i) node.links[i] = packed(children[i].link);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto of = [axis](const Vec3<T>& v) { return component(v, int(axis)); };
      const Ruler ruler = Ruler::over(of(bounds.lower), of(bounds.upper));
      node.origin[axis] = ruler.origin;
      node.exponent[axis] = ruler.exponent;
      node.marks[axis].fill(255);
      node.marks[axis + 3].fill(0);
      for (std::size_t i = 0; i != children.size(); ++i) {
        const std::uint8_t upper = ruler.at_or_above(of(children[i].bounds.upper));
        node.marks[axis][i] = std::min(ruler.at_or_below(of(children[i].bounds.lower)), upper);  // marks may coincide
        node.marks[axis + 3][i] = upper;
      }
    }
  }

  UninitializedVector<Node> nodes_;
  std::vector<Link<I>> far_links_;  // by `first`
  Link<I> root_;
  bool is_empty_ = true;
};

/// Names the layout, and the leaves that go with it: `Bvh{mesh, BinnedSah{}, quantized<8>}`. Both are small.
/// `Lanes` tells units apart that are built for different registers: what they make has names of its own.
template <int N, typename LeafChoice = IndexedBlocks<4>, int Lanes = register_lanes<float>>
struct QuantizedLayout {
  using Leaves = LeafChoice;
  template <std::floating_point T, std::unsigned_integral I>
  using Nodes = QuantizedNodes<T, I, N>;

  Collapse collapse = Collapse::Optimal;

  template <std::floating_point T, std::unsigned_integral I, Executor E>
  [[nodiscard]] Nodes<T, I> nodes(const Tree<T, I>& tree, const E& executor) const {
    return Nodes<T, I>(tree, collapse, executor);
  }
};
template <int N, typename LeafChoice = IndexedBlocks<4>>
inline constexpr QuantizedLayout<N, LeafChoice> quantized{};

static_assert(Layout<QuantizedNodes<float, std::uint32_t, 8>>);

}  // namespace glint
