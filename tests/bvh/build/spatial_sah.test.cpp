// SPDX-License-Identifier: MIT
#include <glint/bvh/build/spatial_sah.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/closed_meshes.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_spatial_sah {

namespace {

using glint::Aabb;
using glint::Boxes;
using glint::Bvh;
using glint::MeshBuffers;
using glint::Ray;
using glint::SpatialSah;
using glint::Vec3;

/// Cuts whatever it can.
constexpr SpatialSah eager{
    .block_size = 1, .max_leaf_size = 2, .memory_budget = 4, .min_overlap = 0, .min_child_overlap = 0};

/// Two sheets of long thin triangles that lie across the axes, over many small ones: what splits of objects are bad at.
template <typename T>
MeshBuffers<T> lattice(std::size_t triangles) {
  MeshBuffers<T> mesh = glint::testing::triangle_soup<T>(triangles, 3);
  for (std::size_t i = 0; i < triangles; i += 4) {
    const T x = T(2) * T(i) / T(triangles) - T(1);
    mesh.positions[3 * i] = {x, T(-1), T(-1)};
    mesh.positions[3 * i + 1] = {x, T(-0.99), T(-1)};
    mesh.positions[3 * i + 2] = {-x, T(1), T(1)};
  }
  return mesh;
}

template <typename T>
std::vector<std::pair<std::string, MeshBuffers<T>>> meshes() {
  return {{"no triangle", {}},
          {"one triangle", glint::testing::identical_triangles<T>(1)},
          {"a cube, whose faces are its bounds", glint::testing::closed_cube<T>()},
          {"soup", glint::testing::triangle_soup<T>(300, 2)},
          {"slivers", glint::testing::diagonal_slivers<T>(150, 3)},
          {"long triangles among short ones", lattice<T>(200)},
          {"equal triangles", glint::testing::identical_triangles<T>(100)},
          {"coincident centroids", glint::testing::coincident_centroids<T>(100, 4)},
          {"broken triangles", glint::testing::degenerate_mix<T>(200, 5)},
          {"a closed surface", glint::testing::scanned_blob<T>(500, 6)},
          {"terrain", glint::testing::terrain<T>(300, 7)}};
}

template <typename Set>
void check_rays(const Set& set, const SpatialSah& builder, std::uint32_t seed) {
  const auto tree = builder.build(set);
  const glint::BruteForce oracle(set);
  const auto check = [&](const auto& bvh) {
    glint::testing::RaySource<typename Set::Scalar> source(oracle.bounds(), seed);
    int wrong = 0;
    for (int i = 0; i < 500; ++i) {
      const auto ray = source.next();
      const auto hit = oracle.closest(ray);
      wrong += int(bvh.closest(ray) != hit) + int(bvh.occluded(ray) != hit.has_value());
    }
    CHECK(wrong == 0);
    for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(bvh, oracle, seed))
      FAIL_CHECK(broken);
  };
  check(Bvh(set, tree, glint::wide<8>));
  check(Bvh(set, tree, glint::wide<4>));
  check(Bvh(set, tree, glint::binary));
}

template <typename T>
std::vector<glint::Triangle<T>> triangles_of(const MeshBuffers<T>& buffers) {
  std::vector<glint::Triangle<T>> triangles;
  for (std::uint32_t i = 0; i < view(buffers).size(); ++i) triangles.push_back(view(buffers).triangle(i));
  return triangles;
}

}  // namespace

TEMPLATE_TEST_CASE("spatial sah: obeys the laws of builders whatever the boxes", "[bvh][build][laws]", float, double) {
  glint::testing::check_builder(TestType{}, SpatialSah{});
  glint::testing::check_builder(TestType{}, eager);
  glint::testing::check_builder(TestType{}, SpatialSah{.bins = 2, .max_leaf_size = 0, .max_depth = 7});
}

TEMPLATE_TEST_CASE("spatial sah: obeys the laws of builders whatever the triangles", "[bvh][build][laws]", float,
                   double) {
  for (const auto& [name, buffers] : meshes<TestType>()) {
    CAPTURE(name);
    for (const SpatialSah& builder : {SpatialSah{}, eager}) {
      for (const std::string& broken : glint::testing::violations_of_builder_laws(builder, view(buffers)))
        FAIL_CHECK(broken);
    }
  }
}

