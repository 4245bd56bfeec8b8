// SPDX-License-Identifier: MIT
#include <glint/geometry/ray_triangle_pack.hpp>  // first, so the header proves it stands alone

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <glint/geometry/ray_packet.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

#include <support/catch.hpp>

namespace test_geometry_ray_triangle_pack {

namespace {

using glint::MoellerTrumbore;
using glint::Pack;
using glint::PackedTest;
using glint::Ray;
using glint::Vec3;
using glint::Watertight;

template <typename Test, typename Scalar>
struct Tested {
  using Intersector = Test;
  using T = Scalar;
};

template <typename T>
using Corners = std::array<Vec3<T>, 3>;

/// Triangles on a small grid, where edges, ties and triangles without area abound, or anywhere.
template <typename T>
Corners<T> any_triangle(std::mt19937& random) {
  const bool on_grid = random() % 2 == 0;
  const auto number = [&] { return on_grid ? T(int(random() % 5) - 2) : T(random()) * T(0x1p-31) - T(1); };
  Corners<T> v;
  for (Vec3<T>& vertex : v) {
    vertex.x = number();
    vertex.y = number();
    vertex.z = number();
  }
  return v;
}

/// Aimed at the inside, an edge or a vertex of a triangle, or past it.
template <typename T>
Ray<T> any_ray(std::mt19937& random, const Corners<T>& at) {
  const T along = T(random() % 3) / 2;
  const T across = T(random() % 5) / 4;
  const Vec3<T> target = at[0] + (at[1] - at[0]) * along + (at[2] - at[0]) * across;
  const Vec3<T> origin = any_triangle<T>(random)[0] * T(3);
  Ray<T> ray{.origin = origin, .direction = target - origin};
  if (random() % 4 == 0) ray.t_max = T(1);
  if (random() % 4 == 0) ray.t_min = T(0.9);
  return ray;
}

struct Counts {
  int wrong = 0;
  int hits = 0;
  int misses = 0;
  int tied = 0;
};

template <typename Test, typename T, int N, int W>
Counts compare() {
  using P = Pack<T, N, W>;
  using Packed = PackedTest<Test, T, N, W>;
  Counts counts;
  std::mt19937 random(N * 100 + W);
  for (int trial = 0; trial < 20000 / N; ++trial) {
    std::array<Corners<T>, std::size_t(N)> all;
    for (Corners<T>& v : all) {
      do v = any_triangle<T>(random);
      while (glint::is_degenerate(v[0], v[1], v[2]));
    }
    const Ray<T> ray = any_ray(random, all[random() % N]);
    const auto vertex = [&](int i, int axis) {
      return P::generate([&](int lane) { return glint::component(all[std::size_t(lane)][std::size_t(i)], axis); });
    };
    const auto prepared = Packed::prepare(ray, Test::prepare(ray));
    const auto kept = Packed::cross(Packed::triangles(vertex), prepared, ray.t_max);
    const auto gathered = Packed::cross_at(vertex, prepared, ray.t_max);
    counts.wrong += kept.hit != gathered.hit || kept.tied != gathered.tied;
    for (int lane = 0; lane < N; ++lane) {
      const Corners<T>& v = all[std::size_t(lane)];
      const auto expected = Test::intersect(ray, Test::prepare(ray), v[0], v[1], v[2]);
      const bool hit = ((kept.hit >> lane) & 1U) != 0;
      const bool tied = ((kept.tied >> lane) & 1U) != 0;
      ++(tied ? counts.tied : hit ? counts.hits : counts.misses);
      counts.wrong += hit && tied;
      if (tied) continue;
      counts.wrong += hit != expected.has_value();
      if (!hit || !expected) continue;
      const T scale = T(1) / kept.det[lane];
      counts.wrong += kept.t[lane] != expected->t || kept.w1[lane] * scale != expected->uv.x ||
                      kept.w2[lane] * scale != expected->uv.y;  // to the last bit
    }
  }
  return counts;
}

/// Many rays at one of four triangles.
template <typename Test, typename T>
Counts compare_rays() {
  using Rays = glint::RayPacket<T>;
  using Kept = PackedTest<Test, T, 4>;
  using Packed = PackedTest<Test, T, Rays::size>;
  Counts counts;
  std::mt19937 random(7);
  for (int trial = 0; trial < 3000; ++trial) {
    std::array<Corners<T>, 4> all;
    for (Corners<T>& v : all) {
      do v = any_triangle<T>(random);
      while (glint::is_degenerate(v[0], v[1], v[2]));
    }
    const int lane = int(random() % 4);
    const Corners<T>& v = all[std::size_t(lane)];
    std::vector<Ray<T>> rays;
    while (rays.size() < 9) {  // with one longest axis, and intervals of their own
      const Ray<T> ray = any_ray(random, v);
      if (glint::max_axis(glint::abs(ray.direction)) == trial % 3) rays.push_back(ray);
    }
    const Rays packet(rays);
    const auto prepared = Packed::prepare(packet);
    const auto kept = Kept::triangles([&](int i, int axis) {
      return Pack<T, 4>::generate([&](int k) { return glint::component(all[std::size_t(k)][std::size_t(i)], axis); });
    });
    const auto one = Packed::cross_one(kept, lane, prepared, glint::infinity<T>);
    for (int i = 0; i < int(rays.size()); ++i) {
      Ray<T> endless = rays[std::size_t(i)];
      endless.t_max = glint::infinity<T>;
      const auto expected = Test::intersect(endless, Test::prepare(endless), v[0], v[1], v[2]);
      const bool hit = ((one.hit >> i) & 1U) != 0;
      const bool tied = ((one.tied >> i) & 1U) != 0;
      ++(tied ? counts.tied : hit ? counts.hits : counts.misses);
      if (tied) continue;
      counts.wrong += hit != expected.has_value();
      if (!hit || !expected) continue;
      const T scale = T(1) / one.det[i];
      counts.wrong += one.t[i] != expected->t || one.w1[i] * scale != expected->uv.x ||
                      one.w2[i] * scale != expected->uv.y;  // to the last bit
    }
  }
  return counts;
}

}  // namespace

TEMPLATE_TEST_CASE("triangle packs: many rays hit one triangle as each by itself would, to the last bit",
                   "[geometry][ray_triangle]", (Tested<MoellerTrumbore, float>), (Tested<MoellerTrumbore, double>),
                   (Tested<Watertight, float>), (Tested<Watertight, double>)) {
  const Counts counts = compare_rays<typename TestType::Intersector, typename TestType::T>();
  CHECK(counts.wrong == 0);
  CHECK(counts.hits > 1000);
  CHECK(counts.misses > 1000);
}

TEMPLATE_TEST_CASE("triangle packs: every lane is hit as the triangle by itself would be, to the last bit",
                   "[geometry][ray_triangle]", (Tested<MoellerTrumbore, float>), (Tested<MoellerTrumbore, double>),
                   (Tested<Watertight, float>), (Tested<Watertight, double>)) {
  using T = typename TestType::T;
  using Test = typename TestType::Intersector;
  constexpr int native = 4 < glint::register_lanes<T> ? 4 : glint::register_lanes<T>;
  for (const Counts& counts : {compare<Test, T, 1, 1>(), compare<Test, T, 4, 1>(), compare<Test, T, 4, native>(),
                               compare<Test, T, 8, native>(), compare<Test, T, 16, Pack<T, 16>::width>()}) {
    CHECK(counts.wrong == 0);
    CHECK(counts.hits > 1000);
    CHECK(counts.misses > 1000);
    CHECK((counts.tied > 100) == std::same_as<Test, Watertight>);
  }
}

TEMPLATE_TEST_CASE("triangle packs: a lane of NaNs, and one where all vertices are equal, are never hit",
                   "[geometry][ray_triangle]", (Tested<MoellerTrumbore, float>), (Tested<MoellerTrumbore, double>),
                   (Tested<Watertight, float>), (Tested<Watertight, double>)) {
  using T = typename TestType::T;
  using Packed = PackedTest<typename TestType::Intersector, T, 4>;
  // Lane 0 spans the ray; lane 1 is a point on it, lane 2 NaN in one place, lane 3 NaN altogether.
  const auto vertex = [](int i, int axis) {
    const Corners<T> v{Vec3<T>{T(-1), T(-1), T(0)}, Vec3<T>{T(1), T(-1), T(0)}, Vec3<T>{T(0), T(1), T(0)}};
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const std::array<T, 4> lanes{glint::component(v[std::size_t(i)], axis), T(0),
                                 i == 1 && axis == 2 ? nan : glint::component(v[std::size_t(i)], axis), nan};
    return Pack<T, 4>::load(lanes.data());
  };
  const Ray<T> ray{.origin = {T(0), T(0), T(3)}};
  const auto prepared = Packed::prepare(ray, TestType::Intersector::prepare(ray));
  const auto found = Packed::cross_at(vertex, prepared, ray.t_max);
  CHECK(found.hit == 1);
  CHECK((found.tied & ~2U) == 0);  // whether the point is hit is left to the test of one triangle, which knows points
}

}  // namespace test_geometry_ray_triangle_pack
