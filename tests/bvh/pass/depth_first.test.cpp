// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/depth_first.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_pass_depth_first {

using glint::Boxes;
using glint::Tree;

namespace {

/// Pairs of siblings, and the slots of leaves, in another order and with gaps between them.
Tree<float> scattered(const Tree<float>& tree, unsigned seed) {
  std::mt19937 random(seed);
  const std::size_t pairs = tree.nodes.size() / 2;
  std::vector<std::uint32_t> place(pairs);  // of the pair at 2i + 1
  std::iota(place.begin(), place.end(), 0U);
  std::shuffle(place.begin(), place.end(), random);
  Tree<float> result = tree;
  result.nodes.resize(3 * pairs + 1);
  result.order.clear();
  result.depth = 99;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    auto node = tree.nodes[i];
    if (node.is_leaf()) {
      result.order.push_back(777);  // a slot of nobody's
      const auto first = std::uint32_t(result.order.size());
      for (std::uint32_t k = 0; k < node.count; ++k) result.order.push_back(tree.order[node.first + k]);
      node.first = first;
    } else {
      node.first = 3 * place[(node.first - 1) / 2] + 1;
    }
    result.nodes[i == 0 ? 0 : 3 * place[(i - 1) / 2] + 1 + (i - 1) % 2] = node;
  }
  return result;
}

}  // namespace

TEMPLATE_TEST_CASE("depth first: what builders make is numbered so already", "[bvh][pass]", float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    const auto tree = glint::BinnedSah{.max_leaf_size = 2}.build(Boxes{boxes});
    CHECK(depth_first(tree) == tree);
  }
}

TEST_CASE("depth first: the numbering alone changes, and what nothing refers to is dropped", "[bvh][pass]") {
  auto boxes = glint::testing::random_boxes<float>(300, 1);
  boxes[7] = {};
  const Tree<float> tree = glint::Median{.max_leaf_size = 3}.build(Boxes{boxes});
  for (unsigned seed = 0; seed < 4; ++seed) CHECK(depth_first(scattered(tree, seed)) == tree);
}

}  // namespace test_bvh_pass_depth_first
