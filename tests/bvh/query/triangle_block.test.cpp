// SPDX-License-Identifier: MIT
#include <glint/bvh/query/triangle_block.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>
#include <support/closest_points.hpp>

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

TEST_CASE("triangle block: what is said to be near is as far as it is, to rounding, slivers too", "[bvh][query]") {
  // Coordinates are below 8, and what is found is a few roundings of them off.
  const long double slack = 8 * std::numeric_limits<float>::epsilon();
  for (const auto& [point, triangle] : glint::testing::points_over_slivers<float>(4800)) {
    CAPTURE(point.x, point.y, point.z, triangle.v0.x, triangle.v1.x, triangle.v2.x);
    const std::array corners{triangle.v0, triangle.v1, triangle.v2};
    const auto vertex = [&](int i, int axis) {
      return glint::Pack<float, 4>::broadcast(glint::component(corners[std::size_t(i)], axis));
    };
    const auto squared = glint::detail::squared_distances<float, 4>(point, vertex);
    const long double least = glint::testing::distance_by_slices(point, triangle);
    for (int lane = 0; lane < 4; ++lane)
      REQUIRE(std::abs(std::sqrt(static_cast<long double>(squared[lane])) - least) <= slack);
  }
}

}  // namespace test_bvh_query_triangle_block
