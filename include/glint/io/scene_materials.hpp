// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <glint/bsdf/metals.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_settings.hpp>

/// The part "materials" of a scene file.
namespace glint::detail {

enum class MaterialKind : std::uint8_t {
  Diffuse,
  Plastic,
  Refraction,
  Glass,
  ThinGlass,
  RoughGlass,
  Mirror,
  Conductor,
  RoughConductor
};

inline constexpr std::array<std::pair<std::string_view, MaterialKind>, 9> material_kinds{
    {{"diffuse", MaterialKind::Diffuse},
     {"plastic", MaterialKind::Plastic},
     {"refraction", MaterialKind::Refraction},
     {"glass", MaterialKind::Glass},
     {"thinglass", MaterialKind::ThinGlass},
     {"roughglass", MaterialKind::RoughGlass},
     {"mirror", MaterialKind::Mirror},
     {"conductor", MaterialKind::Conductor},
     {"roughconductor", MaterialKind::RoughConductor}}};

inline constexpr std::array<std::pair<std::string_view, Metal>, 8> known_metals{{{"aluminum", metals::aluminum},
                                                                                 {"chromium", metals::chromium},
                                                                                 {"copper", metals::copper},
                                                                                 {"gold", metals::gold},
                                                                                 {"iron", metals::iron},
                                                                                 {"silver", metals::silver},
                                                                                 {"titanium", metals::titanium},
                                                                                 {"tungsten", metals::tungsten}}};

/// The texture a material names, or in the legacy spelling the color it holds under `legacy_key`.
[[nodiscard]] inline SceneTexture material_texture(JsonObject& material, const std::string& legacy_key,
                                                   const SceneDraft& draft) {
  const auto legacy = material.find(legacy_key);
  const auto name = material.find("texture_name");
  if (!name && legacy) {
    material.source().warn(legacy->pointer(), "legacy spelling, better: a constant texture named in \"texture_name\"");
    return ConstantTexture{legacy->color()};
  }
  if (legacy) material.source().warn(legacy->pointer(), "has no effect beside \"texture_name\"");
  return named(draft.textures, material.require("texture_name"), "texture");
}

/// The texture a material names, or white.
[[nodiscard]] inline SceneTexture texture_or_white(JsonObject& material, const SceneDraft& draft) {
  const auto name = material.find("texture_name");
  return name ? named(draft.textures, *name, "texture") : SceneTexture(ConstantTexture{Rgb(1)});
}

[[nodiscard]] inline SceneMaterial read_diffuse(JsonObject& object, const SceneDraft& draft) {
  const SceneTexture texture = material_texture(object, "color", draft);
  const float roughness = object.read_or("roughness", 0.0F, [](const JsonValue& v) {
    return v.number_where([](float number) { return number >= 0 && number <= 1; }, "a number from 0 to 1");
  });
  const bool two_sided = object.flag_or("twosided", false);
  if (roughness > 0) {
    const SceneRoughDiffuse rough{.texture = texture, .base = {.roughness = roughness}};
    return two_sided ? SceneMaterial(TwoSidedMaterial<SceneRoughDiffuse>{rough}) : rough;
  }
  const SceneDiffuse diffuse{.texture = texture};
  return two_sided ? SceneMaterial(TwoSidedMaterial<SceneDiffuse>{diffuse}) : diffuse;
}

[[nodiscard]] inline SceneMaterial read_plastic(JsonObject& object, const SceneDraft& draft) {
  ScenePlastic plastic{.texture = material_texture(object, "color", draft)};
  plastic.base.eta = object.read_or("eta", 1.5F, [](const JsonValue& v) {
    return v.number_where([](float number) { return number >= 1.03F && number <= 3; }, "a number from 1.03 to 3");
  });
  return plastic;
}

/// Reads how facets are spread, and makes a material of them: `make(distribution)`.
template <typename Make>
[[nodiscard]] SceneMaterial with_facets(JsonObject& object, const Make& make) {
  enum class Kind : std::uint8_t { Beckmann, Ggx };
  static constexpr std::array<std::pair<std::string_view, Kind>, 2> kinds{
      {{"beckmann", Kind::Beckmann}, {"ggx", Kind::Ggx}}};
  const auto kind = choice_or(object, "distribution", Kind::Beckmann, kinds);
  const float x = object.positive_or("alpha_x", 0.1F);
  const float y = object.positive_or("alpha_y", 0.1F);
  return kind == Kind::Ggx ? make(Ggx{x, y}) : make(Beckmann{x, y});
}

[[nodiscard]] inline SceneMaterial read_rough_glass(JsonObject& object) {
  const Rgb reflectance = object.color_or("R", 1);
  const Rgb transmittance = object.color_or("T", 1);
  const float eta = object.positive_or("eta", 1.5F);
  return with_facets(object, [&]<typename D>(const D& distribution) {
    return SceneMaterial(RoughDielectric<D>{reflectance, transmittance, distribution, eta});
  });
}

/// A metal by name, or by its indices.
[[nodiscard]] inline Metal read_metal(JsonObject& object) {
  const auto name = object.find("metal");
  const bool in_numbers = object.has("etaI") || object.has("etaT") || object.has("k");
  if (name && in_numbers) object.fail("a metal is given either by \"metal\" or by \"etaI\", \"etaT\" and \"k\"");
  if (name) return choice(*name, known_metals);
  const Rgb outside = object.read_or("etaI", Rgb(1), [](const JsonValue& v) {
    const Rgb value = v.color();
    if (!(value.r > 0 && value.g > 0 && value.b > 0)) v.fail("found " + v.json().dump() + ", expected numbers above 0");
    return value;
  });
  return {object.color_or("etaT", 1) / outside, object.color_or("k", 1) / outside};
}

[[nodiscard]] inline SceneMaterial read_conductor(JsonObject& object, const SceneDraft& draft) {
  const Metal metal = read_metal(object);
  return SceneConductor{.texture = texture_or_white(object, draft), .base = {.eta = metal.eta, .k = metal.k}};
}

[[nodiscard]] inline SceneMaterial read_rough_conductor(JsonObject& object, const SceneDraft& draft) {
  const Metal metal = read_metal(object);
  const SceneTexture texture =
      object.has("metal") ? texture_or_white(object, draft) : material_texture(object, "R", draft);
  const bool compensated = object.flag_or("compensated", false);
  return with_facets(object, [&]<typename D>(const D& distribution) {
    const RoughConductor<D> base{.distribution = distribution, .eta = metal.eta, .k = metal.k};
    if (compensated) return SceneMaterial(SceneCompensatedConductor<D>{texture, {base}});
    return SceneMaterial(SceneRoughConductor<D>{texture, base});
  });
}

[[nodiscard]] inline SceneMaterial read_kind_of_material(MaterialKind kind, JsonObject& object,
                                                         const SceneDraft& draft) {
  switch (kind) {
    case MaterialKind::Plastic:
      return read_plastic(object, draft);
    case MaterialKind::Refraction:
      return PerfectRefraction{.eta = object.positive_or("eta", 1.5F)};
    case MaterialKind::Glass:
      return Dielectric{object.color_or("R", 1), object.color_or("T", 1), object.positive_or("eta", 1.5F)};
    case MaterialKind::ThinGlass:
      return ThinDielectric{object.color_or("R", 1), object.color_or("T", 1), object.positive_or("eta", 1.5F)};
    case MaterialKind::RoughGlass:
      return read_rough_glass(object);
    case MaterialKind::Mirror:
      return Mirror{object.color_or("R", 1)};
    case MaterialKind::Conductor:
      return read_conductor(object, draft);
    case MaterialKind::RoughConductor:
      return read_rough_conductor(object, draft);
    case MaterialKind::Diffuse:
      break;
  }
  return read_diffuse(object, draft);
}

[[nodiscard]] inline SceneMaterial read_material(JsonObject object, const SceneDraft& draft) {
  const auto kind = choice_or(object, "type", MaterialKind::Diffuse, material_kinds);
  SceneMaterial result = read_kind_of_material(kind, object, draft);
  object.finish();
  return result;
}

inline void read_materials(JsonObject materials, SceneDraft& draft) {
  for (const auto& [name, value] : materials.members()) {
    draft.materials.emplace(name, draft.add_material(read_material(JsonObject(value), draft)));
  }
}

}  // namespace glint::detail
