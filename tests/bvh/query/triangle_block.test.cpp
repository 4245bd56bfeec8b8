// SPDX-License-Identifier: MIT
#include <glint/bvh/query/triangle_block.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <numeric>
#include <vector>

#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_triangle_block {

namespace {

/// A tree of one leaf that holds all triangles.
template <typename Mesh>
glint::Tree<float> one_leaf(const Mesh& mesh) {
  glint::Tree<float> tree;
  tree.order.resize(mesh.size());
  std::iota(tree.order.begin(), tree.order.end(), 0U);
  tree.nodes = {{.bounds = {{-1, -1, -1}, {1, 1, 1}}, .first = 0, .count = std::uint32_t(mesh.size())}};
  return tree;
}

template <typename Choice>
std::vector<std::uint32_t> enumerated(std::size_t triangles, Choice choice) {
  const auto buffers = glint::testing::triangle_soup<float>(triangles, 1);
  const auto mesh = view(buffers);
  auto tree = one_leaf(mesh);
  const auto leaves = make_leaves(mesh, tree, choice, glint::Serial{});
  std::vector<std::uint32_t> found;
  leaves.for_each_primitive({tree.nodes[0].first, tree.nodes[0].count}, [&](std::uint32_t i) {
    found.push_back(i);
    return glint::Walk::Continue;
  });
  return found;
}

}  // namespace

TEST_CASE("triangle block: each triangle is shown once, lanes to spare are not", "[bvh][query]") {
  for (const std::size_t triangles : {1U, 3U, 4U, 6U}) {
    CAPTURE(triangles);
    std::vector<std::uint32_t> all(triangles);
    std::iota(all.begin(), all.end(), 0U);
    CHECK(enumerated(triangles, glint::CopiedBlocks<4>{}) == all);
    CHECK(enumerated(triangles, glint::IndexedBlocks<4>{}) == all);
  }
}

}  // namespace test_bvh_query_triangle_block
