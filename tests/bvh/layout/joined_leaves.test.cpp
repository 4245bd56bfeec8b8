// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/joined_leaves.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <vector>

#include <glint/bvh/build/median.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_layout_joined_leaves {

using glint::Elements;
using glint::Joined;
using glint::Sphere;

TEST_CASE("joined leaves: a leaf of several kinds finds the closest of all, under the index it has in the whole",
          "[bvh][layout]") {
  const std::vector<Sphere<float>> far{{{0, 0, -9}, 1}};
  const auto buffers = glint::testing::identical_triangles<float>(3);  // at z = 0.08 or so above the origin
  const std::vector<Sphere<float>> near{{{5, 5, 5}, 1}, {{0, 0, 1}, 0.5F}};
  const Joined set{Elements{far}, view(buffers), Elements{near}};
  auto tree = glint::Median{.max_leaf_size = 16}.build(set);
  REQUIRE(tree.nodes.size() == 1);
  const auto leaves = make_leaves(set, tree, glint::CopiedBlocks<4>{}, glint::Serial{});
  static_assert(glint::LeavesOf<decltype(leaves), decltype(set)>);
  CHECK(tree.nodes[0].count == 1);  // one slot: the leaf

  const auto closest = [&](glint::Ray<float> ray) {
    glint::Hit<float> best{.t = ray.t_max};
    leaves.closest(set, ray, leaves.prepare(set, ray), {0, 1}, best);
    return best;
  };
  CHECK(closest({.origin = {0, 0, 3}}).primitive == 5);  // 1 + 3 + 1
  CHECK(closest({.origin = {0, 0, 3}}).t == 1.5F);
  CHECK(closest({.origin = {0, 0, 3}, .t_min = 2.6F}).primitive == 1);  // the first of the equal triangles
  CHECK(closest({.origin = {0, 0, -3}}).primitive == 0);
  CHECK(closest({.origin = {9, 0, 3}}).primitive == glint::none<unsigned>);
  const glint::Ray<float> up{.origin = {0, 0, 3}, .direction = {0, 0, 1}};
  CHECK_FALSE(leaves.occluded(set, up, leaves.prepare(set, up), {0, 1}));
  const glint::Ray<float> down{.origin = {0, 0, 3}};
  CHECK(leaves.occluded(set, down, leaves.prepare(set, down), {0, 1}));
  CHECK(leaves.block_size == 4);
  CHECK(leaves.bytes() > 0);
}

TEST_CASE("joined leaves: of equal hits in different sets, the one of the smaller index wins in either order",
          "[bvh][layout]") {
  const std::vector<Sphere<float>> one{{{0, 0, 0}, 1}};
  const std::vector<Sphere<float>> two{{{0, 0, 0}, 1}};
  const Joined set{Elements{one}, Elements{two}};
  auto tree = glint::Median{.max_leaf_size = 1}.build(set);
  const auto leaves = make_leaves(set, tree, glint::CopiedBlocks<4>{}, glint::Serial{});
  for (const bool forward : {true, false}) {
    const glint::Ray<float> ray{.origin = {0, 0, 3}};
    glint::Hit<float> best{.t = ray.t_max};
    for (const unsigned slot : {forward ? 0U : 1U, forward ? 1U : 0U})
      leaves.closest(set, ray, leaves.prepare(set, ray), {slot, 1}, best);
    CHECK(best.primitive == 0);
  }
}

}  // namespace test_bvh_layout_joined_leaves
