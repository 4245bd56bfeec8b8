// SPDX-License-Identifier: MIT
#include <glint/bvh/tree.hpp>  // first, so the header proves it stands alone

#include <cstdint>

#include <support/catch.hpp>

namespace test_bvh_tree {

TEST_CASE("tree: a node takes half a cache line in float, a whole one in double", "[bvh]") {
  CHECK(sizeof(glint::BinaryNode<float>) == 32);
  CHECK(sizeof(glint::BinaryNode<double>) <= 64);
}

TEST_CASE("tree: a node is a leaf where it has slots", "[bvh]") {
  CHECK_FALSE(glint::BinaryNode<float>{.first = 1}.is_leaf());
  CHECK(glint::BinaryNode<float, std::uint64_t>{.first = 0, .count = 1}.is_leaf());
}

TEST_CASE("tree: equal trees compare equal", "[bvh]") {
  glint::Tree<float> a;
  a.nodes = {{{{0, 0, 0}, {1, 1, 1}}, 0, 1}};
  a.order = {0};
  glint::Tree<float> b = a;
  CHECK(a == b);
  b.order[0] = 1;
  CHECK_FALSE(a == b);
}

}  // namespace test_bvh_tree
