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
#include <glint/io/scene_surfaces.hpp>

/// Materials by themselves, as the part "materials" of a scene file has them.
namespace glint::detail {

enum class MaterialKind : std::uint8_t {
  Diffuse,
  Plastic,
  RoughPlastic,
  Principled,
  Refraction,
  Glass,
  ThinGlass,
  RoughGlass,
  Mirror,
  Conductor,
  RoughConductor,
  Blend  ///< of others, so not read here
};

inline constexpr std::array<std::pair<std::string_view, MaterialKind>, 12> material_kinds{
    {{"diffuse", MaterialKind::Diffuse},
     {"plastic", MaterialKind::Plastic},
     {"roughplastic", MaterialKind::RoughPlastic},
     {"principled", MaterialKind::Principled},
     {"refraction", MaterialKind::Refraction},
     {"glass", MaterialKind::Glass},
     {"thinglass", MaterialKind::ThinGlass},
     {"roughglass", MaterialKind::RoughGlass},
     {"mirror", MaterialKind::Mirror},
     {"conductor", MaterialKind::Conductor},
     {"roughconductor", MaterialKind::RoughConductor},
     {"blend", MaterialKind::Blend}}};

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

/// Accepts shares.
inline constexpr auto from_zero_to_one = [](float number) { return number >= 0 && number <= 1; };

[[nodiscard]] inline ScenePlainMaterial read_diffuse(JsonObject& object, const SceneDraft& draft) {
  const SceneTexture texture = material_texture(object, "color", draft);
  const float roughness = object.read_or(
      "roughness", 0.0F, [](const JsonValue& v) { return v.number_where(from_zero_to_one, "a number from 0 to 1"); });
  if (roughness > 0) return SceneRoughDiffuse{.texture = texture, .base = {.roughness = roughness}};
  return SceneDiffuse{.texture = texture};
}

/// The index of a coat over something that is not seen through.
[[nodiscard]] inline float read_coat_eta(JsonObject& object) {
  return object.read_or("eta", 1.5F, [](const JsonValue& v) {
    return v.number_where([](float number) { return number >= 1.03F && number <= 3; }, "a number from 1.03 to 3");
  });
}

[[nodiscard]] inline ScenePlainMaterial read_plastic(JsonObject& object, const SceneDraft& draft) {
  ScenePlastic plastic{.texture = material_texture(object, "color", draft)};
  plastic.base.eta = read_coat_eta(object);
  return plastic;
}

/// Reads how facets are spread, and makes a material of them: `make(distribution)`.
template <typename Make>
[[nodiscard]] ScenePlainMaterial with_facets(JsonObject& object, const Make& make) {
  enum class Kind : std::uint8_t { Beckmann, Ggx };
  static constexpr std::array<std::pair<std::string_view, Kind>, 2> kinds{
      {{"beckmann", Kind::Beckmann}, {"ggx", Kind::Ggx}}};
  const auto kind = choice_or(object, "distribution", Kind::Beckmann, kinds);
  const float x = object.positive_or("alpha_x", 0.1F);
  const float y = object.positive_or("alpha_y", 0.1F);
  return kind == Kind::Ggx ? make(Ggx{x, y}) : make(Beckmann{x, y});
}

[[nodiscard]] inline ScenePlainMaterial read_rough_glass(JsonObject& object) {
  const Rgb reflectance = object.color_or("R", 1);
  const Rgb transmittance = object.color_or("T", 1);
  const float eta = object.positive_or("eta", 1.5F);
  return with_facets(object, [&]<typename D>(const D& distribution) {
    return ScenePlainMaterial(RoughDielectric<D>{reflectance, transmittance, distribution, eta});
  });
}

[[nodiscard]] inline ScenePlainMaterial read_rough_plastic(JsonObject& object, const SceneDraft& draft) {
  const SceneTexture texture = material_texture(object, "color", draft);
  const float eta = read_coat_eta(object);
  return with_facets(object, [&]<typename D>(const D& distribution) {
    return ScenePlainMaterial(SceneRoughPlastic<D>{texture, {.distribution = distribution, .eta = eta}});
  });
}

/// The numbers of a principled material that are shares, or like them.
inline constexpr std::array<std::pair<const char*, float Principled::*>, 9> principled_numbers{
    {{"metallic", &Principled::metallic},
     {"roughness", &Principled::roughness},
     {"anisotropy", &Principled::anisotropy},
     {"transmission", &Principled::transmission},
     {"coat", &Principled::coat},
     {"coat_roughness", &Principled::coat_roughness},
     {"sheen", &Principled::sheen},
     {"sheen_roughness", &Principled::sheen_roughness},
     {"sheen_tint", &Principled::sheen_tint}}};

/// Each is a number, or the name of a texture; the base color a color, or the name of a texture.
[[nodiscard]] inline ScenePlainMaterial read_principled(JsonObject& object, const SceneDraft& draft) {
  ScenePrincipled result;
  const auto color = object.find("base_color");
  const bool is_name = color && color->json().is_string();
  result.base_color = is_name ? named(draft.textures, *color, "texture")
                              : SceneTexture(ConstantTexture{color ? color->color() : result.base.base_color});
  result.base.eta = read_coat_eta(object);
  for (const auto& [key, member] : principled_numbers) {
    const auto value = object.find(key);
    if (!value) continue;
    if (value->json().is_string()) {
      result.numbers.push_back({member, named(draft.textures, *value, "texture")});
    } else {
      result.base.*member = value->number_where(from_zero_to_one, "a number from 0 to 1, or the name of a texture");
    }
  }
  return result;
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

[[nodiscard]] inline ScenePlainMaterial read_conductor(JsonObject& object, const SceneDraft& draft) {
  const Metal metal = read_metal(object);
  return SceneConductor{.texture = texture_or_white(object, draft), .base = {.eta = metal.eta, .k = metal.k}};
}

[[nodiscard]] inline ScenePlainMaterial read_rough_conductor(JsonObject& object, const SceneDraft& draft) {
  const Metal metal = read_metal(object);
  const SceneTexture texture =
      object.has("metal") ? texture_or_white(object, draft) : material_texture(object, "R", draft);
  const bool compensated = object.flag_or("compensated", false);
  return with_facets(object, [&]<typename D>(const D& distribution) {
    const RoughConductor<D> base{.distribution = distribution, .eta = metal.eta, .k = metal.k};
    if (compensated) return ScenePlainMaterial(SceneCompensatedConductor<D>{texture, {base}});
    return ScenePlainMaterial(SceneRoughConductor<D>{texture, base});
  });
}

[[nodiscard]] inline ScenePlainMaterial read_plain_material(MaterialKind kind, JsonObject& object,
                                                            const SceneDraft& draft) {
  switch (kind) {
    case MaterialKind::Plastic:
      return read_plastic(object, draft);
    case MaterialKind::RoughPlastic:
      return read_rough_plastic(object, draft);
    case MaterialKind::Principled:
      return read_principled(object, draft);
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
    case MaterialKind::Blend:
      break;
  }
  return read_diffuse(object, draft);
}

}  // namespace glint::detail
