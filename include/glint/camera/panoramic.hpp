// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/camera/concepts.hpp>
#include <glint/camera/importance.hpp>
#include <glint/camera/view_frame.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/spherical.hpp>

namespace glint {

/// Rays from one point in all directions.
struct PanoramicRays {
  Vec3<float> eye{0.0F};
  Frame<float> view{};

  [[nodiscard]] Ray<float> ray(const Vec2<float>& film, const Vec2<float>& /*lens*/) const noexcept {
    const Vec2<float> uv{film.x + 0.5F, 1 - film.y};  // u = 0 looks forward: that belongs in the middle
    return {.origin = eye, .direction = view.to_world(equirectangular_to_direction(uv))};
  }

  [[nodiscard]] std::optional<CameraSample> sample_toward(const Vec3<float>& point,
                                                          const Vec2<float>& /*lens*/) const noexcept {
    const Vec3<float> to_point = point - eye;
    const float distance = glm::length(to_point);
    if (!(distance > 0)) return std::nullopt;
    const Vec3<float> direction = to_point / distance;
    const Vec2<float> uv = direction_to_equirectangular(view.to_local(direction));
    const Vec2<float> film{uv.x < 0.5F ? uv.x + 0.5F : uv.x - 0.5F, 1 - uv.y};
    const float density = importance({.origin = eye, .direction = direction}, distance);
    if (!is_on_film(film) || !(density > 0)) return std::nullopt;
    return CameraSample{film, -direction, eye, density};
  }
  /// From the unit square to the sphere, dω = 2π² sin θ du dv. Zero at the poles, which no ray finds.
  [[nodiscard]] float importance(const Ray<float>& ray, float distance) const noexcept {
    const float up = glm::dot(ray.direction, view.y);
    const float squared_sine = 1 - up * up;
    if (!(squared_sine > 0)) return 0;
    return 1 / (2 * pi<float> * pi<float> * std::sqrt(squared_sine) * distance * distance);
  }
};

/// All directions around the eye as one equirectangular image, best twice as wide as high: the target in the middle, up
/// at the top, what lies to the right to the right.
///
/// Errors: eye = target and an up along the view have defined results, see view_frame.
struct Panoramic {
  Vec3<float> eye{0.0F, 0.0F, 1.0F};
  Vec3<float> target{0.0F, 0.0F, 0.0F};
  Vec3<float> up{0.0F, 1.0F, 0.0F};

  [[nodiscard]] PanoramicRays rays(float /*aspect*/) const noexcept {
    const Frame<double> view = view_frame(eye, target, up);
    return {.eye = eye, .view = {Vec3<float>(view.x), Vec3<float>(view.y), Vec3<float>(view.z)}};
  }

  [[nodiscard]] friend bool operator==(const Panoramic&, const Panoramic&) noexcept = default;
};

static_assert(Camera<Panoramic> && ImportanceGenerator<PanoramicRays>);

}  // namespace glint
