// SPDX-License-Identifier: MIT
#include <glint/bvh/build/radix_sort.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/testing/builder_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_radix_sort {

using glint::detail::Keys;
using glint::detail::radix_sort;

namespace {

/// Keys whose low bits tell equal ones apart: how std::stable_sort by the high bits leaves them.
[[nodiscard]] Keys stably_sorted(Keys keys, int begin_bit) {
  std::stable_sort(keys.begin(), keys.end(),
                   [=](std::uint64_t a, std::uint64_t b) { return (a >> begin_bit) < (b >> begin_bit); });
  return keys;
}

/// Random in the bits of the mask.
[[nodiscard]] Keys random_keys(std::size_t n, std::uint64_t mask) {
  std::mt19937_64 random(n);
  Keys keys(n);
  for (std::uint64_t& key : keys) key = random() & mask;
  return keys;
}

}  // namespace

TEST_CASE("radix sort: orders keys as a stable sort by their high bits does", "[bvh][build]") {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{255}, std::size_t{1000},
                              3 * glint::detail::chunk_size + 7}) {
    for (const int begin_bit : {0, 1, 13, 20, 56, 63}) {
      for (const std::uint64_t mask : {~std::uint64_t{0}, std::uint64_t{0xFFFF}, std::uint64_t{0xF00000000F000003}}) {
        CAPTURE(n, begin_bit, mask);
        const auto keys = random_keys(n, mask);
        auto sorted = keys;
        radix_sort(sorted, begin_bit, glint::Serial{});
        CHECK(sorted == stably_sorted(keys, begin_bit));
      }
    }
  }
}

TEST_CASE("radix sort: keys that agree in all bits looked at stay as they are", "[bvh][build]") {
  Keys keys{7, 3, 5, 1};
  radix_sort(keys, 3, glint::Serial{});
  CHECK(keys == Keys{7, 3, 5, 1});
}

TEST_CASE("radix sort: every executor gives the same order", "[bvh][build]") {
  const auto keys = random_keys(5 * glint::detail::chunk_size + 1, 0xFF00FF00FF);
  const auto expected = stably_sorted(keys, 8);
  const auto sorted_by = [&](const auto& executor) {
    auto sorted = keys;
    radix_sort(sorted, 8, executor);
    return sorted;
  };
  CHECK(sorted_by(glint::testing::Backwards{}) == expected);
  CHECK(sorted_by(glint::testing::TwoThreads{}) == expected);
  CHECK(sorted_by(glint::TbbExecutor{3}) == expected);
}

}  // namespace test_bvh_build_radix_sort
