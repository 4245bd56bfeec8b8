// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/geometry/quad.hpp>
#include <glint/light/solid_angle.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

namespace detail {

/// A rectangle in coordinates along its edges, seen from the origin; z < 0 is its distance from the viewer's plane.
///
/// Source: Ureña, Fajardo, King, "An Area-Preserving Parametrization for Spherical Rectangles", EGSR 2013.
struct SphericalRectangle {
  Vec2<float> lower{0.0F};
  Vec2<float> upper{0.0F};
  float z = 0;
  float solid_angle = 0;  ///< zero where sampling by area does as well
  float b0 = 0;           ///< cosines that the two edges along u make with the viewing direction across them
  float b1 = 0;
  float g23 = 0;  ///< the two angles of the spherical rectangle at u = 0

  SphericalRectangle(const Quad<float>& quad, const Vec3<float>& from) noexcept {
    const float u_squared = length_squared(quad.edge_u);
    const float v_squared = length_squared(quad.edge_v);
    const Vec3<float> to_origin = quad.origin - from;
    const Vec3<float> to_center = to_origin + (quad.edge_u + quad.edge_v) * 0.5F;
    if (!(length_squared(to_center) < far_squared * (u_squared + v_squared))) return;
    const float skew = glm::dot(quad.edge_u, quad.edge_v);
    const float u_length = std::sqrt(u_squared);
    const float v_length = std::sqrt(v_squared);
    if (!(std::abs(skew) <= rounding_bound<float>(8) * u_length * v_length)) return;  // not a rectangle
    const Vec3<float> x = quad.edge_u / u_length;
    const Vec3<float> y = quad.edge_v / v_length;
    lower = {glm::dot(to_origin, x), glm::dot(to_origin, y)};
    upper = {lower.x + u_length, lower.y + v_length};
    z = glm::dot(to_origin, glm::cross(x, y));
    if (z < 0) measure();
  }

  /// The solid angle is what the four angles have in excess of a full turn. An angle whose cosine is −b·n, b² = 1 − p,
  /// n² = 1 − q, has the sine √(p + q − p q): exact near 0 and π, where the arc cosine is not.
  void measure() noexcept {
    const float z_squared = z * z;
    const Vec2<float> p_upper = z_squared / (z_squared + upper * upper);
    const Vec2<float> p_lower = z_squared / (z_squared + lower * lower);
    const float inv_z = 1 / z;  // negative: the roots below are those of the squares, with the sign of the coordinate
    b0 = lower.y * inv_z * std::sqrt(p_lower.y);
    const float n1 = -upper.x * inv_z * std::sqrt(p_upper.x);
    b1 = -upper.y * inv_z * std::sqrt(p_upper.y);
    const float n3 = lower.x * inv_z * std::sqrt(p_lower.x);
    const auto angle = [](float cosine, float p, float q) { return std::atan2(std::sqrt(p + q - p * q), cosine); };
    const float g0 = angle(-b0 * n1, p_lower.y, p_upper.x);
    const float g1 = angle(-n1 * b1, p_upper.x, p_upper.y);
    g23 = angle(-b1 * n3, p_upper.y, p_lower.x) + angle(-n3 * b0, p_lower.x, p_lower.y);
    const float excess = (g0 + g1) + (g23 - 2 * pi<float>);
    if (excess > smallest) solid_angle = excess;
  }

  /// The point of the rectangle for a point of the unit square, in edge lengths.
  [[nodiscard]] Vec2<float> point(const Vec2<float>& u) const noexcept {
    const float phi = u.x * solid_angle - g23;  // less 2π
    const float fu = (std::cos(phi) * b0 - b1) / std::sin(phi);
    const float cu = std::copysign(1 / std::sqrt(fu * fu + b0 * b0), fu);
    const float x = std::clamp(-cu * z / std::sqrt(std::max(1 - cu * cu, 1e-12F)), lower.x, upper.x);
    const float d = std::sqrt(x * x + z * z);
    const float h0 = lower.y / std::sqrt(d * d + lower.y * lower.y);
    const float h1 = upper.y / std::sqrt(d * d + upper.y * upper.y);
    const float h = h0 + u.y * (h1 - h0);
    const float y = std::clamp(h * d / std::sqrt(std::max(1 - h * h, 1e-12F)), lower.y, upper.y);
    return (Vec2<float>{x, y} - lower) / (upper - lower);
  }

  static constexpr float far_squared = 4;   ///< in squared diagonals: beyond, the density by area is nearly even
  static constexpr float smallest = 2e-3F;  ///< sr: below, rounding in the difference of angles would be seen
};

}  // namespace detail

/// A point on a rectangle, uniform by solid angle where that is large; else, and on parallelograms with other angles,
/// uniform by area.
[[nodiscard]] inline std::optional<SeenSample> sample_seen(const Quad<float>& quad, const Vec3<float>& from,
                                                           const Vec2<float>& u) noexcept {
  const detail::SphericalRectangle rectangle(quad, from);
  if (!(rectangle.solid_angle > 0)) return sample_seen_by_area(quad, from, u);
  return SeenSample{detail::quad_surface(quad, rectangle.point(u)), 1 / rectangle.solid_angle};
}

[[nodiscard]] inline float seen_pdf(const Quad<float>& quad, const Vec3<float>& from, const Surface& at) noexcept {
  const detail::SphericalRectangle rectangle(quad, from);
  return rectangle.solid_angle > 0 ? 1 / rectangle.solid_angle : seen_area_pdf(1 / area(quad), from, at);
}

}  // namespace glint
