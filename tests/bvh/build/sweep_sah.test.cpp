// SPDX-License-Identifier: MIT
#include <glint/bvh/build/sweep_sah.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_sweep_sah {

using glint::Aabb;
using glint::Boxes;
using glint::SweepSah;

TEMPLATE_TEST_CASE("sweep sah: obeys the laws of builders whatever the boxes", "[bvh][build][laws]", float, double) {
  glint::testing::check_builder(TestType{}, SweepSah{});
  glint::testing::check_builder(TestType{}, SweepSah{.block_size = 1, .max_leaf_size = 1});
}

TEST_CASE("sweep sah: large sets are cut alike for every executor", "[bvh][build]") {
  glint::testing::check_large_builds(SweepSah{});
}

TEST_CASE("sweep sah: the depth stays within its limit", "[bvh][build]") {
  glint::testing::check_depth([](int depth) { return SweepSah{.max_leaf_size = 1, .max_depth = depth}; });
}

TEST_CASE("sweep sah: the first split is the cheapest of all splits by centers", "[bvh][build]") {
  std::mt19937 random(5);
  const auto uniform = [&] { return float(random()) * 0x1p-32F; };
  std::vector<Aabb<float>> boxes(20);
  for (Aabb<float>& box : boxes) {
    box.lower = {uniform(), uniform(), uniform()};
    box.upper = box.lower + glint::Vec3<float>{uniform(), uniform(), uniform()} * 0.2F;
  }
  double cheapest = std::numeric_limits<double>::infinity();  // by definition: every axis, every place in its order
  for (int axis = 0; axis < 3; ++axis) {
    std::sort(boxes.begin(), boxes.end(), [axis](const auto& a, const auto& b) {
      return glint::component(centroid(a), axis) < glint::component(centroid(b), axis);
    });
    for (std::size_t left = 1; left < boxes.size(); ++left) {
      const auto box_of = [&](std::size_t begin, std::size_t end) {
        return std::accumulate(boxes.begin() + std::ptrdiff_t(begin), boxes.begin() + std::ptrdiff_t(end),
                               Aabb<float>{}, [](const auto& a, const auto& b) { return join(a, b); });
      };
      const double right_cost = double(half_area(box_of(left, boxes.size()))) * double(boxes.size() - left);
      cheapest = std::min(cheapest, double(half_area(box_of(0, left))) * double(left) + right_cost);
    }
  }
  const auto tree = SweepSah{.block_size = 1, .max_leaf_size = 1}.build(Boxes{boxes});
  const auto count_below = [&](std::size_t node) {
    std::size_t count = 0;
    std::vector<std::size_t> pending{node};
    while (!pending.empty()) {
      const auto& n = tree.nodes[pending.back()];
      pending.pop_back();
      count += n.count;
      if (!n.is_leaf()) pending.insert(pending.end(), {std::size_t(n.first), std::size_t(n.first) + 1});
    }
    return double(count);
  };
  const double found = double(half_area(tree.nodes[1].bounds)) * count_below(1) +
                       double(half_area(tree.nodes[2].bounds)) * count_below(2);
  CHECK(found == Approx(cheapest).epsilon(1e-5));
}

}  // namespace test_bvh_build_sweep_sah
