// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <utility>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/morton.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/bvh/pass/merge_leaves.hpp>
#include <glint/bvh/pass/reinsert.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint {

/// What a tree is built for.
enum class Quality {
  Fast,      ///< a few rays, or geometry that changes from picture to picture
  Balanced,  ///< most uses: what a Bvh does unless told otherwise
  Best,      ///< many rays over the same geometry
};

/// The builder, and the passes after it, that suit a quality.
///
/// Cost:    Fast takes about two fifths of the time of Balanced, for rays that take about a tenth longer; Best two to
///          five times the time of Balanced, the more the more boxes overlap.
/// Threads: the same tree for every executor.
struct QualityBuilder {
  Quality quality = Quality::Balanced;
  std::size_t block_size = 4;  ///< primitives that a leaf tests at the price of one: a Bvh's Leaves::block_size

  template <BoundedSet S, Executor E = Serial>
  [[nodiscard]] Tree<typename S::Scalar, typename S::Index> build(const S& set, const E& executor = {}) const {
    if (quality == Quality::Fast) return Morton{.block_size = block_size}.build(set, executor);
    if (quality == Quality::Balanced) return BinnedSah{.block_size = block_size}.build(set, executor);
    return merge_leaves(reinsert(SpatialSah{.block_size = block_size}.build(set, executor), {}, executor),
                        {.block_size = block_size});
  }
};

/// A Bvh over a set, by a builder that suits the quality and leaves of this layout.
///
///     const auto bvh = glint::build(mesh, glint::Quality::Best, executor);
///
/// The set is kept by value: where it is a view, what it views must outlive the Bvh, unchanged.
template <PrimitiveSet S, Executor E = Serial, LayoutChoice LayoutName = WideLayout<8>>
[[nodiscard]] Bvh<S, LayoutName> build(S set, Quality quality = Quality::Balanced, const E& executor = {},
                                       LayoutName layout = {}) {
  const QualityBuilder builder{.quality = quality, .block_size = Bvh<S, LayoutName>::Leaves::block_size};
  return Bvh<S, LayoutName>(std::move(set), builder, executor, layout);
}

}  // namespace glint
