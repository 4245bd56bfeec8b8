// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/insert.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/remove.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>
#include <support/updates.hpp>

namespace test_bvh_pass_insert {

namespace {

using glint::Aabb;
using glint::BinnedSah;
using glint::Boxes;
using glint::Median;
using glint::Tree;
using glint::Vec3;
using glint::support::check_tree;
using glint::support::cost_of;
using glint::support::some_of;
using glint::support::without;

std::vector<std::uint32_t> indices_of(std::uint32_t begin, std::uint32_t end) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = begin; i < end; ++i) indices.push_back(i);
  return indices;
}

}  // namespace

TEMPLATE_TEST_CASE("insert: any tree is valid with any primitives", "[bvh][pass]", float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    for (const std::size_t count : {std::size_t(0), std::size_t(1), boxes.size() / 20, boxes.size()}) {
      CAPTURE(count);
      const auto added = some_of(boxes.size(), count, 1);
      const auto before = without(boxes, added);
      for (const auto& tree : {Median{.max_leaf_size = 1}.build(Boxes{before}), BinnedSah{}.build(Boxes{before})}) {
        const auto more = insert(tree, Boxes{boxes}, added);
        check_tree(more, boxes);
        CHECK(insert(tree, Boxes{boxes}, added, {}, glint::testing::Backwards{}) == more);
      }
    }
  }
}

TEST_CASE("insert: the place found for a box is the best of all places", "[bvh][pass]") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto boxes = glint::testing::random_boxes<double>(41, seed);
    const auto tree = Median{.max_leaf_size = 1}.build(Boxes{std::span(boxes).first(40)});
    // By definition: what the areas of all nodes sum to, with the box beside a node, less what they sum to now.
    const auto cost = [&](std::size_t target) {
      double sum = 0;
      std::size_t at = target;
      while (at != 0) {
        std::size_t parent = 0;
        while (tree.nodes[parent].is_leaf() || tree.nodes[parent].first != ((at - 1) | 1U)) ++parent;
        sum += half_area(join(tree.nodes[parent].bounds, boxes[40])) - half_area(tree.nodes[parent].bounds);
        at = parent;
      }
      return sum + half_area(join(tree.nodes[target].bounds, boxes[40]));
    };
    double best = cost(0);
    for (std::size_t i = 1; i < tree.nodes.size(); ++i) best = std::min(best, cost(i));
    const auto place = glint::detail::insertion_place(tree, boxes[40]);
    CHECK(place.cost == Approx(best));
    CHECK(cost(place.node) == Approx(best));
  }
}

TEST_CASE("insert: an object far away stays in one piece, beside the root", "[bvh][pass]") {
  auto boxes = glint::testing::random_boxes<float>(1000, 2);
  const std::size_t near = boxes.size();
  for (Aabb<float> box : glint::testing::random_boxes<float>(50, 3))
    boxes.push_back({box.lower + Vec3<float>(1000), box.upper + Vec3<float>(1000)});
  const auto tree = BinnedSah{}.build(Boxes{std::span(boxes).first(near)});
  const auto more = insert(tree, Boxes{boxes}, indices_of(1000, 1050));
  check_tree(more, boxes);
  CHECK(more.nodes[1].bounds == tree.nodes[0].bounds);
  CHECK(contains(Aabb<float>{Vec3<float>(1000), Vec3<float>(1002)}, more.nodes[2].bounds));
}

TEST_CASE("insert: a tree with a batch more costs little more than one built for all", "[bvh][pass]") {
  for (const auto& buffers :
       {glint::testing::scanned_blob<float>(20'000, 1), glint::testing::triangle_soup<float>(20'000, 2)}) {
    const auto mesh = glint::view(buffers);
    const double fresh = cost_of(BinnedSah{}.build(mesh));
    const auto put_back = [&](const std::vector<std::uint32_t>& some) {
      return cost_of(insert(remove(BinnedSah{}.build(mesh), mesh, some), mesh, some)) / fresh;
    };
    CHECK(put_back(indices_of(500, 700)) < 1.01);
    CHECK(put_back(some_of(mesh.size(), 200, 3)) < 1.01);
    CHECK(put_back(some_of(mesh.size(), 1000, 4)) < 1.02);
    Tree<float> grown;  // of nothing, in some hundred batches: no longer a good tree, but no bad one
    for (std::uint32_t begin = 0; begin < mesh.size();) {
      const auto end = std::min(std::uint32_t(mesh.size()), begin + 1 + begin / 17);
      grown = insert(grown, mesh, indices_of(begin, end));
      begin = end;
    }
    CHECK(cost_of(grown) < 1.7 * fresh);
  }
}

