// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

namespace glint {

/// Ideal diffuse reflection, f = reflectance / π, on the normal's side; black from behind.
struct Lambertian {
  Rgb reflectance{0.5F};

  [[nodiscard]] constexpr Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    return reflectance * pdf(wo, wi);
  }

  [[nodiscard]] constexpr float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    return wo.z > 0.0F ? cosine_hemisphere_pdf(wi.z) : 0.0F;
  }

  /// The cosine and π cancel: the weight is the reflectance.
  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float /*u*/,
                                                 const Vec2<float>& uv) const noexcept {
    std::optional<BsdfSample> result;
    if (!(wo.z > 0.0F)) return result;
    const Vec3<float> wi = cosine_hemisphere(uv);
    if (!(wi.z > 0.0F)) return result;
    BsdfSample& sample = result.emplace();  // filled in place: copies of what was just written stall the processor
    sample.wi = wi;
    sample.weight = reflectance;
    sample.pdf = wi.z * inv_pi<float>;
    return result;
  }

  [[nodiscard]] constexpr Rgb albedo(const Vec3<float>& wo) const noexcept { return wo.z > 0.0F ? reflectance : Rgb{}; }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return false; }

  [[nodiscard]] friend constexpr bool operator==(const Lambertian&, const Lambertian&) noexcept = default;
};

static_assert(Bsdf<Lambertian>);

}  // namespace glint
