// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glm/geometric.hpp>

#include <glint/camera/concepts.hpp>
#include <glint/camera/importance.hpp>
#include <glint/camera/view_frame.hpp>

namespace glint {

/// Parallel rays from a window.
struct OrthographicRays {
  Vec3<float> corner{-0.5F, -0.5F, 0.0F};  ///< the window's lower left corner
  Vec3<float> across{1.0F, 0.0F, 0.0F};    ///< its lower edge
  Vec3<float> upward{0.0F, 1.0F, 0.0F};    ///< its left edge
  Vec3<float> direction{0.0F, 0.0F, -1.0F};

  [[nodiscard]] Ray<float> ray(const Vec2<float>& film, const Vec2<float>& /*lens*/) const noexcept {
    return {.origin = corner + film.x * across + film.y * upward, .direction = direction};
  }

  /// One ray alone finds the point, whose density over the window is one over its area.
  [[nodiscard]] std::optional<CameraSample> sample_toward(const Vec3<float>& point,
                                                          const Vec2<float>& /*lens*/) const noexcept {
    const Vec3<float> at = point - corner;
    const float depth = glm::dot(at, direction);
    const Vec2<float> film{glm::dot(at, across) / length_squared(across),
                           glm::dot(at, upward) / length_squared(upward)};
    if (!(depth > 0) || !is_on_film(film)) return std::nullopt;
    return CameraSample{film, -direction, point - direction * depth, inverse_area()};
  }
  [[nodiscard]] float importance(const Ray<float>& /*ray*/, float /*distance*/) const noexcept {
    return inverse_area();
  }

 private:
  [[nodiscard]] float inverse_area() const noexcept { return 1 / glm::length(glm::cross(across, upward)); }
};

/// A camera without perspective. Its rays start in the plane through the eye: what lies behind it is not seen.
///
/// Units:    scene units; `height` is that of the view, its width is aspect · height.
/// Requires: height > 0.
/// Errors:   eye = target and an up along the view have defined results, see view_frame.
struct Orthographic {
  Vec3<float> eye{0.0F, 0.0F, 1.0F};
  Vec3<float> target{0.0F, 0.0F, 0.0F};
  Vec3<float> up{0.0F, 1.0F, 0.0F};
  float height = 1;

  /// Requires: aspect > 0.
  [[nodiscard]] OrthographicRays rays(float aspect) const noexcept {
    const Frame<double> view = view_frame(eye, target, up);
    const Vec3<double> across = view.x * (static_cast<double>(height) * static_cast<double>(aspect));
    const Vec3<double> upward = view.y * static_cast<double>(height);
    return {.corner = Vec3<float>(Vec3<double>(eye) - 0.5 * (across + upward)),
            .across = Vec3<float>(across),
            .upward = Vec3<float>(upward),
            .direction = Vec3<float>(-view.z)};
  }

  [[nodiscard]] friend bool operator==(const Orthographic&, const Orthographic&) noexcept = default;
};

static_assert(Camera<Orthographic> && ImportanceGenerator<OrthographicRays>);

}  // namespace glint
