// SPDX-License-Identifier: MIT
#include <glint/bvh/query/packet.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray_box.hpp>

#include <support/catch.hpp>
#include <support/coherent_rays.hpp>

namespace test_bvh_query_packet {

namespace {

using glint::Aabb;
using glint::BoxPack;
using glint::PacketQuery;
using glint::Ray;
using glint::RayPacket;
using glint::Vec3;

template <typename T>
BoxPack<T, 4> packed(const std::array<Aabb<T>, 4>& boxes) {
  BoxPack<T, 4> pack;
  for (int i = 0; i < 4; ++i) {
    const Aabb<T>& b = boxes[std::size_t(i)];
    const T planes[] = {b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z};
    for (std::size_t p = 0; p < 6; ++p) pack.planes[p].set(i, planes[p]);
  }
  return pack;
}

template <typename T>
const Aabb<T> world{Vec3<T>(T(-1)), Vec3<T>(T(1))};

/// Coherent packets of all octants and longest axes, from in- and outside of the world.
template <typename T, typename Check>
int for_packets(const Check& check) {
  int packets = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const std::size_t count = 1 + seed % 16;
    const auto rays = seed % 2 == 0 ? glint::testing::pencil_of_rays<T>(world<T>, count, T(0.1), seed)
                                    : glint::testing::rays_toward_a_point<T>(world<T>, count, T(0.1), seed);
    const auto alike = glint::testing::of_one_course(rays);
    const RayPacket<T> packet(alike);
    if (!is_coherent(packet, T(2))) continue;
    check(packet);
    ++packets;
  }
  return packets;
}

}  // namespace

TEMPLATE_TEST_CASE("packet query: never leaves out a box that holds a point of a ray", "[bvh][query][packet]", float,
                   double) {
  using T = TestType;
  std::mt19937 random(4);
  const auto uniform = [&] { return T(random()) * T(0x1p-32); };
  int left_out = 0;
  const int packets = for_packets<T>([&](const RayPacket<T>& packet) {
    const PacketQuery<T> query(packet, T(0));
    for (std::size_t i = 0; i < packet.rays.size(); ++i) {
      const Ray<T>& ray = packet.rays[i];
      const T t = ray.t_min + (std::min(ray.t_max, T(3)) - ray.t_min) * uniform();
      // The rounded point is off the line by half an ulp or two; boxes grow by that.
      const Vec3<T> p = ray.at(t);
      const Vec3<T> slack = (abs(ray.origin) + abs(ray.direction * t)) * std::numeric_limits<T>::epsilon();
      const auto boxes = packed<T>(
          {Aabb<T>{p - slack, p + slack}, Aabb<T>{p - slack, p + Vec3<T>(T(1))}, Aabb<T>{p - Vec3<T>(T(1)), p + slack},
           Aabb<T>{{p.x - slack.x, p.y - T(1), p.z - slack.z}, {p.x + slack.x, p.y + slack.y, p.z + T(1)}}});
      left_out += query.enter(boxes).mask != 15U;
      for (int box = 0; box < 4; ++box) left_out += ((query.enter(boxes, box) >> i) & 1U) == 0;
    }
  });
  CHECK(left_out == 0);
  CHECK(packets > 100);
}

TEMPLATE_TEST_CASE("packet query: boxes that a ray enters are those that any ray may enter, and no sooner",
                   "[bvh][query][packet]", float, double) {
  using T = TestType;
  glint::Random random(5);
  int wrong = 0;
  int entered = 0;
  int culled = 0;
  for_packets<T>([&](const RayPacket<T>& packet) {
    const PacketQuery<T> query(packet, T(0));
    std::array<Aabb<T>, 4> some;
    for (Aabb<T>& box : some) {
      const Vec3<T> corner = glint::testing::detail::random_point(world<T>, random);
      box = {corner - random.uniform_vec3<T>(), corner + random.uniform_vec3<T>()};
    }
    const auto boxes = packed<T>(some);
    const auto any = query.enter(boxes);
    for (int box = 0; box < 4; ++box) {
      const std::uint32_t rays = query.enter(boxes, box);
      wrong += rays != 0 && ((any.mask >> box) & 1U) == 0;
      culled += ((any.mask >> box) & 1U) == 0;
      for (std::size_t i = 0; i < packet.rays.size(); ++i) {
        const Ray<T>& ray = packet.rays[i];
        const auto slabs = glint::FastSlab::prepare(ray);
        const auto part = glint::FastSlab::intersect(slabs, some[std::size_t(box)], ray.t_min,
                                                     std::min(ray.t_max, std::numeric_limits<T>::max()));
        if (!part) continue;
        ++entered;
        wrong += ((rays >> i) & 1U) == 0 || any.key[box] > part->lower;
      }
    }
  });
  CHECK(wrong == 0);
  CHECK(entered > 500);
  CHECK(culled > 200);
}

TEMPLATE_TEST_CASE("packet query: no ray enters an empty box, one beyond its end, or any once it is dropped",
                   "[bvh][query][packet]", float, double) {
  using T = TestType;
  using Lanes = typename RayPacket<T>::Lanes;
  std::vector<Ray<T>> rays;
  for (int i = 0; i < 16; ++i) rays.push_back({.direction = {T(0.01) + T(i) / 1000, T(0.02), T(-1)}});
  const RayPacket<T> packet(rays);
  PacketQuery<T> query(packet, T(0));
  const Aabb<T> far{{T(-1), T(-1), T(-11)}, {T(1), T(1), T(-10)}};
  const auto boxes = packed<T>({far, Aabb<T>{}, far, Aabb<T>{}});
  CHECK(query.enter(boxes).mask == 5U);
  CHECK(query.enter(boxes, 0) == 0xFFFFU);
  CHECK(query.enter(boxes, 1) == 0U);
  Lanes t = Lanes::broadcast(T(9.9));
  t.set(3, T(12));
  query.shrink(t);
  CHECK(query.enter(boxes).mask == 5U);
  CHECK(query.enter(boxes, 2) == 8U);
  CHECK(query.reach(T(9.8)) == 0xFFFFU);
  CHECK(query.reach(T(10)) == 8U);
  query.drop(8U);
  CHECK(query.enter(boxes).mask == 0U);
  CHECK(query.enter(boxes, 2) == 0U);
  CHECK(query.reach(T(0)) == 0xFFF7U);
}

}  // namespace test_bvh_query_packet
