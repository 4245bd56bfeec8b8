// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/rebuild.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/refit.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>
#include <support/updates.hpp>

namespace test_bvh_pass_rebuild {

namespace {

using glint::Aabb;
using glint::BinnedSah;
using glint::Boxes;
using glint::Tree;
using glint::Vec3;
using glint::support::check_tree;
using glint::support::cost_of;

/// The boxes whose corner is in a range of x change places.
template <typename T>
std::vector<Aabb<T>> shuffled(std::vector<Aabb<T>> boxes, T begin, T end, unsigned seed) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (boxes[i].lower.x >= begin && boxes[i].lower.x < end) chosen.push_back(i);
  auto to = chosen;
  std::shuffle(to.begin(), to.end(), std::mt19937(seed));
  const auto before = boxes;
  for (std::size_t i = 0; i < chosen.size(); ++i) boxes[chosen[i]] = before[to[i]];
  return boxes;
}

}  // namespace

TEMPLATE_TEST_CASE("rebuild: any tree stays valid and costs no more", "[bvh][pass]", float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    auto moved = boxes;
    std::shuffle(moved.begin(), moved.end(), std::mt19937(1));
    if (name == "some with a box" || name == "none with a box") moved = boxes;  // else some would come back
    for (const auto& built : {glint::Median{.max_leaf_size = 1}.build(Boxes{boxes}), BinnedSah{}.build(Boxes{boxes})}) {
      auto tree = built;
      glint::refit(tree, Boxes{moved});
      const auto rebuilt = rebuild(tree, Boxes{moved}, built);
      check_tree(rebuilt.tree, moved);
      CHECK_FALSE(cost_of(rebuilt.tree) > 1.00001 * cost_of(tree));  // but for rounding; both may be no number
      CHECK(rebuild(tree, Boxes{moved}, built, {}, glint::testing::Backwards{}).tree == rebuilt.tree);
    }
  }
}

TEST_CASE("rebuild: where nothing moved nothing is done", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(2000, 1);
  const auto tree = BinnedSah{}.build(Boxes{boxes});
  const auto rebuilt = rebuild(tree, Boxes{boxes}, tree);
  CHECK(rebuilt.tree == tree);
  CHECK(rebuilt.subtrees == 0);
  CHECK(rebuilt.primitives == 0);
}

TEST_CASE("rebuild: a subtree that degraded is built anew, and it alone", "[bvh][pass]") {
  // Two clouds far apart; the second is shuffled.
  auto boxes = glint::testing::random_boxes<float>(1000, 2);
  for (Aabb<float> box : glint::testing::random_boxes<float>(1000, 3))
    boxes.push_back({box.lower + Vec3<float>(10, 0, 0), box.upper + Vec3<float>(10, 0, 0)});
  const auto moved = shuffled(boxes, 10.0F, 20.0F, 4);
  const auto built = BinnedSah{}.build(Boxes{boxes});
  auto tree = built;
  glint::refit(tree, Boxes{moved});
  const auto fresh = BinnedSah{}.build(Boxes{moved});
  REQUIRE(cost_of(tree) > 1.5 * cost_of(fresh));
  const auto rebuilt = rebuild(tree, Boxes{moved}, built);
  check_tree(rebuilt.tree, moved);
  CHECK(rebuilt.subtrees == 1);
  CHECK(rebuilt.primitives == 1000);
  CHECK(cost_of(rebuilt.tree) < 1.001 * cost_of(fresh));
}

TEST_CASE("rebuild: where all degraded the tree is a new one", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(2000, 5);
  const auto moved = shuffled(boxes, 0.0F, 2.0F, 6);
  const auto built = BinnedSah{}.build(Boxes{boxes});
  auto tree = built;
  glint::refit(tree, Boxes{moved});
  const auto rebuilt = rebuild(tree, Boxes{moved}, built);
  CHECK(rebuilt.subtrees == 1);
  CHECK(rebuilt.primitives == 2000);
  CHECK(cost_of(rebuilt.tree) == Approx(cost_of(BinnedSah{}.build(Boxes{moved}))).epsilon(0.01));
  CHECK(rebuild(tree, Boxes{moved}, built, {.growth = 1000}).tree == tree);  // unless nobody minds
}

