// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {

namespace detail {

template <ShadablePrimitive P, std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface_at(const P& primitive, const Vec3<T>& position, const Hit<T>& hit) {
  if constexpr (requires { surface(primitive, position, hit); }) {
    return surface(primitive, position, hit);
  } else {
    return surface(primitive, position);
  }
}

/// One primitive on trial.
template <Primitive P>
class PrimitiveTrial {
 public:
  using T = ScalarOf<P>;

  PrimitiveTrial(const P& primitive, std::uint64_t seed)
      : primitive_(primitive), random_(seed), box_(bounds(primitive)), size_(glm::length(extent(box_))) {
    magnitude_ = std::max(max_component(abs(box_.lower)), max_component(abs(box_.upper)));
  }

  [[nodiscard]] std::vector<std::string> run() {
    if (is_empty(box_)) {
      check_nothing_is_hit();
      return violations_.take();
    }
    for (int i = 0; i < rays_; ++i) {
      const Ray<T> ray = random_ray(i);
      check_broken_rays(ray);
      check_ray(ray);
      check_ray_past_bounds();
    }
    if constexpr (ShadablePrimitive<P>) {
      violations_.expect(neighbors_off_plane_ * 5 <= neighbors_, "normals are perpendicular to the surface",
                         double(neighbors_off_plane_), double(neighbors_) / 5);
      violations_.expect(neighbors_off_map_ * 5 <= neighbors_, "tangents say how texture coordinates change",
                         double(neighbors_off_map_), double(neighbors_) / 5);
    }
    if constexpr (SampleablePrimitive<P>) check_sampling();
    return violations_.take();
  }

 private:
  static constexpr int rays_ = 256;
  static constexpr int lines_ = 4096;
  static constexpr T epsilon_ = std::numeric_limits<T>::epsilon();

  void check_nothing_is_hit() {
    for (int i = 0; i < rays_; ++i) {
      const Vec3<T> origin = random_unit_vector<T>(random_);
      const Ray<T> ray{origin, random_unit_vector<T>(random_) - origin};
      violations_.expect(!intersect(ray, primitive_), "a primitive with empty bounds is never hit", ray);
    }
  }

  /// From outside, from inside, and along an axis; directions of many lengths.
  [[nodiscard]] Ray<T> random_ray(int i) {
    const Vec3<T> target = random_point(box_, random_);
    const T distance = size_ * random_.uniform(T(1), T(3));
    Vec3<T> direction = random_unit_vector<T>(random_);
    if (i % 4 == 3) {
      const T sign = i % 8 == 3 ? T(1) : T(-1);
      direction = {i % 3 == 0 ? sign : T(0), i % 3 == 1 ? sign : T(0), i % 3 == 2 ? sign : T(0)};
    }
    const Vec3<T> origin = i % 4 == 2 ? random_point(box_, random_) : target - direction * distance;
    return {origin, direction * std::exp2(random_.uniform(T(-5), T(5)))};
  }

  /// What rounding may do to a point on this ray.
  [[nodiscard]] T slack(const Ray<T>& ray, T t) const {
    const T reach = max_component(abs(ray.origin)) + t * max_component(abs(ray.direction));
    return T(32) * epsilon_ * (reach + magnitude_);
  }

  [[nodiscard]] bool is_hit_at(const Ray<T>& ray, T t) const {
    const auto hit = intersect(ray, primitive_);
    return hit && hit->t == t;
  }

  void check_ray(const Ray<T>& ray) {
    check_scaling(ray);
    const auto hit = intersect(ray, primitive_);
    if (!hit) return;
    const T t = hit->t;
    violations_.expect(t >= ray.t_min && t <= ray.t_max && std::isfinite(t), "a hit's t lies in the interval", ray);
    const Vec3<T> margin(slack(ray, t));
    violations_.expect(contains(Aabb<T>{box_.lower - margin, box_.upper + margin}, ray.at(t)),
                       "a hit lies in the bounds", ray);
    check_intervals(ray, t);
    if constexpr (ShadablePrimitive<P>) check_surface(ray, *hit);
  }

