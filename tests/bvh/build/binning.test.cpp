// SPDX-License-Identifier: MIT
#include <glint/bvh/build/binning.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/math/constants.hpp>
#include <glint/testing/builder_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_binning {

namespace {

using glint::Aabb;
using glint::Serial;
using namespace glint::detail;

template <typename T>
References<T> references_to(const std::vector<Aabb<T>>& boxes) {
  return gather(glint::Boxes{boxes}, Serial{});
}

/// Unit cubes in a row, as many as the argument says at each place.
std::vector<Aabb<float>> row(const std::vector<int>& counts) {
  std::vector<Aabb<float>> boxes;
  for (std::size_t place = 0; place < counts.size(); ++place) {
    const auto x = float(place);
    boxes.insert(boxes.end(), std::size_t(counts[place]), {{x, 0, 0}, {x + 1, 1, 1}});
  }
  return boxes;
}

}  // namespace

TEST_CASE("binning: bins are at least two, at most 32, and fewer for few", "[bvh][build]") {
  CHECK(bins_for(1'000'000, 16) == 16);
  CHECK(bins_for(1'000'000, 1000) == max_bins);
  CHECK(bins_for(1'000'000, -1) == 2);
  CHECK(bins_for(32, 16) == 4 + 32 / 16);
}

TEMPLATE_TEST_CASE("binning: centers fall into bins of equal width; all into the first where they do not differ",
                   "[bvh][build]", float, double) {
  using T = TestType;
  std::vector<Aabb<T>> boxes;
  for (int i = 0; i < 192; ++i)
    boxes.push_back({glint::Vec3<T>(T(i), T(2), T(0)), glint::Vec3<T>(T(i), T(2), T(-0.0))});
  const auto references = references_to(boxes);
  const auto part = whole<T>(references, Serial{});
  const Binning<T> binning(part, 16);
  REQUIRE(binning.bins == 16);
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto bin = binning(references[i]);
    CHECK(bin[0] == std::min(15, int(i) * 16 / 191));  // i of 191 widths, the last center in the last bin
    CHECK(bin[1] == 0);
    CHECK(bin[2] == 0);
  }
}

TEST_CASE("binning: many references are binned by chunks, alike for every executor", "[bvh][build]") {
  const auto boxes = glint::testing::random_boxes<float>(parallel_size + 1000, 3);
  const auto references = references_to(boxes);
  const auto part = whole<float>(references, Serial{});
  const Binning<float> binning(part, 8);
  const auto bins = filled<Bins<float>, float>(references, binning, Serial{});
  const auto backwards = filled<Bins<float>, float>(references, binning, glint::testing::Backwards{});
  Bins<float> one_by_one(binning.bins);
  for (const auto& r : references) one_by_one.add(r, binning);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t bin = 0; bin < 8; ++bin) {
      CHECK(bins.count[axis][bin] == one_by_one.count[axis][bin]);
      CHECK(bins.box[axis][bin].box() == one_by_one.box[axis][bin].box());
      CHECK(backwards.box[axis][bin].box() == bins.box[axis][bin].box());
    }
  }
}

TEST_CASE("binning: the best plane has the least area times count, and counts no more than it may", "[bvh][build]") {
  // Cubes at 0 and 3 only. Any plane between has half areas 3 and 3: cost 3 · 5 + 3 · 2 = 21 with a block size of 1.
  const auto boxes = row({5, 0, 0, 2});
  const auto references = references_to(boxes);
  const auto part = whole<float>(references, Serial{});
  const Binning<float> binning(part, 4);
  REQUIRE(binning.bins == 4);
  const auto bins = filled<Bins<float>, float>(references, binning, Serial{});
  const auto plane = best_plane(bins.box, bins.count, bins.count, 4, 1, boxes.size());
  CHECK(plane.cost == 21);
  CHECK(plane.axis == 0);
  CHECK(plane.left_count == 5);
  CHECK(plane.right_count == 2);
  CHECK(plane.fits(5));
  CHECK_FALSE(plane.fits(4));
  CHECK(best_plane(bins.box, bins.count, bins.count, 4, 4, 7).cost == 3 * 2 + 3 * 1);  // in blocks of 4
  CHECK_FALSE(best_plane(bins.box, bins.count, bins.count, 4, 1, 6).fits(7));
  const auto [left, right] = sides(bins.box, plane, 4);
  CHECK(left.box() == boxes.front());
  CHECK(right.box() == boxes.back());
}

TEST_CASE("binning: a split pays where it is cheaper than testing all", "[bvh][build]") {
  struct Costs {
    float traversal_cost = 1;
    float intersection_cost = 2;
    std::size_t block_size = 4;
  };
  Part<float> part{.count = 5};  // two blocks: 2 · 2 · area
  part.box = PackedBox<float>(Aabb<float>{{0, 0, 0}, {1, 1, 1}});
  CHECK(pays(Costs{}, part, 4.4F));  // 1 · 3 + 2 · 4.4 < 2 · 3 · 2
  CHECK_FALSE(pays(Costs{}, part, 4.6F));
}

}  // namespace test_bvh_build_binning
