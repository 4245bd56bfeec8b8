// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/ray_caster_laws.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {
namespace detail {

template <PrimitiveSet S>
class SetTrial {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;

  SetTrial(const S& set, std::uint32_t seed) : set_(set), random_(seed) {
    for (I i = 0; i < set.size(); ++i)
      if (const Aabb<T> box = set.bounds(i); is_bounded(box)) extend(box_, box);
  }

  [[nodiscard]] std::vector<std::string> run(std::uint32_t seed, int rays) {
    RaySource<T> source(box_, seed);
    for (int k = 0; k < rays; ++k) {
      const Ray<T> ray = source.next();
      for (I i = 0; i < set_.size(); ++i) check(ray, i);
    }
    return violations_.take();
  }

 private:
  void check(const Ray<T>& ray, I i) {
    const auto hit = set_.intersect(ray, i);
    const auto expect = [&](bool kept, const char* law) { violations_.expect(kept, law, ray); };
    if constexpr (PreparedSet<S>)
      expect(set_.intersect(ray, set_.prepare(ray), i) == hit, "what is prepared once a ray changes no hit");
    if constexpr (OccluderSet<S>)
      expect(set_.occluded(ray, i) == hit.has_value(), "occluded says whether intersect finds something");
    if (hit) check_hit(ray, i, *hit);
  }

  void check_hit(const Ray<T>& ray, I i, const Hit<T, I>& hit) {
    const auto expect = [&](bool kept, const char* law) { violations_.expect(kept, law, ray); };
    expect(hit.primitive == i, "a hit carries the index of its primitive");
    expect(ray.t_min <= hit.t && hit.t <= ray.t_max, "hits lie in the ray's interval");
    Ray<T> closed = ray;
    closed.t_min = closed.t_max = hit.t;
    expect(set_.intersect(closed, i) == hit, "both ends of a ray count");
    closed.t_max = std::numeric_limits<T>::quiet_NaN();
    expect(!set_.intersect(closed, i), "a NaN for an end meets nothing");
    const Vec3<T> position = ray.at(hit.t);
    const Vec3<T> rounding = abs(ray.origin) + abs(ray.direction * hit.t) + extent(box_);
    slack_ = max_component(rounding) * rounding_bound<T>(64);
    expect(is_near(set_.bounds(i), position), "bounds hold every hit");
    if constexpr (ClippableSet<S>) check_clip(ray, i, position);
    if constexpr (ClosestPointSet<S>) check_closest(ray, i, position);
  }

  /// Of a cell somewhere about the hit.
  void check_clip(const Ray<T>& ray, I i, const Vec3<T>& position) {
    const Vec3<T> size = extent(box_) * random_.uniform(T(0.01), T(1));
    const Vec3<T> lower = position - size * random_.uniform_vec3<T>();
    const Aabb<T> cell{lower, lower + size};
    violations_.expect(is_near(set_.clip(i, cell), position), "clip holds every hit in the cell", ray);
  }

  void check_closest(const Ray<T>& ray, I i, const Vec3<T>& position) {
    const Vec3<T> point = random_point(box_, random_);
    const Vec3<T> closest = set_.closest_point(point, i);
    const T reach = std::sqrt(length_squared(position - point));
    violations_.expect(std::sqrt(length_squared(closest - point)) <= reach + T(8) * slack_,
                       "no hit is closer to a point than the closest point", ray);
    violations_.expect(is_near(set_.bounds(i), closest), "bounds hold the closest point", ray);
  }

  [[nodiscard]] bool is_near(const Aabb<T>& box, const Vec3<T>& p) const {
    const Vec3<T> outside = max(box.lower - p, p - box.upper);
    return !is_empty(box) && max_component(outside) <= slack_;
  }

  const S& set_;
  Random random_;
  Aabb<T> box_;
  T slack_ = 0;
  Violations violations_;
};

}  // namespace detail

/// What a set breaks of the laws of PrimitiveSet, and of PreparedSet, OccluderSet, ClippableSet and ClosestPointSet as
/// far as it offers them, a sentence each; nothing where it keeps them all.
///
/// - Hits carry their primitive's index and lie in the ray's interval, whose ends count, and in the bounds.
/// - What is prepared, and occluded, say the same as intersect; clip and closest_point leave no hit out.
///
/// Requires: a set of few primitives that random rays about their bounds hit now and then.
/// Cost:     some calls for each ray and primitive.
template <PrimitiveSet S>
[[nodiscard]] std::vector<std::string> violations_of_set_laws(const S& set, std::uint32_t seed, int rays = 128) {
  return detail::SetTrial<S>(set, seed).run(seed, rays);
}

}  // namespace glint::testing