TEST_CASE("insert: no tree goes deeper than trees may", "[bvh][pass]") {
  // A chain of nested boxes as deep as trees may be; then a box inside of all, and one for which the root steps down.
  constexpr std::uint32_t steps = Tree<float>::max_depth;
  std::vector<Aabb<float>> boxes;
  Tree<float> chain{.depth = steps};
  for (std::uint32_t i = 0; i <= steps; ++i) {
    boxes.push_back({Vec3<float>(0.0F), Vec3<float>(100 - float(i))});
    if (i != steps) chain.nodes.push_back({boxes[i], 2 * i + 1, 0});
    chain.nodes.push_back({boxes[i], i, 1});
    chain.order.push_back(i);
  }
  REQUIRE(violations(chain, Boxes{boxes}).empty());
  boxes.push_back({Vec3<float>(0.0F), Vec3<float>(1.0F)});
  check_tree(insert(chain, Boxes{boxes}, indices_of(65, 66)), boxes);
  boxes.push_back({Vec3<float>(1000.0F), Vec3<float>(1001.0F)});
  check_tree(insert(chain, Boxes{boxes}, indices_of(65, 67)), boxes);
}

TEST_CASE("insert: primitives without a box are left out until they have one", "[bvh][pass]") {
  auto boxes = glint::testing::random_boxes<float>(100, 5);
  const Aabb<float> box = std::exchange(boxes[7], {});
  const auto tree = insert(BinnedSah{}.build(Boxes{std::span(boxes).first(60)}), Boxes{boxes}, indices_of(60, 62));
  CHECK(tree.left_out == 1 + 38);
  boxes[7] = box;
  CHECK(insert(tree, Boxes{boxes}, std::vector{7U}).left_out == 38);
  const std::vector<Aabb<float>> none(3);
  CHECK(insert(Tree<float>{}, Boxes{none}, indices_of(0, 3)) == Tree<float>{.left_out = 3});
}

TEST_CASE("insert: every executor makes the same tree", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(40'000, 6);
  const auto added = some_of(boxes.size(), 2000, 7);
  const auto tree = BinnedSah{}.build(Boxes{without(boxes, added)});
  const auto more = insert(tree, Boxes{boxes}, added);
  check_tree(more, boxes);
  CHECK(insert(tree, Boxes{boxes}, added, {}, glint::testing::Backwards{}) == more);
  CHECK(insert(tree, Boxes{boxes}, added, {}, glint::TbbExecutor{3}) == more);
}

TEST_CASE("insert: threads do not get in each other's way", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(2000, 6);
  const auto added = some_of(boxes.size(), 60, 7);
  const auto tree = BinnedSah{}.build(Boxes{without(boxes, added)});
  CHECK(insert(tree, Boxes{boxes}, added, {}, glint::testing::TwoThreads{}) == insert(tree, Boxes{boxes}, added));
}

TEST_CASE("insert: rays meet what brute force meets, beside whole triangles and parts", "[bvh][pass][laws]") {
  for (const auto& buffers :
       {glint::testing::scanned_blob<float>(1000, 8), glint::testing::diagonal_slivers<float>(500, 9)}) {
    const auto mesh = glint::view(buffers);
    for (const std::size_t count : {mesh.size() / 30, mesh.size() / 3}) {
      const auto some = some_of(mesh.size(), count, 10);
      for (const auto& tree : {BinnedSah{}.build(mesh), glint::SpatialSah{}.build(mesh)}) {
        const auto back = insert(remove(tree, mesh, some), mesh, some);
        for (const std::string& broken : violations(back, mesh)) FAIL_CHECK(broken);
        const glint::Bvh bvh(mesh, back);
        for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(bvh, glint::BruteForce(mesh), 1))
          FAIL_CHECK(broken);
      }
    }
  }
}

}  // namespace test_bvh_pass_insert
