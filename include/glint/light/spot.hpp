// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/light/concepts.hpp>
#include <glint/light/emission.hpp>
#include <glint/light/light_bounds.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/warp.hpp>

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

  /// A cone whose soft rim is wider than a right angle counts as looking everywhere.
  [[nodiscard]] LightBounds light_bounds() const noexcept {
    const float rim = std::cos(cone_angle_radians - falloff_start_radians);
    return {.box = {position, position},
            .axis = glm::normalize(direction),
            .cos_theta_o = rim > 0 ? std::cos(falloff_start_radians) : -1.0F,
            .cos_theta_e = std::max(0.0F, rim),
            .intensity = luminance(intensity)};
  }

  /// Uniform in the cone.
  [[nodiscard]] std::optional<EmittedRay> emit(const Vec2<float>& /*u_position*/, const Vec2<float>& u_direction,
                                               const Aabb<float>& /*scene*/) const noexcept {
    const Vec3<float> local = uniform_cone(u_direction, cone_extent());
    const float share = falloff(local.z);
    if (!(share > 0)) return std::nullopt;
    const Vec3<float> out = Frame<float>::around(glm::normalize(direction)).to_world(local);
    return EmittedRay{.ray = {.origin = position, .direction = out},
                      .radiance = intensity * share,
                      .normal = out,
                      .pdf = {1, uniform_cone_pdf(cone_extent())},
                      .is_delta_position = true};
  }
  [[nodiscard]] EmissionPdf emission_pdf(const Surface& /*at*/, const Vec3<float>& out,
                                         const Aabb<float>& /*scene*/) const noexcept {
    const bool inside = falloff(glm::dot(out, glm::normalize(direction))) > 0;
    return {1, inside ? uniform_cone_pdf(cone_extent()) : 0.0F};
  }

  [[nodiscard]] friend bool operator==(const SpotLight&, const SpotLight&) noexcept = default;

 private:
  /// 1 − cos of the cone's angle.
  [[nodiscard]] float cone_extent() const noexcept {
    const float sine = std::sin(0.5F * cone_angle_radians);
    return 2 * sine * sine;
  }

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

static_assert(BoundedLight<SpotLight> && EmittingLight<SpotLight>);

}  // namespace glint
