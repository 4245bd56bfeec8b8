// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/light/concepts.hpp>
#include <glint/math/constants.hpp>

namespace glint {

/// A point that shines into a cone: full intensity up to `falloff_start_radians` from the axis, then a smooth fall to
/// nothing at `cone_angle_radians`.
///
/// Units:    intensity on the axis, in watts a steradian; angles from the axis.
/// Requires: |direction| > 0, 0 ≤ falloff_start_radians ≤ cone_angle_radians ≤ π.
struct SpotLight {
  static constexpr bool is_delta = true;

  Vec3<float> position{0.0F};
  Vec3<float> direction{0.0F, 0.0F, -1.0F};
  Rgb intensity{1};
  float cone_angle_radians = radians(30.0F);
  float falloff_start_radians = radians(25.0F);

  [[nodiscard]] std::optional<LightSample> sample(const Vec3<float>& from, const Vec2<float>& /*u*/) const noexcept {
    const Vec3<float> to_light = position - from;
    const float squared = length_squared(to_light);
    if (!(squared > 0)) return std::nullopt;
    const float distance = std::sqrt(squared);
    const Vec3<float> wi = to_light / distance;
    const float share = falloff(-glm::dot(wi, glm::normalize(direction)));
    if (!(share > 0)) return std::nullopt;
    return LightSample{wi, distance, intensity * (share / squared), 1, true, position};
  }

  /// The exact flux: the integral of the fall-off over the cone is that of a cone midway between the two angles, as
  /// the smooth step is symmetric in the cosine.
  [[nodiscard]] Rgb power(const Aabb<float>& /*scene*/) const noexcept {
    const float middle = 0.5F * (std::cos(falloff_start_radians) + std::cos(cone_angle_radians));
    return intensity * (2 * pi<float> * (1 - middle));
  }

  [[nodiscard]] friend bool operator==(const SpotLight&, const SpotLight&) noexcept = default;

 private:
  /// A smooth step over the cosine of the angle from the axis.
  [[nodiscard]] float falloff(float cosine) const noexcept {
    const float outer = std::cos(cone_angle_radians);
    const float inner = std::cos(falloff_start_radians);
    if (cosine >= inner) return 1;
    if (cosine <= outer) return 0;
    const float x = (cosine - outer) / (inner - outer);
    return x * x * (3 - 2 * x);
  }
};

static_assert(Light<SpotLight>);

}  // namespace glint
