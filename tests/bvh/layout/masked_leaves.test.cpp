// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/masked_leaves.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/query/hits.hpp>
#include <glint/bvh/query/nearest.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/set/masked.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>

namespace test_bvh_layout_masked_leaves {

namespace {

using glint::BruteForce;
using glint::Bvh;
using glint::Filtered;
using glint::Hit;
using glint::Joined;
using glint::Masked;
using glint::Median;
using glint::Ray;

/// Runs of equal masks, so that some leaves are seen wholly, some not at all, and some in part.
std::vector<std::uint32_t> masks_in_runs(std::size_t count) {
  std::vector<std::uint32_t> masks;
  for (std::size_t i = 0; i < count; ++i) masks.push_back(std::uint32_t{1} << (i / 9 % 3));
  return masks;
}

/// A ray caster whose rays have a mask.
template <typename G>
struct Through {
  using Scalar = typename G::Scalar;
  using Index = typename G::Index;
  const G& scene;
  std::uint32_t mask;

  [[nodiscard]] auto bounds() const { return scene.bounds(); }
  [[nodiscard]] Ray<Scalar> masked(Ray<Scalar> ray) const {
    ray.mask = mask;
    return ray;
  }
  [[nodiscard]] auto closest(const Ray<Scalar>& ray) const { return scene.closest(masked(ray)); }
  [[nodiscard]] bool occluded(const Ray<Scalar>& ray) const { return scene.occluded(masked(ray)); }
};

/// The laws for rays of several masks, with two oracles: brute force over the set itself, and a filter that says the
/// same.
template <typename Set, typename Layout>
void check_laws(const Set& all, const std::vector<std::uint32_t>& masks, Layout layout) {
  using T = typename Set::Scalar;
  const Masked set{all, masks};
  const Filtered filtered{all,
                          [&](const Ray<T>& ray, const Hit<T>& hit) { return (ray.mask & masks[hit.primitive]) != 0; }};
  const Bvh bvh{set, Median{.max_leaf_size = 11}, layout};
  const BruteForce oracle(set);
  const Bvh by_filter{filtered, Median{.max_leaf_size = 11}, layout};
  for (const std::uint32_t mask : {0b001U, 0b110U, 0b111U, 0U}) {
    CAPTURE(mask);
    CHECK(glint::testing::violations_of_ray_caster_laws(Through<std::remove_cvref_t<decltype(bvh)>>{bvh, mask},
                                                        Through<BruteForce<Masked<Set>>>{oracle, mask}, 7,
                                                        128) == std::vector<std::string>{});
    glint::testing::RaySource<T> source(bvh.bounds(), 3);
    for (int i = 0; i < 100; ++i) {
      Ray<T> ray = source.next();
      ray.mask = mask;
      CHECK(bvh.closest(ray) == by_filter.closest(ray));
    }
  }
}

}  // namespace

TEMPLATE_TEST_CASE("masked leaves: rays of any mask find what brute force and a filter find, in every layout",
                   "[bvh][layout]", float, double) {
  const auto soup = glint::testing::triangle_soup<TestType>(300, 21);
  const auto masks = masks_in_runs(300);
  check_laws(view(soup), masks, glint::binary);
  check_laws(view(soup), masks, glint::wide<4>);
  check_laws(view(soup), masks, glint::wide<8>);
  check_laws(view(soup), masks, glint::quantized<8>);
}

TEST_CASE("masked leaves: equal triangles do not hide each other", "[bvh][layout]") {
  const auto equal = glint::testing::identical_triangles<float>(40);
  const auto masks = masks_in_runs(40);
  const Bvh bvh{Masked{view(equal), masks}};
  for (std::uint32_t bit = 0; bit < 3; ++bit) {
    const auto hit = bvh.closest({.origin = {0, 0, 3}, .mask = std::uint32_t{1} << bit});
    REQUIRE(hit);
    CHECK(hit->primitive == 9 * bit);  // the first of its run
  }
}

TEST_CASE("masked leaves: spheres and triangles share a tree, masks around either or both", "[bvh][layout]") {
  const auto soup = glint::testing::triangle_soup<float>(100, 22);
  std::vector<glint::Sphere<float>> spheres;
  for (int i = 0; i < 30; ++i) spheres.push_back({{0.1F * float(i % 6) - 0.3F, 0.1F * float(i / 6), 0.0F}, 0.04F});
  const auto inner = masks_in_runs(30);
  const auto outer = masks_in_runs(130);
  check_laws(Joined{view(soup), Masked{glint::Elements{spheres}, inner}}, outer, glint::wide<8>);
}

TEST_CASE("masked leaves: batches of rays with masks of their own find what single rays do", "[bvh][layout]") {
  const auto soup = glint::testing::triangle_soup<float>(300, 23);
  const auto masks = masks_in_runs(300);
  const Bvh bvh{Masked{view(soup), masks}};
  std::vector<Ray<float>> rays;
  for (std::uint32_t i = 0; i < 1024; ++i)
    rays.push_back({.origin = {0, 0, 4},
                    .direction = {float(i % 32) * 0.015F - 0.24F, float(i / 32) * 0.015F - 0.24F, -1},
                    .mask = i % 8});
  std::vector<std::optional<Hit<float>>> hits(rays.size());
  const auto results = std::make_unique<bool[]>(rays.size());
  bvh.closest(rays, hits);
  bvh.occluded(rays, {results.get(), rays.size()});
  std::size_t found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    CHECK(hits[i] == bvh.closest(rays[i]));
    CHECK(results[i] == hits[i].has_value());
    if (hits[i]) CHECK((rays[i].mask & masks[hits[i]->primitive]) != 0);
    found += std::size_t(hits[i].has_value());
  }
  CHECK(found > 50);  // enough of them meet something
}

TEST_CASE("masked leaves: all hits are those that the mask lets pass, and points see everything", "[bvh][layout]") {
  const auto soup = glint::testing::triangle_soup<float>(300, 24);
  const auto masks = masks_in_runs(300);
  const Masked set{view(soup), masks};
  const Bvh bvh{set};
  const Bvh all{view(soup)};
  glint::testing::RaySource<float> source(bvh.bounds(), 5);
  std::size_t seen = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray<float> ray = source.next();
    ray.mask = 0b010;
    std::size_t expected = 0;
    for (std::uint32_t k = 0; k < 300; ++k) expected += std::size_t(set.intersect(ray, k).has_value());
    std::size_t count = 0;
    for_each_hit(bvh, ray, [&](const Hit<float>& hit) { count += std::size_t(masks[hit.primitive] == 0b010); });
    CHECK(count == expected);
    seen += count;
    const auto near = closest_point(bvh, ray.origin);
    REQUIRE(near);
    CHECK(near->primitive == closest_point(all, ray.origin)->primitive);
  }
  CHECK(seen > 10);  // enough of them meet something
}

TEST_CASE("masked leaves: a refit takes up masks that changed", "[bvh][layout]") {
  const auto cube = glint::testing::closed_cube<float>();
  std::vector<std::uint32_t> masks(12, 1);
  Bvh bvh{Masked{view(cube), masks}};
  const Ray<float> ray{.origin = {0.1F, 0.2F, 3}, .mask = 2};
  CHECK_FALSE(bvh.closest(ray));
  masks.assign(12, 2);
  bvh.refit();
  CHECK(bvh.closest(ray));
  CHECK(bvh.occluded(ray));
}

}  // namespace test_bvh_layout_masked_leaves
