// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <glint/io/json_object.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_settings.hpp>

/// The part "materials" of a scene file.
namespace glint::detail {

enum class MaterialKind : std::uint8_t { Diffuse, Refraction, Glass, Mirror, RoughConductor };

inline constexpr std::array<std::pair<std::string_view, MaterialKind>, 5> material_kinds{
    {{"diffuse", MaterialKind::Diffuse},
     {"refraction", MaterialKind::Refraction},
     {"glass", MaterialKind::Glass},
     {"mirror", MaterialKind::Mirror},
     {"roughconductor", MaterialKind::RoughConductor}}};

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

[[nodiscard]] inline SceneMaterial read_diffuse(JsonObject& object, const SceneDraft& draft) {
  const SceneDiffuse diffuse{.texture = material_texture(object, "color", draft)};
  if (object.flag_or("twosided", false)) return TwoSidedMaterial<SceneDiffuse>{diffuse};
  return diffuse;
}

[[nodiscard]] inline SceneMaterial read_rough_conductor(JsonObject& object, const SceneDraft& draft) {
  const Rgb outside = object.read_or("etaI", Rgb(1), [](const JsonValue& v) {
    const Rgb value = v.color();
    if (!(value.r > 0 && value.g > 0 && value.b > 0)) v.fail("found " + v.json().dump() + ", expected numbers above 0");
    return value;
  });
  SceneRoughConductor result{.texture = material_texture(object, "R", draft)};
  result.base.distribution = {object.positive_or("alpha_x", 0.1F), object.positive_or("alpha_y", 0.1F)};
  result.base.eta = object.color_or("etaT", 1) / outside;
  result.base.k = object.color_or("k", 1) / outside;
  return result;
}

[[nodiscard]] inline SceneMaterial read_material(JsonObject object, const SceneDraft& draft) {
  const auto kind = choice_or(object, "type", MaterialKind::Diffuse, material_kinds);
  SceneMaterial result = PerfectRefraction{};
  if (kind == MaterialKind::Refraction) {
    result = PerfectRefraction{.eta = object.positive_or("eta", 1.5F)};
  } else if (kind == MaterialKind::Glass) {
    result = Dielectric{object.color_or("R", 1), object.color_or("T", 1), object.positive_or("eta", 1.5F)};
  } else if (kind == MaterialKind::Mirror) {
    result = Mirror{object.color_or("R", 1)};
  } else if (kind == MaterialKind::RoughConductor) {
    result = read_rough_conductor(object, draft);
  } else {
    result = read_diffuse(object, draft);
  }
  object.finish();
  return result;
}

inline void read_materials(JsonObject materials, SceneDraft& draft) {
  for (const auto& [name, value] : materials.members()) {
    draft.materials.emplace(name, draft.add_material(read_material(JsonObject(value), draft)));
  }
}

}  // namespace glint::detail
