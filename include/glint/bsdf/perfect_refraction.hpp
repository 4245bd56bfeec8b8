// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/fresnel.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A smooth interface that lets all light through, bent by Snell's law; a mirror under total internal reflection.
///
/// There is no Fresnel term, and transmitted radiance is NOT scaled by the squared index ratio: the weight is exactly
/// one, so what is seen through a closed body is neither brighter nor darker. Dielectric is the physical interface.
///
/// Shapes:   eta = index inside / index outside; z points outside.
/// Requires: eta > 0.
struct PerfectRefraction {
  float eta = 1.5F;

  [[nodiscard]] static constexpr Rgb evaluate(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept {
    return {};
  }

  [[nodiscard]] static constexpr float pdf(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept { return 0; }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float /*u*/,
                                                 const Vec2<float>& /*uv*/) const noexcept {
    const bool outside = wo.z > 0.0F;
    const float ratio = outside ? 1.0F / eta : eta;
    const auto cos_i = refracted_cos(wo.x * wo.x + wo.y * wo.y, ratio);
    const Vec3<float> wi =
        cos_i ? Vec3<float>{-ratio * wo.x, -ratio * wo.y, outside ? -*cos_i : *cos_i} : Vec3<float>{-wo.x, -wo.y, wo.z};
    return BsdfSample{wi, Rgb{1.0F}, 1.0F, Lobe::Specular, cos_i ? ratio * ratio : 1.0F};
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return true; }

  [[nodiscard]] friend constexpr bool operator==(const PerfectRefraction&, const PerfectRefraction&) noexcept = default;
};

static_assert(Bsdf<PerfectRefraction>);

}  // namespace glint
