// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/bsdf/coated_diffuse.hpp>
#include <glint/bsdf/compensated.hpp>
#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/conductor.hpp>
#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/oren_nayar.hpp>
#include <glint/bsdf/perfect_refraction.hpp>
#include <glint/bsdf/rough_coated_diffuse.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/bsdf/rough_dielectric.hpp>
#include <glint/bsdf/thin_dielectric.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/material/blended.hpp>
#include <glint/material/bump_map.hpp>
#include <glint/material/concepts.hpp>
#include <glint/material/normal_map.hpp>
#include <glint/material/textured.hpp>
#include <glint/material/textured_principled.hpp>
#include <glint/material/two_sided.hpp>
#include <glint/texture/any_texture.hpp>
#include <glint/texture/checkerboard.hpp>
#include <glint/texture/concepts.hpp>
#include <glint/texture/constant.hpp>
#include <glint/texture/filtered_image_texture.hpp>
#include <glint/texture/image_texture.hpp>

/// What the textures and materials of a scene file can be.
namespace glint {

using SceneTexture = OneOf<ConstantTexture, Checkerboard, ImageTexture, FilteredImageTexture, AnyTexture>;
using SceneDiffuse = Textured<Lambertian, SceneTexture>;
using SceneRoughDiffuse = Textured<OrenNayar, SceneTexture>;
using ScenePlastic = Textured<CoatedDiffuse, SceneTexture>;
template <MicrofacetDistribution D>
using SceneRoughPlastic = Textured<RoughCoatedDiffuse<D>, SceneTexture>;
using SceneConductor = Textured<Conductor, SceneTexture>;
template <MicrofacetDistribution D>
using SceneRoughConductor = Textured<RoughConductor<D>, SceneTexture>;
template <MicrofacetDistribution D>
using SceneCompensatedConductor = Textured<Compensated<RoughConductor<D>>, SceneTexture>;
using ScenePrincipled = TexturedPrincipled<SceneTexture>;

/// Materials by themselves.
using ScenePlainMaterial =
    OneOf<SceneDiffuse, PerfectRefraction, Dielectric, Mirror, SceneRoughConductor<Beckmann>, SceneRoughConductor<Ggx>,
          SceneCompensatedConductor<Beckmann>, SceneCompensatedConductor<Ggx>, SceneConductor, ScenePlastic,
          SceneRoughPlastic<Beckmann>, SceneRoughPlastic<Ggx>, SceneRoughDiffuse, ThinDielectric,
          RoughDielectric<Beckmann>, RoughDielectric<Ggx>, ScenePrincipled>;

/// A plain BSDF, the same from both sides where it is told to be; `TwoSided` with the choice left to run time, so that
/// what is made of such layers exists once.
class SceneLayerBsdf {
 public:
  using Plain = BsdfOf<ScenePlainMaterial>;

  SceneLayerBsdf() = default;
  SceneLayerBsdf(const Plain& plain, bool two_sided) noexcept : plain_(plain), two_sided_(two_sided) {}

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const {
    const float side = side_of(wo);
    return plain_.evaluate(turned(wo, side), turned(wi, side));
  }
  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const {
    const float side = side_of(wo);
    return plain_.pdf(turned(wo, side), turned(wi, side));
  }
  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const {
    const float side = side_of(wo);
    auto result = plain_.sample(turned(wo, side), u, uv);
    if (result) result->wi.z *= side;
    return result;
  }
  [[nodiscard]] bool is_specular() const { return plain_.is_specular(); }

  [[nodiscard]] friend bool operator==(const SceneLayerBsdf&, const SceneLayerBsdf&) = default;

 private:
  [[nodiscard]] float side_of(const Vec3<float>& wo) const noexcept { return two_sided_ && wo.z < 0.0F ? -1.0F : 1.0F; }
  [[nodiscard]] static Vec3<float> turned(const Vec3<float>& w, float side) noexcept { return {w.x, w.y, side * w.z}; }

  Plain plain_{};
  bool two_sided_ = false;
};

static_assert(Bsdf<SceneLayerBsdf>);

/// A plain material as a part of others.
struct SceneLayer {
  static constexpr bool asks_for_footprints = glint::asks_for_footprints<ScenePlainMaterial>;

  ScenePlainMaterial material{};
  bool two_sided = false;

  [[nodiscard]] SceneLayerBsdf bsdf(const Surface& at) const { return {bsdf_at(material, at, 0), two_sided}; }

  [[nodiscard]] friend bool operator==(const SceneLayer&, const SceneLayer&) = default;
};

using SceneNormalMapped = NormalMapped<SceneLayer, SceneTexture>;
using SceneBumpMapped = BumpMapped<SceneLayer, SceneTexture>;
using SceneBlend = Blended<SceneLayer, SceneLayer, SceneTexture>;

/// The most common ones first: which it is, is asked in this order.
using SceneMaterial =
    OneOf<SceneDiffuse, TwoSidedMaterial<SceneDiffuse>, PerfectRefraction, Dielectric, Mirror,
          SceneRoughConductor<Beckmann>, SceneRoughConductor<Ggx>, SceneCompensatedConductor<Beckmann>,
          SceneCompensatedConductor<Ggx>, SceneConductor, ScenePlastic, SceneRoughPlastic<Beckmann>,
          SceneRoughPlastic<Ggx>, SceneRoughDiffuse, TwoSidedMaterial<SceneRoughDiffuse>, ThinDielectric,
          RoughDielectric<Beckmann>, RoughDielectric<Ggx>, ScenePrincipled, SceneLayer, SceneNormalMapped,
          SceneBumpMapped, SceneBlend>;

}  // namespace glint
