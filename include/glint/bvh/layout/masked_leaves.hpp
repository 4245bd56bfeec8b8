// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/filtered_leaves.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/set/masked.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Leaves of a masked set: passed over by rays that see nothing of them, tested in the way of the set itself by rays
/// that see all of them, and filtered where it takes a look at each primitive. A slot is a leaf.
template <typename Choice, PrimitiveSet S>
class MaskedLeaves {
 public:
  using Set = Masked<S>;
  using Scalar = typename Set::Scalar;
  using Index = typename Set::Index;

 private:
  using Filter = FilteredLeaves<Choice, Set>;
  /// Of the primitives of a leaf: bits that one has, and bits that all have.
  struct Bits {
    std::uint32_t some = 0;
    std::uint32_t every = ~std::uint32_t{0};
  };

 public:
  static constexpr std::size_t block_size = Filter::block_size;

  /// Renumbers the leaves of the tree: one slot each. Requires: a valid tree over the set.
  template <Executor E>
  MaskedLeaves(const Set& set, Tree<Scalar, Index>& tree, const E& executor) : leaves_(set, tree, executor) {
    for (const BinaryNode<Scalar, Index>& node : tree.nodes)
      if (node.is_leaf()) bits_.push_back(bits_of(set, {node.first, node.count}));
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE auto prepare(const Set& set, const Ray<Scalar>& ray) const {
    return leaves_.prepare(set, ray);
  }
  template <typename Prepared>
  GLINT_ALWAYS_INLINE bool closest(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared, Slots<Index> slots,
                                   Hit<Scalar, Index>& best) const {
    const Bits& bits = bits_[slots.first];
    if ((ray.mask & bits.some) == 0) return false;
    if ((ray.mask & bits.every) == 0) return leaves_.closest(set, ray, prepared, slots, best);
    return leaves_.unfiltered().closest(set.set(), ray, prepared, leaves_.unfiltered(slots), best);
  }
  template <typename Prepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE bool occluded(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                                  Slots<Index> slots) const {
    const Bits& bits = bits_[slots.first];
    if ((ray.mask & bits.some) == 0) return false;
    if ((ray.mask & bits.every) == 0) return leaves_.occluded(set, ray, prepared, slots);
    return leaves_.unfiltered().occluded(set.set(), ray, prepared, leaves_.unfiltered(slots));
  }
  template <typename F>
  GLINT_ALWAYS_INLINE Walk for_each_primitive(Slots<Index> slots, const F& f) const {
    return leaves_.for_each_primitive(slots, f);
  }
  template <typename Prepared, typename Sink>
  GLINT_ALWAYS_INLINE Walk for_each_hit(const Set& set, const Ray<Scalar>& ray, const Prepared& prepared,
                                        Slots<Index> slots, Sink& sink) const {
    if ((ray.mask & bits_[slots.first].some) == 0) return Walk::Continue;
    return leaves_.for_each_hit(set, ray, prepared, slots, sink);
  }
  template <typename Sink>
  GLINT_ALWAYS_INLINE void for_each_near(const Set& set, const Vec3<Scalar>& point, Slots<Index> slots,
                                         Sink& sink) const {
    leaves_.unfiltered().for_each_near(set.set(), point, leaves_.unfiltered(slots), sink);
  }
  /// Takes up where the primitives are, and their masks.
  [[nodiscard]] FittedLeaf<Scalar> refit(const Set& set, Slots<Index> slots) requires(requires(Filter& leaves) {
    leaves.refit(set, slots);
  }) {
    bits_[slots.first] = bits_of(set, slots);
    return leaves_.refit(set, slots);
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return leaves_.bytes() + bits_.size() * sizeof(Bits); }

 private:
  [[nodiscard]] Bits bits_of(const Set& set, Slots<Index> slots) const {
    Bits bits;
    leaves_.for_each_primitive(slots, [&](Index i) {
      bits.some |= set.mask(i);
      bits.every &= set.mask(i);
      return Walk::Continue;
    });
    return bits;
  }

  Filter leaves_;
  std::vector<Bits> bits_;
};

template <PrimitiveSet S, typename Choice, Executor E>
[[nodiscard]] MaskedLeaves<Choice, S> make_leaves(const Masked<S>& set,
                                                  Tree<typename S::Scalar, typename S::Index>& tree, Choice /*choice*/,
                                                  const E& executor) {
  return MaskedLeaves<Choice, S>(set, tree, executor);
}

}  // namespace glint
