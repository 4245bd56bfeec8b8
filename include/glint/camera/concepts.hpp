// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/geometry/ray.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Rays of a camera whose constants are worked out. `film` is in [0, 1]², (0, 0) the lower left corner of the image,
/// x to the right, y up. `lens` is in [0, 1)²; pinholes ignore it. Directions have unit length.
template <typename G>
concept RayGenerator = requires(const G& generator, const Vec2<float>& film, const Vec2<float>& lens) {
  { generator.ray(film, lens) } -> std::same_as<Ray<float>>;
};

/// A camera: a plain description; `rays(aspect)` prepares it for an image of that width over height.
template <typename C>
concept Camera = requires(const C& camera, float aspect) {
  { camera.rays(aspect) } -> RayGenerator;
};

}  // namespace glint
