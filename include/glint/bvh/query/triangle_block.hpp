// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include <glint/bvh/concepts.hpp>
#include <glint/core/config.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_triangle_pack.hpp>
#include <glint/math/constants.hpp>
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

/// Vertices of triangles, looked up; NaNs where there is none.
template <std::floating_point T, int N, typename Mesh, typename Indices>
[[nodiscard]] auto gathered_vertices(const Mesh& mesh, const Indices& primitives) noexcept {
  return [&](int i, int axis) {
    return Pack<T, N>::generate([&](int lane) {
      const auto primitive = primitives[std::size_t(lane)];
      if (primitive == none<typename Mesh::Index>) return std::numeric_limits<T>::quiet_NaN();
      return component(mesh.vertices(primitive)[std::size_t(i)], axis);
    });
  };
}

template <typename P>
[[nodiscard]] GLINT_ALWAYS_INLINE P squared_length(const Pack3<P>& v) noexcept {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}
template <typename P>
[[nodiscard]] GLINT_ALWAYS_INLINE P product(const Pack3<P>& a, const Pack3<P>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// From the point at `from` to the way's closest point: `along` is where that would be on an endless line.
template <typename P>
[[nodiscard]] GLINT_ALWAYS_INLINE P squared_to_segment(const Pack3<P>& from, const Pack3<P>& way, const P& along,
                                                       const P& zero, const P& one) noexcept {
  const P t = min(max(along, zero), one);
  return squared_length(Pack3<P>{from[0] - way[0] * t, from[1] - way[1] * t, from[2] - way[2] * t});
}

/// Squared distances from a point to triangles, as closest_point of one has it; without meaning for those without area.
template <std::floating_point T, int N, typename Vertex>
[[nodiscard]] GLINT_ALWAYS_INLINE Pack<T, N> squared_distances(const Vec3<T>& point, const Vertex& vertex) noexcept {
  using P = Pack<T, N>;
  const Pack3<P> a = corner<P>(vertex, 0);
  const Pack3<P> ab = minus(corner<P>(vertex, 1), a);
  const Pack3<P> ac = minus(corner<P>(vertex, 2), a);
  const Pack3<P> bc = minus(ac, ab);
  const Pack3<P> ap = minus(in_all_lanes<P>(point), a);
  const Pack3<P> bp = minus(ap, ab);
  const P zero = P::broadcast(T(0));
  const P one = P::broadcast(T(1));
  const P per_base = one / squared_length(ab);
  const P along = product(ab, ap) * per_base;
  P least = squared_to_segment(ap, ab, along, zero, one);
  least = min(squared_to_segment(ap, ac, product(ac, ap) / squared_length(ac), zero, one), least);
  least = min(squared_to_segment(bp, bc, product(bp, bc) / squared_length(bc), zero, one), least);
  const P skew = product(ab, ac) * per_base;
  const Pack3<P> height{ac[0] - ab[0] * skew, ac[1] - ab[1] * skew, ac[2] - ab[2] * skew};
  const Pack3<P> rest{ap[0] - ab[0] * along, ap[1] - ab[1] * along, ap[2] - ab[2] * along};
  const P up = product(height, rest) / squared_length(height);
  const std::uint32_t inside = less(zero, min(up, along - skew * up)) & less(along + (one - skew) * up, one);
  if (inside == 0) return least;
  const P within =
      squared_length(Pack3<P>{rest[0] - height[0] * up, rest[1] - height[1] * up, rest[2] - height[2] * up});
  return select(inside, min(within, least), least);
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

namespace detail {

/// The hit that a block found in a lane. A ray through an edge is decided by the mesh.
template <typename Block, typename Mesh, std::floating_point T, typename Prepared, typename Found>
[[nodiscard]] GLINT_ALWAYS_INLINE std::optional<Hit<T, typename Block::Index>> hit_in_lane(
    const Block& block, const Mesh& mesh, const Ray<T>& ray, const Prepared& prepared, const Found& c, int lane) {
  if ((c.tied >> lane & 1U) != 0) return mesh.intersect(ray, prepared.single, block.primitive(lane));
  const T scale = T(1) / c.det[lane];
  return Hit<T, typename Block::Index>{
      .t = c.t[lane], .uv = {c.w1[lane] * scale, c.w2[lane] * scale}, .primitive = block.primitive(lane)};
}

}  // namespace detail

/// Shows the hits in blocks to a sink, as leaves.hpp has it.
template <typename Block, typename Mesh, std::floating_point T, typename Prepared, typename Sink>
GLINT_ALWAYS_INLINE Walk for_each_hit_in_blocks(std::span<const Block> blocks, const Mesh& mesh, const Ray<T>& ray,
                                                const Prepared& prepared, Sink& sink) {
  for (const Block& block : blocks) {
    const auto c = block.cross(mesh, prepared.packed, std::min(ray.t_max, sink.limit()));
    for (std::uint32_t mask = c.hit | c.tied; mask != 0; mask &= mask - 1) {
      const int lane = std::countr_zero(mask);
      if (!block.holds(lane)) continue;
      const auto hit = detail::hit_in_lane(block, mesh, ray, prepared, c, lane);
      if (hit && sink(*hit) == Walk::Stop) return Walk::Stop;
    }
  }
  return Walk::Continue;
}

/// Shows a sink the triangles whose squared distance from a point is at most its limit, or may be by rounding.
template <typename Block, typename Mesh, std::floating_point T, typename Sink>
GLINT_ALWAYS_INLINE void for_each_near_in_blocks(std::span<const Block> blocks, const Mesh& mesh, const Vec3<T>& point,
                                                 Sink& sink) {
  constexpr int lanes = Block::Test::P::size;
  constexpr T stretch = T(1) + rounding_bound<T>(32);
  for (const Block& block : blocks) {
    const auto squared = block.with_vertices(
        mesh, [&](const auto& vertex) { return detail::squared_distances<T, lanes>(point, vertex); });
    std::uint32_t mask = less_equal(squared, Pack<T, lanes>::broadcast(sink.limit() * stretch));
    for (; mask != 0; mask &= mask - 1) {
      const int lane = std::countr_zero(mask);
      if (block.holds(lane) && squared[lane] <= sink.limit() * stretch) sink(block.primitive(lane));
    }
  }
}

}  // namespace glint
