// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/statistics.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <vector>

#include <glint/bvh/tree.hpp>

#include <support/catch.hpp>

namespace test_bvh_pass_statistics {

using glint::Tree;

TEMPLATE_TEST_CASE("statistics: agree with a tree counted by hand", "[bvh][pass]", float, double) {
  using T = TestType;
  // A 4 × 1 × 1 box of half area 9 over a unit cube (3) with 2 primitives and a 2 × 1 × 1 box (5) with 1.
  Tree<T> tree;
  tree.nodes = {{{{0, 0, 0}, {4, 1, 1}}, 1, 0}, {{{0, 0, 0}, {1, 1, 1}}, 0, 2}, {{{2, 0, 0}, {4, 1, 1}}, 2, 1}};
  tree.order = {0, 1, 2};
  tree.depth = 1;
  tree.left_out = 7;
  const glint::TreeStatistics s = statistics(tree);
  CHECK(s.nodes == 3);
  CHECK(s.leaves == 2);
  CHECK(s.primitives == 3);
  CHECK(s.references == 3);
  CHECK(s.left_out == 7);
  CHECK(s.depth == 1);
  CHECK(s.leaf_sizes == std::vector<std::size_t>{0, 1, 1});
  CHECK(s.bytes == 3 * sizeof(tree.nodes[0]) + 3 * sizeof(tree.order[0]));
  CHECK(s.sah_cost == Approx(1 + 2 * 3.0 / 9 + 1 * 5.0 / 9));
  CHECK(statistics(tree, 2, 10).sah_cost == Approx(2 + 10 * (2 * 3.0 / 9 + 1 * 5.0 / 9)));
}

TEST_CASE("statistics: of nothing are zero", "[bvh][pass]") {
  CHECK(statistics(Tree<float>{}) == glint::TreeStatistics{});
}

TEST_CASE("statistics: a root without area costs every node", "[bvh][pass]") {
  Tree<float> tree;
  tree.nodes = {{{{1, 1, 1}, {1, 1, 1}}, 1, 0}, {{{1, 1, 1}, {1, 1, 1}}, 0, 2}, {{{1, 1, 1}, {1, 1, 1}}, 2, 1}};
  tree.order = {0, 1, 2};
  CHECK(statistics(tree).sah_cost == 1 + 2 + 1);
}

TEST_CASE("statistics: a primitive in several leaves is one primitive and several references", "[bvh][pass]") {
  Tree<float> tree;
  tree.nodes = {{{{0, 0, 0}, {2, 1, 1}}, 1, 0}, {{{0, 0, 0}, {1, 1, 1}}, 0, 2}, {{{1, 0, 0}, {2, 1, 1}}, 2, 1}};
  tree.order = {0, 5, 5};
  CHECK(statistics(tree).primitives == 2);
  CHECK(statistics(tree).references == 3);
}

}  // namespace test_bvh_pass_statistics
