// SPDX-License-Identifier: MIT
#include <glint/bvh/build/deal.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/testing/builder_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_deal {

namespace {

using glint::Serial;
using namespace glint::detail;

/// By index: the first of three goes left, the second right, the third to both, as two halves of its x range.
struct ByThrees {
  static constexpr bool cuts = true;

  [[nodiscard]] Side side(const Reference<float>& r) const noexcept { return Side(r.index() % 3 + 1); }
  [[nodiscard]] std::pair<Reference<float>, Reference<float>> cut(const Reference<float>& r) const noexcept {
    auto left = PackedBox<float>(r.lower, r.upper).box();
    auto right = left;
    left.upper.x = right.lower.x = centroid(left).x;
    return {{left, r.index()}, {right, r.index()}};
  }
};

template <typename Executor>
void check(std::size_t n, const Executor& executor) {
  const auto boxes = glint::testing::random_boxes<float>(n, 1);
  const auto from = gather(glint::Boxes{boxes}, Serial{});
  const Part<float> part{.first = 7, .count = n, .spare = n};
  const std::size_t right_begin = n + n / 4;
  std::vector<Reference<float>> to(2 * n);
  const auto [left, right] = deal<float>(part, right_begin, ByThrees{}, from, to, executor);

  std::vector<std::size_t> lefts;
  std::vector<std::size_t> rights;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 3 != 1) lefts.push_back(i);
    if (i % 3 != 0) rights.push_back(i);
  }
  REQUIRE(left.count == lefts.size());
  REQUIRE(right.count == rights.size());
  CHECK(left.first == 7);
  CHECK(right.first == 7 + right_begin);
  CHECK(left.count + left.spare == right_begin);
  CHECK(right.count + right.spare == 2 * n - right_begin);
  CHECK((left.in_scratch && right.in_scratch));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < lefts.size(); ++i) wrong += std::size_t(to[i].index() != lefts[i]);
  for (std::size_t i = 0; i < rights.size(); ++i) wrong += std::size_t(to[right_begin + i].index() != rights[i]);
  CHECK(wrong == 0);
  const std::span all(std::as_const(to));
  CHECK(left.box.box() == measured<float>(all.first(left.count), 0, false).box.box());
  CHECK(right.box.box() == measured<float>(all.subspan(right_begin, right.count), 0, false).box.box());
  CHECK(left.centers.box() == measured<float>(all.first(left.count), 0, false).centers.box());
}

}  // namespace

TEST_CASE("deal: both sides get theirs in order, and the slots that are left", "[bvh][build]") {
  check(1, Serial{});
  check(100, Serial{});
}

TEST_CASE("deal: many references are dealt by chunks to the same places", "[bvh][build]") {
  check(parallel_size + 100, Serial{});
  check(parallel_size + 100, glint::testing::Backwards{});
  check(parallel_size + 100, glint::testing::TwoThreads{});
}

}  // namespace test_bvh_build_deal
