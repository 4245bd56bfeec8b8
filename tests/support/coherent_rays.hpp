// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_packet.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_rays.hpp>

namespace glint::testing {

/// Rays from one point about the box toward a spot in its middle, `spread` times as wide as the way is long; directions
/// of many lengths, intervals of some kinds.
template <typename T>
[[nodiscard]] std::vector<Ray<T>> pencil_of_rays(const Aabb<T>& box, std::size_t count, T spread, std::uint64_t seed) {
  Random random(seed);
  const Vec3<T> around = extent(box);
  const Vec3<T> eye = detail::random_point(Aabb<T>{box.lower - around, box.upper + around}, random);
  const Vec3<T> quarter = around / T(4);
  const Vec3<T> way = detail::random_point(Aabb<T>{box.lower + quarter, box.upper - quarter}, random) - eye;
  const Vec3<T> spot = abs(way) * spread;
  std::vector<Ray<T>> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<T> off = detail::random_point(Aabb<T>{-spot, spot}, random);
    Ray<T> ray{.origin = eye, .direction = (way + off) * random.uniform(T(0.5), T(2))};
    if (random.below(8) == 0) ray.t_min = random.uniform(T(0), T(1));
    if (random.below(8) == 0) ray.t_max = random.uniform(T(0.5), T(2));
    rays.push_back(ray);
  }
  return rays;
}

/// Rays from a spot in the box toward one point, where they end: what shadow rays look like.
template <typename T>
[[nodiscard]] std::vector<Ray<T>> rays_toward_a_point(const Aabb<T>& box, std::size_t count, T spread,
                                                      std::uint64_t seed) {
  std::vector<Ray<T>> rays = pencil_of_rays(box, count, spread, seed);
  if (rays.empty()) return rays;
  const T length = glm::length(rays[0].direction);
  for (Ray<T>& ray : rays) ray.direction *= length / glm::length(ray.direction);
  for (Ray<T>& ray : rays) ray = {.origin = ray.origin + ray.direction, .direction = -ray.direction, .t_max = T(1)};
  return rays;
}

/// Those that have the course of the first.
template <typename T>
[[nodiscard]] std::vector<Ray<T>> of_one_course(std::vector<Ray<T>> rays) {
  const std::uint32_t course = rays.empty() ? 0 : course_of(rays[0]);
  rays.erase(std::remove_if(rays.begin(), rays.end(), [&](const Ray<T>& ray) { return course_of(ray) != course; }),
             rays.end());
  return rays;
}

}  // namespace glint::testing
