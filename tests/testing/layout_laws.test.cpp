// SPDX-License-Identifier: MIT
#include <glint/testing/layout_laws.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/boxes.hpp>

namespace test_testing_layout_laws {

using glint::testing::violations_of_layout_laws;

TEMPLATE_TEST_CASE("layout laws: hold for the library's layouts, for boxes of all kinds", "[testing][layout_laws]",
                   float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    const auto tree = glint::BinnedSah{}.build(glint::Boxes{boxes});
    CHECK(violations_of_layout_laws(glint::binary, tree) == std::vector<std::string>{});
    CHECK(violations_of_layout_laws(glint::wide<4>, tree) == std::vector<std::string>{});
    CHECK(violations_of_layout_laws(glint::wide<8>, tree) == std::vector<std::string>{});
    CHECK(violations_of_layout_laws(glint::quantized<8>, tree) == std::vector<std::string>{});
  }
}

namespace {

/// Lays out a tree, but not the one it is given.
template <typename Change>
struct Broken {
  template <std::floating_point T, std::unsigned_integral I>
  using Nodes = glint::BinaryNodes<T, I>;
  using Leaves = glint::DefaultLeaves;

  Change change;

  template <std::floating_point T, std::unsigned_integral I, glint::Executor E>
  [[nodiscard]] Nodes<T, I> nodes(glint::Tree<T, I> tree, const E& /*executor*/) const {
    change(tree);
    return Nodes<T, I>(tree);
  }
};

template <typename Change>
std::string first_violation(const Change& change) {
  const std::vector<glint::Aabb<float>> boxes{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}, {{5, 0, 0}, {6, 1, 1}}};
  const auto tree = glint::BinnedSah{.max_leaf_size = 1}.build(glint::Boxes{boxes});
  const auto broken = violations_of_layout_laws(Broken<Change>{change}, tree);
  return broken.empty() ? std::string() : broken.front().substr(0, broken.front().find(':'));
}

}  // namespace

TEST_CASE("layout laws: find a leaf that is lost, a box that shrank, and slots that moved", "[testing][layout_laws]") {
  CHECK(first_violation([](auto&) {}).empty());
  CHECK(first_violation([](auto& tree) { tree.nodes[2] = tree.nodes[1]; }) != "");
  CHECK(first_violation([](auto& tree) { tree.nodes.back().bounds.upper.x -= 0.5F; }) ==
        "a leaf's box holds the tree's");
  CHECK(first_violation([](auto& tree) { tree.nodes.back().count = 2; }) == "leaves keep their slots");
}

}  // namespace test_testing_layout_laws
