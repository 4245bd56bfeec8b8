// SPDX-License-Identifier: MIT
#include <glint/bvh/leaves.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <glint/bvh/tree.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>

#include <support/catch.hpp>

namespace test_bvh_leaves {

TEST_CASE("leaves: closer is a smaller t, then a smaller index", "[bvh][leaves]") {
  const glint::Hit<float> near{.t = 1, .primitive = 5};
  const glint::Hit<float> far{.t = 2, .primitive = 3};
  const glint::Hit<float> first{.t = 1, .primitive = 4};
  CHECK(is_closer(near, far));
  CHECK_FALSE(is_closer(far, near));
  CHECK(is_closer(first, near));
  CHECK_FALSE(is_closer(near, near));
  CHECK(is_closer(near, glint::Hit<float>{.t = 1}));  // a hit at the very end of the ray beats none
}

TEST_CASE("leaves: hits carry the caller's index, not the slot", "[bvh][leaves]") {
  const std::vector<glint::Sphere<float>> shapes{{{0, 0, -9}, 1}, {{0, 0, -5}, 1}, {{7, 7, 7}, 1}};
  const glint::Elements set{shapes};
  glint::Tree<float> tree;
  tree.order = {2, 1, 0};
  const auto leaves = make_leaves(set, tree, glint::CopiedBlocks<4>{}, glint::Serial{});
  static_assert(glint::LeavesOf<decltype(leaves), decltype(set)>);
  const glint::Ray<float> ray;
  glint::Hit<float> best{.t = ray.t_max};
  CHECK(leaves.closest(set, ray, leaves.prepare(set, ray), {2, 1}, best));
  CHECK(best.primitive == 0);
  CHECK(best.t == 8);
  CHECK(leaves.closest(set, ray, leaves.prepare(set, ray), {0, 3}, best));
  CHECK(best.primitive == 1);
  CHECK_FALSE(leaves.closest(set, ray, leaves.prepare(set, ray), {0, 3}, best));
  CHECK_FALSE(leaves.occluded(set, ray, leaves.prepare(set, ray), {0, 1}));
  CHECK(leaves.occluded(set, ray, leaves.prepare(set, ray), {0, 2}));
  CHECK(leaves.bytes() == 12);
}

}  // namespace test_bvh_leaves
