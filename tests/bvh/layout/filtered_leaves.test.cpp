// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/filtered_leaves.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>

namespace test_bvh_layout_filtered_leaves {

namespace {

using glint::BruteForce;
using glint::Bvh;
using glint::Elements;
using glint::Filtered;
using glint::Hit;
using glint::Joined;
using glint::Median;
using glint::Ray;
using glint::Sphere;
using glint::Vec3;

/// Cut out as leaves are: stripes across each triangle.
struct Stripes {
  template <typename T>
  bool operator()(const Ray<T>& /*ray*/, const Hit<T>& hit) const {
    return (int(std::floor(hit.uv.x * T(7))) & 1) == 0;
  }
};
/// All but every third.
struct SkipThirds {
  template <typename T>
  bool operator()(const Ray<T>& /*ray*/, const Hit<T>& hit) const {
    return hit.primitive % 3 != 0;
  }
};

template <typename Set, typename Layout>
void check_laws(const Set& set, Layout layout) {
  const Bvh bvh{set, Median{.max_leaf_size = 11}, layout};
  const BruteForce oracle(set);
  CHECK(glint::testing::violations_of_ray_caster_laws(bvh, oracle, 7) == std::vector<std::string>{});
}

template <typename Set>
void check_every_layout(const Set& set) {
  check_laws(set, glint::binary);
  check_laws(set, glint::wide<4>);
  check_laws(set, glint::wide<8>);
  check_laws(set, glint::quantized<8>);
}

}  // namespace

TEMPLATE_TEST_CASE("filtered leaves: of blocks of triangles, what counts is what brute force finds, in every layout",
                   "[bvh][layout]", float, double) {
  const auto soup = glint::testing::triangle_soup<TestType>(300, 21);
  check_every_layout(Filtered{view(soup), Stripes{}});
}

TEMPLATE_TEST_CASE("filtered leaves: equal triangles do not hide each other when some are skipped", "[bvh][layout]",
                   float, double) {
  const auto equal = glint::testing::identical_triangles<TestType>(40);
  const Bvh bvh{Filtered{view(equal), SkipThirds{}}};
  const Ray<TestType> ray{.origin = {0, 0, 3}};
  const auto hit = bvh.closest(ray);
  REQUIRE(hit);
  CHECK(hit->primitive == 1);  // the least that is no multiple of three
  CHECK(bvh.occluded(ray));
}

TEST_CASE("filtered leaves: spheres and triangles share a tree, each behind a filter of its own", "[bvh][layout]") {
  const auto soup = glint::testing::triangle_soup<float>(100, 22);
  std::vector<Sphere<float>> spheres;
  for (int i = 0; i < 30; ++i) spheres.push_back({{0.1F * float(i % 6) - 0.3F, 0.1F * float(i / 6), 0.0F}, 0.04F});
  check_laws(Joined{Filtered{view(soup), Stripes{}}, Filtered{Elements{spheres}, SkipThirds{}}}, glint::wide<8>);
}

TEST_CASE("filtered leaves: triangles seen from behind are culled", "[bvh][layout]") {
  const auto cube = glint::testing::closed_cube<float>();
  const auto mesh = view(cube);
  const Bvh bvh{Filtered{mesh, [mesh](const Ray<float>& ray, const Hit<float>& hit) {
                           return dot(mesh.surface(ray, hit).normal, ray.direction) < 0.0F;
                         }}};
  const Vec3<float> direction{0.1F, 0.2F, -1.0F};
  const glint::Vec3<float> center = (bvh.bounds().lower + bvh.bounds().upper) * 0.5F;
  CHECK_FALSE(bvh.closest({.origin = center, .direction = direction}));
  CHECK_FALSE(bvh.occluded({.origin = center, .direction = direction}));
  CHECK(bvh.closest({.origin = center - direction * 9.0F, .direction = direction}));
}

TEST_CASE("filtered leaves: many rays at once obey the filter as single rays do", "[bvh][layout]") {
  const auto soup = glint::testing::triangle_soup<float>(300, 23);
  const Bvh bvh{Filtered{view(soup), Stripes{}}};
  std::vector<Ray<float>> rays;
  for (int i = 0; i < 1024; ++i)
    rays.push_back(
        {.origin = {0, 0, 4}, .direction = {float(i % 32) * 0.015F - 0.24F, float(i / 32) * 0.015F - 0.24F, -1}});
  std::vector<std::optional<Hit<float>>> hits(rays.size());
  const auto results = std::make_unique<bool[]>(rays.size());
  bvh.closest(rays, hits);
  bvh.occluded(rays, {results.get(), rays.size()});
  std::size_t found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    CHECK(hits[i] == bvh.closest(rays[i]));
    CHECK(results[i] == hits[i].has_value());
    if (hits[i]) CHECK(Stripes{}(rays[i], *hits[i]));
    found += std::size_t(hits[i].has_value());
  }
  CHECK(found > 50);  // enough of them meet something
}

}  // namespace test_bvh_layout_filtered_leaves
