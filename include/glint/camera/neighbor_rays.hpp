// SPDX-License-Identifier: MIT
#pragma once
#include <glint/camera/concepts.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_differential.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// How a camera's ray changes over a step on the film, by the rays of the neighbors themselves: right for every
/// camera, the user's own included.
///
/// Units: `step` in those of `film`: one over the image's size for the neighboring pixels.
/// Cost:  two more rays.
template <RayGenerator G>
[[nodiscard]] RayDifferential ray_differential(const G& generator, const Vec2<float>& film, const Vec2<float>& lens,
                                               const Vec2<float>& step) {
  const Ray<float> ray = generator.ray(film, lens);
  const Ray<float> across = generator.ray(Vec2<float>{film.x + step.x, film.y}, lens);
  const Ray<float> upward = generator.ray(Vec2<float>{film.x, film.y + step.y}, lens);
  return {.origin_x = across.origin - ray.origin,
          .direction_x = across.direction - ray.direction,
          .origin_y = upward.origin - ray.origin,
          .direction_y = upward.direction - ray.direction};
}

}  // namespace glint
