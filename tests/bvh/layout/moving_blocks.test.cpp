// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/moving_blocks.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <optional>

#include <glint/bvh/build/median.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_layout_moving_blocks {

namespace {

using glint::Hit;
using glint::Moving;
using glint::Ray;
using glint::Slots;

template <typename Intersector, typename T>
void check_bits() {
  const auto a = glint::testing::triangle_soup<T>(7, 81);
  auto b = a;
  glint::Random random(82);
  for (auto& p : b.positions) p += random.uniform_vec3<T>() - T(0.5);
  const Moving set{glint::view<Intersector>(a), glint::view<Intersector>(b)};
  auto tree = glint::Median{.max_leaf_size = 7}.build(set, glint::Serial{});
  REQUIRE(tree.nodes.size() == 1);
  const auto leaves = make_leaves(set, tree, glint::CopiedBlocks<4>{}, glint::Serial{});
  CHECK(tree.nodes[0].count == 2);  // blocks, for seven triangles
  int found = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto point = [&] { return set.bounds(std::uint32_t(i % 7)).lower + random.uniform_vec3<T>() * T(0.5); };
    Ray<T> ray{.origin = point()};
    ray.direction = point() - ray.origin;
    ray.time = random.uniform_vec3<T>().x;
    std::optional<Hit<T>> expected;
    for (std::uint32_t k = 0; k < 7; ++k) {
      const auto hit = set.intersect(ray, k);
      if (hit && (!expected || hit->t < expected->t)) expected = hit;
    }
    Hit<T> best{.t = ray.t_max};
    const bool improved = leaves.closest(set, ray, leaves.prepare(set, ray), Slots<std::uint32_t>{0, 2}, best);
    CHECK(improved == expected.has_value());
    if (expected) CHECK(best == *expected);
    CHECK(leaves.occluded(set, ray, leaves.prepare(set, ray), {0, 2}) == improved);
    found += int(improved);
  }
  CHECK(found > 100);  // enough of them meet something
}

}  // namespace

TEMPLATE_TEST_CASE("moving blocks: hits are those of the mesh at the ray's time, to the last bit", "[bvh][layout]",
                   float, double) {
  check_bits<glint::Watertight, TestType>();
  check_bits<glint::MoellerTrumbore, TestType>();
}

}  // namespace test_bvh_layout_moving_blocks
