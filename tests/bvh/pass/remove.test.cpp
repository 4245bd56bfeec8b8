// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/remove.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/refit.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>
#include <support/updates.hpp>

namespace test_bvh_pass_remove {

namespace {

using glint::Aabb;
using glint::BinnedSah;
using glint::Boxes;
using glint::Median;
using glint::support::check_tree;
using glint::support::cost_of;
using glint::support::some_of;
using glint::support::without;

}  // namespace

TEMPLATE_TEST_CASE("remove: any tree is valid without any of its primitives", "[bvh][pass]", float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    for (const std::size_t count : {std::size_t(0), std::size_t(1), boxes.size() / 2, boxes.size()}) {
      const auto removed = some_of(boxes.size(), count, 1);
      const auto left = without(boxes, removed);
      check_tree(remove(Median{.max_leaf_size = 1}.build(Boxes{boxes}), Boxes{left}, removed), left);
      check_tree(remove(BinnedSah{}.build(Boxes{boxes}), Boxes{left}, removed), left);
    }
  }
}

TEST_CASE("remove: boxes shrink to what is left, and nodes with one child are no more", "[bvh][pass]") {
  const std::vector<Aabb<float>> boxes{
      {{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{100, 0, 0}, {101, 1, 1}}, {{101, 0, 0}, {102, 1, 1}}};
  const auto tree = Median{.max_leaf_size = 1}.build(Boxes{boxes});
  REQUIRE(tree.depth == 2);
  const auto less = remove(tree, Boxes{boxes}, std::vector{3U, 0U});
  REQUIRE(less.nodes.size() == 3);
  CHECK(less.depth == 1);
  CHECK(less.left_out == 2);
  CHECK(less.order == std::vector<std::uint32_t>{1, 2});
  CHECK(less.nodes[0].bounds == Aabb<float>{{1, 0, 0}, {101, 1, 1}});
  CHECK(less.nodes[1].bounds == boxes[1]);
  CHECK(less.nodes[2].bounds == boxes[2]);
}

TEST_CASE("remove: a refit of what is left finds nothing to tighten", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(3000, 2);
  const auto removed = some_of(boxes.size(), 1500, 3);
  const auto less = remove(BinnedSah{}.build(Boxes{boxes}), Boxes{boxes}, removed);
  auto fitted = less;
  glint::refit(fitted, Boxes{boxes});
  CHECK(fitted == less);
}

TEST_CASE("remove: what the tree does not have, and what is named twice, is no harm", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(100, 4);
  const auto tree = BinnedSah{}.build(Boxes{boxes});
  const auto once = remove(tree, Boxes{boxes}, std::vector{7U, 8U});
  CHECK(remove(tree, Boxes{boxes}, std::vector{8U, 7U, 8U}) == once);
  CHECK(remove(once, Boxes{boxes}, std::vector{7U}) == once);
  CHECK(once.left_out == 2);
}

TEST_CASE("remove: the tree costs little more than one built for what is left", "[bvh][pass]") {
  for (const auto& buffers :
       {glint::testing::scanned_blob<float>(20'000, 1), glint::testing::triangle_soup<float>(20'000, 2)}) {
    const auto mesh = glint::view(buffers);
    std::vector<Aabb<float>> boxes;
    for (std::uint32_t i = 0; i < mesh.size(); ++i) boxes.push_back(mesh.bounds(i));
    const auto tree = BinnedSah{}.build(mesh);
    const auto ratio = [&](std::size_t count) {
      const auto removed = some_of(boxes.size(), count, 5);
      return cost_of(remove(tree, mesh, removed)) / cost_of(BinnedSah{}.build(Boxes{without(boxes, removed)}));
    };
    CHECK(ratio(200) < 1.01);
    CHECK(ratio(10'000) < 1.1);  // whose leaves are half empty
  }
}

TEST_CASE("remove: rays do not meet what was removed, of whole triangles or of parts", "[bvh][pass][laws]") {
  for (const auto& buffers :
       {glint::testing::scanned_blob<float>(1000, 6), glint::testing::diagonal_slivers<float>(500, 7)}) {
    const auto mesh = glint::view(buffers);
    const auto removed = some_of(mesh.size(), mesh.size() / 3, 8);
    std::vector<bool> is_left(mesh.size(), true);
    for (const std::uint32_t i : removed) is_left[i] = false;
    const glint::Filtered left{mesh, [&](const auto&, const auto& hit) { return bool(is_left[hit.primitive]); }};
    for (const auto& tree : {BinnedSah{}.build(mesh), glint::SpatialSah{}.build(mesh)}) {
      const glint::Bvh bvh(mesh, remove(tree, mesh, removed));
      for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(bvh, glint::BruteForce(left), 1))
        FAIL_CHECK(broken);
    }
  }
}

}  // namespace test_bvh_pass_remove
