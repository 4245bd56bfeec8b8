// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The triangles of a mesh, copied in the order of the leaves into blocks of N that are tested at once, by the same
/// arithmetic as Watertight, to the last bit. What a block cannot decide, a ray through an edge, it asks the mesh for.
///
/// Source: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
template <std::floating_point T, std::unsigned_integral VertexIndex, int N = 4>
class TriangleBlocks {
 public:
  using Mesh = TriangleMesh<T, VertexIndex, Watertight>;
  using Index = typename Mesh::Index;
  static constexpr std::size_t block_size = std::size_t(N);

  /// Renumbers the leaves of the tree by blocks. Requires: a valid tree over the mesh.
  TriangleBlocks(const Mesh& mesh, Tree<T, Index>& tree) {
    std::size_t count = 0;
    for (const BinaryNode<T, Index>& node : tree.nodes) count += blocks_for(node.count);
    blocks_.resize(count);
    std::size_t next = 0;
    for (BinaryNode<T, Index>& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      for (std::size_t i = 0; i < node.count; ++i) place(mesh, next + i / N, int(i % N), tree.order[node.first + i]);
      node.first = Index(next);
      node.count = Index(blocks_for(node.count));
      next += node.count;
    }
  }

  /// A ray, its axes permuted as in Watertight::Prepared, in all lanes.
  struct Prepared {
    Watertight::Prepared<T> shear;
    Pack<T, N> x, y, z;  ///< of the origin
    Pack<T, N> shear_x, shear_y, scale_z;
    Pack<T, N> t_min;
  };

  [[nodiscard]] GLINT_ALWAYS_INLINE Prepared prepare(const Mesh& mesh, const Ray<T>& ray) const noexcept {
    const Watertight::Prepared<T> shear = mesh.prepare(ray);
    const std::array<T, 3> origin{ray.origin.x, ray.origin.y, ray.origin.z};
    const auto all = [](T value) { return Pack<T, N>::broadcast(value); };
    return {shear,
            all(origin[std::size_t(shear.x)]),
            all(origin[std::size_t(shear.y)]),
            all(origin[std::size_t(shear.z)]),
            all(shear.shear_x),
            all(shear.shear_y),
            all(shear.scale_z),
            all(ray.t_min)};
  }

