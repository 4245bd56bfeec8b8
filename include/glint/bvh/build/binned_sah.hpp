// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/build/binning.hpp>
#include <glint/bvh/build/deal.hpp>
#include <glint/bvh/build/grow.hpp>
#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The surface area heuristic over a few equally wide bins an axis: nearly the rays of a full sweep for a fraction of
/// the time. The default builder.
///
/// Cost:    O(n log n).
/// Threads: large nodes and subtrees in parallel; the same tree for every executor.
/// Source:  Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", Interactive Ray Tracing 2007.
struct BinnedSah {
  int bins = 16;                ///< an axis, in large nodes; clamped to 2 … 32
  float traversal_cost = 0.7F;  ///< of visiting an inner node …
  float intersection_cost = 1;  ///< … against testing a primitive
  std::size_t block_size = 4;   ///< primitives that a leaf tests at the price of one: a Bvh's Leaves::block_size
  std::size_t max_leaf_size = 8;
  int max_depth = 64;  ///< clamped to 0 … Tree::max_depth

  template <BoundedSet S, Executor E = Serial>
  [[nodiscard]] Tree<typename S::Scalar, typename S::Index> build(const S& set, const E& executor = {}) const;
};

namespace detail {

template <std::floating_point T>
class BinnedSplitter {
 public:
  BinnedSplitter(const BinnedSah& options, References<T>& references)
      : options_(options), references_(references), scratch_(references.size()) {}

  std::size_t max_leaf_size = 1;

  template <typename Executor>
  [[nodiscard]] std::optional<std::pair<Part<T>, Part<T>>> split(const Part<T>& part, std::size_t capacity,
                                                                 const Executor& executor) {
    const Binning<T> binning(part, options_.bins);
    const Bins<T> bins = filled<Bins<T>, T>(run(part), binning, executor);
    const BinPlane<T> plane =
        best_plane(bins.box, bins.count, bins.count, binning.bins, options_.block_size, part.count);
    if (part.count <= max_leaf_size && !pays(options_, part, plane.cost)) return std::nullopt;
    if (!plane.fits(capacity)) return halve<T>(run(part), part);
    return deal<T>(part, plane.left_count, CenterDealer<T>{binning, plane}, run(part), run(part, !part.in_scratch),
                   executor);
  }
  template <std::unsigned_integral I>
  void write(const Part<T>& part, I* order) noexcept {
    for (const Reference<T>& r : run(part)) *order++ = I(r.index());
  }

 private:
  [[nodiscard]] std::span<Reference<T>> run(const Part<T>& part) noexcept { return run(part, part.in_scratch); }
  [[nodiscard]] std::span<Reference<T>> run(const Part<T>& part, bool in_scratch) noexcept {
    return std::span(in_scratch ? scratch_ : references_).subspan(part.first, part.count);
  }

  BinnedSah options_;
  std::span<Reference<T>> references_;
  References<T> scratch_;
};

}  // namespace detail

template <BoundedSet S, Executor E>
Tree<typename S::Scalar, typename S::Index> BinnedSah::build(const S& set, const E& executor) const {
  using T = typename S::Scalar;
  return detail::grow_tree(
      set, executor,
      [this](detail::References<T>& r, const auto& /*root*/) { return detail::BinnedSplitter<T>(*this, r); },
      max_leaf_size, max_depth);
}

}  // namespace glint
