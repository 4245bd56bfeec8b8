// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/geometry/triangle.hpp>
#include <glint/light/solid_angle.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

namespace detail {

/// A triangle seen from a point, as the spherical triangle of the directions a, b, c of its corners.
///
/// Source: Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995; the solid angle by Van Oosterom,
/// Strackee,
///         "The Solid Angle of a Plane Triangle", IEEE Transactions on Biomedical Engineering 30(2), 1983.
struct SphericalTriangle {
  Vec3<float> a{0.0F};
  Vec3<float> b{0.0F};
  Vec3<float> c{0.0F};
  float volume = 0;  ///< a · (b × c), positive where the outer side is seen
  float cos_ab = 0;
  float cos_ac = 0;
  float cos_bc = 0;
  float solid_angle = 0;  ///< zero where sampling by area does as well

  SphericalTriangle(const Triangle<float>& triangle, const Vec3<float>& from) noexcept
      : a(triangle.v0 - from), b(triangle.v1 - from), c(triangle.v2 - from) {
    const Vec3<float> e1 = b - a;
    const Vec3<float> e2 = c - a;
    const float size = std::max(length_squared(e1), length_squared(e2));
    if (!(length_squared(a + (e1 + e2) * (1.0F / 3)) < far_squared * size)) return;
    a = glm::normalize(a);
    b = glm::normalize(b);
    c = glm::normalize(c);
    volume = -glm::dot(a, glm::cross(b, c));
    cos_ab = glm::dot(a, b);
    cos_ac = glm::dot(a, c);
    cos_bc = glm::dot(b, c);
    const float angle = 2 * std::atan2(volume, 1 + cos_ab + cos_ac + cos_bc);
    if (angle > smallest && angle < largest) solid_angle = angle;
  }

  /// A direction uniform in the spherical triangle: u.x chooses the triangle a b c' with c' between a and c that has
  /// this share of the solid angle, u.y a point between b and c'.
  [[nodiscard]] Vec3<float> direction(const Vec2<float>& u) const noexcept {
    // The angle α at a: cosine and sine, but for a common factor, of the planes a b and a c.
    const float x = cos_bc - cos_ab * cos_ac;
    const float inv = 1 / std::sqrt(x * x + volume * volume);
    const float cos_alpha = x * inv;
    const float sin_alpha = volume * inv;
    const float part = u.x * solid_angle;
    const float sin_part = std::sin(part);
    const float cos_part = std::cos(part);
    const float s = sin_part * cos_alpha - cos_part * sin_alpha;
    const float t = cos_part * cos_alpha + sin_part * sin_alpha;
    const float k1 = t - cos_alpha;
    const float k2 = s + sin_alpha * cos_ab;
    const float q = ((k2 * t - k1 * s) * cos_alpha - k2) / ((k2 * s + k1 * t) * sin_alpha);
    const Vec3<float> c_part = between(a, c - a * cos_ac, std::clamp(q, -1.0F, 1.0F));
    const float cosine = glm::dot(c_part, b);
    const float height = 1 - u.y * (1 - cosine);
    return between(b, c_part - b * cosine, height);
  }

  /// The direction whose cosine with `axis` is q, in the plane of `side`, perpendicular to it.
  [[nodiscard]] static Vec3<float> between(const Vec3<float>& axis, const Vec3<float>& side, float q) noexcept {
    const float squared = length_squared(side);
    if (!(squared > 0)) return axis;
    return axis * q + side * std::sqrt(std::max(1 - q * q, 0.0F) / squared);
  }

  static constexpr float far_squared = 4;   ///< in squared edges: beyond, the density by area is nearly even
  static constexpr float smallest = 2e-3F;  ///< sr: below, rounding would be seen
  static constexpr float largest = 6.2F;    ///< sr: a viewer on the triangle
};

/// The weights of v1 and v2 where a direction meets the triangle's plane, brought back onto the triangle if rounding
/// has left it.
[[nodiscard]] inline Vec2<float> triangle_weights(const Triangle<float>& triangle, const Vec3<float>& from,
                                                  const Vec3<float>& w) noexcept {
  const Vec3<float> e1 = triangle.v1 - triangle.v0;
  const Vec3<float> e2 = triangle.v2 - triangle.v0;
  const Vec3<float> p = glm::cross(w, e2);
  const float determinant = glm::dot(p, e1);
  if (determinant == 0) return Vec2<float>(1.0F / 3);
  const Vec3<float> to_from = from - triangle.v0;
  const float w1 = std::clamp(glm::dot(to_from, p) / determinant, 0.0F, 1.0F);
  const float w2 = std::clamp(glm::dot(w, glm::cross(to_from, e1)) / determinant, 0.0F, 1.0F);
  const float sum = std::max(w1 + w2, 1.0F);
  return {w1 / sum, w2 / sum};
}

}  // namespace detail

/// A point on a triangle, uniform by solid angle where that is large, else by area.
[[nodiscard]] inline std::optional<SeenSample> sample_seen(const Triangle<float>& triangle, const Vec3<float>& from,
                                                           const Vec2<float>& u) noexcept {
  const detail::SphericalTriangle seen(triangle, from);
  if (!(seen.solid_angle > 0)) return sample_seen_by_area(triangle, from, u);
  const Vec2<float> weights = detail::triangle_weights(triangle, from, seen.direction(u));
  return SeenSample{surface_at(triangle, weights.x, weights.y), 1 / seen.solid_angle};
}

[[nodiscard]] inline float seen_pdf(const Triangle<float>& triangle, const Vec3<float>& from,
                                    const Surface& at) noexcept {
  const detail::SphericalTriangle seen(triangle, from);
  return seen.solid_angle > 0 ? 1 / seen.solid_angle : seen_area_pdf(1 / area(triangle), from, at);
}

}  // namespace glint
