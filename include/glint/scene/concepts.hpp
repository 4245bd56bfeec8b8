// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>
#include <span>

#include <glint/color/rgb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/light/light_sampler.hpp>

namespace glint {

/// What integrators ask of a scene.
///
/// - `interact(ray)`: the closest surface as an optional Interaction.
/// - `occluded(ray)`: whether anything is in the way.
/// - `background(direction)`: radiance that a ray meets when it leaves the scene.
/// - `light_count()`, `light(i)`, `light_sampler()`: the lights, and a way to choose one.
/// - `infinite_lights()`: the indices of the lights that `background` is made of.
template <typename S>
concept SceneLike = requires(const S& scene, const Ray<float>& ray, const Vec3<float>& direction, std::uint32_t i) {
  scene.interact(ray).has_value();
  { scene.occluded(ray) } -> std::same_as<bool>;
  { scene.background(direction) } -> std::same_as<Rgb>;
  { scene.light_count() } -> std::same_as<std::uint32_t>;
  { scene.light(i) } -> Light;
  { scene.light_sampler() } -> LightSampler;
  { scene.infinite_lights() } -> std::same_as<std::span<const std::uint32_t>>;
};

}  // namespace glint