  GLINT_ALWAYS_INLINE bool closest(const Mesh& mesh, const Ray<T>& ray, const Prepared& prepared, Slots<Index> slots,
                                   Hit<T, Index>& best) const noexcept {
    const Index before = best.primitive;
    const T t_before = best.t;
    for (std::size_t i = slots.first; i != std::size_t(slots.first) + slots.count; ++i) {
      const Block& block = blocks_[i];
      const Crossings c = cross(block, prepared);
      if (c.inside == 0) continue;
      std::uint32_t mask = c.inside & ~c.tied & in_interval(c, prepared, best.t);
      for (; mask != 0; mask &= mask - 1) {
        const int lane = std::countr_zero(mask);
        consider(hit_at(block, c, lane), best);
      }
      for (mask = c.inside & c.tied; mask != 0; mask &= mask - 1) {
        const auto hit = mesh.intersect(ray, prepared.shear, block.primitive[std::size_t(std::countr_zero(mask))]);
        if (hit) consider(*hit, best);
      }
    }
    return best.primitive != before || best.t != t_before;
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE bool occluded(const Mesh& mesh, const Ray<T>& ray, const Prepared& prepared,
                                                  Slots<Index> slots) const noexcept {
    for (std::size_t i = slots.first; i != std::size_t(slots.first) + slots.count; ++i) {
      const Block& block = blocks_[i];
      const Crossings c = cross(block, prepared);
      if (c.inside == 0) continue;
      if ((c.inside & ~c.tied & in_interval(c, prepared, ray.t_max)) != 0) return true;
      for (std::uint32_t mask = c.inside & c.tied; mask != 0; mask &= mask - 1)
        if (mesh.intersect(ray, prepared.shear, block.primitive[std::size_t(std::countr_zero(mask))])) return true;
    }
    return false;
  }

  [[nodiscard]] std::size_t bytes() const noexcept { return blocks_.size() * sizeof(Block); }

 private:
  struct Block {
    std::array<std::array<Pack<T, N>, 3>, 3> vertex = nowhere();  // [vertex][axis]
    std::array<Index, std::size_t(N)> primitive = nobody();
  };
  /// Where the ray crosses the planes of a block's triangles. Where `tied`, rounded areas do not tell the side.
  struct Crossings {
    std::uint32_t inside = 0;
    std::uint32_t tied = 0;
    Pack<T, N> t, det, v, w;
  };
  struct Projected {
    Pack<T, N> x, y, z;
  };

  static std::array<std::array<Pack<T, N>, 3>, 3> nowhere() noexcept {
    std::array<std::array<Pack<T, N>, 3>, 3> vertices;
    for (auto& vertex : vertices) vertex.fill(Pack<T, N>::broadcast(std::numeric_limits<T>::quiet_NaN()));
    return vertices;
  }
  static std::array<Index, std::size_t(N)> nobody() noexcept {
    std::array<Index, std::size_t(N)> indices;
    indices.fill(none<Index>);
    return indices;
  }
  [[nodiscard]] static constexpr std::size_t blocks_for(std::size_t count) noexcept {
    return (count + std::size_t(N) - 1) / std::size_t(N);
  }
  /// A triangle without area stays out: a lane of NaNs is never hit.
  void place(const Mesh& mesh, std::size_t block, int lane, Index primitive) noexcept {
    const std::array<Vec3<T>, 3> v = mesh.vertices(primitive);
    if (is_degenerate(v[0], v[1], v[2])) return;
    for (std::size_t i = 0; i < 3; ++i) {
      blocks_[block].vertex[i][0].set(lane, v[i].x);
      blocks_[block].vertex[i][1].set(lane, v[i].y);
      blocks_[block].vertex[i][2].set(lane, v[i].z);
    }
    blocks_[block].primitive[std::size_t(lane)] = primitive;
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE static Projected project(const std::array<Pack<T, N>, 3>& vertex,
                                                             const Prepared& ray) noexcept {
    const Pack<T, N> z = vertex[std::size_t(ray.shear.z)] - ray.z;
    return {(vertex[std::size_t(ray.shear.x)] - ray.x) - fenced(ray.shear_x * z),
            (vertex[std::size_t(ray.shear.y)] - ray.y) - fenced(ray.shear_y * z), z};
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE static Crossings cross(const Block& block, const Prepared& ray) noexcept {
    const Projected a = project(block.vertex[0], ray);
    const Projected b = project(block.vertex[1], ray);
    const Projected c = project(block.vertex[2], ray);
    // Fenced, a difference is zero just where the rounded products tie.
    const Pack<T, N> u = fenced(c.x * b.y) - fenced(c.y * b.x);
    const Pack<T, N> v = fenced(a.x * c.y) - fenced(a.y * c.x);
    const Pack<T, N> w = fenced(b.x * a.y) - fenced(b.y * a.x);
    const Pack<T, N> zero = Pack<T, N>::broadcast(T(0));
    const Pack<T, N> least = min(min(u, v), w);
    const Pack<T, N> most = max(max(u, v), w);
    Crossings result;
    result.inside = less_equal(zero, least) | less_equal(most, zero);
    if (result.inside == 0) return result;
    result.tied = ~(less(zero, least) | less(most, zero));
    result.det = u + v + w;
    result.t = (fenced(u * a.z) + fenced(v * b.z) + fenced(w * c.z)) * ray.scale_z / result.det;
    result.v = v;
    result.w = w;
    return result;
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE static std::uint32_t in_interval(const Crossings& c, const Prepared& ray,
                                                                     T t_max) noexcept {
    return less_equal(ray.t_min, c.t) & less_equal(c.t, Pack<T, N>::broadcast(t_max));
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE static Hit<T, Index> hit_at(const Block& block, const Crossings& c,
                                                                int lane) noexcept {
    const T scale = T(1) / c.det[lane];
    return {
        .t = c.t[lane], .uv = {c.v[lane] * scale, c.w[lane] * scale}, .primitive = block.primitive[std::size_t(lane)]};
  }
  GLINT_ALWAYS_INLINE static void consider(const Hit<T, Index>& hit, Hit<T, Index>& best) noexcept {
    if (is_closer(hit, best)) best = hit;
  }

  std::vector<Block> blocks_;
};

template <std::floating_point T, std::unsigned_integral VertexIndex, int N, Executor E>
[[nodiscard]] TriangleBlocks<T, VertexIndex, N> make_leaves(const TriangleMesh<T, VertexIndex, Watertight>& mesh,
                                                            Tree<T, std::uint32_t>& tree, CopiedBlocks<N> /*choice*/,
                                                            const E& /*executor*/) {
  return TriangleBlocks<T, VertexIndex, N>(mesh, tree);
}

}  // namespace glint
