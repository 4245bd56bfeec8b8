// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/motion.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/query/hits.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/set/masked.hpp>
#include <glint/geometry/set/moving.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/at_time.hpp>
#include <support/catch.hpp>

namespace test_bvh_layout_motion {

namespace {

using glint::BruteForce;
using glint::Bvh;
using glint::Hit;
using glint::MeshBuffers;
using glint::Moving;
using glint::Ray;
using glint::Vec3;

/// A soup whose triangles fly in directions of their own, some far and some hardly.
template <typename T>
MeshBuffers<T> flown(MeshBuffers<T> soup, std::uint32_t seed) {
  glint::Random random(seed);
  for (std::size_t i = 0; i < soup.indices.size(); i += 3) {
    const Vec3<T> way = (random.uniform_vec3<T>() - T(0.5)) * T(i % 4);
    for (std::size_t k = 0; k < 3; ++k) soup.positions[soup.indices[i + k]] += way;
  }
  return soup;
}

/// At many times, a tree finds what brute force finds.
template <typename Set, typename... Choice>
void check_times(const Set& set, const Choice&... choice) {
  const Bvh bvh{set, choice...};
  const BruteForce oracle(set);
  using T = typename Set::Scalar;
  for (const T time : {T(0), T(0.125), T(0.3), T(0.5), T(0.77), T(1)}) {
    CAPTURE(time);
    CHECK(glint::testing::violations_of_ray_caster_laws(support::AtTime{bvh, time}, support::AtTime{oracle, time}, 5,
                                                        100) == std::vector<std::string>{});
  }
}

}  // namespace

TEMPLATE_TEST_CASE("motion layout: trees of moving triangles find what brute force finds, at all times",
                   "[bvh][layout]", float, double) {
  using T = TestType;
  const auto a = glint::testing::triangle_soup<T>(300, 31);
  const auto b = flown(a, 32);
  const auto c = flown(b, 33);
  const Moving two{view(a), view(b)};
  static_assert(
      std::is_same_v<typename Bvh<std::remove_const_t<decltype(two)>>::Nodes, glint::MotionNodes<T, std::uint32_t, 8>>);
  check_times(two);
  check_times(two, glint::Median{}, glint::motion<4>);
  check_times(two, glint::SweepSah{}, glint::motion<8, glint::IndexedBlocks<4>>);
  check_times(two, glint::BinnedSah{}, glint::wide<8>);
  check_times(Moving{view(a), view(b), view(c)});
}

TEST_CASE("motion layout: boxes follow their primitives, so that a ray enters few at any time", "[bvh][layout]") {
  // A row of small triangles flies ten units along its own line: at no time does a ray across meet more than one, and
  // there are no more boxes of leaves in its way than these need.
  MeshBuffers<float> a;
  for (std::uint32_t i = 0; i < 512; ++i) {
    const float x = float(i) * 0.02F;
    for (const Vec3<float>& p : {Vec3<float>{x, 0, 0}, {x + 0.01F, 0, 0}, {x, 0.01F, 0}}) a.positions.push_back(p);
    for (std::uint32_t k = 0; k < 3; ++k) a.indices.push_back(3 * i + k);
  }
  MeshBuffers<float> b = a;
  for (auto& p : b.positions) p.x += 10.0F;
  const Bvh bvh{Moving{view(a), view(b)}};
  const Ray<float> ray{.origin = {10.003F, 0.003F, 5}, .time = 0.5F};
  const auto leaves_met = [&](const auto& nodes) {
    int count = 0;
    const glint::RayQuery<float, 8, glint::RayOrder::Any> query(ray, bvh.reach());
    traverse(nodes, query, [&](auto /*slots*/) {
      ++count;
      return glint::Walk::Continue;
    });
    return count;
  };
  CHECK(bvh.occluded(ray));
  CHECK(leaves_met(bvh.nodes().at(ray.time)) <= 2);
  CHECK(leaves_met(bvh.nodes()) >= 16);  // as boxes of all times would have it
}

TEMPLATE_TEST_CASE("motion layout: what moves may be joined, filtered and masked", "[bvh][layout]", float, double) {
  using T = TestType;
  const auto a = glint::testing::triangle_soup<T>(120, 41);
  const auto b = flown(a, 42);
  std::vector<glint::Sphere<T>> spheres;
  for (int i = 0; i < 30; ++i) spheres.push_back({{T(0.1) * T(i % 6) - T(0.3), T(0.1) * T(i / 6), T(0)}, T(0.04)});
  const auto some = [](const Ray<T>& /*ray*/, const Hit<T>& hit) { return hit.uv.x < T(0.5); };
  std::vector<std::uint32_t> masks;
  for (std::uint32_t i = 0; i < 150; ++i) masks.push_back(i % 3 == 0 ? 0 : 1);
  const glint::Masked set{glint::Joined{glint::Filtered{Moving{view(a), view(b)}, some}, glint::Elements{spheres}},
                          masks};
  static_assert(glint::MovingSet<std::remove_const_t<decltype(set)>>);
  check_times(set);
}

TEST_CASE("motion layout: batches and all hits see each ray's own time", "[bvh][layout]") {
  const auto a = glint::testing::triangle_soup<float>(300, 51);
  const auto b = flown(a, 52);
  const Moving set{view(a), view(b)};
  const Bvh bvh{set};
  std::vector<Ray<float>> rays;
  for (int i = 0; i < 1024; ++i)
    rays.push_back({.origin = {0, 0, 4},
                    .direction = {float(i % 32) * 0.015F - 0.24F, float(i / 32) * 0.015F - 0.24F, -1},
                    .time = float(i % 7) / 6.0F});
  std::vector<std::optional<Hit<float>>> hits(rays.size());
  const auto results = std::make_unique<bool[]>(rays.size());
  bvh.closest(rays, hits);
  bvh.occluded(rays, {results.get(), rays.size()});
  const BruteForce oracle(set);
  std::size_t found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    CHECK(hits[i] == oracle.closest(rays[i]));
    CHECK(results[i] == hits[i].has_value());
    std::size_t expected = 0;
    for (std::uint32_t k = 0; k < 300; ++k) expected += std::size_t(set.intersect(rays[i], k).has_value());
    std::size_t count = 0;
    for_each_hit(bvh, rays[i], [&](const Hit<float>& /*hit*/) { ++count; });
    CHECK(count == expected);
    found += count;
  }
  CHECK(found > 50);  // enough of them meet something
}

