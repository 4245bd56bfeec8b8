// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/query/hits.hpp>
#include <glint/bvh/query/nearest.hpp>
#include <glint/bvh/query/overlap.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/ray_caster_laws.hpp>

namespace glint::testing {

/// What a set says of some rays and points when every primitive is asked: right by being simple.
template <PrimitiveSet S>
class Oracle {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;
  using Hits = std::vector<Hit<T, I>>;

  Oracle(const S& set, const Aabb<T>& bounds, std::size_t rays) {
    RaySource<T> source(bounds, 7);
    for (std::size_t i = 0; i < rays; ++i) rays_.push_back(source.next());
    for (const Ray<T>& ray : rays_) hits_.push_back(all_hits(set, ray));
    const Vec3<T> center = centroid(bounds);
    for (const T share : {T(0.1), T(0.4), T(2)}) {
      const Vec3<T> half = extent(bounds) * (share / 2);
      boxes_.push_back({center - half, center + half});
      overlapping_.push_back(all_overlapping(BruteForce<S>(set), boxes_.back()));
    }
    if constexpr (ClosestPointSet<S>) measure_distances(set);
  }

  /// What a Bvh over the set says otherwise, by the name of the query.
  template <typename B>
  [[nodiscard]] std::vector<std::string> disagreements(const B& bvh) const {
    std::vector<std::string> wrong;
    const auto expect = [&](bool right, const char* query) {
      if (!right && (wrong.empty() || wrong.back() != query)) wrong.emplace_back(query);
    };
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const std::optional<Hit<T, I>> first = hits_[i].empty() ? std::nullopt : std::optional(hits_[i].front());
      expect(bvh.closest(rays_[i]) == first, "closest");
      expect(bvh.occluded(rays_[i]) == first.has_value(), "occluded");
    }
    expect(batches_agree(bvh), "batch");
    for (std::size_t i = 0; i < rays_.size(); ++i) expect(all_hits_of(bvh, rays_[i]) == hits_[i], "for_each_hit");
    for (std::size_t i = 0; i < rays_.size(); ++i) expect(nearest_agree(bvh, i), "nearest_hits");
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      expect(all_overlapping(bvh, boxes_[i]) == overlapping_[i], "overlapping");
    if constexpr (ClosestPointSet<S>) expect(closest_points_agree(bvh), "closest_point");
    return wrong;
  }

  /// How many hits there are: a matrix without any would hold for everything.
  [[nodiscard]] std::size_t hit_count() const {
    std::size_t count = 0;
    for (const Hits& hits : hits_) count += hits.size();
    return count;
  }

 private:
  static void sort(Hits& hits) {
    std::sort(hits.begin(), hits.end(),
              [](const auto& a, const auto& b) { return is_closer(a, b) || (!is_closer(b, a) && a.inner < b.inner); });
  }

  /// Each primitive is asked again behind every hit.
  [[nodiscard]] static Hits all_hits(const S& set, const Ray<T>& ray) {
    Hits hits;
    for (I i = 0; i < set.size(); ++i) {
      Ray<T> rest = ray;
      for (auto hit = set.intersect(rest, i); hit; hit = set.intersect(rest, i)) {
        hits.push_back(*hit);
        rest.t_min = std::nextafter(hit->t, infinity<T>);
      }
    }
    sort(hits);
    return hits;
  }
  template <typename B>
  [[nodiscard]] static Hits all_hits_of(const B& bvh, const Ray<T>& ray) {
    Hits hits;
    for_each_hit(bvh, ray, [&](const Hit<T, I>& hit) { hits.push_back(hit); });
    sort(hits);
    return hits;
  }
  template <RayCaster B>
  [[nodiscard]] static std::vector<I> all_overlapping(const B& caster, const Aabb<T>& box) {
    std::vector<I> found = overlapping(caster, box);
    std::sort(found.begin(), found.end());
    return found;
  }
  template <typename B>
  [[nodiscard]] bool nearest_agree(const B& bvh, std::size_t i) const {
    std::array<Hit<T, I>, 2> nearest;
    const std::size_t count = nearest_hits(bvh, rays_[i], nearest);
    return count == std::min(hits_[i].size(), nearest.size()) &&
           std::equal(nearest.begin(), nearest.begin() + std::ptrdiff_t(count), hits_[i].begin());
  }
  template <typename B>
  [[nodiscard]] bool batches_agree(const B& bvh) const {
    std::vector<std::optional<Hit<T, I>>> closest(rays_.size());
    const auto occluded = std::make_unique<bool[]>(rays_.size());
    bvh.closest(std::span<const Ray<T>>(rays_), std::span(closest));
    bvh.occluded(std::span<const Ray<T>>(rays_), std::span(occluded.get(), rays_.size()));
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const bool is_hit = !hits_[i].empty();
      if (closest[i].has_value() != is_hit || occluded[i] != is_hit) return false;
      if (is_hit && !(*closest[i] == hits_[i].front())) return false;
    }
    return true;
  }

  void measure_distances(const S& set) {
    Random random(3);
    for (int i = 0; i < 20; ++i) {
      const Vec3<T> point = random.uniform_vec3<T>() * T(4) - T(2);
      T least = infinity<T>;
      for (I k = 0; k < set.size(); ++k) {
        if (!is_bounded(set.bounds(k))) continue;
        least = std::min(least, length_squared(set.closest_point(point, k) - point));
      }
      points_.emplace_back(point, std::sqrt(least));
    }
  }
  template <typename B>
  [[nodiscard]] bool closest_points_agree(const B& bvh) const {
    const T slack = rounding_bound<T>(32);  // of a distance of a few units, by other arithmetic
    return std::all_of(points_.begin(), points_.end(), [&](const auto& asked) {
      const auto found = closest_point(bvh, asked.first);
      return found && std::abs(found->distance - asked.second) <= slack;
    });
  }

  std::vector<Ray<T>> rays_;
  std::vector<Hits> hits_;
  std::vector<Aabb<T>> boxes_;
  std::vector<std::vector<I>> overlapping_;
  std::vector<std::pair<Vec3<T>, T>> points_;
};

}  // namespace glint::testing
