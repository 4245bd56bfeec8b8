// SPDX-License-Identifier: MIT
#include <glint/bvh/query/parity.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <utility>

#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_parity {

namespace {

using glint::Bvh;
using glint::Vec3;
using glint::Winding;

/// How many of random points in the box of the mesh are told to be where the exact winding number does not say, and how
/// many are inside.
template <typename B, typename C>
std::pair<std::size_t, std::size_t> wrong_and_inside(const B& bvh, const C& whole, int points) {
  using T = typename B::Scalar;
  const Winding winding{whole, glint::infinity<T>};
  const auto box = whole.bounds();
  glint::Random random(5);
  std::size_t wrong = 0;
  std::size_t inside = 0;
  for (int i = 0; i < points; ++i) {
    const Vec3<T> point = box.lower + (box.upper - box.lower) * random.uniform_vec3<T>();
    const bool expected = winding.holds(point);
    wrong += std::size_t(inside_by_parity(bvh, point) != expected);
    inside += std::size_t(expected);
  }
  return {wrong, inside};
}

}  // namespace

TEMPLATE_TEST_CASE("parity: it tells what is inside a closed mesh, as the winding number does", "[bvh][query][parity]",
                   float, double) {
  using T = TestType;
  const auto mesh = glint::testing::scanned_blob<T>(3000, 1);
  const Bvh bvh{view(mesh)};
  const auto [wrong, inside] = wrong_and_inside(bvh, bvh, 2000);
  CHECK(wrong == 0);
  CHECK(inside > 200);
  CHECK(inside < 1800);
}

TEST_CASE("parity: it does not matter which side of a triangle is outer", "[bvh][query][parity]") {
  const auto mesh = glint::testing::scanned_blob<float>(1000, 1);
  auto turned = mesh;
  for (std::size_t i = 0; i < turned.indices.size(); i += 9) std::swap(turned.indices[i], turned.indices[i + 1]);
  const Bvh bvh{view(turned), glint::BinnedSah{}, glint::binary};
  const Bvh outward{view(mesh)};
  CHECK(wrong_and_inside(bvh, outward, 500).first == 0);
}

TEST_CASE("parity: triangles that a tree has in parts count once", "[bvh][query][parity]") {
  auto mesh = glint::testing::closed_cube<float>();  // long diagonals in a row of cubes: worth cutting
  const auto one = mesh;
  for (int i = 1; i < 40; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3<float>& p : one.positions) {
      mesh.positions.push_back(p * 0.02F + Vec3<float>{0.04F * float(i) - 0.8F, 0, 0});
    }
    for (const std::uint32_t index : one.indices) mesh.indices.push_back(first + index);
  }
  const Bvh parts{view(mesh), glint::SpatialSah{}};
  REQUIRE(parts.has_parts());
  CHECK(inside_by_parity(parts, {0.5F, 0.5F, 0.5F}));
  CHECK_FALSE(inside_by_parity(parts, {-0.76F, 0, 0}));  // in a small cube inside the large one
  CHECK_FALSE(inside_by_parity(parts, {1.5F, 0, 0}));
}

TEMPLATE_TEST_CASE("parity: a ray through an edge or a corner does not count", "[bvh][query][parity]", float, double) {
  using T = TestType;
  const auto cube = glint::testing::closed_cube<T>();
  const Bvh bvh{view(cube)};
  const auto crossings = [&](const Vec3<T>& direction) {
    return glint::detail::crossings(bvh, glint::Ray<T>{.origin = Vec3<T>(0), .direction = direction});
  };
  CHECK_FALSE(crossings({1, 0, 0}));  // the diagonal of a side
  CHECK_FALSE(crossings({1, 1, T(0.3)}));
  CHECK_FALSE(crossings({1, 1, 1}));
  CHECK(crossings({1, T(0.3), T(0.2)}) == std::size_t(1));
  CHECK(inside_by_parity(bvh, {0, 0, 0}));
}

}  // namespace test_bvh_query_parity