TEST_CASE("motion layout: a refit follows keyframes that changed", "[bvh][layout]") {
  auto a = glint::testing::triangle_soup<float>(300, 61);
  auto b = flown(a, 62);
  Bvh bvh{Moving{view(a), view(b)}};
  std::ranges::copy(flown(a, 63).positions, a.positions.begin());  // in place: the set looks at these buffers
  std::ranges::copy(flown(b, 64).positions, b.positions.begin());
  bvh.refit();
  const BruteForce oracle(bvh.set());
  for (const float time : {0.0F, 0.4F, 1.0F})
    CHECK(glint::testing::violations_of_ray_caster_laws(support::AtTime{bvh, time}, support::AtTime{oracle, time}, 6,
                                                        100) == std::vector<std::string>{});
}

TEST_CASE("motion layout: sets of no primitive, one, and some that are not finite", "[bvh][layout]") {
  const MeshBuffers<float> nothing;
  CHECK_FALSE(Bvh{Moving{view(nothing), view(nothing)}}.closest({}));
  const auto one = glint::testing::identical_triangles<float>(1);
  const Bvh single{Moving{view(one), view(one)}};
  CHECK(single.closest({.origin = {0, 0, 3}, .time = 0.3F}));
  const auto a = glint::testing::triangle_soup<float>(40, 71);
  auto b = flown(a, 72);
  for (std::size_t i = 0; i < 30; i += 9) b.positions[i].y = std::numeric_limits<float>::infinity();
  b.positions[50].x = std::numeric_limits<float>::quiet_NaN();
  const Moving set{view(a), view(b)};
  check_times(set);
  CHECK(Bvh{set}.statistics().left_out == 4);
}

}  // namespace test_bvh_layout_motion
