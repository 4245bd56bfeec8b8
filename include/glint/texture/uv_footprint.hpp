// SPDX-License-Identifier: MIT
#pragma once
#include <glm/geometric.hpp>

#include <glint/geometry/surface.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A neighborhood in texture coordinates: how far they move where a path's pixel is exchanged for the next one across
/// (x) or up (y).
struct UvFootprint {
  Vec2<float> x{0.0F};
  Vec2<float> y{0.0F};

  [[nodiscard]] friend bool operator==(const UvFootprint&, const UvFootprint&) noexcept = default;
};

/// A surface's footprint in its texture coordinates, by least squares where tangents and footprint are not in one
/// plane. Zero where there is no parametrization.
///
/// Source: Pharr, Jakob, Humphreys, Physically Based Rendering (2023), section 10.1.1.
[[nodiscard]] inline UvFootprint uv_footprint(const Surface& at) noexcept {
  const float u_u = length_squared(at.tangent);
  const float v_v = length_squared(at.bitangent);
  const float u_v = glm::dot(at.tangent, at.bitangent);
  const float determinant = u_u * v_v - u_v * u_v;
  if (!(determinant > 1e-7F * u_u * v_v)) return {};
  const float inverse = 1 / determinant;
  const auto in_uv = [&](const Vec3<float>& p) {
    const float p_u = glm::dot(at.tangent, p);
    const float p_v = glm::dot(at.bitangent, p);
    return Vec2<float>{(v_v * p_u - u_v * p_v) * inverse, (u_u * p_v - u_v * p_u) * inverse};
  };
  return {in_uv(at.footprint.x), in_uv(at.footprint.y)};
}

}  // namespace glint
