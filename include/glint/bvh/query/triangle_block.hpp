// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glint/bvh/concepts.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {
namespace detail {

/// The boxes of triangles given as for PackedTest.
template <std::floating_point T, int N, typename Vertex>
[[nodiscard]] GLINT_ALWAYS_INLINE BoxPack<T, N> boxes_of(const Vertex& vertex) noexcept {
  BoxPack<T, N> boxes;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = std::size_t(axis);
    boxes.planes[at] = min(min(vertex(0, axis), vertex(1, axis)), vertex(2, axis));
    boxes.planes[at + 3] = max(max(vertex(0, axis), vertex(1, axis)), vertex(2, axis));
  }
  return boxes;
}

template <std::floating_point T>
[[nodiscard]] Aabb<T> box_of(const std::array<Vec3<T>, 3>& vertices) noexcept {
  Aabb<T> box;
  for (const Vec3<T>& v : vertices) extend(box, v);
  return box;
}

}  // namespace detail

/// Shows the triangles of blocks to `f(Index) -> Walk`.
template <typename Block, typename F>
GLINT_ALWAYS_INLINE Walk for_each_in_blocks(std::span<const Block> blocks, const F& f) {
  for (const Block& block : blocks)
    for (int lane = 0; lane < Block::Test::P::size && block.holds(lane); ++lane)
      if (f(block.primitive(lane)) == Walk::Stop) return Walk::Stop;
  return Walk::Continue;
}

/// Shows the hits in blocks to a sink, as leaves.hpp has it. Rays through edges are decided by the mesh.
template <typename Block, typename Mesh, std::floating_point T, typename Prepared, typename Sink>
GLINT_ALWAYS_INLINE Walk for_each_hit_in_blocks(std::span<const Block> blocks, const Mesh& mesh, const Ray<T>& ray,
                                                const Prepared& prepared, Sink& sink) {
  for (const Block& block : blocks) {
    const auto c = block.cross(mesh, prepared.packed, std::min(ray.t_max, sink.limit()));
    for (std::uint32_t mask = c.hit | c.tied; mask != 0; mask &= mask - 1) {
      const int lane = std::countr_zero(mask);
      if (!block.holds(lane)) continue;
      std::optional<Hit<T, typename Block::Index>> hit;
      if ((c.tied >> lane & 1U) != 0) {
        hit = mesh.intersect(ray, prepared.single, block.primitive(lane));
      } else {
        const T scale = T(1) / c.det[lane];
        hit = {.t = c.t[lane], .uv = {c.w1[lane] * scale, c.w2[lane] * scale}, .primitive = block.primitive(lane)};
      }
      if (hit && sink(*hit) == Walk::Stop) return Walk::Stop;
    }
  }
  return Walk::Continue;
}

}  // namespace glint
