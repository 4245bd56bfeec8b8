// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/binary.hpp>  // first, so the header proves it stands alone

#include <cstdint>

#include <glint/bvh/build/median.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/testing/layout_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_layout_binary {

TEMPLATE_TEST_CASE("binary: holds the leaves of the tree, each once, with its box", "[bvh][layout]", float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    const auto tree = glint::Median{.max_leaf_size = 3}.build(glint::Boxes{boxes});
    const glint::BinaryNodes<TestType, std::uint32_t> nodes(tree);
    CHECK(glint::testing::leaves_of(nodes, tree) == glint::testing::leaves_of(tree));
    CHECK(nodes.bytes() == tree.nodes.size() * sizeof(glint::BinaryNode<TestType>));
  }
}

}  // namespace test_bvh_layout_binary
