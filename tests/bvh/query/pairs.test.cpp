// SPDX-License-Identifier: MIT
#include <glint/bvh/query/pairs.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_pairs {

namespace {

using glint::Bvh;
using glint::MeshBuffers;
using glint::Vec3;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// A soup of larger triangles, so that many meet.
template <typename T>
MeshBuffers<T> dense_soup(std::size_t triangles, std::uint64_t seed) {
  auto soup = glint::testing::triangle_soup<T>(triangles, seed);
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    const Vec3<T>& first = soup.positions[i / 3 * 3];
    soup.positions[i] = first + (soup.positions[i] - first) * T(4);
  }
  return soup;
}

template <typename Mesh>
Pairs tried_each(const Mesh& a, const Mesh& b) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j)
      if (overlaps(a.triangle(i), b.triangle(j))) pairs.emplace_back(i, j);
  return pairs;
}
template <typename Mesh>
Pairs tried_each(const Mesh& mesh) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    for (std::uint32_t j = i + 1; j < mesh.size(); ++j)
      if (overlaps_beyond_corners(mesh.triangle(i), mesh.triangle(j))) pairs.emplace_back(i, j);
  return pairs;
}

template <typename A, typename B>
Pairs visited_pairs(const A& a, const B& b) {
  Pairs pairs;
  for_each_overlapping_pair(a, b, [&](std::uint32_t i, std::uint32_t j) { pairs.emplace_back(i, j); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

TEMPLATE_TEST_CASE("pairs: two trees overlap in the pairs that trying each finds", "[bvh][query][pairs]", float,
                   double) {
  using T = TestType;
  const auto first = dense_soup<T>(400, 1);
  const auto second = dense_soup<T>(300, 2);
  const auto expected = tried_each(view(first), view(second));
  REQUIRE(expected.size() > 50);
  const Bvh a{view(first)};
  const Bvh b{view(second), glint::BinnedSah{}, glint::quantized<8>};
  CHECK(overlapping_pairs(a, b) == expected);
  CHECK(overlapping_pairs(a, b, glint::TbbExecutor(2)) == expected);
  CHECK(visited_pairs(a, b) == expected);
  CHECK(self_overlaps(a) == tried_each(view(first)));
}

TEST_CASE("pairs: layouts of other widths and trees of parts find the same", "[bvh][query][pairs]") {
  const auto first = dense_soup<float>(600, 3);
  const auto second = dense_soup<float>(300, 2);
  const Bvh a{view(first), glint::SpatialSah{}, glint::binary};
  REQUIRE(a.has_parts());
  CHECK(visited_pairs(a, Bvh{view(second)}) == tried_each(view(first), view(second)));
  CHECK(self_overlaps(a) == tried_each(view(first)));
}

TEST_CASE("pairs: a closed surface does not run into itself, and two of them in one mesh do", "[bvh][query][pairs]") {
  auto mesh = glint::testing::scanned_blob<float>(2000, 1);
  CHECK(self_overlaps(Bvh{view(mesh)}).empty());
  const auto once = mesh;
  const auto count = std::uint32_t(mesh.positions.size());
  for (const Vec3<float>& p : once.positions) mesh.positions.push_back(p + Vec3<float>{0.4F, 0.1F, 0});
  for (const std::uint32_t i : once.indices) mesh.indices.push_back(count + i);
  const auto found = self_overlaps(Bvh{view(mesh)}, glint::TbbExecutor(2));
  CHECK(found == tried_each(view(mesh)));
  CHECK(found.size() > 50);
}

TEST_CASE("pairs: a visit may stop it, and what is apart does not overlap", "[bvh][query][pairs]") {
  const auto first = dense_soup<float>(400, 1);
  auto second = dense_soup<float>(300, 2);
  const Bvh a{view(first)};
  int seen = 0;
  CHECK(for_each_overlapping_pair(a, Bvh{view(second)}, [&](std::uint32_t, std::uint32_t) {
          return ++seen == 2 ? glint::Walk::Stop : glint::Walk::Continue;
        }) == glint::Walk::Stop);
  CHECK(seen == 2);
  CHECK(overlaps(a, Bvh{view(second)}));
  for (Vec3<float>& p : second.positions) p.x += 5;
  CHECK_FALSE(overlaps(a, Bvh{view(second)}));
  CHECK(self_overlaps(Bvh{view(MeshBuffers<float>{})}).empty());
}

TEST_CASE("pairs: sets of several kinds overlap as each pair does", "[bvh][query][pairs]") {
  const auto soup = dense_soup<float>(200, 4);
  std::vector<glint::Sphere<float>> spheres;
  for (int i = 0; i < 30; ++i) spheres.push_back({{0.06F * float(i) - 0.9F, 0.1F, -0.1F}, 0.02F + 0.01F * float(i)});
  const auto mesh = view(soup);
  const Bvh mixed{glint::Joined{mesh, glint::Elements{spheres}}};
  Pairs expected = tried_each(mesh, mesh);
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    for (std::uint32_t j = 0; j < spheres.size(); ++j)
      if (overlaps(mesh.triangle(i), bounds(spheres[j])) && overlaps(spheres[j], mesh.bounds(i)))
        expected.emplace_back(i, std::uint32_t(mesh.size()) + j);
  std::sort(expected.begin(), expected.end());
  CHECK(overlapping_pairs(Bvh{mesh}, mixed) == expected);
}

}  // namespace test_bvh_query_pairs
