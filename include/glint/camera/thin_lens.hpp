// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/camera/concepts.hpp>
#include <glint/camera/importance.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/warp.hpp>

namespace glint {

/// Rays from a disk through a window in the plane of focus.
struct ThinLensRays {
  PerspectiveRays focus{};               ///< its window lies in the plane of focus
  Vec3<float> lens_x{1.0F, 0.0F, 0.0F};  ///< the lens's radius to the right
  Vec3<float> lens_y{0.0F, 1.0F, 0.0F};  ///< and to the top

  /// The point of the lens is uniform by area for a uniform `lens`.
  [[nodiscard]] Ray<float> ray(const Vec2<float>& film, const Vec2<float>& lens) const noexcept {
    const Vec2<float> at = concentric_disk(lens);
    const Vec3<float> shift = at.x * lens_x + at.y * lens_y;
    const Vec3<float> target = focus.corner + film.x * focus.across + film.y * focus.upward;
    return {.origin = focus.eye + shift, .direction = normalized(target - shift)};
  }

  [[nodiscard]] std::optional<CameraSample> sample_toward(const Vec3<float>& point,
                                                          const Vec2<float>& lens) const noexcept {
    const Vec2<float> at = concentric_disk(lens);
    const Vec3<float> shift = at.x * lens_x + at.y * lens_y;
    return seen_through({focus.corner - shift, focus.across, focus.upward}, focus.eye + shift, point);
  }
  /// Of all parts of the lens the window is equally far away.
  [[nodiscard]] float importance(const Ray<float>& ray, float distance) const noexcept {
    return focus.importance(ray, distance);
  }
};

/// A camera with depth of field: an ideal lens, sharp at one distance, measured along the view. As lens_radius → 0 it
/// becomes Perspective.
///
/// Units:    scene units; the field of view is the full vertical angle.
/// Requires: 0 < fov_y_radians < π, lens_radius ≥ 0, focus_distance > 0.
/// Errors:   as Perspective.
/// Source:   Cook, Porter, Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984, section 4.
struct ThinLens {
  Vec3<float> eye{0.0F, 0.0F, 1.0F};
  Vec3<float> target{0.0F, 0.0F, 0.0F};
  Vec3<float> up{0.0F, 1.0F, 0.0F};
  float fov_y_radians = radians(45.0F);
  float lens_radius = 0;
  float focus_distance = 1;

  /// Requires: aspect > 0.
  [[nodiscard]] ThinLensRays rays(float aspect) const noexcept {
    const Frame<double> view = view_frame(eye, target, up);
    PerspectiveRays focus =
        Perspective{.eye = eye, .target = target, .up = up, .fov_y_radians = fov_y_radians}.rays(aspect);
    focus.corner *= focus_distance;
    focus.across *= focus_distance;
    focus.upward *= focus_distance;
    return {.focus = focus, .lens_x = Vec3<float>(view.x) * lens_radius, .lens_y = Vec3<float>(view.y) * lens_radius};
  }

  [[nodiscard]] friend bool operator==(const ThinLens&, const ThinLens&) noexcept = default;
};

static_assert(Camera<ThinLens> && ImportanceGenerator<ThinLensRays>);

}  // namespace glint
