// SPDX-License-Identifier: MIT
#include <glint/bvh/query/nearest.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_nearest {

namespace {

using glint::Bvh;
using glint::Vec3;

/// Distances to all primitives, sorted, as the primitives say.
template <typename S>
std::vector<typename S::Scalar> distances(const S& set, const Vec3<typename S::Scalar>& point) {
  std::vector<typename S::Scalar> all;
  for (typename S::Index i = 0; i < set.size(); ++i)
    all.push_back(std::sqrt(glint::length_squared(set.closest_point(point, i) - point)));
  std::sort(all.begin(), all.end());
  return all;
}

template <typename Found, typename T>
bool tells_the_truth(const Found& found, const Vec3<T>& point, T distance) {
  const T slack = std::numeric_limits<T>::epsilon() * T(16);
  return std::abs(found.distance - distance) <= slack * (T(1) + distance) &&
         std::abs(std::sqrt(glint::length_squared(found.position - point)) - found.distance) <=
             slack * (T(1) + distance);
}

/// Queries that disagree with the oracle, of points inside of the scene's box, around it, and far away.
template <typename B>
std::size_t disagreements(const B& bvh, int points = 60) {
  using T = typename B::Scalar;
  glint::Random random(23);
  std::size_t wrong = 0;
  for (int i = 0; i < points; ++i) {
    const Vec3<T> point = (random.uniform_vec3<T>() * T(2) - T(1)) * (i % 3 == 0 ? T(1) : i % 3 == 1 ? T(3) : T(50));
    const auto expected = distances(bvh.set(), point);
    const auto one = closest_point(bvh, point);
    wrong += std::size_t(!one || !tells_the_truth(*one, point, expected[0]));
    std::array<glint::ClosestPoint<T>, 5> few;
    const std::size_t count = nearest_primitives(bvh, point, few);
    wrong += std::size_t(count != few.size());
    for (std::size_t k = 0; k < count; ++k) {
      wrong += std::size_t(!tells_the_truth(few[k], point, expected[k]));
      for (std::size_t other = 0; other < k; ++other)
        wrong += std::size_t(few[other].primitive == few[k].primitive);  // each once
    }
  }
  return wrong;
}

}  // namespace

TEMPLATE_TEST_CASE("nearest: the closest point and the nearest few are those of trying every triangle",
                   "[bvh][query][nearest]", float, double) {
  using T = TestType;
  const auto buffers = glint::testing::triangle_soup<T>(1500, 3);
  const auto mesh = view(buffers);
  CHECK(disagreements(Bvh{mesh}) == 0);
  CHECK(disagreements(Bvh{mesh, glint::BinnedSah{}, glint::quantized<8>}) == 0);
  auto large = glint::testing::triangle_soup<T>(600, 3);
  for (std::size_t i = 0; i < large.positions.size(); ++i) {
    const Vec3<T>& first = large.positions[i / 3 * 3];  // made larger, so that cutting them pays
    large.positions[i] = first + (large.positions[i] - first) * T(4);
  }
  const Bvh parts{view(large), glint::SpatialSah{}, glint::binary};
  REQUIRE(parts.has_parts());
  CHECK(disagreements(parts) == 0);
}

TEST_CASE("nearest: other primitives, other triangle tests and joined sets do as well", "[bvh][query][nearest]") {
  const auto buffers = glint::testing::triangle_soup<float>(300, 9);
  std::vector<glint::Sphere<float>> spheres;
  for (int i = 0; i < 30; ++i) spheres.push_back({{0.06F * float(i) - 0.9F, 0.1F, -0.1F}, 0.02F + 0.01F * float(i)});
  CHECK(disagreements(Bvh{glint::Joined{view(buffers), glint::Elements{spheres}}}) == 0);
  CHECK(disagreements(Bvh{view<glint::MoellerTrumbore>(buffers)}, 20) == 0);
}

TEST_CASE("nearest: nothing is found beyond the distance given, at a NaN, or in an empty set",
          "[bvh][query][nearest]") {
  const std::vector<glint::Sphere<float>> spheres{{{0, 0, 0}, 1}, {{10, 0, 0}, 1}};
  const Bvh bvh{glint::Elements{spheres}};
  CHECK_FALSE(closest_point(bvh, {4, 0, 0}, 2.5F));
  const auto found = closest_point(bvh, {4, 0, 0}, 3.0F);  // 4 − 1
  REQUIRE(found);
  CHECK(*found == glint::ClosestPoint<float>{{1, 0, 0}, 3, 0});
  std::array<glint::ClosestPoint<float>, 3> few;
  CHECK(nearest_primitives(bvh, {4, 0, 0}, few) == 2);
  CHECK(few[1] == glint::ClosestPoint<float>{{9, 0, 0}, 5, 1});
  CHECK(nearest_primitives(bvh, {4, 0, 0}, few, 4) == 1);
  CHECK(nearest_primitives(bvh, {4, 0, 0}, {}) == 0);
  CHECK_FALSE(closest_point(bvh, {std::numeric_limits<float>::quiet_NaN(), 0, 0}));
  CHECK_FALSE(closest_point(Bvh{glint::Elements<glint::Sphere<float>>{}}, {0, 0, 0}));
}

}  // namespace test_bvh_query_nearest
