// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/camera/concepts.hpp>
#include <glint/camera/importance.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {

namespace detail {

/// Where the ray of a film position meets the plane that faces another ray at some distance.
template <RayGenerator G>
[[nodiscard]] Vec3<double> on_facing_plane(const G& generator, const Vec2<float>& film, const Vec2<float>& lens,
                                           const Ray<float>& through, float distance) {
  const Ray<float> ray = generator.ray(film, lens);
  const Vec3<double> normal(through.direction);
  const Vec3<double> origin(ray.origin);
  const Vec3<double> direction(ray.direction);
  const Vec3<double> center = Vec3<double>(through.origin) + normal * static_cast<double>(distance);
  return origin + direction * (glm::dot(center - origin, normal) / glm::dot(direction, normal));
}

/// The density of rays on that plane, by differences.
template <RayGenerator G>
[[nodiscard]] double density_by_differences(const G& generator, const Vec2<float>& film, const Vec2<float>& lens,
                                            float distance) {
  constexpr float step = 0x1p-8F;
  const Ray<float> through = generator.ray(film, lens);
  const auto at = [&](float x, float y) {
    return on_facing_plane(generator, film + Vec2<float>{x, y}, lens, through, distance);
  };
  const Vec3<double> by_x = (at(step, 0) - at(-step, 0)) / (2 * static_cast<double>(step));
  const Vec3<double> by_y = (at(0, step) - at(0, -step)) / (2 * static_cast<double>(step));
  return 1 / glm::length(glm::cross(by_x, by_y));
}

}  // namespace detail

/// The laws of ImportanceGenerator that `generator` breaks: a sentence each, none where all hold.
///
/// - A point on a ray is seen through the same part of the lens at the ray's film position, back along the ray.
/// - Its importance is what importance(ray, distance) says, and the density of rays there: what one film position has
///   to the next, they have one to the other on a plane that faces the ray. Within a hundredth.
///
/// Requires: film positions a 256th apart have rays that differ little.
template <ImportanceGenerator G>
  requires RayGenerator<G>
[[nodiscard]] std::vector<std::string> violations_of_camera_laws(const G& generator, std::uint64_t seed) {
  Violations violations;
  Random random{seed};
  for (int i = 0; i < 500; ++i) {
    const Vec2<float> film = random.uniform_vec2() * 0.8F + 0.1F;
    const Vec2<float> lens = random.uniform_vec2();
    const float distance = std::exp2(random.uniform_vec2().x * 6 - 2);
    const Ray<float> ray = generator.ray(film, lens);
    const auto seen = generator.sample_toward(ray.at(distance), lens);
    violations.expect(seen.has_value(), "a point on a ray is in the picture", ray);
    if (!seen) continue;
    violations.expect(glm::length(seen->film - film) < 1e-3F, "a point on a ray is seen at its film position", ray);
    violations.expect(glm::length(seen->wi + ray.direction) < 1e-4F, "a point on a ray sees the camera along it", ray);
    violations.expect(glm::length(seen->target - ray.origin) < 1e-3F * (1 + distance), "the target is on the lens",
                      ray);
    const auto stated = static_cast<double>(generator.importance(ray, distance));
    violations.expect(std::abs(static_cast<double>(seen->importance) - stated) <= 1e-3 * stated,
                      "importance(ray, distance) is the importance of the sample", ray);
    const double density = detail::density_by_differences(generator, film, lens, distance);
    violations.expect(std::abs(density - stated) <= 1e-2 * stated, "importance is the density of rays", ray);
  }
  return violations.take();
}

}  // namespace glint::testing
