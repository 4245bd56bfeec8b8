// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/graft.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_pass_graft {

namespace {

using glint::Aabb;
using glint::BinnedSah;
using glint::Boxes;
using glint::Median;
using glint::Tree;
using glint::detail::Gathered;
using glint::detail::Graft;
using glint::detail::Repeats;

}  // namespace

TEST_CASE("graft: a copy without replacements is the tree", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(300, 1);
  const auto tree = BinnedSah{}.build(Boxes{boxes});
  Graft<float, std::uint32_t> graft(tree.nodes.size(), tree.order.size());
  graft.copy(tree, 0, 0);
  CHECK(std::move(graft).tree(boxes.size()) == tree);
}

TEST_CASE("graft: a replaced node's ancestors hold what replaces it, and the depth is measured anew", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(40, 2);
  const auto tree = Median{.max_leaf_size = 1}.build(Boxes{std::span(boxes).first(8)});  // 3 steps deep
  const auto other = Median{.max_leaf_size = 1}.build(Boxes{boxes});                     // 6 steps deep
  Graft<float, std::uint32_t> graft(0, 0);
  graft.copy(tree, 0, 0, 0, [&](std::size_t at, std::size_t to, int depth) {
    if (at != tree.nodes[0].first) return false;
    graft.copy(other, to, depth);
    return true;
  });
  const auto grafted = std::move(graft).tree(100);
  CHECK(grafted.depth == 7);
  CHECK(grafted.nodes[0].bounds == join(other.nodes[0].bounds, tree.nodes[tree.nodes[0].first + 1].bounds));
  CHECK(grafted.order.size() == 40 + 4);
  CHECK(grafted.left_out == 100 - 40);  // the four are among the forty
}

TEST_CASE("gathered: parts of a primitive become one, and orders name the caller's primitives", "[bvh][pass]") {
  Gathered<float, std::uint32_t> gathered(Repeats::Possible);
  gathered.add(7, {{0, 0, 0}, {1, 1, 1}});
  gathered.add(3, {{5, 0, 0}, {6, 1, 1}});
  gathered.add(7, {{1, 0, 0}, {2, 1, 1}});
  const auto tree = gathered.build({.block_size = 1, .max_leaf_size = 1}, 0, glint::Serial{});
  REQUIRE(tree.nodes.size() == 3);
  CHECK(tree.order == std::vector<std::uint32_t>{7, 3});
  CHECK(tree.nodes[1].bounds == Aabb<float>{{0, 0, 0}, {2, 1, 1}});
}

TEST_CASE("gathered: what a leaf has of a primitive is what lies in its box", "[bvh][pass]") {
  const std::vector<Aabb<float>> boxes{{{0, 0, 0}, {4, 1, 1}}};
  const Tree<float> tree{.nodes = {{{{1, 0, 0}, {3, 1, 1}}, 0, 1}}, .order = {0}};
  Gathered<float, std::uint32_t> gathered(Repeats::Possible);
  gathered.add_below(tree, 0, Boxes{boxes});
  CHECK(gathered.build({}, 0, glint::Serial{}).nodes[0].bounds == tree.nodes[0].bounds);
}

TEST_CASE("gathered: a tree below a node is no deeper than is left", "[bvh][pass]") {
  Gathered<float, std::uint32_t> gathered(Repeats::None);
  for (std::uint32_t i = 0; i < 100; ++i) gathered.add(i, {{float(i), 0, 0}, {float(i), 1, 1}});
  CHECK(gathered.build({}, 61, glint::Serial{}).depth == 3);
  CHECK(gathered.build({}, 64, glint::Serial{}).depth == 0);
}

}  // namespace test_bvh_pass_graft
