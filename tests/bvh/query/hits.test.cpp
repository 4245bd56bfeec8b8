// SPDX-License-Identifier: MIT
#include <glint/bvh/query/hits.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

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
#include <glint/testing/random_rays.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_hits {

namespace {

using glint::Bvh;
using glint::Hit;
using glint::Ray;
using glint::Walk;

template <typename T>
using Hits = std::vector<Hit<T>>;

template <typename T>
void sort(Hits<T>& hits) {
  std::sort(hits.begin(), hits.end(), [](const Hit<T>& a, const Hit<T>& b) { return is_closer(a, b); });
}

/// The oracle: each primitive, asked again behind every hit.
template <typename S>
Hits<typename S::Scalar> brute_force(const S& set, const Ray<typename S::Scalar>& ray) {
  using T = typename S::Scalar;
  Hits<T> hits;
  for (typename S::Index i = 0; i < set.size(); ++i) {
    Ray<T> rest = ray;
    for (auto hit = set.intersect(rest, i); hit; hit = set.intersect(rest, i)) {
      hits.push_back(*hit);
      rest.t_min = std::nextafter(hit->t, std::numeric_limits<T>::infinity());
    }
  }
  sort(hits);
  return hits;
}

/// What a query finds that disagrees with the oracle, of all rays; and how many hits there were, so that a test without
/// any is seen.
template <typename B>
std::tuple<std::size_t, std::size_t> disagreements(const B& bvh, const std::vector<Ray<typename B::Scalar>>& rays) {
  using T = typename B::Scalar;
  std::size_t wrong = 0;
  std::size_t total = 0;
  for (const Ray<T>& ray : rays) {
    const Hits<T> expected = brute_force(bvh.set(), ray);
    total += expected.size();
    Hits<T> all;
    Hits<T> in_order;
    for_each_hit(bvh, ray, [&](const Hit<T>& hit) { all.push_back(hit); });
    for_each_hit_in_order(bvh, ray, [&](const Hit<T>& hit) { in_order.push_back(hit); });
    sort(all);
    std::array<Hit<T>, 3> nearest;
    const std::size_t count = nearest_hits(bvh, ray, nearest);
    const bool are_nearest = count == std::min(expected.size(), nearest.size()) &&
                             std::equal(nearest.begin(), nearest.begin() + std::ptrdiff_t(count), expected.begin());
    wrong += std::size_t(all != expected) + std::size_t(in_order != expected) + std::size_t(!are_nearest);
  }
  return {wrong, total};
}

template <typename T>
std::vector<Ray<T>> rays() {
  return glint::testing::rays_into(glint::testing::scene_box<T>(), 60, 3);
}

}  // namespace

TEMPLATE_TEST_CASE("hits: all, in order, and the nearest are those of trying every primitive", "[bvh][query][hits]",
                   float, double) {
  using T = TestType;
  auto buffers = glint::testing::triangle_soup<T>(2000, 5);
  for (std::size_t i = 0; i < buffers.positions.size(); ++i) {
    const glint::Vec3<T>& first = buffers.positions[i / 3 * 3];  // made larger, so that a ray crosses many
    buffers.positions[i] = first + (buffers.positions[i] - first) * T(4);
  }
  const auto mesh = view(buffers);
  const auto check = [](const auto& bvh) {
    const auto [wrong, total] = disagreements(bvh, rays<T>());
    CHECK(wrong == 0);
    CHECK(total > 100);
  };
  check(Bvh{mesh});
  check(Bvh{mesh, glint::BinnedSah{}, glint::quantized<8>});
  const Bvh parts{mesh, glint::SpatialSah{}};
  REQUIRE(parts.has_parts());
  check(parts);
}

TEST_CASE("hits: a ray through identical triangles hits every one, more than are kept at a time",
          "[bvh][query][hits]") {
  const auto buffers = glint::testing::identical_triangles<float>(50);
  const Bvh bvh{view(buffers), glint::BinnedSah{}, glint::binary};
  const Ray<float> ray{.origin = {0, 0, 4}};
  std::vector<std::uint32_t> found;
  for_each_hit_in_order(bvh, ray, [&](const Hit<float>& hit) { found.push_back(hit.primitive); });
  REQUIRE(found.size() == 50);
  for (std::uint32_t i = 0; i < 50; ++i) CHECK(found[i] == i);  // all at one t, so in the order of their indices
}

TEST_CASE("hits: spheres are crossed twice, filters and joined sets are obeyed", "[bvh][query][hits]") {
  const auto buffers = glint::testing::triangle_soup<float>(500, 11);
  std::vector<glint::Sphere<float>> spheres;
  for (int i = 0; i < 40; ++i) spheres.push_back({{0.04F * float(i) - 0.8F, 0.1F, -0.1F}, 0.2F + 0.01F * float(i)});
  const glint::Joined both{view(buffers), glint::Elements{spheres}};
  const auto [wrong, total] = disagreements(Bvh{both}, rays<float>());
  CHECK(wrong == 0);
  CHECK(total > 500);
  const glint::Filtered even{both, [](const auto& /*ray*/, const auto& hit) { return hit.primitive % 2 == 0; }};
  const auto [wrong_even, total_even] = disagreements(Bvh{even}, rays<float>());
  CHECK(wrong_even == 0);
  CHECK(total_even > 200);
  CHECK(total_even < total);
}

TEST_CASE("hits: a visitor that stops sees no more", "[bvh][query][hits]") {
  const std::vector<glint::Sphere<float>> spheres{{{0, 0, -3}, 1}, {{0, 0, -9}, 1}};
  const Bvh bvh{glint::Elements{spheres}};
  std::vector<float> seen;
  const auto two = [&](const Hit<float>& hit) {
    seen.push_back(hit.t);
    return seen.size() == 2 ? Walk::Stop : Walk::Continue;
  };
  CHECK(for_each_hit_in_order(bvh, {}, two) == Walk::Stop);
  CHECK(seen == std::vector<float>{2, 4});  // into and out of the first sphere: 3 − 1 and 3 + 1
  seen.clear();
  CHECK(for_each_hit(bvh, {}, two) == Walk::Stop);
  CHECK(seen.size() == 2);
  CHECK(for_each_hit(bvh, {.t_max = 1}, two) == Walk::Continue);
  CHECK(nearest_hits(bvh, {}, {}) == 0);
}

}  // namespace test_bvh_query_hits
