// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/geometry/sphere.hpp>
#include <glint/light/solid_angle.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/warp.hpp>

namespace glint {

namespace detail {

/// The cone that a sphere fills, seen from outside.
struct SphereCone {
  Vec3<float> axis{0.0F};  ///< to the center, not of unit length
  float distance_squared = 0;
  float sin_squared = 1;
  float extent = 0;  ///< 1 − cosine; zero for a viewer inside, who sees no outer side

  SphereCone(const Sphere<float>& sphere, const Vec3<float>& from) noexcept
      : axis(sphere.center - from), distance_squared(length_squared(axis)) {
    sin_squared = sphere.radius * sphere.radius / distance_squared;
    if (sin_squared < 1) extent = one_minus_cos(sin_squared);
  }
};

}  // namespace detail

/// A point on a sphere, uniform by solid angle as seen from outside. The outer side shows nothing to a viewer inside.
///
/// The angle at the center between viewer and point follows from the law of sines, which needs no difference of nearly
/// equal numbers, however small or far the sphere is.
///
/// Source: Pharr, Jakob, Humphreys, Physically Based Rendering (2023), section 6.2.4.
[[nodiscard]] inline std::optional<SeenSample> sample_seen(const Sphere<float>& sphere, const Vec3<float>& from,
                                                           const Vec2<float>& u) noexcept {
  const detail::SphereCone cone(sphere, from);
  if (!(cone.extent > 0)) return std::nullopt;
  const Vec3<float> w = uniform_cone(u, cone.extent);
  const float sine = std::sqrt(cone.sin_squared);
  const float share = std::min((w.x * w.x + w.y * w.y) / cone.sin_squared, 1.0F);  // sin² of the angle, at the rim 1
  const float height = std::sqrt(1 - share);
  const float sideways = w.z / sine - height;
  const Vec3<float> outward{w.x * sideways, w.y * sideways, -(w.z * height + share * sine)};
  const Frame<float> frame = Frame<float>::around(cone.axis / std::sqrt(cone.distance_squared));
  const Vec3<float> normal = frame.to_world(outward);
  return SeenSample{detail::sphere_surface(sphere, normal, detail::sphere_uv(normal)), uniform_cone_pdf(cone.extent)};
}

[[nodiscard]] inline float seen_pdf(const Sphere<float>& sphere, const Vec3<float>& from, const Surface& at) noexcept {
  if (!(glm::dot(from - at.position, at.normal) > 0)) return 0;
  const detail::SphereCone cone(sphere, from);
  return cone.extent > 0 ? uniform_cone_pdf(cone.extent) : 0.0F;
}

}  // namespace glint
