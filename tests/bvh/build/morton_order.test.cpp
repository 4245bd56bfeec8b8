// SPDX-License-Identifier: MIT
#include <glint/bvh/build/morton_order.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/math/vec.hpp>

#include <support/catch.hpp>

namespace test_bvh_build_morton_order {

using glint::Vec3;
using glint::detail::MortonOrder;
using glint::detail::Reference;

namespace {

template <typename T>
[[nodiscard]] std::vector<Reference<T>> points(const std::vector<Vec3<T>>& at) {
  std::vector<Reference<T>> references;
  for (const Vec3<T>& p : at) references.emplace_back(glint::Aabb<T>{p, p}, references.size());
  return references;
}

template <typename T>
[[nodiscard]] MortonOrder<T> order_of(const std::vector<Reference<T>>& references) {
  return {references, glint::detail::whole<T>(references, glint::Serial{}).centers, glint::Serial{}};
}

template <typename T>
[[nodiscard]] std::vector<std::size_t> places(const std::vector<Vec3<T>>& at) {
  const auto references = points(at);
  const auto order = order_of(references);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i != at.size(); ++i) result.push_back(order.place(i));
  return result;
}

}  // namespace

TEST_CASE("morton order: a spread number has its bits at every third place", "[bvh][build]") {
  for (int bit = 0; bit < 21; ++bit)
    CHECK(glint::detail::spread_by_three(std::uint64_t{1} << bit) == std::uint64_t{1} << (3 * bit));
  CHECK(glint::detail::spread_by_three(~std::uint64_t{0}) == 0111111111111111111111ULL);
}

TEMPLATE_TEST_CASE("morton order: the corners of a cube come with x slowest and z fastest", "[bvh][build]", float,
                   double) {
  using T = TestType;
  std::vector<Vec3<T>> corners;  // the i-th in the order, put in backwards
  for (int i = 7; i >= 0; --i) corners.push_back({T(i / 4), T(i / 2 % 2), T(i % 2)});
  CHECK(places(corners) == std::vector<std::size_t>{7, 6, 5, 4, 3, 2, 1, 0});
}

TEMPLATE_TEST_CASE("morton order: equal centers keep the order of the set", "[bvh][build]", float, double) {
  using T = TestType;
  CHECK(places<T>({Vec3<T>(T(2)), Vec3<T>(T(1)), Vec3<T>(T(2)), Vec3<T>(T(1))}) ==
        std::vector<std::size_t>{1, 3, 0, 2});
  CHECK(places(std::vector<Vec3<T>>(5, Vec3<T>(T(-3)))) == std::vector<std::size_t>{0, 1, 2, 3, 4});
  CHECK(places<T>({Vec3<T>(T(9))}) == std::vector<std::size_t>{0});
}

TEMPLATE_TEST_CASE("morton order: cells are cubes, so a long scene is cut along first", "[bvh][build]", float, double) {
  using T = TestType;
  // 8 × 1 × 1: the first cut that tells any two apart is at x = 4, whatever their y and z.
  CHECK(places<T>({{8, 0, 0}, {5, 1, 1}, {3, 1, 1}, {0, 0, 0}}) == std::vector<std::size_t>{3, 2, 1, 0});
}

TEMPLATE_TEST_CASE("morton order: the widest and the narrowest scenes have an order", "[bvh][build]", float, double) {
  using T = TestType;
  constexpr T huge = std::numeric_limits<T>::max();
  constexpr T tiny = std::numeric_limits<T>::denorm_min();
  for (const T size : {huge, tiny}) {
    const auto order = places<T>({Vec3<T>(size), Vec3<T>(-size), Vec3<T>(T(0))});
    std::vector<int> seen(3);
    for (const std::size_t place : order) ++seen.at(place);
    CHECK(seen == std::vector<int>{1, 1, 1});
  }
}

TEST_CASE("morton order: a run is split where the first bit changes in which its keys differ", "[bvh][build]") {
  const auto references = points<float>({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {8, 0, 0}, {8, 0, 0}, {8, 0, 0}});
  const auto order = order_of(references);
  CHECK(order.split(0, 6) == 3);  // at x = 4
  CHECK(order.split(0, 3) == 2);  // at x = 2
  CHECK(order.split(0, 2) == 1);  // at x = 1
  CHECK(order.split(3, 6) == 4);  // equal codes, by place: 3 = 011, 4 = 100, 5 = 101
}

}  // namespace test_bvh_build_morton_order
