// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/triangle_blocks.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_layout_triangle_blocks {

namespace {

using glint::Bvh;
using glint::CopiedBlocks;
using glint::IndexedBlocks;
using glint::Median;
using glint::MeshBuffers;
using glint::MoellerTrumbore;
using glint::Serial;
using glint::Watertight;

template <typename Test, typename Scalar, typename Leaves>
struct Kept {
  using Intersector = Test;
  using T = Scalar;
  using Choice = Leaves;
};

/// Every leaf tried for every ray: the blocks without a traversal.
template <typename Case>
int wrong_answers(const MeshBuffers<typename Case::T>& buffers, std::uint64_t seed) {
  using T = typename Case::T;
  const auto mesh = glint::view<typename Case::Intersector>(buffers);
  auto tree = Median{.max_leaf_size = 7}.build(mesh);
  const auto blocks = make_leaves(mesh, tree, typename Case::Choice{}, Serial{});
  const glint::BruteForce oracle(mesh);
  int wrong = 0;
  auto rays = glint::testing::rays_into(oracle.bounds(), 100, seed);
  for (const auto& more : {glint::testing::axis_aligned_rays(oracle.bounds(), 100, seed),
                           glint::testing::rays_in_face_planes(oracle.bounds(), 100, seed)})
    rays.insert(rays.end(), more.begin(), more.end());
  for (const auto& ray : rays) {
    const auto prepared = blocks.prepare(mesh, ray);
    glint::Hit<T> best{.t = ray.t_max};
    bool any = false;
    for (const auto& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      const auto before = best;
      wrong += blocks.closest(mesh, ray, prepared, {node.first, node.count}, best) != (best != before);
      any = any || blocks.occluded(mesh, ray, prepared, {node.first, node.count});
    }
    const auto expected = oracle.closest(ray);
    const std::optional<glint::Hit<T>> found =
        best.primitive == glint::none<std::uint32_t> ? std::nullopt : std::optional(best);
    wrong += found != expected;  // to the last bit
    wrong += any != expected.has_value();
  }
  return wrong;
}

/// Rays from inside of a closed mesh at the vertices and edges of random triangles that hit nothing.
template <typename T, typename Choice>
int leaks(const MeshBuffers<T>& buffers, int rays, std::uint64_t seed) {
  const auto mesh = glint::view(buffers);
  const Bvh bvh{mesh, Median{}, glint::wide<8, Choice>};
  int leaks = 0;
  glint::Random random(seed);
  for (int i = 0; i < rays; ++i) {
    const auto v = mesh.vertices(random.below(std::uint32_t(mesh.size())));
    const T w = i % 4 == 0 ? T(0) : i % 4 == 1 ? T(0.5) : random.uniform<T>();
    const glint::Vec3<T> target = v[0] + (v[1] - v[0]) * w;
    const glint::Vec3<T> origin = random.uniform_vec3<T>() * T(0.05);
    const glint::Ray<T> ray{.origin = origin, .direction = target - origin};
    const auto hit = bvh.closest(ray);
    leaks += !hit || !bvh.occluded(ray);
  }
  return leaks;
}

}  // namespace

TEMPLATE_TEST_CASE("triangle blocks: hit what the mesh's own test hits, to the last bit", "[bvh][layout]",
                   (Kept<Watertight, float, CopiedBlocks<4>>), (Kept<Watertight, double, CopiedBlocks<4>>),
                   (Kept<Watertight, float, CopiedBlocks<8>>), (Kept<Watertight, float, IndexedBlocks<4>>),
                   (Kept<Watertight, double, IndexedBlocks<4>>), (Kept<Watertight, float, IndexedBlocks<8>>),
                   (Kept<MoellerTrumbore, float, CopiedBlocks<4>>), (Kept<MoellerTrumbore, double, CopiedBlocks<4>>),
                   (Kept<MoellerTrumbore, float, CopiedBlocks<8>>), (Kept<MoellerTrumbore, float, IndexedBlocks<4>>),
                   (Kept<MoellerTrumbore, double, IndexedBlocks<2>>), (Kept<MoellerTrumbore, float, CopiedBlocks<1>>)) {
  using T = typename TestType::T;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    CAPTURE(seed);
    CHECK(wrong_answers<TestType>(glint::testing::scanned_blob<T>(200, seed), seed) == 0);
    CHECK(wrong_answers<TestType>(glint::testing::triangle_soup<T>(100, seed), seed) == 0);
    CHECK(wrong_answers<TestType>(glint::testing::degenerate_mix<T>(100, seed), seed) == 0);
    CHECK(wrong_answers<TestType>(glint::testing::diagonal_slivers<T>(60, seed), seed) == 0);
    CHECK(wrong_answers<TestType>(glint::testing::identical_triangles<T>(20), seed) == 0);
    CHECK(wrong_answers<TestType>(glint::testing::closed_cube<T>(), seed) == 0);  // rays in face planes: edges and ties
  }
}

