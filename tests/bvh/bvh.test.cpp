// SPDX-License-Identifier: MIT
#include <glint/bvh/bvh.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/collapse.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>

namespace test_bvh_bvh {

namespace {

using glint::BinnedSah;
using glint::BruteForce;
using glint::Bvh;
using glint::Elements;
using glint::Joined;
using glint::Median;
using glint::MeshBuffers;
using glint::Ray;
using glint::Sphere;
using glint::SweepSah;
using glint::Vec3;

static_assert(glint::RayCaster<Bvh<glint::TriangleMesh<float>>>);
static_assert(glint::RayCaster<BruteForce<glint::TriangleMesh<double>>>);

template <typename T>
std::vector<std::pair<std::string, MeshBuffers<T>>> meshes() {
  return {{"no triangle", {}},
          {"one triangle", glint::testing::identical_triangles<T>(1)},
          {"two triangles", glint::testing::triangle_soup<T>(2, 1)},
          {"a cube, whose faces are its bounds", glint::testing::closed_cube<T>()},
          {"soup", glint::testing::triangle_soup<T>(400, 2)},
          {"slivers", glint::testing::diagonal_slivers<T>(150, 3)},
          {"equal triangles", glint::testing::identical_triangles<T>(100)},
          {"coincident centroids", glint::testing::coincident_centroids<T>(100, 4)},
          {"broken triangles", glint::testing::degenerate_mix<T>(200, 5)},
          {"a closed surface", glint::testing::scanned_blob<T>(500, 6)},
          {"terrain", glint::testing::terrain<T>(300, 7)}};
}

template <typename T>
std::vector<Sphere<T>> spheres(std::size_t n) {
  std::mt19937 random(11);
  const auto uniform = [&] { return T(random()) * T(0x1p-31) - T(1); };
  std::vector<Sphere<T>> result(n);
  for (Sphere<T>& s : result) {
    s.center = {uniform(), uniform(), uniform()};
    s.radius = T(0.15) * (uniform() + T(1.1));
  }
  return result;
}

template <typename Geometry, typename Set>
void check_laws(const Geometry& geometry, const Set& set) {
  const BruteForce oracle(set);
  CHECK(geometry.bounds() == oracle.bounds());
  for (std::uint32_t seed = 0; seed < 2; ++seed) {
    for (const std::string& broken : glint::testing::violations_of_ray_caster_laws(geometry, oracle, seed)) {
      CAPTURE(seed);
      FAIL_CHECK(broken);
    }
  }
}

template <typename Set>
void check_every_composition(const Set& set) {
  const auto with_layouts = [&](const auto& builder) {
    check_laws(Bvh(set, builder, glint::wide<8>), set);
    check_laws(Bvh(set, builder, glint::wide<4>), set);
    check_laws(Bvh(set, builder, glint::wide<2>), set);
    check_laws(Bvh(set, builder, glint::WideLayout<8>{glint::Collapse::Greedy}), set);
    check_laws(Bvh(set, builder, glint::quantized<8>), set);
    check_laws(Bvh(set, builder, glint::quantized<4>), set);
    check_laws(Bvh(set, builder, glint::binary), set);
  };
  with_layouts(BinnedSah{});
  with_layouts(SweepSah{});
  with_layouts(Median{.max_leaf_size = 1});
}

}  // namespace

TEMPLATE_TEST_CASE("bvh: every builder and layout answers as brute force does", "[bvh][laws]", float, double) {
  for (const auto& [name, buffers] : meshes<TestType>()) {
    CAPTURE(name);
    check_every_composition(view(buffers));
  }
}

TEMPLATE_TEST_CASE("bvh: sets of the user's primitives answer as brute force does", "[bvh][laws]", float, double) {
  const auto shapes = spheres<TestType>(60);
  check_every_composition(Elements{shapes});
}

TEMPLATE_TEST_CASE("bvh: triangles without blocks answer as brute force does", "[bvh][laws]", float, double) {
  const auto soup = glint::testing::triangle_soup<TestType>(300, 12);
  const auto set = glint::view<glint::MoellerTrumbore>(soup);
  check_laws(Bvh(set), set);
}

TEMPLATE_TEST_CASE("bvh: joined sets answer as brute force does, each with its own kind of leaves", "[bvh][laws]",
                   float, double) {
  const auto shapes = spheres<TestType>(40);
  const auto soup = glint::testing::triangle_soup<TestType>(150, 8);
  const auto same = glint::testing::identical_triangles<TestType>(20);
  const std::vector<Sphere<TestType>> nobody;
  check_every_composition(Joined{Elements{shapes}, view(soup), Elements{nobody}, view(same), Elements{shapes}});
}

TEST_CASE("bvh: far from the origin and at all scales, no hit is lost", "[bvh][laws]") {
  for (const float scale : {1e-6F, 1.0F, 1e6F}) {
    for (const float offset : {0.0F, 1e4F}) {
      auto buffers = glint::testing::scanned_blob<float>(400, 9);
      for (auto& p : buffers.positions) p = (p + offset) * scale;
      CAPTURE(scale, offset);
      const auto mesh = view(buffers);
      check_laws(Bvh(mesh), mesh);
    }
  }
}

TEST_CASE("bvh: of hits at the same t, the primitive of the smallest index wins", "[bvh]") {
  const auto buffers = glint::testing::identical_triangles<float>(50);
  const Bvh bvh(view(buffers));
  const auto hit = bvh.closest({.origin = {0, 0, 2}});
  REQUIRE(hit);
  CHECK(hit->primitive == 0);
  const auto mesh = view(buffers);
  const Bvh joined(Joined{mesh, mesh});
  CHECK(joined.closest({.origin = {0, 0, 2}})->primitive == 0);
}

TEST_CASE("bvh: primitives without a finite box are counted and never hit", "[bvh]") {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::vector<Sphere<float>> shapes{
      {{0, 0, 0}, 1}, {{nan, 0, 0}, 1}, {{0, 0, 0}, infinity}, {{4, 0, 0}, 1}, {{0, 0, infinity}, 1}};
  const Bvh bvh(Elements{shapes});
  CHECK(bvh.statistics().left_out == 3);
  CHECK(bvh.statistics().primitives == 2);
  CHECK(bvh.bounds().upper.x == 5);
  CHECK(bvh.closest({.origin = {9, 0, 0}, .direction = {-1, 0, 0}})->primitive == 3);
  CHECK_FALSE(bvh.occluded({.origin = {9, 3, 0}, .direction = {-1, 0, 0}}));
}

TEST_CASE("bvh: a set of nothing has empty bounds and is never hit", "[bvh]") {
  const std::vector<Sphere<float>> nobody;
  const Bvh bvh(Elements{nobody});
  CHECK(is_empty(bvh.bounds()));
  CHECK_FALSE(bvh.closest({}));
  CHECK_FALSE(bvh.occluded({}));
  CHECK(bvh.bytes() == 0);
}

TEST_CASE("bvh: builder, executor, layout and tree can be chosen, each or none", "[bvh]") {
  const auto shapes = spheres<float>(9);
  const Elements set{shapes};
  const Bvh plain{set};
  const Bvh built{set, SweepSah{}};
  const Bvh executed{set, SweepSah{}, glint::Serial{}};
  const Bvh laid_out{set, SweepSah{}, glint::wide<4>};
  const Bvh chosen{set, SweepSah{}, glint::Serial{}, glint::wide<4>};
  const Bvh from_tree{set, SweepSah{}.build(set)};
  const Bvh from_tree_laid_out{set, SweepSah{}.build(set), glint::binary};
  static_assert(std::same_as<decltype(laid_out), decltype(chosen)>);
  CHECK(built.statistics() == from_tree.statistics());
  CHECK(plain.bounds() == from_tree_laid_out.bounds());
  CHECK(plain.set().size() == 9);
  CHECK(executed.bytes() == built.bytes());
}

TEST_CASE("bvh: hits are shaded by the set", "[bvh]") {
  const std::vector<Sphere<float>> shapes{{{0, 0, 0}, 1}, {{0, 0, -5}, 2}};
  const Bvh bvh(Elements{shapes});
  const Ray<float> ray{.origin = {0, 0, 4}};
  const auto hit = bvh.closest(ray);
  REQUIRE(hit);
  CHECK(bvh.surface(ray, *hit).normal == Vec3<float>{0, 0, 1});
}

}  // namespace test_bvh_bvh