  void check_intervals(Ray<T> ray, T t) {
    ray.t_max = t;
    violations_.expect(is_hit_at(ray, t), "an interval that ends at the hit keeps it", ray);
    ray.t_min = t;
    violations_.expect(is_hit_at(ray, t), "an interval of one point keeps the hit there", ray);
    ray.t_max = infinity<T>;
    violations_.expect(is_hit_at(ray, t), "an interval that begins at the hit keeps it", ray);
    ray.t_min = std::nextafter(t, infinity<T>);
    const auto later = intersect(ray, primitive_);
    violations_.expect(!later || later->t > t, "an interval that begins past a hit finds only later ones", ray);
    ray.t_max = t;
    violations_.expect(!intersect(ray, primitive_), "an empty interval finds nothing", ray);
    if (!(t > T(0))) return;
    ray.t_min = 0;
    ray.t_max = std::nextafter(t, -infinity<T>);
    violations_.expect(!intersect(ray, primitive_), "an interval that ends before the first hit finds nothing", ray);
  }

  /// By powers of two, which round nothing: a difference comes from a constant that is in the code, not in the data.
  void check_scaling(const Ray<T>& ray) {
    const auto hit = intersect(ray, primitive_);
    for (const T factor : {T(1) / T(1024), T(1024)}) {
      Ray<T> scaled = ray;
      scaled.direction *= factor;
      const auto other = intersect(scaled, primitive_);
      const bool same = hit.has_value() == other.has_value() &&
                        (!hit || std::abs(other->t * factor - hit->t) <= T(64) * epsilon_ * std::abs(hit->t));
      violations_.expect(same, "t scales inversely with the length of the direction", scaled);
    }
  }

  void check_broken_rays(const Ray<T>& good) {
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const auto expect_no_hit = [&](const Ray<T>& ray, const char* law) {
      violations_.expect(!intersect(ray, primitive_), law, ray);
    };
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3<T> hole{axis == 0 ? nan : T(0), axis == 1 ? nan : T(0), axis == 2 ? nan : T(0)};
      Ray<T> ray = good;
      ray.origin += hole;
      expect_no_hit(ray, "a NaN in the origin hits nothing");
      ray = good;
      ray.direction += hole;
      expect_no_hit(ray, "a NaN in the direction hits nothing");
    }
    Ray<T> ray = good;
    ray.direction = Vec3<T>(T(0));
    expect_no_hit(ray, "a zero direction hits nothing");
    ray = good;
    ray.t_min = nan;
    expect_no_hit(ray, "a NaN for t_min hits nothing");
    ray = good;
    ray.t_max = nan;
    expect_no_hit(ray, "a NaN for t_max hits nothing");
  }

  /// A line that keeps clear of the sphere around the bounds.
  void check_ray_past_bounds() {
    const Vec3<T> away = random_unit_vector<T>(random_);
    const Frame<T> frame = Frame<T>::around(away);
    const T clearance = size_ * random_.uniform(T(0.51), T(2)) + T(64) * epsilon_ * magnitude_;
    const T back = size_ * random_.uniform(T(0), T(3));
    const Vec3<T> origin = centroid(box_) + away * clearance - frame.x * back;
    const Ray<T> past{origin, frame.x};
    violations_.expect(!intersect(past, primitive_), "a ray that misses the bounds misses the primitive", past);
    const Ray<T> leaving{centroid(box_) + away * clearance, away};
    violations_.expect(!intersect(leaving, primitive_), "what lies behind the origin is not hit", leaving);
  }

  void check_surface(const Ray<T>& ray, const Hit<T>& hit) requires(ShadablePrimitive<P>) {
    const Vec3<T> position = ray.at(hit.t);
    const SurfaceOf<T> at = surface_at(primitive_, position, hit);
    check_shading_data(ray, at);
    const Vec3<T> direction = glm::normalize(ray.direction);
    const T facing = std::max(std::abs(glm::dot(at.normal, direction)), epsilon_);
    const Vec3<T> allowed = at.position_error + Vec3<T>(slack(ray, hit.t) / facing);
    const Vec3<T> off = abs(at.position - position);
    violations_.expect(off.x <= allowed.x && off.y <= allowed.y && off.z <= allowed.z,
                       "the surface's position is the ray's point, up to rounding", ray);
    check_neighbor(ray, position, at, facing);
  }

