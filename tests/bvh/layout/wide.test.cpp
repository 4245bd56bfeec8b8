// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/wide.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/testing/layout_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_layout_wide {

TEMPLATE_TEST_CASE("wide: holds the leaves of the tree, each once, with its box", "[bvh][layout]", float, double) {
  using T = TestType;
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<T>()) {
    CAPTURE(name);
    const auto tree = glint::BinnedSah{}.build(glint::Boxes{boxes});
    const auto expected = glint::testing::leaves_of(tree);
    CHECK(glint::testing::leaves_of(glint::WideNodes<T, std::uint32_t, 2>(tree), tree) == expected);
    CHECK(glint::testing::leaves_of(glint::WideNodes<T, std::uint32_t, 4>(tree), tree) == expected);
    CHECK(glint::testing::leaves_of(glint::WideNodes<T, std::uint32_t, 8>(tree), tree) == expected);
  }
}

TEST_CASE("wide: a greedy collapse opens the largest children first", "[bvh][layout]") {
  // The root's children: A, small, and B, large, both inner. With room for three, B is opened and A stays.
  glint::Tree<float> tree;
  const auto box = [](float x, float size) { return glint::Aabb<float>{{x, 0, 0}, {x + size, size, size}}; };
  tree.nodes = {{box(0, 20), 1, 0}, {box(0, 2), 3, 0}, {box(2, 9), 5, 0}, {box(0, 1), 0, 1},
                {box(1, 1), 1, 1},  {box(2, 3), 2, 1}, {box(5, 6), 3, 1}};
  tree.order = {0, 1, 2, 3};
  tree.depth = 2;
  const glint::WideNodes<float, std::uint32_t, 4> four(tree, glint::Collapse::Greedy);
  CHECK(four.bytes() == 128);  // all four leaves in one node
  const glint::WideNodes<float, std::uint32_t, 2> two(tree, glint::Collapse::Greedy);
  CHECK(two.bytes() == 3 * 64);
}

TEST_CASE("wide: without a tree there is nothing to walk", "[bvh][layout]") {
  CHECK(glint::WideNodes<float, std::uint32_t, 8>{}.empty());
  CHECK(glint::WideNodes<float, std::uint32_t, 8>(glint::Tree<float>{}).empty());
}

}  // namespace test_bvh_layout_wide
