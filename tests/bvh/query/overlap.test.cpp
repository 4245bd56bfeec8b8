// SPDX-License-Identifier: MIT
#include <glint/bvh/query/overlap.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_overlap {

namespace {

using glint::Aabb;
using glint::Ball;
using glint::Bvh;
using glint::Frustum;
using glint::Vec3;

template <typename T>
Frustum<T> view_of(const Vec3<T>& eye, const Vec3<T>& target, T far) {
  return glint::frustum_of(glm::perspective(T(0.8), T(1.3), T(0.05), far) *
                           glm::lookAt(glm::vec<3, T>(eye), glm::vec<3, T>(target), glm::vec<3, T>(0.1, 1, 0.2)));
}

/// Regions, from small to larger than the scene, of which a tree finds other primitives than trying each does.
template <typename B>
std::size_t disagreements(const B& bvh, int regions = 60) {
  using T = typename B::Scalar;
  glint::Random random(31);
  const glint::BruteForce all(bvh.set());
  std::size_t wrong = 0;
  std::size_t found = 0;
  const auto compare = [&](const auto& region) {
    const auto expected = overlapping(all, region);
    wrong +=
        std::size_t(overlapping(bvh, region) != expected) + std::size_t(overlaps(bvh, region) != !expected.empty());
    found += expected.size();
  };
  for (int i = 0; i < regions; ++i) {
    const Vec3<T> center = random.uniform_vec3<T>() * T(2) - T(1);
    const T size = T(i % 3 == 0 ? 0.05 : i % 3 == 1 ? 0.4 : 1.8);
    compare(Aabb<T>{center - random.uniform_vec3<T>() * size, center + random.uniform_vec3<T>() * size});
    compare(Ball<T>{center, size});
    compare(view_of(center * T(1.5), random.uniform_vec3<T>() - T(0.5), size * T(3)));
  }
  return wrong + std::size_t(found == 0);
}

}  // namespace

TEMPLATE_TEST_CASE("overlap query: trees of every layout find what trying each triangle finds", "[bvh][query][overlap]",
                   float, double) {
  using T = TestType;
  const auto buffers = glint::testing::triangle_soup<T>(1200, 3);
  const auto mesh = view(buffers);
  CHECK(disagreements(Bvh{mesh}) == 0);
  CHECK(disagreements(Bvh{mesh, glint::BinnedSah{}, glint::quantized<8>}) == 0);
  CHECK(disagreements(Bvh{mesh, glint::BinnedSah{}, glint::binary}) == 0);
  CHECK(disagreements(Bvh{mesh, glint::BinnedSah{}, glint::wide<4, glint::IndexedBlocks<4>>}) == 0);
}

TEST_CASE("overlap query: triangles without area, or with NaNs, are found as trying each does",
          "[bvh][query][overlap]") {
  const auto buffers = glint::testing::degenerate_mix<float>(900, 3);
  CHECK(disagreements(Bvh{view(buffers)}) == 0);
  CHECK(disagreements(Bvh{view(buffers), glint::BinnedSah{}, glint::wide<8, glint::IndexedBlocks<8>>}) == 0);
}

TEST_CASE("overlap query: a primitive in parts is shown once", "[bvh][query][overlap]") {
  auto buffers = glint::testing::triangle_soup<float>(600, 3);
  for (std::size_t i = 0; i < buffers.positions.size(); ++i) {
    const Vec3<float>& first = buffers.positions[i / 3 * 3];  // made larger, so that cutting them pays
    buffers.positions[i] = first + (buffers.positions[i] - first) * 4.0F;
  }
  const Bvh parts{view(buffers), glint::SpatialSah{}};
  REQUIRE(parts.has_parts());
  CHECK(disagreements(parts) == 0);
}

TEST_CASE("overlap query: sets of sets do as well, and filters are for rays", "[bvh][query][overlap]") {
  const auto buffers = glint::testing::triangle_soup<float>(300, 9);
  std::vector<glint::Sphere<float>> spheres;
  for (int i = 0; i < 30; ++i) spheres.push_back({{0.06F * float(i) - 0.9F, 0.1F, -0.1F}, 0.02F + 0.01F * float(i)});
  const auto never = [](const auto& /*ray*/, const auto& /*hit*/) { return false; };
  const glint::Filtered filtered{view(buffers), never};
  const Bvh bvh{glint::Joined{filtered, glint::Elements{spheres}}};
  CHECK(disagreements(bvh) == 0);
  CHECK(disagreements(Bvh{filtered}) == 0);
  CHECK(overlapping(bvh, Aabb<float>{Vec3<float>(-9.0F), Vec3<float>(9.0F)}).size() == 330);
}

TEMPLATE_TEST_CASE("overlap query: what was placed is looked for where it is at home", "[bvh][query][overlap]", float,
                   double) {
  using T = TestType;
  const auto buffers = glint::testing::triangle_soup<T>(100, 5);
  using Object = Bvh<glint::TriangleMesh<T>>;
  const Object object{view(buffers)};
  glint::Random random(6);
  std::vector<glint::Instance<Object>> places;
  for (int i = 0; i < 60; ++i) {
    places.push_back(place(object, glint::Affine<T>::translate(random.uniform_vec3<T>() * T(2) - T(1)) *
                                       glint::Affine<T>::rotate({1, 1, 0}, T(i)) *
                                       glint::Affine<T>::scale({T(0.3), T(0.1), T(-0.2)})));
  }
  const Bvh world{glint::Instanced{places}};
  CHECK(disagreements(world) == 0);
  // Against the triangles themselves, carried into the world: the tests may differ by rounding alone.
  std::size_t wrong = 0;
  std::size_t found = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3<T> lower = random.uniform_vec3<T>() * T(2) - T(1);
    const Aabb<T> box{lower, lower + T(0.3)};
    std::vector<std::uint32_t> expected;
    for (std::uint32_t k = 0; k < places.size(); ++k) {
      bool touches = false;
      for (std::uint32_t j = 0; j < object.set().size(); ++j) {
        const auto [a, b, c] = object.set().vertices(j);
        const auto& map = places[k].to_world;
        touches |= overlaps(glint::Triangle<T>{map.point(a), map.point(b), map.point(c)}, box);
      }
      if (touches) expected.push_back(k);
    }
    wrong += std::size_t(overlapping(world, box) != expected);
    found += expected.size();
  }
  CHECK(wrong == 0);
  CHECK(found > 50);
}

TEST_CASE("overlap query: a visit may stop it, and nothing overlaps where nothing is", "[bvh][query][overlap]") {
  const auto buffers = glint::testing::triangle_soup<float>(300, 9);
  const Bvh bvh{view(buffers)};
  const Aabb<float> everything{Vec3<float>(-glint::infinity<float>), Vec3<float>(glint::infinity<float>)};
  int seen = 0;
  CHECK(for_each_overlapping(bvh, everything, [&](std::uint32_t) {
          return ++seen == 3 ? glint::Walk::Stop : glint::Walk::Continue;
        }) == glint::Walk::Stop);
  CHECK(seen == 3);
  CHECK(overlapping(bvh, everything).size() == 300);
  CHECK_FALSE(overlaps(bvh, Aabb<float>{}));
  CHECK_FALSE(overlaps(Bvh{glint::Elements<glint::Sphere<float>>{}}, everything));
}

}  // namespace test_bvh_query_overlap
