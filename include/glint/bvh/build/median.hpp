// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/build/grow.hpp>
#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint {
namespace detail {

template <std::floating_point T>
struct MedianSplitter {
  std::span<Reference<T>> references;
  std::size_t max_leaf_size = 1;

  template <typename Executor>
  [[nodiscard]] std::optional<std::pair<Part<T>, Part<T>>> split(const Part<T>& part, std::size_t /*capacity*/,
                                                                 const Executor& /*executor*/) const {
    if (part.count <= max_leaf_size) return std::nullopt;
    return halve<T>(references.subspan(part.first, part.count), part);
  }
  template <std::unsigned_integral I>
  void write(const Part<T>& part, I* order) const noexcept {
    for (const Reference<T>& r : references.subspan(part.first, part.count)) *order++ = I(r.index());
  }
};

}  // namespace detail

/// Halves the primitives by count along the longest axis of their centers: simple, balanced, and blind to areas. Rays
/// take about a third longer than with a surface area heuristic.
///
/// Cost:    O(n log n).
/// Threads: subtrees in parallel; the same tree for every executor.
struct Median {
  std::size_t max_leaf_size = 4;  ///< more where `max_depth` leaves no room; 0 counts as 1
  int max_depth = 64;             ///< clamped to 0 … Tree::max_depth

  template <BoundedSet S, Executor E = Serial>
  [[nodiscard]] Tree<typename S::Scalar, typename S::Index> build(const S& set, const E& executor = {}) const {
    using T = typename S::Scalar;
    return detail::grow_tree(
        set, executor, [](detail::References<T>& r, const auto& /*root*/) { return detail::MedianSplitter<T>{r}; },
        max_leaf_size, max_depth);
  }
};

}  // namespace glint
