// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/validate.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <glint/bvh/build/median.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/triangle.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_pass_validate {

using glint::Boxes;
using glint::Tree;

TEST_CASE("validate: a broken tree of every kind is found out", "[bvh][pass]") {
  auto boxes = glint::testing::random_boxes<float>(20, 1);
  boxes[3] = {};
  const Boxes set{boxes};
  const Tree<float> good = glint::Median{.max_leaf_size = 2}.build(set);
  REQUIRE(violations(good, set).empty());
  REQUIRE(good.nodes[1].count == 0);
  std::size_t leaf = 0;
  while (!good.nodes[leaf].is_leaf()) ++leaf;

  const auto broken = [&](const auto& change) {
    Tree<float> tree = good;
    change(tree);
    return !violations(tree, set).empty();
  };
  CHECK(broken([](auto& t) { t.nodes.clear(); }));
  CHECK(broken([](auto& t) { t.depth += 1; }));
  CHECK(broken([](auto& t) { t.left_out = 0; }));
  CHECK(broken([](auto& t) { t.nodes[0].first = 0; }));           // its own child
  CHECK(broken([](auto& t) { t.nodes[0].first = 1'000'000; }));   // no such child
  CHECK(broken([](auto& t) { t.nodes[1].first = 1; }));           // a child of itself
  CHECK(broken([](auto& t) { t.nodes[0].bounds.upper.x = 0; }));  // children stick out
  CHECK(broken([&](auto& t) { t.nodes[leaf].bounds.upper.y = t.nodes[leaf].bounds.lower.y; }));
  CHECK(broken([&](auto& t) { t.nodes[leaf].count += 1; }));  // a slot in two leaves, or beyond the order
  CHECK(broken([&](auto& t) { t.nodes[leaf].first = 1'000'000; }));
  CHECK(broken([](auto& t) { t.order[0] = t.order[1]; }));        // one primitive twice, one nowhere
  CHECK(broken([](auto& t) { t.order[0] = 99; }));                // no such primitive
  CHECK(broken([](auto& t) { t.order[0] = 3; }));                 // one without a box
  CHECK(broken([](auto& t) { t.order.push_back(0); }));           // a slot in no leaf
  CHECK(broken([](auto& t) { t.nodes.push_back(t.nodes[0]); }));  // a node without a parent
}

TEST_CASE("validate: a tree deeper than traversals can bear is refused", "[bvh][pass]") {
  constexpr unsigned depth = Tree<float>::max_depth + 1;
  const std::vector<glint::Aabb<float>> boxes(depth + 1, {{0, 0, 0}, {1, 1, 1}});
  Tree<float> tree;
  for (unsigned i = 0; i < depth; ++i) {  // a chain: a leaf on the left of every step
    tree.nodes.push_back({boxes[0], 2 * i + 1, 0});
    tree.nodes.push_back({boxes[0], i, 1});
    tree.order.push_back(i);
  }
  tree.nodes.push_back({boxes[0], depth, 1});
  tree.order.push_back(depth);
  tree.depth = int(depth);
  CHECK_FALSE(violations(tree, Boxes{boxes}).empty());
}

namespace {

/// A root over two leaves with one slot each, both of the first primitive.
Tree<float> two_leaves_of(const glint::Aabb<float>& left, const glint::Aabb<float>& right) {
  Tree<float> tree;
  tree.nodes = {{join(left, right), 1, 0}, {left, 0, 1}, {right, 1, 1}};
  tree.order = {0, 0};
  tree.depth = 1;
  return tree;
}

}  // namespace

TEST_CASE("validate: the leaves of a primitive that was cut hold all of it together", "[bvh][pass]") {
  const std::vector<glint::Aabb<float>> boxes{{{0, 0, 0}, {4, 1, 1}}};
  const Boxes set{boxes};
  const auto valid = [&](const glint::Aabb<float>& left, const glint::Aabb<float>& right) {
    return violations(two_leaves_of(left, right), set).empty();
  };
  CHECK(valid({{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {4, 1, 1}}));
  CHECK_FALSE(valid({{0, 0, 0}, {3, 1, 1}}, {{-2, -2, -2}, {1, 1, 0.5F}}));  // right of 3 there is nothing
  CHECK(valid({{-1, -1, -1}, {3, 1, 1}}, {{2, 0, 0}, {5, 5, 5}}));
  CHECK_FALSE(valid({{0, 0, 0}, {1, 1, 1}}, {{1.5F, 0, 0}, {4, 1, 1}}));  // a gap
  CHECK_FALSE(valid({{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {4, 1, 0.9F}}));  // a corner is missing
  CHECK_FALSE(valid({{0, 0, 0}, {4, 1, 1}}, {{5, 0, 0}, {6, 1, 1}}));     // a leaf that it does not reach
}

TEST_CASE("validate: where a set clips, leaves need to hold no more than the parts", "[bvh][pass]") {
  const std::vector<glint::Triangle<float>> triangles{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}};  // y ≤ x
  const glint::Elements set{triangles};
  const auto valid = [&](const glint::Aabb<float>& left, const glint::Aabb<float>& right) {
    return violations(two_leaves_of(left, right), set).empty();
  };
  CHECK(valid({{0, 0, 0}, {2, 2, 0}}, {{2, 0, 0}, {4, 4, 0}}));
  CHECK(valid({{0, 0, 0}, {1, 1, 0}}, {{1, 0, 0}, {4, 4, 0}}));
  CHECK_FALSE(valid({{0, 0, 0}, {2, 1.9F, 0}}, {{2, 0, 0}, {4, 4, 0}}));
  CHECK_FALSE(valid({{0, 0, 0}, {2, 2, 0}}, {{2, 0.1F, 0}, {4, 4, 0}}));
}

}  // namespace test_bvh_pass_validate
