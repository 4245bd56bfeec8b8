// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A smooth mirror of constant reflectance, on the normal's side; black from behind.
struct Mirror {
  Rgb reflectance{1.0F};

  [[nodiscard]] static constexpr Rgb evaluate(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept {
    return {};
  }

  [[nodiscard]] static constexpr float pdf(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept { return 0; }

  [[nodiscard]] constexpr std::optional<BsdfSample> sample(const Vec3<float>& wo, float /*u*/,
                                                           const Vec2<float>& /*uv*/) const noexcept {
    if (!(wo.z > 0.0F)) return std::nullopt;
    return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance, 1.0F, Lobe::Specular};
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return true; }

  [[nodiscard]] friend constexpr bool operator==(const Mirror&, const Mirror&) noexcept = default;
};

static_assert(Bsdf<Mirror>);

}  // namespace glint
