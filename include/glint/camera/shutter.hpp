// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <optional>

#include <glint/camera/concepts.hpp>
#include <glint/camera/importance.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Rays that leave at different times. `moment` is in [0, 1); its rays are those of `ray(film, lens)` but for the time.
template <typename G>
concept TimedRayGenerator = RayGenerator<G> &&
    requires(const G& generator, const Vec2<float>& film, const Vec2<float>& lens, float moment) {
  { generator.ray(film, lens, moment) } -> std::same_as<Ray<float>>;
};

/// Rays through a shutter.
template <RayGenerator G>
struct ShutterRays {
  G camera{};
  float open = 0;
  float close = 1;

  /// As the shutter opens.
  [[nodiscard]] Ray<float> ray(const Vec2<float>& film, const Vec2<float>& lens) const { return ray(film, lens, 0.0F); }
  [[nodiscard]] Ray<float> ray(const Vec2<float>& film, const Vec2<float>& lens, float moment) const {
    Ray<float> timed = camera.ray(film, lens);
    timed.time = open + (close - open) * moment;
    return timed;
  }

  [[nodiscard]] std::optional<CameraSample> sample_toward(const Vec3<float>& point, const Vec2<float>& lens) const
      requires(ImportanceGenerator<G>) {
    return camera.sample_toward(point, lens);
  }
  [[nodiscard]] float importance(const Ray<float>& ray, float distance) const requires(ImportanceGenerator<G>) {
    return camera.importance(ray, distance);
  }
};

/// A camera with motion blur: its shutter is open from one time to another, and what moves is seen at all times
/// between. It stands still itself. `render` then draws one number a sample more; other cameras are rendered as ever.
///
///     glint::render(scene, glint::Shutter{glint::Perspective{.eye = eye}}, glint::Path{}, film);
///
/// Requires: 0 ≤ open ≤ close ≤ 1. Where they are equal, the picture is a still one.
/// Source:   Cook, Porter, Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984, section 4.
template <Camera C>
struct Shutter {
  C camera{};
  float open = 0;
  float close = 1;

  /// Requires: aspect > 0.
  [[nodiscard]] auto rays(float aspect) const { return ShutterRays{camera.rays(aspect), open, close}; }
};
template <Camera C>
explicit Shutter(C) -> Shutter<C>;
template <Camera C>
Shutter(C, float, float) -> Shutter<C>;
template <RayGenerator G>
ShutterRays(G, float, float) -> ShutterRays<G>;

}  // namespace glint
