// SPDX-License-Identifier: MIT
#include <glint/geometry/ray_packet.hpp>  // first, so the header proves it stands alone

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <vector>

#include <support/catch.hpp>

namespace test_geometry_ray_packet {

namespace {

using glint::Ray;
using glint::RayPacket;
using glint::Vec3;

/// From one point, a little apart; along z the furthest.
template <typename T>
std::vector<Ray<T>> a_few(std::size_t count) {
  std::vector<Ray<T>> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const T step = T(i) / T(128);
    rays.push_back({.origin = {T(1), T(2), T(3)}, .direction = {T(-0.25) - step, T(0.5) + step, T(-1)}});
  }
  return rays;
}

template <typename T>
bool are_coherent(const std::vector<Ray<T>>& rays, T reach = T(1)) {
  return is_coherent(RayPacket<T>(rays), reach);
}

/// Whether they are no more, when this is done to one of them, whichever it is.
template <typename T>
bool any_one_spoils(const std::function<void(Ray<T>&)>& change) {
  for (std::size_t i = 0; i < 16; ++i) {
    auto rays = a_few<T>(16);
    change(rays[i]);
    if (are_coherent(rays)) return false;
  }
  return true;
}

}  // namespace

TEMPLATE_TEST_CASE("ray packet: a lane holds a ray, and lanes to spare repeat the first", "[geometry][ray_packet]",
                   float, double) {
  using T = TestType;
  for (const std::size_t count : {1U, 7U, 16U}) {
    auto rays = a_few<T>(count);
    for (std::size_t i = 0; i < count; ++i) {
      rays[i].t_min = T(i);
      rays[i].t_max = T(i + 1);
      rays[i].origin.y = T(2 * i);
    }
    const RayPacket<T> packet(rays);
    CHECK(packet.longest_axis() == 2);
    CHECK(std::popcount(packet.members) == int(count));
    CHECK(packet.members >> (count - 1) == 1);
    for (int lane = 0; lane < RayPacket<T>::size; ++lane) {
      const Ray<T>& ray = rays[std::size_t(lane) < count ? std::size_t(lane) : 0];
      CHECK(packet.t_min[lane] == ray.t_min);
      CHECK(packet.t_max[lane] == ray.t_max);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(packet.origin[axis][lane] == glint::component(ray.origin, int(axis)));
        CHECK(packet.direction[axis][lane] == glint::component(ray.direction, int(axis)));
      }
    }
  }
}

TEMPLATE_TEST_CASE("ray packet: rays that start and go about alike are coherent, whatever their length",
                   "[geometry][ray_packet]", float, double) {
  using T = TestType;
  auto rays = a_few<T>(16);
  CHECK(are_coherent(rays));
  CHECK(are_coherent(a_few<T>(3)));
  rays[4].direction *= T(1000);
  rays[5].origin.x += T(0.2);
  rays[6].t_max = T(2);
  CHECK(are_coherent(rays));
  CHECK_FALSE(are_coherent(rays, T(0.5)));  // 0.2 apart is far in a scene of size 0.5
}

TEMPLATE_TEST_CASE("ray packet: rays that are no members take no part", "[geometry][ray_packet]", float, double) {
  using T = TestType;
  auto rays = a_few<T>(16);
  rays[0].direction.x = T(0);
  rays[9].origin.z = std::numeric_limits<T>::quiet_NaN();
  CHECK_FALSE(are_coherent(rays));
  const RayPacket<T> packet(rays, 0xFDFEU);
  CHECK(is_coherent(packet, T(1)));
  CHECK(packet.origin[2][9] == rays[1].origin.z);
  CHECK(packet.direction[0][0] == rays[1].direction.x);
  CHECK(packet.direction[0][8] == rays[8].direction.x);
}

TEMPLATE_TEST_CASE("ray packet: a course is an octant and a longest axis, the first of equals",
                   "[geometry][ray_packet]", float, double) {
  using T = TestType;
  std::set<std::uint32_t> courses;
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    for (int longest = 0; longest < 3; ++longest) {
      Vec3<T> d{T(1), T(1), T(1)};
      d[longest] = T(2);
      for (int axis = 0; axis < 3; ++axis)
        if (((octant >> axis) & 1U) != 0) d[axis] = -d[axis];
      courses.insert(course_of(Ray<T>{.direction = d}));
      CHECK(course_of(Ray<T>{.direction = d}) ==
            course_of(Ray<T>{.origin = {T(1), T(2), T(3)}, .direction = d * T(7)}));
    }
  }
  CHECK(courses.size() == 24);
  const auto course = [](T x, T y, T z) { return course_of(Ray<T>{.direction = {x, y, z}}); };
  CHECK(course(T(1), T(2), T(2)) == course(T(1), T(3), T(2)));
  CHECK(course(T(2), T(2), T(2)) == course(T(3), T(2), T(2)));
}

TEMPLATE_TEST_CASE("ray packet: one ray that goes another way spoils the company", "[geometry][ray_packet]", float,
                   double) {
  using T = TestType;
  CHECK(any_one_spoils<T>([](auto& ray) { ray.direction.x = T(-0.9); }));
  CHECK(any_one_spoils<T>([](auto& ray) { ray.origin.z += T(2); }));
}

TEMPLATE_TEST_CASE("ray packet: rays that need care are not coherent", "[geometry][ray_packet]", float, double) {
  using T = TestType;
  using Limits = std::numeric_limits<T>;
  for (const T bad : {Limits::quiet_NaN(), Limits::infinity(), T(0), T(-0.0), Limits::denorm_min()}) {
    CHECK(any_one_spoils<T>([&](auto& ray) { ray.direction.x = bad; }));
    CHECK(any_one_spoils<T>([&](auto& ray) { ray.direction = Vec3<T>(bad); }));
  }
  for (const T bad : {Limits::quiet_NaN(), Limits::infinity()})
    CHECK(any_one_spoils<T>([&](auto& ray) { ray.origin.y = bad; }));
  CHECK(any_one_spoils<T>([](auto& ray) { ray.t_min = T(-1); }));
  CHECK(any_one_spoils<T>([](auto& ray) { ray.t_min = Limits::quiet_NaN(); }));
  CHECK(any_one_spoils<T>([](auto& ray) { ray.t_max = Limits::quiet_NaN(); }));
  CHECK(any_one_spoils<T>([](auto& ray) { ray.t_max = T(-1); }));
  auto still = a_few<T>(16);
  for (auto& ray : still) ray.direction = Vec3<T>(T(0));
  CHECK_FALSE(are_coherent(still));
}

}  // namespace test_geometry_ray_packet