TEST_CASE("rebuild: a mesh of which a part moves costs about what a new tree does", "[bvh][pass]") {
  auto buffers = glint::testing::scanned_blob<float>(20'000, 1);
  const auto built = BinnedSah{}.build(view(buffers));
  std::mt19937 random(7);
  const auto shake = [&] { return 0.1F * (float(random()) * 0x1p-32F - 0.5F); };
  const Aabb<float> all = built.nodes[0].bounds;
  for (auto& p : buffers.positions) {
    if (p.x > all.lower.x + 0.1F * extent(all).x) continue;
    p.x += shake();
    p.y += shake();
    p.z += shake();
  }
  auto tree = built;
  glint::refit(tree, view(buffers));
  const double fresh = cost_of(BinnedSah{}.build(view(buffers)));
  const auto rebuilt = rebuild(tree, view(buffers), built);
  for (const std::string& broken : violations(rebuilt.tree, view(buffers))) FAIL_CHECK(broken);
  CHECK(cost_of(tree) > 1.02 * fresh);
  CHECK(cost_of(rebuilt.tree) < 1.015 * fresh);
  CHECK(rebuilt.primitives < buffers.indices.size() / 2);
}

TEST_CASE("rebuild: what lost its box is left out of what is built anew", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(500, 8);
  auto moved = shuffled(boxes, 0.0F, 2.0F, 9);
  moved[3] = moved[4] = {};
  const auto built = BinnedSah{}.build(Boxes{boxes});
  auto tree = built;
  REQUIRE(glint::refit(tree, Boxes{moved}).lost == 2);
  const auto rebuilt = rebuild(tree, Boxes{moved}, built);
  check_tree(rebuilt.tree, moved);
  CHECK(rebuilt.tree.left_out == 2);
}

TEST_CASE("rebuild: every executor makes the same tree", "[bvh][pass]") {
  const auto boxes = glint::testing::random_boxes<float>(20'000, 10);
  const auto moved = shuffled(boxes, 0.2F, 0.4F, 11);
  const auto built = BinnedSah{}.build(Boxes{boxes});
  auto tree = built;
  glint::refit(tree, Boxes{moved});
  const auto rebuilt = rebuild(tree, Boxes{moved}, built);
  CHECK(rebuilt.primitives > 0);
  CHECK(rebuild(tree, Boxes{moved}, built, {}, glint::TbbExecutor{3}).tree == rebuilt.tree);
  CHECK(rebuild(tree, Boxes{moved}, built, {}, glint::testing::TwoThreads{}).tree == rebuilt.tree);
}

TEST_CASE("rebuild: rays meet what brute force meets, in whole triangles and parts", "[bvh][pass][laws]") {
  for (const auto& buffers :
       {glint::testing::scanned_blob<float>(1000, 12), glint::testing::diagonal_slivers<float>(500, 12)}) {
    const auto built = glint::SpatialSah{}.build(view(buffers));
    auto moved = buffers;
    std::mt19937 random(13);
    for (std::size_t i = 0; i + 2 < moved.positions.size(); i += 3) {  // each somewhere else
      const Vec3<float> by(3 * (float(random()) * 0x1p-32F), 3 * (float(random()) * 0x1p-32F), 0);
      for (std::size_t k = i; k < i + 3; ++k) moved.positions[k] += by;
    }
    const auto mesh = glint::view(moved);
    auto tree = built;
    glint::refit(tree, mesh);
    const auto rebuilt = rebuild(tree, mesh, built, {.growth = 0});  // whatever can be better
    CHECK(rebuilt.subtrees > 0);
    for (const std::string& broken : violations(rebuilt.tree, mesh)) FAIL_CHECK(broken);
    const glint::Bvh bvh(mesh, rebuilt.tree);
    for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(bvh, glint::BruteForce(mesh), 1))
      FAIL_CHECK(broken);
  }
}

}  // namespace test_bvh_pass_rebuild
