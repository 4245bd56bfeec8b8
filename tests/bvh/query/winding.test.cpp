// SPDX-License-Identifier: MIT
#include <glint/bvh/query/winding.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_winding {

namespace {

using glint::Bvh;
using glint::MeshBuffers;
using glint::Vec3;
using glint::Winding;

template <typename T>
Vec3<T> anywhere(glint::Random& random, T reach) {
  return (random.uniform_vec3<T>() * T(2) - T(1)) * reach;
}

/// The oracle: the sum of all solid angles.
template <typename Mesh, typename T>
double summed(const Mesh& mesh, const Vec3<T>& point) {
  double sum = 0;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) sum += double(signed_solid_angle(point, mesh.triangle(i)));
  return sum / (4 * glint::pi<double>);
}

/// The largest difference from the oracle, of random points in and around the mesh.
template <typename W>
double worst_error(const W& winding, int points) {
  using T = typename W::Scalar;
  glint::Random random(8);
  double worst = 0;
  for (int i = 0; i < points; ++i) {
    const Vec3<T> point = anywhere(random, T(1.5));
    worst = std::max(worst, std::abs(double(winding.number(point)) - summed(winding.bvh().set(), point)));
  }
  return worst;
}

/// Around z, of the radii 1 and 0.4.
template <typename T>
MeshBuffers<T> torus(std::uint32_t cuts) {
  MeshBuffers<T> mesh;
  for (std::uint32_t i = 0; i < cuts; ++i) {
    for (std::uint32_t j = 0; j < cuts; ++j) {
      const T u = T(2) * glint::pi<T> * T(i) / T(cuts);
      const T v = T(2) * glint::pi<T> * T(j) / T(cuts);
      const T r = T(1) + T(0.4) * std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), T(0.4) * std::sin(v));
      const std::uint32_t i1 = (i + 1) % cuts;
      const std::uint32_t j1 = (j + 1) % cuts;
      const std::uint32_t a = i * cuts + j;
      const std::uint32_t b = i1 * cuts + j;
      const std::uint32_t c = i1 * cuts + j1;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, i * cuts + j1});
    }
  }
  return mesh;
}

}  // namespace

TEMPLATE_TEST_CASE("winding: an octant's triangle is seen under an eighth of all directions", "[bvh][query][winding]",
                   float, double) {
  using T = TestType;
  const glint::Triangle<T> triangle{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // its outer side is away from the origin
  CHECK(signed_solid_angle(Vec3<T>{0, 0, 0}, triangle) == Approx(double(glint::pi<T>) / 2));  // 4π / 8
  CHECK(signed_solid_angle(Vec3<T>{100, 100, 100}, triangle) < T(0));
  CHECK(signed_solid_angle(Vec3<T>{5, T(-2), T(-2)}, triangle) == T(0));  // in its plane
}

TEMPLATE_TEST_CASE("winding: it is 1 inside of a cube and 0 outside, and the missing sixth where one side is open",
                   "[bvh][query][winding]", float, double) {
  using T = TestType;
  auto cube = glint::testing::closed_cube<T>();
  glint::Random random(3);
  {
    const Bvh bvh{view(cube)};
    const Winding winding{bvh, glint::infinity<T>};
    std::size_t wrong = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3<T> p = anywhere(random, T(2));
      const T expected = glint::max_component(abs(p)) < T(1) ? T(1) : T(0);
      wrong += std::size_t(std::abs(winding.number(p) - expected) > T(1e-5)) +
               std::size_t(winding.holds(p) != (expected > T(0)));
    }
    CHECK(wrong == 0);
  }
  cube.indices.resize(cube.indices.size() - 6);  // the last two triangles are one side
  const Bvh open{view(cube)};
  CHECK(Winding{open, glint::infinity<T>}.number({0, 0, 0}) == Approx(5.0 / 6));
}

TEMPLATE_TEST_CASE("winding: in a tree it is the sum of solid angles, closely by dipoles and exactly without",
                   "[bvh][query][winding]", float, double) {
  using T = TestType;
  const auto blob = glint::testing::scanned_blob<T>(3000, 1);
  const Bvh bvh{view(blob)};
  CHECK(worst_error(Winding{bvh, glint::infinity<T>}, 100) < 1e-4);
  CHECK(worst_error(Winding{bvh}, 300) < 0.05);
  CHECK(worst_error(Winding{bvh, T(6)}, 300) < 0.005);
  const auto hills = glint::testing::terrain<T>(2000, 1);  // open
  const Bvh open{view(hills), glint::BinnedSah{}, glint::quantized<8>};
  CHECK(worst_error(Winding{open}, 300) < 0.05);
}

TEST_CASE("winding: binary trees do as well, and those with triangles in parts are refused", "[bvh][query][winding]") {
  const auto blob = glint::testing::scanned_blob<float>(1000, 1);
  const Bvh bvh{view(blob), glint::BinnedSah{}, glint::binary};
  CHECK(worst_error(Winding{bvh}, 200) < 0.05);
  auto soup = glint::testing::triangle_soup<float>(600, 3);
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    const Vec3<float>& first = soup.positions[i / 3 * 3];
    soup.positions[i] = first + (soup.positions[i] - first) * 4.0F;
  }
  const Bvh parts{view(soup), glint::SpatialSah{}};
  REQUIRE(parts.has_parts());
  CHECK_THROWS_AS(Winding{parts}, std::invalid_argument);
  const Bvh nothing{view(MeshBuffers<float>{})};
  CHECK(Winding{nothing}.number({0, 0, 0}) == 0.0F);
  CHECK(signed_distance(Winding{nothing}, {0, 0, 0}) == glint::infinity<float>);
}

TEMPLATE_TEST_CASE("winding: the signed distance is that of the cube and of the torus", "[bvh][query][winding]", float,
                   double) {
  using T = TestType;
  const auto cube = glint::testing::closed_cube<T>();
  const auto ring = torus<T>(160);
  const Bvh cube_tree{view(cube)};
  const Bvh ring_tree{view(ring)};
  const Winding in_cube{cube_tree};
  const Winding in_ring{ring_tree};
  glint::Random random(4);
  double worst_cube = 0;
  double worst_ring = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3<T> p = anywhere(random, T(1.8));
    const Vec3<T> q = abs(p) - T(1);
    const T outside = std::sqrt(glint::length_squared(max(q, Vec3<T>(T(0)))));
    const T expected = outside + std::min(glint::max_component(q), T(0));
    worst_cube = std::max(worst_cube, double(std::abs(signed_distance(in_cube, p) - expected)));
    const T from_circle = std::hypot(std::hypot(p.x, p.y) - T(1), p.z);
    worst_ring = std::max(worst_ring, double(std::abs(signed_distance(in_ring, p) - (from_circle - T(0.4)))));
  }
  CHECK(worst_cube < 1e-5);
  // Chords of 2π / 160 leave a circle of radius r by r (1 − cos(π / 160)): 0.0002 r, for radii of up to 1.4 and of 0.4.
  CHECK(worst_ring < 0.001);
}

}  // namespace test_bvh_query_winding
