// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/packet_leaves.hpp>
#include <glint/bvh/query/packet.hpp>
#include <glint/bvh/query/triangle_block.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/index.hpp>
#include <glint/core/prefetch.hpp>
#include <glint/core/uninitialized.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_packet.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/ray_triangle_pack.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {
namespace detail {

/// N triangles, and what their test needs of them. A triangle without area stays out, as do lanes to spare: NaNs are
/// never hit.
template <std::floating_point T, std::unsigned_integral V, typename Intersector, int N>
class alignas(8 * sizeof(T)) CopiedBlock {
 public:
  using Mesh = TriangleMesh<T, V, Intersector>;
  using Index = typename Mesh::Index;
  using Test = PackedTest<Intersector, T, N>;
  using RaysTest = PackedTest<Intersector, T, RayPacket<T>::size>;

  CopiedBlock() = default;
  /// Requires: 1 to N primitives.
  CopiedBlock(const Mesh& mesh, std::span<const Index> primitives) noexcept {
    primitive_.fill(none<Index>);
    std::copy(primitives.begin(), primitives.end(), primitive_.begin());
    copy(mesh, [](const auto& /*vertices*/) {});
  }
  /// Copies the vertices anew.
  void refit(const Mesh& mesh, FittedLeaf<T>& fitted) noexcept {
    copy(mesh, [&](const std::array<Vec3<T>, 3>& v) { fitted.add(box_of(v)); });
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE auto cross(const Mesh& /*mesh*/, const typename Test::Prepared& ray,
                                               T t_max) const noexcept {
    return Test::cross(triangles_, ray, t_max);
  }
  /// Triangles that some ray of a packet may hit.
  [[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t entered(const Mesh& /*mesh*/,
                                                          const PacketQuery<T>& query) const noexcept {
    if constexpr (requires { triangles_.vertex; }) {
      const auto vertex = [&](int i, int axis) { return triangles_.vertex[std::size_t(i)][std::size_t(axis)]; };
      return query.enter(boxes_of<T, N>(vertex)).mask;
    } else {
      return ~std::uint32_t{0} >> (32 - N);
    }
  }
  /// One triangle, many rays.
  [[nodiscard]] GLINT_ALWAYS_INLINE auto cross(const Mesh& /*mesh*/, int lane,
                                               const typename RaysTest::Prepared& rays) const noexcept {
    return RaysTest::cross_one(triangles_, lane, rays, infinity<T>);
  }
  [[nodiscard]] Index primitive(int lane) const noexcept { return primitive_[std::size_t(lane)]; }
  template <typename Use>
  [[nodiscard]] GLINT_ALWAYS_INLINE auto with_vertices(const Mesh& mesh, const Use& use) const noexcept {
    if constexpr (requires { triangles_.vertex; })
      return use([&](int i, int axis) { return triangles_.vertex[std::size_t(i)][std::size_t(axis)]; });
    else
      return use(detail::gathered_vertices<T, N>(mesh, primitive_));
  }
  /// Whether a lane is not to spare.
  [[nodiscard]] bool holds(int lane) const noexcept { return primitive(lane) != none<Index>; }

 private:
  template <typename Visit>
  void copy(const Mesh& mesh, const Visit& visit) noexcept {
    std::array<std::array<std::array<T, std::size_t(N)>, 3>, 3> lanes;  // [vertex][axis][lane]
    for (auto& vertex : lanes)
      for (auto& axis : vertex) axis.fill(std::numeric_limits<T>::quiet_NaN());
    for (std::size_t lane = 0; lane < std::size_t(N) && primitive_[lane] != none<Index>; ++lane) {
      const std::array<Vec3<T>, 3> v = mesh.vertices(primitive_[lane]);
      visit(v);
      if (is_degenerate(v[0], v[1], v[2])) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        lanes[i][0][lane] = v[i].x;
        lanes[i][1][lane] = v[i].y;
        lanes[i][2][lane] = v[i].z;
      }
    }
    triangles_ = Test::triangles(
        [&](int i, int axis) { return Pack<T, N>::load(lanes[std::size_t(i)][std::size_t(axis)].data()); });
  }

  typename Test::Triangles triangles_;
  std::array<Index, std::size_t(N)> primitive_;
};

/// The indices of N triangles and of their vertices, which are gathered for each test. A lane to spare repeats another;
/// a triangle without area is put down as a point.
template <std::floating_point T, std::unsigned_integral V, typename Intersector, int N>
class IndexedBlock {
 public:
  using Mesh = TriangleMesh<T, V, Intersector>;
  using Index = typename Mesh::Index;
  using Test = PackedTest<Intersector, T, N>;
  using RaysTest = PackedTest<Intersector, T, RayPacket<T>::size>;

  IndexedBlock() = default;
  /// Requires: 1 to N primitives.
  IndexedBlock(const Mesh& mesh, std::span<const Index> primitives) noexcept {
    for (std::size_t lane = 0; lane < std::size_t(N); ++lane)
      primitive_[lane] = primitives[std::min(lane, primitives.size() - 1)];
    look_up(mesh, [](const auto& /*vertices*/) {});
  }
  /// Looks up anew which triangles have an area.
  void refit(const Mesh& mesh, FittedLeaf<T>& fitted) noexcept {
    look_up(mesh, [&](const std::array<Vec3<T>, 3>& v) { fitted.add(box_of(v)); });
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE auto cross(const Mesh& mesh, const typename Test::Prepared& ray,
                                               T t_max) const noexcept {
    return with_vertices(mesh, [&](const auto& vertex) { return Test::cross_at(vertex, ray, t_max); });
  }
  /// Triangles that some ray of a packet may hit.
  [[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t entered(const Mesh& mesh,
                                                          const PacketQuery<T>& query) const noexcept {
    return with_vertices(mesh, [&](const auto& vertex) { return query.enter(boxes_of<T, N>(vertex)).mask; });
  }
  /// One triangle, many rays.
  [[nodiscard]] GLINT_ALWAYS_INLINE auto cross(const Mesh& mesh, int lane,
                                               const typename RaysTest::Prepared& rays) const noexcept {
    const auto at = [&](std::size_t i) { return mesh.positions[vertex_[i][std::size_t(lane)]]; };
    const std::array<Vec3<T>, 3> v{at(0), at(1), at(2)};
    const auto vertex = [&](int i, int axis) {
      return RayPacket<T>::Lanes::broadcast(component(v[std::size_t(i)], axis));
    };
    return RaysTest::cross_at(vertex, rays, infinity<T>);
  }
  [[nodiscard]] Index primitive(int lane) const noexcept { return primitive_[std::size_t(lane)]; }
  template <typename Use>
  [[nodiscard]] GLINT_ALWAYS_INLINE auto with_vertices(const Mesh& mesh, const Use& use) const noexcept {
    std::array<std::array<const std::byte*, std::size_t(N)>, 3> from;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t lane = 0; lane < std::size_t(N); ++lane) from[i][lane] = mesh.positions.at(vertex_[i][lane]);
    return use([&](int i, int axis) {
      return Pack<T, N>::generate([&](int lane) {
        T value;
        std::memcpy(&value, from[std::size_t(i)][std::size_t(lane)] + std::size_t(axis) * sizeof(T), sizeof(T));
        return value;
      });
    });
  }
  /// Whether a lane is not to spare.
  [[nodiscard]] bool holds(int lane) const noexcept { return lane == 0 || primitive(lane) != primitive(lane - 1); }

 private:
  template <typename Visit>
  void look_up(const Mesh& mesh, const Visit& visit) noexcept {
    for (std::size_t lane = 0; lane < std::size_t(N); ++lane) {
      const std::array<Vec3<T>, 3> v = mesh.vertices(primitive_[lane]);
      const std::array<V, 3> vertices = mesh.triangles[primitive_[lane]];
      const bool is_point = is_degenerate(v[0], v[1], v[2]);
      for (std::size_t i = 0; i < 3; ++i) vertex_[i][lane] = vertices[is_point ? 0 : i];
      if (lane == 0 || primitive_[lane] != primitive_[lane - 1]) visit(v);
    }
  }

  std::array<std::array<V, std::size_t(N)>, 3> vertex_;
  std::array<Index, std::size_t(N)> primitive_;
};

}  // namespace detail

/// The triangles of a mesh in blocks of N that are tested at once, in the order of the leaves: hits are those of the
/// mesh's own test to the last bit. What a block cannot decide, a ray through an edge, it asks the mesh for.
template <typename Block, int N>
class TriangleBlocks {
 public:
  using Mesh = typename Block::Mesh;
  using T = typename Mesh::Scalar;
  using Index = typename Mesh::Index;
  static constexpr std::size_t block_size = std::size_t(N);

  /// Renumbers the leaves of the tree by blocks. Requires: a valid tree over the mesh.
  template <Executor E>
  TriangleBlocks(const Mesh& mesh, Tree<T, Index>& tree, const E& executor) {
    constexpr std::size_t chunk = 1024;  // nodes; where each begins does not depend on the executor
    const std::size_t chunks = (tree.nodes.size() + chunk - 1) / chunk;
    const auto nodes = [&](std::size_t i) {
      return std::span(tree.nodes).subspan(i * chunk, std::min(chunk, tree.nodes.size() - i * chunk));
    };
    std::vector<std::size_t> first(chunks + 1);
    executor.parallel_for(chunks, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i)
        for (const BinaryNode<T, Index>& node : nodes(i)) first[i + 1] += blocks_for(node.count);
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    blocks_.resize(first.back());
    executor.parallel_for(chunks, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) fill(mesh, tree.order, nodes(i), first[i]);
    });
  }

  struct Prepared {
    typename Block::Test::Prepared packed;
    decltype(std::declval<const Mesh&>().prepare(std::declval<const Ray<T>&>())) single;
  };
  [[nodiscard]] GLINT_ALWAYS_INLINE Prepared prepare(const Mesh& mesh, const Ray<T>& ray) const noexcept {
    const auto single = mesh.prepare(ray);
    return {Block::Test::prepare(ray, single), single};
  }

  GLINT_ALWAYS_INLINE bool closest(const Mesh& mesh, const Ray<T>& ray, const Prepared& prepared, Slots<Index> slots,
                                   Hit<T, Index>& best) const noexcept {
    bool improved = false;
    for (std::size_t i = slots.first; i != std::size_t(slots.first) + slots.count; ++i) {
      const Block& block = blocks_[i];
      const auto c = block.cross(mesh, prepared.packed, best.t);
      for (std::uint32_t mask = c.hit; mask != 0; mask &= mask - 1) {
        const int lane = std::countr_zero(mask);
        const T t = c.t[lane];
        const Index primitive = block.primitive(lane);
        if (!(t < best.t || (t == best.t && primitive < best.primitive))) continue;
        const T scale = T(1) / c.det[lane];
        best = {.t = t, .uv = {c.w1[lane] * scale, c.w2[lane] * scale}, .primitive = primitive};
        improved = true;
      }
      if (c.tied != 0) improved |= closest_of(c.tied, mesh, ray, prepared, block, best);
    }
    return improved;
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE bool occluded(const Mesh& mesh, const Ray<T>& ray, const Prepared& prepared,
                                                  Slots<Index> slots) const noexcept {
    for (std::size_t i = slots.first; i != std::size_t(slots.first) + slots.count; ++i) {
      const auto c = blocks_[i].cross(mesh, prepared.packed, ray.t_max);
      if (c.hit != 0) return true;
      if (c.tied == 0) continue;
      Hit<T, Index> any{.t = ray.t_max};
      if (closest_of(c.tied, mesh, ray, prepared, blocks_[i], any)) return true;
    }
    return false;
  }

  [[nodiscard]] std::span<const Block> blocks(Slots<Index> slots) const noexcept {
    return {blocks_.data() + slots.first, slots.count};
  }
  template <typename F>
  GLINT_ALWAYS_INLINE Walk for_each_primitive(Slots<Index> slots, const F& f) const {
    return for_each_in_blocks(blocks(slots), f);
  }
  template <typename Sink>
  GLINT_ALWAYS_INLINE Walk for_each_hit(const Mesh& mesh, const Ray<T>& ray, const Prepared& prepared,
                                        Slots<Index> slots, Sink& sink) const {
    return for_each_hit_in_blocks(blocks(slots), mesh, ray, prepared, sink);
  }
  template <typename Sink>
  GLINT_ALWAYS_INLINE void for_each_near(const Mesh& mesh, const Vec3<T>& point, Slots<Index> slots, Sink& sink) const {
    for_each_near_in_blocks(blocks(slots), mesh, point, sink);
  }

  /// Takes up where the triangles are now. Different slots may be at once.
  [[nodiscard]] FittedLeaf<T> refit(const Mesh& mesh, Slots<Index> slots) noexcept {
    FittedLeaf<T> fitted;
    for (std::size_t i = slots.first; i != std::size_t(slots.first) + slots.count; ++i) blocks_[i].refit(mesh, fitted);
    return fitted;
  }

  /// Has the block fetched that will be tested soon.
  GLINT_ALWAYS_INLINE void prefetch(Index slot) const noexcept { glint::prefetch(blocks_[slot]); }

  [[nodiscard]] GLINT_ALWAYS_INLINE auto prepare(const Mesh& /*mesh*/, const RayPacket<T>& packet) const noexcept
      requires(requires { Block::RaysTest::prepare(packet); }) {
    return Block::RaysTest::prepare(packet);
  }
  template <typename RaysPrepared>
  GLINT_ALWAYS_INLINE std::uint32_t closest(const Mesh& mesh, const RayPacket<T>& packet, const RaysPrepared& prepared,
                                            const PacketQuery<T>& query, Slots<Index> slots, std::uint32_t asked,
                                            PacketHits<T, Index>& best) const noexcept {
    std::uint32_t improved = 0;
    const auto visit = [&](Index primitive, const auto& c) {
      improved |= detail::take_closer(c, c.hit & asked & less_equal(c.t, best.t), primitive, best);
      const std::uint32_t tied = c.tied & asked;
      if (tied != 0) improved |= detail::closest_of_rays(tied, mesh, packet, primitive, best);
      return asked;
    };
    for_each_triangle(mesh, prepared, query, slots, visit);
    return improved;
  }
  template <typename RaysPrepared>
  [[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t occluded(const Mesh& mesh, const RayPacket<T>& packet,
                                                           const RaysPrepared& prepared, const PacketQuery<T>& query,
                                                           Slots<Index> slots, std::uint32_t asked) const noexcept {
    std::uint32_t found = 0;
    const auto visit = [&](Index primitive, const auto& c) {
      found |= c.hit & asked & less_equal(c.t, packet.t_max);
      const std::uint32_t tied = c.tied & asked & ~found;
      if (tied != 0) found |= detail::occluded_of_rays(tied, mesh, packet, primitive);
      return asked & ~found;
    };
    for_each_triangle(mesh, prepared, query, slots, visit);
    return found;
  }

  [[nodiscard]] std::size_t bytes() const noexcept { return blocks_.size() * sizeof(Block); }

 private:
  [[nodiscard]] static constexpr std::size_t blocks_for(std::size_t count) noexcept {
    return (count + std::size_t(N) - 1) / std::size_t(N);
  }
  void fill(const Mesh& mesh, std::span<const Index> order, std::span<BinaryNode<T, Index>> nodes,
            std::size_t next) noexcept {
    for (BinaryNode<T, Index>& node : nodes) {
      if (!node.is_leaf()) continue;
      const std::size_t begin = next;
      std::span<const Index> rest = order.subspan(node.first, node.count);
      if constexpr (requires { mesh.positions; }) fetch_soon(mesh, order, node);
      for (; !rest.empty(); rest = rest.subspan(std::min(rest.size(), block_size)))
        blocks_[next++] = Block(mesh, rest.first(std::min(rest.size(), block_size)));
      node.first = Index(begin);
      node.count = Index(next - begin);
    }
  }
  /// What the next leaves are made of lies scattered: their vertices, and further on their indices, are asked for
  /// early.
  static void fetch_soon(const Mesh& mesh, std::span<const Index> order, const BinaryNode<T, Index>& leaf) noexcept {
    constexpr std::size_t ahead = 4 * block_size;
    if (order.size() - leaf.first <= 2 * ahead + leaf.count) return;
    const Index* const next = order.data() + leaf.first + ahead;
    for (std::size_t i = 0; i != leaf.count; ++i) {
      GLINT_PREFETCH(mesh.positions.at(mesh.triangles[next[i]][0]));
      GLINT_PREFETCH(mesh.triangles.at(next[i + ahead]));
    }
  }
  /// Lanes tested one by one.
  GLINT_NO_INLINE static bool closest_of(std::uint32_t lanes, const Mesh& mesh, const Ray<T>& ray,
                                         const Prepared& prepared, const Block& block, Hit<T, Index>& best) noexcept {
    bool improved = false;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto hit = mesh.intersect(ray, prepared.single, block.primitive(std::countr_zero(lanes)));
      if (!hit || !is_closer(*hit, best)) continue;
      best = *hit;
      improved = true;
    }
    return improved;
  }

  /// Until `visit` says that no ray asks any more.
  template <typename RaysPrepared, typename Visit>
  GLINT_ALWAYS_INLINE void for_each_triangle(const Mesh& mesh, const RaysPrepared& prepared,
                                             const PacketQuery<T>& query, Slots<Index> slots,
                                             const Visit& visit) const noexcept {
    for (std::size_t i = slots.first; i != std::size_t(slots.first) + slots.count; ++i) {
      const Block& block = blocks_[i];
      for (std::uint32_t mask = block.entered(mesh, query); mask != 0; mask &= mask - 1) {
        const int lane = std::countr_zero(mask);
        if (block.primitive(lane) == none<Index>) continue;
        if (visit(block.primitive(lane), block.cross(mesh, lane, prepared)) == 0) return;
      }
    }
  }

  UninitializedVector<Block> blocks_;
};

template <std::floating_point T, std::unsigned_integral V, typename Intersector, int N, Executor E>
  requires PackedIntersector<Intersector, T, N>
[[nodiscard]] auto make_leaves(const TriangleMesh<T, V, Intersector>& mesh, Tree<T, std::uint32_t>& tree,
                               CopiedBlocks<N> /*choice*/, const E& executor) {
  return TriangleBlocks<detail::CopiedBlock<T, V, Intersector, N>, N>(mesh, tree, executor);
}
template <std::floating_point T, std::unsigned_integral V, typename Intersector, int N, Executor E>
  requires PackedIntersector<Intersector, T, N>
[[nodiscard]] auto make_leaves(const TriangleMesh<T, V, Intersector>& mesh, Tree<T, std::uint32_t>& tree,
                               IndexedBlocks<N> /*choice*/, const E& executor) {
  return TriangleBlocks<detail::IndexedBlock<T, V, Intersector, N>, N>(mesh, tree, executor);
}

}  // namespace glint
