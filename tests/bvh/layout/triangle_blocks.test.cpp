// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/triangle_blocks.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <optional>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace {

/// Every leaf tried for every ray: the blocks without a traversal.
template <typename T, int N>
void check_blocks(const glint::MeshBuffers<T>& buffers, std::uint64_t seed) {
  const auto mesh = view(buffers);
  auto tree = glint::Median{.max_leaf_size = 7}.build(mesh);
  const glint::TriangleBlocks<T, std::uint32_t, N> blocks(mesh, tree);
  const glint::BruteForce oracle(mesh);
  int wrong = 0;
  auto rays = glint::testing::rays_into(oracle.bounds(), 150, seed);
  for (const auto& more : {glint::testing::axis_aligned_rays(oracle.bounds(), 150, seed),
                           glint::testing::rays_in_face_planes(oracle.bounds(), 150, seed)})
    rays.insert(rays.end(), more.begin(), more.end());
  for (const auto& ray : rays) {
    const auto prepared = blocks.prepare(mesh, ray);
    glint::Hit<T> best{.t = ray.t_max};
    bool any = false;
    for (const auto& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      blocks.closest(mesh, ray, prepared, {node.first, node.count}, best);
      any = any || blocks.occluded(mesh, ray, prepared, {node.first, node.count});
    }
    const auto expected = oracle.closest(ray);
    const std::optional<glint::Hit<T>> found =
        best.primitive == glint::none<std::uint32_t> ? std::nullopt : std::optional(best);
    wrong += found != expected;  // to the last bit
    wrong += any != expected.has_value();
  }
  CHECK(wrong == 0);
}

}  // namespace

TEMPLATE_TEST_CASE("triangle blocks: hit what the mesh's own test hits, to the last bit", "[bvh][layout]", float,
                   double) {
  using T = TestType;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    check_blocks<T, 4>(glint::testing::scanned_blob<T>(200, seed), seed);
    check_blocks<T, 8>(glint::testing::triangle_soup<T>(100, seed), seed);
    check_blocks<T, 4>(glint::testing::degenerate_mix<T>(100, seed), seed);
    check_blocks<T, 4>(glint::testing::diagonal_slivers<T>(60, seed), seed);
    check_blocks<T, 2>(glint::testing::closed_cube<T>(), seed);  // rays in face planes: edges and ties
  }
}

TEMPLATE_TEST_CASE("triangle blocks: rays through vertices and edges of a closed mesh do not leak", "[bvh][layout]",
                   float, double) {
  using T = TestType;
  const auto buffers = glint::testing::scanned_blob<T>(200, 1);
  const auto mesh = view(buffers);
  auto tree = glint::Median{}.build(mesh);
  const auto blocks = make_leaves(mesh, tree, glint::CopiedBlocks<4>{}, glint::Serial{});
  int leaks = 0;
  glint::Random random(2);
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const auto v = mesh.vertices(std::uint32_t(i));
    const T w = random.uniform<T>();
    for (const glint::Vec3<T>& target : {v[0], v[0] * w + v[1] * (T(1) - w)}) {
      const glint::Ray<T> ray{.origin = {T(0.01), T(0.02), T(0.03)}, .direction = target};  // from inside
      bool any = false;
      for (const auto& node : tree.nodes) {
        if (node.is_leaf())
          any = any || blocks.occluded(mesh, ray, blocks.prepare(mesh, ray), {node.first, node.count});
      }
      leaks += !any;
    }
  }
  CHECK(leaks == 0);
}

TEST_CASE("triangle blocks: four triangles share a block, which holds 9 numbers and an index for each",
          "[bvh][layout]") {
  const auto buffers = glint::testing::identical_triangles<float>(9);
  const auto mesh = view(buffers);
  auto tree = glint::Median{.max_leaf_size = 9}.build(mesh);
  REQUIRE(tree.nodes.size() == 1);
  const auto blocks = make_leaves(mesh, tree, glint::CopiedBlocks<4>{}, glint::Serial{});
  CHECK(tree.nodes[0].count == 3);
  CHECK(blocks.bytes() == 3 * 4 * (9 * sizeof(float) + sizeof(std::uint32_t)));
}