TEST_CASE("spatial sah: large sets are cut alike for every executor", "[bvh][build]") {
  glint::testing::check_large_builds(SpatialSah{});
  const auto buffers = lattice<float>(50'000);
  for (const std::string& broken : glint::testing::violations_of_builder_laws(SpatialSah{}, view(buffers)))
    FAIL_CHECK(broken);
  CHECK(SpatialSah{}.build(view(buffers), glint::testing::TwoThreads{}) == SpatialSah{}.build(view(buffers)));
}

TEST_CASE("spatial sah: the depth stays within its limit", "[bvh][build]") {
  glint::testing::check_depth([](int depth) {
    SpatialSah builder = eager;
    builder.max_depth = depth;
    return builder;
  });
}

TEMPLATE_TEST_CASE("spatial sah: rays hit exactly what brute force hits", "[bvh][build][laws]", float, double) {
  for (const auto& [name, buffers] : meshes<TestType>()) {
    CAPTURE(name);
    check_rays(view(buffers), eager, 1);
    check_rays(view(buffers), SpatialSah{}, 2);
  }
}

TEMPLATE_TEST_CASE("spatial sah: sets of all kinds are hit as by brute force, whether they clip or not",
                   "[bvh][build][laws]", float, double) {
  using T = TestType;
  const auto buffers = lattice<T>(120);
  const auto triangles = triangles_of(buffers);
  std::vector<glint::Sphere<T>> spheres;
  glint::Random random(4);
  for (int i = 0; i < 40; ++i) {
    const Vec3<T> center = random.uniform_vec3<T>() * T(2) - T(1);
    spheres.push_back({center, random.uniform(T(0.05), T(0.6))});
  }
  const glint::Elements elements{triangles};
  const glint::Elements balls{spheres};
  static_assert(glint::ClippableSet<decltype(elements)> && !glint::ClippableSet<decltype(balls)>);
  const glint::Joined joined{balls, view(buffers), elements};
  static_assert(glint::ClippableSet<decltype(joined)> && !glint::ClippableSet<glint::Joined<decltype(balls)>>);
  check_rays(elements, eager, 3);
  check_rays(balls, eager, 4);
  check_rays(joined, eager, 5);
  for (const std::string& broken : glint::testing::violations_of_builder_laws(eager, joined)) FAIL_CHECK(broken);
}

TEMPLATE_TEST_CASE("spatial sah: no ray through an edge or a vertex leaks out of a closed mesh", "[bvh][build]", float,
                   double) {
  using T = TestType;
  for (const T offset : {T(0), T(100)}) {
    MeshBuffers<T> mesh = glint::testing::rough_sphere<T>(3, 2);
    const Vec3<T> center(offset);
    for (Vec3<T>& p : mesh.positions)
      p = p * Vec3<T>(T(1), T(0.01), T(1)) + center;  // flat: triangles lie across the axes
    const Bvh bvh(view(mesh), eager);
    REQUIRE(bvh.statistics().references > bvh.statistics().primitives);
    int leaks = 0;
    for (std::uint32_t i = 0; i < view(mesh).size(); ++i) {
      const auto v = view(mesh).vertices(i);
      for (std::size_t k = 0; k < 3; ++k) {
        for (const T share : {T(0), T(0.5), T(0.3), T(0.9)}) {
          const Vec3<T> target = v[k] + (v[(k + 1) % 3] - v[k]) * share;
          leaks += int(!bvh.occluded({.origin = center, .direction = target - center}));
          leaks += int(!bvh.closest({.origin = center, .direction = target - center}));
        }
      }
    }
    CHECK(leaks == 0);
  }
}

TEST_CASE("spatial sah: long triangles among short ones are cut, and rays have less to do", "[bvh][build]") {
  const auto buffers = lattice<float>(5000);
  const auto whole = statistics(glint::BinnedSah{}.build(view(buffers)));
  const auto cut = statistics(SpatialSah{.memory_budget = 3}.build(view(buffers)));
  CHECK(cut.primitives == 5000);
  CHECK(cut.references > cut.primitives);
  CHECK(cut.sah_cost < 0.8 * whole.sah_cost);
}

TEST_CASE("spatial sah: there are no more slots than the budget allows", "[bvh][build]") {
  const auto buffers = lattice<float>(3000);
  for (const float budget : {0.0F, 1.0F, 1.1F, 1.5F, 3.0F}) {
    SpatialSah builder = eager;
    builder.memory_budget = budget;
    const auto tree = builder.build(view(buffers));
    CAPTURE(budget);
    CHECK(double(tree.order.size()) <= std::max(1.0, double(budget)) * 3000);
    CHECK(violations(tree, view(buffers)).empty());
  }
}

TEST_CASE("spatial sah: a box that crosses two clusters is cut between them", "[bvh][build]") {
  std::vector<Aabb<float>> boxes{{{0, 0, 0}, {1010, 1, 1}}};
  for (int i = 0; i < 20; ++i) {
    const float x = float(i % 10) + (i < 10 ? 0.0F : 1000.0F);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  const auto tree = SpatialSah{.memory_budget = 2}.build(Boxes{boxes});
  CHECK(tree.order.size() > boxes.size());
  CHECK(tree.nodes[1].bounds.upper.x == tree.nodes[2].bounds.lower.x);  // they meet at the plane
}

}  // namespace test_bvh_build_spatial_sah
