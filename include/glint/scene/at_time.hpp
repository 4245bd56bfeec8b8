// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>

#include <glint/scene/concepts.hpp>
#include <glint/scene/path_footprint.hpp>

namespace glint {

/// A scene at one time: whatever rays it is asked for, they have that time. Integrators do not notice, and all rays of
/// a path see the same moment.
template <SceneLike S>
struct AtTime {
  static constexpr bool asks_for_footprints = FilteringScene<S>;

  const S& scene;
  float time = 0;

  [[nodiscard]] auto interact(const Ray<float>& ray) const { return scene.interact(timed(ray)); }
  [[nodiscard]] auto interact(const Ray<float>& ray, const PathFootprint& footprint) const requires(FilteringScene<S>) {
    return scene.interact(timed(ray), footprint);
  }
  [[nodiscard]] bool occluded(const Ray<float>& ray) const { return scene.occluded(timed(ray)); }
  [[nodiscard]] auto closest(const Ray<float>& ray) const requires requires(const S& s) { s.closest(ray); }
  { return scene.closest(timed(ray)); }
  [[nodiscard]] const auto& materials() const noexcept requires requires(const S& s) { s.materials(); }
  { return scene.materials(); }
  [[nodiscard]] Rgb background(const Vec3<float>& direction) const { return scene.background(direction); }
  [[nodiscard]] std::uint32_t light_count() const noexcept { return scene.light_count(); }
  [[nodiscard]] const auto& light(std::uint32_t i) const noexcept { return scene.light(i); }
  [[nodiscard]] const auto& light_sampler() const noexcept { return scene.light_sampler(); }
  [[nodiscard]] std::span<const std::uint32_t> infinite_lights() const noexcept { return scene.infinite_lights(); }

 private:
  [[nodiscard]] Ray<float> timed(Ray<float> ray) const noexcept {
    ray.time = time;
    return ray;
  }
};

template <SceneLike S>
AtTime(const S&, float) -> AtTime<S>;

}  // namespace glint
