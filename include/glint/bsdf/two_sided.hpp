// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A BSDF whose front is seen from both sides: from behind, everything is mirrored at the surface.
template <Bsdf B>
struct TwoSided {
  B front{};

  [[nodiscard]] constexpr Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return wo.z < 0.0F ? front.evaluate(mirrored(wo), mirrored(wi)) : front.evaluate(wo, wi);
  }

  [[nodiscard]] constexpr float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return wo.z < 0.0F ? front.pdf(mirrored(wo), mirrored(wi)) : front.pdf(wo, wi);
  }

  [[nodiscard]] constexpr std::optional<BsdfSample> sample(const Vec3<float>& wo, float u,
                                                           const Vec2<float>& uv) const {
    if (!(wo.z < 0.0F)) return front.sample(wo, u, uv);
    auto result = front.sample(mirrored(wo), u, uv);
    if (result) result->wi.z = -result->wi.z;
    return result;
  }

  [[nodiscard]] constexpr bool is_specular() const { return front.is_specular(); }

  [[nodiscard]] friend constexpr bool operator==(const TwoSided&, const TwoSided&) = default;

 private:
  [[nodiscard]] static constexpr Vec3<float> mirrored(const Vec3<float>& w) noexcept { return {w.x, w.y, -w.z}; }
};

template <Bsdf B>
TwoSided(B) -> TwoSided<B>;

}  // namespace glint
