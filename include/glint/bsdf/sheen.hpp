// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/microfacet_albedo.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

namespace glint {

namespace detail {

/// What white fuzz reflects, 1e-4 each: a row for each roughness 0.5, 0.625, … 1; columns are √cos θ in equal steps.
inline constexpr std::array<std::array<int, albedo_steps + 1>, 5> sheen_albedo{
    {{9362, 9159, 8730, 8201, 7620, 7013, 6398, 5786, 5184, 4599,
      4034, 3494, 2980, 2496, 2044, 1624, 1240, 892,  583,  313},
     {8058, 7904, 7580, 7181, 6742, 6283, 5816, 5349, 4887, 4433,
      3989, 3557, 3138, 2733, 2342, 1967, 1608, 1264, 937,  628},
     {7255, 7128, 6862, 6535, 6176, 5801, 5420, 5038, 4660, 4287,
      3920, 3560, 3208, 2863, 2526, 2196, 1872, 1554, 1242, 935},
     {6726, 6615, 6385, 6102, 5792, 5470, 5143, 4815, 4490, 4170,
      3855, 3545, 3240, 2940, 2644, 2352, 2063, 1775, 1487, 1199},
     {6360, 6260, 6053, 5799, 5522, 5234, 4943, 4651, 4363, 4079,
      3799, 3525, 3254, 2988, 2724, 2463, 2203, 1942, 1680, 1414}}};

}  // namespace detail

/// Fuzz: fibers that stand up, as on velvet, felt, peaches and dust, bright where they are seen from aside; on the
/// normal's side, black from behind. As a layer over something else it is a part of `Principled`.
///
/// f = reflectance · D · V, with D ∝ (sin θ of the half vector)^(1/α), α = roughness², V = 1 / (4 (cos θo + cos θi −
/// cos θo cos θi)).
///
/// Units:    roughness from 0.5, a rim of light, to 1, almost even; what is below counts as 0.5: the model would give
///           off more light than it gets.
/// Source:   D: Estevez, Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH course Physically Based Shading
///           in Theory and Practice, 2017; V: Neubelt, Pettineo, "Crafting a Next-Gen Material Pipeline for The Order:
///           1886", in the same course, 2013. Directions are drawn uniformly, as the former advise.
struct Sheen {
  Rgb reflectance{1.0F};
  float roughness = 0.5F;

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return {};
    return value(wo, wi);
  }

  [[nodiscard]] static constexpr float pdf(const Vec3<float>& wo, const Vec3<float>& wi) noexcept {
    return wo.z > 0.0F && wi.z > 0.0F ? uniform_hemisphere_pdf<float>() : 0.0F;
  }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float /*u*/,
                                                 const Vec2<float>& uv) const noexcept {
    if (!(wo.z > 0.0F)) return std::nullopt;
    const Vec3<float> wi = uniform_hemisphere(uv);
    if (!(wi.z > 0.0F)) return std::nullopt;
    constexpr float pdf = uniform_hemisphere_pdf<float>();
    return BsdfSample{wi, value(wo, wi) / pdf, pdf, Lobe::Diffuse};
  }

  /// What white fuzz of this roughness reflects of the light from a direction, within 0.005.
  ///
  /// Requires: 0 ≤ cos ≤ 1.
  [[nodiscard]] float albedo(float cos) const noexcept {
    const float row = 8.0F * (clamped() - 0.5F);
    const std::size_t index = std::min(static_cast<std::size_t>(row), detail::sheen_albedo.size() - 2);
    const detail::AlbedoPlace place{cos};
    const auto in = [&](std::size_t i) {
      const auto& values = detail::sheen_albedo[i];
      const auto left = static_cast<float>(values[place.index]);
      return left + place.share * (static_cast<float>(values[place.index + 1]) - left);
    };
    const float below = in(index);
    return 1e-4F * (below + (row - static_cast<float>(index)) * (in(index + 1) - below));
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return false; }

  [[nodiscard]] friend constexpr bool operator==(const Sheen&, const Sheen&) noexcept = default;

 private:
  [[nodiscard]] float clamped() const noexcept { return std::clamp(roughness, 0.5F, 1.0F); }

  [[nodiscard]] Rgb value(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    const Vec3<float> m = glm::normalize(wo + wi);
    const float exponent = 1.0F / (clamped() * clamped());
    const float fibers = (2.0F + exponent) * std::pow(m.x * m.x + m.y * m.y, 0.5F * exponent);
    return reflectance * (0.125F * inv_pi<float> * fibers * wi.z / (wo.z + wi.z - wo.z * wi.z));
  }
};

static_assert(Bsdf<Sheen>);

}  // namespace glint
