// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {

/// Rays that try a box and what is in it: from in- and outside, along axes, in the planes of its faces, in intervals of
/// all kinds, on both sides of the origin.
template <std::floating_point T>
class RaySource {
 public:
  RaySource(const Aabb<T>& box, std::uint32_t seed) : box_(box), generator_(seed) {
    if (is_empty(box_)) box_ = {Vec3<T>(T(-1)), Vec3<T>(T(1))};
  }

  [[nodiscard]] Ray<T> next() {
    Ray<T> ray{.origin = point(T(1))};
    const Vec3<T> target = point(T(0));
    ray.direction = (target - ray.origin) * uniform(T(0.2), T(2));
    switch (draw(6)) {
      case 0:
        ray.direction = along_axis();
        break;
      case 1:
        ray = along_grid();
        break;
      case 2:
        ray.direction = on_grid() - ray.origin;
        break;
      default:
        break;
    }
    switch (draw(5)) {
      case 0:
        ray.t_max = uniform(T(0), T(2));
        break;
      case 1:
        ray.t_min = uniform(T(0), T(1));
        break;
      case 2:
        ray.t_min = uniform(T(-2), T(0));
        break;
      case 3:
        ray.t_min = -infinity<T>;
        break;
      default:
        break;
    }
    return ray;
  }

 private:
  [[nodiscard]] unsigned draw(unsigned n) { return unsigned(generator_() % n); }
  [[nodiscard]] T uniform(T low, T high) { return low + (high - low) * T(generator_()) * T(0x1p-32); }
  /// In the box grown on all sides by `margin` times its size.
  [[nodiscard]] Vec3<T> point(T margin) {
    const Vec3<T> e = extent(box_);
    const T x = uniform(-margin, 1 + margin);
    const T y = uniform(-margin, 1 + margin);
    const T z = uniform(-margin, 1 + margin);
    return box_.lower + e * Vec3<T>{x, y, z};
  }
  /// A corner of the box, the middle of a face or edge, or the center: where coordinates tie.
  [[nodiscard]] Vec3<T> on_grid() {
    const Vec3<T> e = extent(box_);
    const T x = T(draw(3)) / 2;
    const T y = T(draw(3)) / 2;
    const T z = T(draw(3)) / 2;
    return box_.lower + e * Vec3<T>{x, y, z};
  }
  [[nodiscard]] Ray<T> along_grid() {
    const Vec3<T> origin = on_grid();
    return {.origin = origin, .direction = along_axis()};
  }
  [[nodiscard]] Vec3<T> along_axis() {
    std::array<T, 3> d{};
    d.fill(draw(2) == 0 ? T(0) : T(-0.0));
    d[draw(3)] = draw(2) == 0 ? T(2) : T(-2);
    return {d[0], d[1], d[2]};
  }

  Aabb<T> box_;
  std::mt19937 generator_;
};

/// True where two ray casters say the same: both nothing, or the same primitive at the same t but for the rounding of a
/// different order of operations, or two primitives that this rounding cannot tell apart.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] bool agree(const Ray<T>& ray, const std::optional<Hit<T, I>>& a, const std::optional<Hit<T, I>>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  const T way = max_component(abs(ray.direction));
  const T rounding = rounding_bound<T>(64) * (max_component(abs(ray.origin)) + way * std::abs(a->t));
  return std::abs(a->t - b->t) * way <= rounding;
}

/// The laws of RayCaster, for one seed: `closest` and `occluded` agree with each other and with `oracle`, hits lie in
/// the ray's interval, both ends count, and a ray without a direction, or with a NaN, meets nothing.
///
/// Pass BruteForce over the same set as the oracle.
template <RayCaster G, RayCaster Oracle>
[[nodiscard]] std::vector<std::string> violations_of_ray_caster_laws(const G& geometry, const Oracle& oracle,
                                                                     std::uint32_t seed, int rays = 256) {
  using T = typename G::Scalar;
  Violations broken;
  RaySource<T> source(geometry.bounds(), seed);
  for (int i = 0; i < rays; ++i) {
    const Ray<T> ray = source.next();
    const auto hit = geometry.closest(ray);
    broken.expect(geometry.occluded(ray) == hit.has_value(), "occluded says whether there is a closest hit", ray);
    broken.expect(agree(ray, hit, oracle.closest(ray)), "the closest hit is the oracle's", ray);
    broken.expect(oracle.occluded(ray) == hit.has_value(), "the oracle sees a hit where there is one", ray);
    for (const T bad : {T(0), std::numeric_limits<T>::quiet_NaN()}) {
      const Ray<T> nowhere{.origin = ray.origin, .direction = Vec3<T>(bad)};
      broken.expect(!geometry.closest(nowhere) && !geometry.occluded(nowhere), "a ray without a direction", nowhere);
    }
    if (!hit) continue;
    broken.expect(ray.t_min <= hit->t && hit->t <= ray.t_max, "hits lie in the ray's interval", ray);
    Ray<T> closed = ray;
    closed.t_max = hit->t;
    broken.expect(geometry.closest(closed) == hit && geometry.occluded(closed), "the end of a ray counts", closed);
    closed.t_min = hit->t;
    broken.expect(geometry.closest(closed) == hit && geometry.occluded(closed), "both ends of a ray count", closed);
    closed.t_max = std::numeric_limits<T>::quiet_NaN();
    broken.expect(!geometry.closest(closed) && !geometry.occluded(closed), "a NaN for an end meets nothing", closed);
  }
  return broken.take();
}

}  // namespace glint::testing
