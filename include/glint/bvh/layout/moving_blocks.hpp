// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/query/triangle_block.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/motion.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_triangle_pack.hpp>
#include <glint/geometry/set/moving.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {
namespace detail {

/// N moving triangles, with their vertices in all keyframes, mixed for each test as the mesh itself does. A triangle
/// that is not bounded stays out, as do lanes to spare: NaNs are never hit.
template <std::floating_point T, std::unsigned_integral V, typename Intersector, std::size_t K, int N>
class MovingBlock {
 public:
  using Mesh = Moving<TriangleMesh<T, V, Intersector>, K>;
  using Index = typename Mesh::Index;

  /// The test of triangles that stand still, and the ray's moment.
  struct Test {
    using Still = PackedTest<Intersector, T, N>;
    using P = typename Still::P;
    struct Prepared {
      typename Still::Prepared ray;
      Moment<T, K> moment;
    };
    [[nodiscard]] GLINT_ALWAYS_INLINE static Prepared prepare(const Ray<T>& ray,
                                                              const typename Mesh::Prepared& single) noexcept {
      return {Still::prepare(ray, single.ray), single.moment};
    }
  };

  MovingBlock() = default;
  /// Requires: 1 to N primitives.
  MovingBlock(const Mesh& mesh, std::span<const Index> primitives) noexcept {
    primitive_.fill(none<Index>);
    std::copy(primitives.begin(), primitives.end(), primitive_.begin());
    copy(mesh);
  }
  /// Copies the vertices anew.
  void refit(const Mesh& mesh, FittedLeaf<T>& fitted) noexcept {
    copy(mesh);
    for (std::size_t lane = 0; lane < std::size_t(N) && primitive_[lane] != none<Index>; ++lane)
      fitted.add(mesh.bounds(primitive_[lane]));
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE auto cross(const Mesh& /*mesh*/, const typename Test::Prepared& prepared,
                                               T t_max) const noexcept {
    using P = typename Test::P;
    const P before = P::broadcast(prepared.moment.before);
    const P after = P::broadcast(prepared.moment.after);
    const Triangles& a = key_[prepared.moment.key];
    const Triangles& b = key_[prepared.moment.key + 1];
    const auto vertex = [&](int i, int axis) {
      const auto v = std::size_t(i);
      const auto x = std::size_t(axis);
      return fenced(a[v][x] * before) + fenced(b[v][x] * after);
    };
    return Test::Still::cross_at(vertex, prepared.ray, t_max);
  }
  [[nodiscard]] Index primitive(int lane) const noexcept { return primitive_[std::size_t(lane)]; }
  [[nodiscard]] bool holds(int lane) const noexcept { return primitive(lane) != none<Index>; }

 private:
  using Triangles = std::array<std::array<Pack<T, N>, 3>, 3>;  // [vertex][axis]

  void copy(const Mesh& mesh) noexcept {
    for (std::size_t k = 0; k < K; ++k)
      for (auto& vertex : key_[k]) vertex.fill(Pack<T, N>::broadcast(std::numeric_limits<T>::quiet_NaN()));
    for (int lane = 0; lane < N && holds(lane); ++lane) {
      if (is_empty(mesh.bounds(primitive(lane)))) continue;
      for (std::size_t k = 0; k < K; ++k) copy(mesh.vertices(k, primitive(lane)), key_[k], lane);
    }
  }
  static void copy(const std::array<Vec3<T>, 3>& from, Triangles& to, int lane) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      to[i][0].set(lane, from[i].x);
      to[i][1].set(lane, from[i].y);
      to[i][2].set(lane, from[i].z);
    }
  }

  std::array<Triangles, K> key_;
  std::array<Index, std::size_t(N)> primitive_;
};

}  // namespace detail

template <std::floating_point T, std::unsigned_integral V, typename Intersector, std::size_t K, int N, Executor E>
  requires PackedIntersector<Intersector, T, N>
[[nodiscard]] auto make_leaves(const Moving<TriangleMesh<T, V, Intersector>, K>& mesh, Tree<T, std::uint32_t>& tree,
                               CopiedBlocks<N> /*choice*/, const E& executor) {
  return TriangleBlocks<detail::MovingBlock<T, V, Intersector, K, N>, N>(mesh, tree, executor);
}

}  // namespace glint