  void check_shading_data(const Ray<T>& ray, const SurfaceOf<T>& at) {
    const auto is_unit = [](const Vec3<T>& v) { return std::abs(glm::length(v) - T(1)) <= T(16) * epsilon_; };
    violations_.expect(is_unit(at.normal), "normals have unit length", ray);
    violations_.expect(is_unit(at.shading_normal), "shading normals have unit length", ray);
    violations_.expect(is_finite(at.tangent) && is_finite(at.bitangent) && std::isfinite(at.uv.x + at.uv.y),
                       "tangents and texture coordinates are finite", ray);
    violations_.expect(at.position_error.x >= T(0) && at.position_error.y >= T(0) && at.position_error.z >= T(0) &&
                           max_component(at.position_error) <= T(1024) * epsilon_ * (magnitude_ + size_),
                       "the position's error bound is a few roundings", ray);
    for (const Vec3<T>& tangent : {at.tangent, at.bitangent}) {
      const T slope = std::abs(glm::dot(tangent, at.normal));
      violations_.expect(slope <= T(64) * epsilon_ * glm::length(tangent), "tangents are perpendicular to normals",
                         ray);
    }
  }

  /// Whether the surface goes on where the normal says, and its texture coordinates as the tangents say where there are
  /// any. Edges, seams and strong curvature let a few say no.
  void check_neighbor(const Ray<T>& ray, const Vec3<T>& position, const SurfaceOf<T>& at, T facing) {
    if (facing < T(0.2)) return;
    const T step = size_ * std::sqrt(epsilon_) * T(4);
    Ray<T> beside = ray;
    beside.origin += random_unit_vector<T>(random_) * step;
    const auto hit = intersect(beside, primitive_);
    if (!hit) return;
    const Vec3<T> to_neighbor = beside.at(hit->t) - position;
    const T distance = glm::length(to_neighbor);
    if (distance > T(10) * step || distance < T(0.1) * step) return;
    ++neighbors_;
    const T allowed = T(0.05) * distance + slack(ray, hit->t);
    if (std::abs(glm::dot(to_neighbor, at.normal)) > allowed) ++neighbors_off_plane_;
    if (at.bitangent == Vec3<T>(T(0))) return;
    const Vec2<T> step_in_uv = surface_at(primitive_, beside.at(hit->t), *hit).uv - at.uv;
    const Vec3<T> by_tangents = at.tangent * step_in_uv.x + at.bitangent * step_in_uv.y;
    if (glm::length(by_tangents - to_neighbor) > T(2) * allowed) ++neighbors_off_map_;
  }

  using Octants = std::array<double, 8>;

  /// Of the bounds; the little more keeps the points of a flat shape on one side of its own plane.
  [[nodiscard]] std::size_t octant(const Vec3<T>& p) const {
    const Vec3<T> c = centroid(box_) + T(64) * epsilon_ * (size_ + magnitude_);
    return (p.x > c.x ? 1U : 0U) + (p.y > c.y ? 2U : 0U) + (p.z > c.z ? 4U : 0U);
  }

  /// Lines through the sphere around the bounds, uniform in direction and place, cross a surface in points uniform
  /// by area, and area / (2πR²) times in the mean (Crofton). So they tell area and distribution without the
  /// primitive's help.
  void check_sampling() requires(SampleablePrimitive<P>) {
    const T radius = size_ * T(0.5) * T(1.01);
    Octants crossed{};
    double crossings = 0;
    double squares = 0;
    for (int i = 0; i < lines_; ++i) {
      const double count = count_crossings(radius, crossed);
      crossings += count;
      squares += count * count;
    }
    const double mean = crossings / lines_;
    const double deviation = std::sqrt(std::max(squares / lines_ - mean * mean, 1e-3) / lines_);
    const double expected = double(area(primitive_)) / (2 * pi<double> * double(radius) * double(radius));
    violations_.expect(std::abs(mean - expected) <= 5 * deviation, "the area is what random lines measure", mean,
                       expected);
    check_samples(crossed, crossings);
  }

