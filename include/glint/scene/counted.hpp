// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>

#include <glint/scene/concepts.hpp>
#include <glint/scene/path_footprint.hpp>

namespace glint {

/// A scene that counts the rays it is asked for. Integrators do not notice.
///
/// Threads: one counter each; the scene itself is shared.
template <SceneLike S>
struct Counted {
  static constexpr bool asks_for_footprints = FilteringScene<S>;

  const S& scene;
  std::uint64_t& rays;

  [[nodiscard]] auto interact(const Ray<float>& ray) const {
    ++rays;
    return scene.interact(ray);
  }
  [[nodiscard]] auto interact(const Ray<float>& ray, const PathFootprint& footprint) const requires(FilteringScene<S>) {
    ++rays;
    return scene.interact(ray, footprint);
  }
  [[nodiscard]] bool occluded(const Ray<float>& ray) const {
    ++rays;
    return scene.occluded(ray);
  }
  [[nodiscard]] auto closest(const Ray<float>& ray) const requires requires(const S& s) { s.closest(ray); }
  {
    ++rays;
    return scene.closest(ray);
  }
  [[nodiscard]] const auto& materials() const noexcept requires requires(const S& s) { s.materials(); }
  { return scene.materials(); }
  [[nodiscard]] Rgb background(const Vec3<float>& direction) const { return scene.background(direction); }
  [[nodiscard]] std::uint32_t light_count() const noexcept { return scene.light_count(); }
  [[nodiscard]] const auto& light(std::uint32_t i) const noexcept { return scene.light(i); }
  [[nodiscard]] const auto& light_sampler() const noexcept { return scene.light_sampler(); }
  [[nodiscard]] std::span<const std::uint32_t> infinite_lights() const noexcept { return scene.infinite_lights(); }
};

template <SceneLike S>
Counted(const S&, std::uint64_t&) -> Counted<S>;

}  // namespace glint
