// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/refit.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_pass_refit {

namespace {

using glint::Aabb;
using glint::BinnedSah;
using glint::Boxes;
using glint::Tree;
using glint::Vec3;

template <typename T>
std::vector<Aabb<T>> moved(std::vector<Aabb<T>> boxes, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return T(random()) * T(0x1p-32); };
  for (Aabb<T>& box : boxes) {
    const T x = uniform();
    const T y = uniform();
    const T z = uniform();
    box.lower += Vec3<T>{x, y, z};
    box.upper = box.lower + Vec3<T>(uniform() * T(0.2));
  }
  return boxes;
}

/// By definition: the union of all boxes below.
template <typename T>
Aabb<T> box_below(const Tree<T>& tree, std::size_t at, const std::vector<Aabb<T>>& boxes) {
  Aabb<T> box;
  std::vector<std::size_t> pending{at};
  while (!pending.empty()) {
    const auto& node = tree.nodes[pending.back()];
    pending.pop_back();
    for (std::size_t slot = node.first; slot < std::size_t(node.first) + node.count; ++slot)
      extend(box, boxes[tree.order[slot]]);
    if (!node.is_leaf()) pending.insert(pending.end(), {std::size_t(node.first), std::size_t(node.first) + 1});
  }
  return box;
}

}  // namespace

TEMPLATE_TEST_CASE("refit: each box becomes the union of those below, and nothing else changes", "[bvh][pass]", float,
                   double) {
  const auto before = glint::testing::random_boxes<TestType>(600, 1);
  const auto after = moved(before, 2);
  const auto tree = BinnedSah{}.build(Boxes{before});
  auto fitted = tree;
  const glint::Refit refit = glint::refit(fitted, Boxes{after});
  CHECK(violations(fitted, Boxes{after}).empty());
  CHECK(refit.lost == 0);
  CHECK(refit.growth == Approx(statistics(fitted).sah_cost / statistics(tree).sah_cost));
  CHECK(refit.growth > 1.5);  // each moved by a good part of the scene: a good tree no more
  CHECK(fitted.order == tree.order);
  CHECK(fitted.depth == tree.depth);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    CHECK(fitted.nodes[i].bounds == box_below(fitted, i, after));
    CHECK(fitted.nodes[i].first == tree.nodes[i].first);
    CHECK(fitted.nodes[i].count == tree.nodes[i].count);
  }
}

TEMPLATE_TEST_CASE("refit: where nothing moved nothing changes", "[bvh][pass]", float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    const auto tree = BinnedSah{}.build(Boxes{boxes});
    auto fitted = tree;
    const glint::Refit refit = glint::refit(fitted, Boxes{boxes});
    CHECK(fitted == tree);
    CHECK(refit.lost == 0);
    if (std::isfinite(statistics(tree).sah_cost)) CHECK(refit.growth == 1);
  }
}

TEST_CASE("refit: scaling and shifting all changes no cost", "[bvh][pass]") {
  auto boxes = glint::testing::random_boxes<double>(500, 3);
  auto tree = BinnedSah{}.build(Boxes{boxes});
  for (auto& box : boxes) box = {box.lower * 4.0 + 16.0, box.upper * 4.0 + 16.0};
  CHECK(glint::refit(tree, Boxes{boxes}).growth == Approx(1));
}

TEST_CASE("refit: every executor fits the same boxes", "[bvh][pass]") {
  const auto before = glint::testing::random_boxes<float>(30'000, 4);
  const auto after = moved(before, 5);
  const auto tree = BinnedSah{}.build(Boxes{before});
  auto fitted = tree;
  const glint::Refit refit = glint::refit(fitted, Boxes{after});
  const auto check = [&](const auto& executor) {
    auto other = tree;
    CHECK(glint::refit(other, Boxes{after}, executor) == refit);
    CHECK(other == fitted);
  };
  check(glint::testing::Backwards{});
  check(glint::TbbExecutor{3});
}

TEST_CASE("refit: threads do not get in each other's way", "[bvh][pass]") {
  const auto before = glint::testing::random_boxes<float>(3000, 4);
  const auto after = moved(before, 5);
  auto tree = glint::Median{.max_leaf_size = 1}.build(Boxes{before});
  auto other = tree;
  const glint::Refit refit = glint::refit(tree, Boxes{after});
  CHECK(glint::refit(other, Boxes{after}, glint::testing::TwoThreads{}) == refit);
  CHECK(other == tree);
}

TEST_CASE("refit: a primitive that lost its box takes no room, is counted, and tells that the tree is out of date",
          "[bvh][pass]") {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  auto boxes = glint::testing::random_boxes<float>(100, 6);
  auto tree = glint::Median{.max_leaf_size = 1}.build(Boxes{boxes});
  boxes[3] = {};
  boxes[4].upper.y = infinity;
  boxes[5].lower.z = nan;
  const glint::Refit refit = glint::refit(tree, Boxes{boxes});
  CHECK(refit.lost == 3);
  CHECK_FALSE(violations(tree, Boxes{boxes}).empty());
  boxes[4] = boxes[5] = {};
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) CHECK(tree.nodes[i].bounds == box_below(tree, i, boxes));
  for (Aabb<float>& box : boxes) box = {};
  CHECK(glint::refit(tree, Boxes{boxes}).lost == 100);
  CHECK(is_empty(tree.nodes[0].bounds));
}

TEST_CASE("refit: primitives in several leaves have their whole box in each", "[bvh][pass]") {
  const auto halves = glint::testing::random_boxes<float>(40, 7);
  auto tree = glint::Median{.max_leaf_size = 1}.build(Boxes{halves});
  for (auto& primitive : tree.order) primitive /= 2;
  std::vector<Aabb<float>> whole;
  for (std::size_t i = 0; i < halves.size(); i += 2) whole.push_back(join(halves[i], halves[i + 1]));
  CHECK(glint::refit(tree, Boxes{whole}).lost == 0);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) CHECK(tree.nodes[i].bounds == box_below(tree, i, whole));
}

TEMPLATE_TEST_CASE("refit: rays meet what brute force meets in the moved mesh", "[bvh][pass][laws]", float, double) {
  auto buffers = glint::testing::scanned_blob<TestType>(500, 8);
  auto tree = BinnedSah{}.build(view(buffers));
  for (auto& p : buffers.positions) p = {p.y * p.x, p.z + p.x, p.y};
  const auto mesh = glint::view(buffers);
  glint::refit(tree, mesh);
  const glint::Bvh bvh(mesh, tree);
  for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(bvh, glint::BruteForce(mesh), 1))
    FAIL_CHECK(broken);
}

}  // namespace test_bvh_pass_refit