  double count_crossings(T radius, Octants& crossed) {
    const Frame<T> frame = Frame<T>::around(random_unit_vector<T>(random_));
    const T r = radius * std::sqrt(random_.uniform<T>());
    const T phi = random_.uniform(T(0), T(2) * pi<T>);
    const Vec3<T> offset = (frame.x * std::cos(phi) + frame.y * std::sin(phi)) * r;
    Ray<T> ray{centroid(box_) + offset - frame.z * (T(2) * radius), frame.z};
    double count = 0;
    while (count < 64) {
      const auto hit = intersect(ray, primitive_);
      if (!hit) break;
      ++crossed[octant(ray.at(hit->t))];
      ++count;
      ray.t_min = std::nextafter(hit->t, infinity<T>);
    }
    return count;
  }

  void check_samples(const Octants& crossed, double crossings) requires(SampleablePrimitive<P>) {
    Octants sampled{};
    int lost = 0;
    for (int i = 0; i < lines_; ++i) {
      const AreaSample<T> sample = sample_area(primitive_, random_.uniform_vec2<T>());
      ++sampled[octant(sample.surface.position)];
      if (!is_found(sample)) ++lost;
    }
    violations_.expect(lost * 50 <= lines_, "a ray toward a sampled point finds it", double(lost), 0);
    if (crossings < 100) return;
    double chi_square = 0;  // of two samples of unequal size; 3 is more than the pairing of a line's crossings adds
    const double a = std::sqrt(lines_ / crossings);
    for (std::size_t i = 0; i < crossed.size(); ++i) {
      const double sum = crossed[i] + sampled[i];
      const double difference = crossed[i] * a - sampled[i] / a;
      if (sum > 0) chi_square += difference * difference / sum;
    }
    constexpr double limit = 3 * 40;  // seven degrees of freedom exceed 40 once in a million
    violations_.expect(chi_square <= limit, "sampled points are uniform by area (chi-square)", chi_square, limit);
  }

  [[nodiscard]] bool is_found(const AreaSample<T>& sample) requires(SampleablePrimitive<P>) {
    const SurfaceOf<T>& at = sample.surface;
    const T distance = size_ * random_.uniform(T(0.1), T(2));
    const T side = random_.uniform<T>() < T(0.5) ? T(-1) : T(1);
    const T tolerance = T(64) * epsilon_ * (T(1) + magnitude_ / distance);
    const Vec3<T> away = at.normal * (side * distance);
    const Ray<T> ray{at.position + away, -away, T(1) - tolerance, T(1) + tolerance};
    check_shading_data(ray, at);
    violations_.expect(std::abs(sample.pdf * area(primitive_) - T(1)) <= T(16) * epsilon_,
                       "the density of a sampled point is 1 / area", ray);
    return intersect(ray, primitive_).has_value();
  }

  const P& primitive_;
  Random random_;
  Aabb<T> box_;
  T size_;
  T magnitude_ = 0;
  Violations violations_;
  int neighbors_ = 0;
  int neighbors_off_plane_ = 0;
  int neighbors_off_map_ = 0;
};

}  // namespace detail

/// What a primitive breaks of the laws of Primitive, ShadablePrimitive and SampleablePrimitive (as far as it offers
/// them), a sentence each; nothing where it keeps them all.
///
/// Requires: bounds that are empty, or finite and not a point.
/// Cost:     about 10⁴ intersections.
template <Primitive P>
[[nodiscard]] std::vector<std::string> violations_of_primitive_laws(const P& primitive, std::uint64_t seed) {
  return detail::PrimitiveTrial<P>(primitive, seed).run();
}

}  // namespace glint::testing
