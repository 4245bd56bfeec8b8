// SPDX-License-Identifier: MIT
#include <glint/bvh/query/ray.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray_box.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_query_ray {

namespace {

using glint::Aabb;
using glint::BoxPack;
using glint::Pack;
using glint::Ray;
using glint::RayOrder;
using glint::RayQuery;
using glint::RayReach;
using glint::Vec3;

template <typename T>
BoxPack<T, 4> packed(const std::vector<Aabb<T>>& boxes) {
  BoxPack<T, 4> pack;
  for (int i = 0; i < 4; ++i) {
    const Aabb<T>& b = boxes[std::size_t(i)];
    const T planes[] = {b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z};
    for (std::size_t p = 0; p < 6; ++p) pack.planes[p].set(i, planes[p]);
  }
  return pack;
}

}  // namespace

TEMPLATE_TEST_CASE("ray query: never leaves out a box that holds a point of the ray, on either side of the origin",
                   "[bvh][query]", float, double) {
  using T = TestType;
  const Aabb<T> world{Vec3<T>(T(-1)), Vec3<T>(T(1))};
  glint::testing::RaySource<T> source(world, 3);
  std::mt19937 random(4);
  const auto uniform = [&] { return T(random()) * T(0x1p-32); };
  int left_out = 0;
  for (int i = 0; i < 20'000; ++i) {
    Ray<T> ray = source.next();
    // Boxes with the rounded point of the ray on a face, an edge or a corner: the hardest to hit. The point is off the
    // line by half an ulp or two; boxes grow by that.
    const T first = ray.t_min == -glint::infinity<T> ? T(-2) : ray.t_min;
    const T last = ray.t_max == glint::infinity<T> ? T(2) : ray.t_max;
    if (!(first <= last)) continue;
    const T t = first + (last - first) * uniform();
    if (!(ray.t_min <= t && t <= ray.t_max)) continue;
    const Vec3<T> p = ray.at(t);
    const Vec3<T> slack = (abs(ray.origin) + abs(ray.direction * t)) * std::numeric_limits<T>::epsilon();
    const Aabb<T> around{p - slack, p + slack};
    const Aabb<T> corner{p - slack, p + Vec3<T>(T(1))};
    const Aabb<T> flat{{p.x - slack.x, p.y - T(1), p.z - slack.z}, {p.x + slack.x, p.y + slack.y, p.z + T(1)}};
    Aabb<T> all = around;
    extend(all, corner);
    extend(all, flat);
    const RayQuery<T, 4, RayOrder::NearestFirst> query(ray, RayReach<T>::of(all));
    left_out += query.enter(packed<T>({around, corner, flat, Aabb<T>{}})).mask != 7U;
  }
  CHECK(left_out == 0);
}

TEMPLATE_TEST_CASE("ray query: enters the boxes that the slab test enters, and no others but by a hair", "[bvh][query]",
                   float, double) {
  using T = TestType;
  const auto boxes = glint::testing::random_boxes<T>(4, 5);
  const Aabb<T> world{Vec3<T>(T(0)), Vec3<T>(T(1))};
  const T hair = T(64) * std::numeric_limits<T>::epsilon();
  auto grown = boxes;
  for (Aabb<T>& box : grown) box = {box.lower - hair, box.upper + hair};
  int wrong = 0;
  for (const Ray<T>& ray : glint::testing::rays_within(world, 2000, 6)) {
    const RayQuery<T, 4, RayOrder::NearestFirst> query(ray, RayReach<T>::of(world));
    const auto entered = query.enter(packed(boxes));
    const auto slabs = glint::ConservativeSlab::prepare(ray);
    const T end = std::numeric_limits<T>::max();
    for (int i = 0; i < 4; ++i) {
      const bool is_entered = ((entered.mask >> i) & 1U) != 0;
      const auto inner = glint::ConservativeSlab::intersect(slabs, boxes[std::size_t(i)], ray.t_min, end);
      const auto outer = glint::ConservativeSlab::intersect(slabs, grown[std::size_t(i)], ray.t_min, end);
      wrong += inner.has_value() && !is_entered;
      wrong += is_entered && !outer.has_value();
      wrong +=
          inner && outer && !(outer->lower * (1 - hair) - hair <= entered.key[i] && entered.key[i] <= inner->lower);
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("ray query: no ray enters an empty box, nor one beyond its end", "[bvh][query]") {
  const Aabb<float> far{{-1, -1, -11}, {1, 1, -10}};
  RayQuery<float, 4, RayOrder::NearestFirst> query(Ray<float>{}, RayReach<float>::of(far));
  CHECK(query.enter(packed<float>({far, {}, far, {}})).mask == 5U);
  query.shrink(9.9F);
  CHECK(query.enter(packed<float>({far, {}, far, {}})).mask == 0U);
  CHECK(query.limit() >= 9.9F);
  CHECK(query.limit() < 9.91F);
}

TEMPLATE_TEST_CASE("ray query: a parallel ray enters what it lies in, and nothing beside it, however far it goes",
                   "[bvh][query]", float, double) {
  using T = TestType;
  const Aabb<T> around{Vec3<T>(T(-1)), Vec3<T>(T(1))};
  const Vec3<T> origin{T(0.25), T(-0.5), T(0.75)};
  const T gap = T(1e-6);
  for (const T sideways : {T(0), T(-0.0), T(1e-30), T(-1e-12)}) {
    for (int along = 0; along < 3; ++along) {
      for (int across = 0; across < 3; ++across) {
        if (across == along) continue;
        Ray<T> ray{.origin = origin, .direction = Vec3<T>(sideways)};
        ray.direction[along] = T(1);
        Aabb<T> below = around;  // ends where the ray is, or just short of it
        Aabb<T> beside = around;
        below.upper[across] = origin[across];
        beside.upper[across] = origin[across] - gap;
        Aabb<T> above = around;
        above.lower[across] = origin[across] + gap;
        const RayQuery<T, 4, RayOrder::Any> query(ray, RayReach<T>::of(around));
        CHECK(query.enter(packed<T>({around, below, beside, above})).mask == 3U);
      }
    }
  }
}

TEST_CASE("ray query: a ray without a line enters nothing", "[bvh][query]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Aabb<float> box{Vec3<float>(-1), Vec3<float>(1)};
  for (const Vec3<float>& bad : {Vec3<float>(nan, 0, 1), Vec3<float>(glint::infinity<float>, 0, 1), Vec3<float>(0)}) {
    const RayQuery<float, 4, RayOrder::Any> query(Ray<float>{.direction = bad}, RayReach<float>::of(box));
    CHECK(query.enter(packed<float>({box, box, box, box})).mask == 0U);
  }
  const RayQuery<float, 4, RayOrder::Any> lost(Ray<float>{.origin = {0, nan, 0}}, RayReach<float>::of(box));
  CHECK(lost.enter(packed<float>({box, box, box, box})).mask == 0U);
}

}  // namespace test_bvh_query_ray
