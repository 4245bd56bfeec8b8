// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// How a ray changes where its pixel is exchanged for the next one across (x) or up (y). All zero: not at all.
///
/// Source: Igehy, "Tracing Ray Differentials", SIGGRAPH 1999.
struct RayDifferential {
  Vec3<float> origin_x{0.0F};
  Vec3<float> direction_x{0.0F};
  Vec3<float> origin_y{0.0F};
  Vec3<float> direction_y{0.0F};

  [[nodiscard]] friend bool operator==(const RayDifferential&, const RayDifferential&) noexcept = default;
};

/// Where the neighbors of a ray meet the plane that touches a surface, seen from where the ray itself does.
///
/// Requires: the ray's direction has unit length, and the surface is what it meets.
/// Errors:   a ray nearly in the plane counts as inclined by a thousandth: footprints are finite.
/// Source:   Igehy (1999), section 3.1.1.
[[nodiscard]] inline Footprint footprint_at(const Surface& at, const Ray<float>& ray,
                                            const RayDifferential& differential) noexcept {
  const float distance = std::sqrt(length_squared(at.position - ray.origin));
  const float facing = glm::dot(at.normal, ray.direction);
  const float inverse = 1 / std::copysign(std::max(std::abs(facing), 1e-3F), facing);
  const auto met_by = [&](const Vec3<float>& origin, const Vec3<float>& direction) {
    const Vec3<float> beside = origin + direction * distance;
    return beside - ray.direction * (glm::dot(at.normal, beside) * inverse);
  };
  return {met_by(differential.origin_x, differential.direction_x),
          met_by(differential.origin_y, differential.direction_y)};
}

}  // namespace glint