TEMPLATE_TEST_CASE("triangle blocks: rays through vertices and edges of a closed mesh do not leak", "[bvh][layout]",
                   float, double) {
  const auto buffers = glint::testing::scanned_blob<TestType>(3000, 1);
  CHECK(leaks<TestType, CopiedBlocks<4>>(buffers, 100000, 2) == 0);
  CHECK(leaks<TestType, CopiedBlocks<8>>(buffers, 30000, 3) == 0);
  CHECK(leaks<TestType, IndexedBlocks<4>>(buffers, 30000, 4) == 0);
}

TEMPLATE_TEST_CASE("triangle blocks: a mesh of triangles without area is never hit", "[bvh][layout]", CopiedBlocks<4>,
                   IndexedBlocks<4>) {
  glint::MeshBuffers<float> buffers;
  buffers.positions = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  buffers.indices = {0, 1, 2, 0, 0, 0, 1, 1, 2, 2, 1, 0, 0, 2, 2};
  const glint::Ray<float> ray{.origin = {1, 1, 1}};
  CHECK_FALSE(Bvh(view<Watertight>(buffers), Median{}, glint::wide<4, TestType>).closest(ray));
  CHECK_FALSE(Bvh(view<MoellerTrumbore>(buffers), Median{}, glint::wide<4, TestType>).closest(ray));
}

TEST_CASE("triangle blocks: copies hold nine numbers and an index for each triangle, indexed blocks four indices",
          "[bvh][layout]") {
  const auto buffers = glint::testing::identical_triangles<float>(9);
  const auto mesh = view(buffers);
  auto tree = Median{.max_leaf_size = 9}.build(mesh);
  REQUIRE(tree.nodes.size() == 1);
  auto same_tree = tree;
  const auto copied = make_leaves(mesh, tree, CopiedBlocks<4>{}, Serial{});
  CHECK(tree.nodes[0].count == 3);
  CHECK(copied.bytes() == 3 * 4 * (9 * sizeof(float) + sizeof(std::uint32_t)));
  const auto indexed = make_leaves(mesh, same_tree, IndexedBlocks<4>{}, Serial{});
  CHECK(same_tree == tree);
  CHECK(indexed.bytes() == 3 * 4 * (4 * sizeof(std::uint32_t)));
}

TEMPLATE_TEST_CASE("triangle blocks: every executor makes the same", "[bvh][layout]", CopiedBlocks<4>,
                   IndexedBlocks<4>) {
  const auto buffers = glint::testing::scanned_blob<float>(20000, 3);
  const auto mesh = view(buffers);
  auto tree = Median{}.build(mesh);
  auto same_tree = tree;
  const auto serial = make_leaves(mesh, tree, TestType{}, Serial{});
  const auto parallel = make_leaves(mesh, same_tree, TestType{}, glint::TbbExecutor{});
  CHECK(tree == same_tree);
  CHECK(serial.bytes() == parallel.bytes());
  int wrong = 0;
  for (const auto& ray : glint::testing::rays_into(tree.nodes[0].bounds, 20, 1)) {
    const auto prepared = serial.prepare(mesh, ray);
    for (const auto& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      glint::Hit<float> expected{.t = ray.t_max};
      glint::Hit<float> found = expected;
      serial.closest(mesh, ray, prepared, {node.first, node.count}, expected);
      parallel.closest(mesh, ray, prepared, {node.first, node.count}, found);
      wrong += found != expected;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("triangle blocks: indices are looked up in vertices at any distance from each other", "[bvh][layout]") {
  struct Vertex {
    float weight = 0;
    std::array<float, 3> position{};
  };
  const auto buffers = glint::testing::scanned_blob<float>(500, 3);
  std::vector<Vertex> vertices;
  for (const auto& p : buffers.positions) vertices.push_back({.position = {p.x, p.y, p.z}});
  std::vector<std::uint16_t> indices(buffers.indices.begin(), buffers.indices.end());
  const glint::TriangleMesh<float, std::uint16_t> spread{
      .positions = {&vertices[0].position, vertices.size(), sizeof(Vertex)},
      .triangles = {indices.data(), indices.size() / 3}};
  const glint::BruteForce oracle(view(buffers));
  const Bvh bvh{spread, Median{}, glint::wide<8, IndexedBlocks<4>>};
  int wrong = 0;
  for (const auto& ray : glint::testing::rays_into(oracle.bounds(), 300, 1))
    wrong += bvh.closest(ray) != oracle.closest(ray);
  CHECK(wrong == 0);
}

}  // namespace test_bvh_layout_triangle_blocks
