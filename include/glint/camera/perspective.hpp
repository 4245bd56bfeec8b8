// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/camera/concepts.hpp>
#include <glint/camera/importance.hpp>
#include <glint/camera/view_frame.hpp>
#include <glint/math/constants.hpp>

namespace glint {

/// Rays from one point through a window at distance 1: a few multiply-adds and one normalization each.
struct PerspectiveRays {
  Vec3<float> eye{0.0F};
  Vec3<float> corner{-1.0F, -1.0F, -1.0F};  ///< from the eye to the window's lower left corner
  Vec3<float> across{2.0F, 0.0F, 0.0F};     ///< the window's lower edge
  Vec3<float> upward{0.0F, 2.0F, 0.0F};     ///< its left edge

  [[nodiscard]] Ray<float> ray(const Vec2<float>& film, const Vec2<float>& /*lens*/) const noexcept {
    return {.origin = eye, .direction = normalized(corner + film.x * across + film.y * upward)};
  }

  [[nodiscard]] std::optional<CameraSample> sample_toward(const Vec3<float>& point,
                                                          const Vec2<float>& /*lens*/) const noexcept {
    return seen_through(Window{corner, across, upward}, eye, point);
  }
  [[nodiscard]] float importance(const Ray<float>& ray, float distance) const noexcept {
    return Window{corner, across, upward}.importance(ray.direction, distance);
  }
};

/// A pinhole camera.
///
/// Units:    scene units; the field of view is the full vertical angle.
/// Requires: 0 < fov_y_radians < π.
/// Errors:   eye = target and an up along the view have defined results, see view_frame.
struct Perspective {
  Vec3<float> eye{0.0F, 0.0F, 1.0F};
  Vec3<float> target{0.0F, 0.0F, 0.0F};
  Vec3<float> up{0.0F, 1.0F, 0.0F};  ///< any length; need not be perpendicular to the view
  float fov_y_radians = radians(45.0F);

  /// Requires: aspect > 0.
  [[nodiscard]] PerspectiveRays rays(float aspect) const noexcept {
    const Frame<double> view = view_frame(eye, target, up);
    const double half_height = std::tan(0.5 * static_cast<double>(fov_y_radians));
    const Vec3<double> half_across = view.x * (half_height * static_cast<double>(aspect));
    const Vec3<double> half_upward = view.y * half_height;
    return {.eye = eye,
            .corner = Vec3<float>(-view.z - half_across - half_upward),
            .across = Vec3<float>(2.0 * half_across),
            .upward = Vec3<float>(2.0 * half_upward)};
  }

  [[nodiscard]] friend bool operator==(const Perspective&, const Perspective&) noexcept = default;
};

static_assert(Camera<Perspective> && ImportanceGenerator<PerspectiveRays>);

}  // namespace glint
