// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include <glint/io/json_object.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_plain_materials.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/io/scene_surfaces.hpp>

/// The part "materials" of a scene file.
namespace glint::detail {

/// The material of a layer: the choice that is quickest to shade.
[[nodiscard]] inline SceneMaterial material_of(const SceneLayer& layer) {
  if (!layer.two_sided) return layer.material.visit([](const auto& plain) { return SceneMaterial(plain); });
  if (const auto* diffuse = layer.material.get_if<SceneDiffuse>()) return TwoSidedMaterial<SceneDiffuse>{*diffuse};
  if (const auto* rough = layer.material.get_if<SceneRoughDiffuse>())
    return TwoSidedMaterial<SceneRoughDiffuse>{*rough};
  return layer;
}

/// A layer below heights of a texture. Slopes are taken between the pixels of an image.
[[nodiscard]] inline SceneMaterial bump_mapped(SceneLayer layer, SceneTexture heights, float scale) {
  SceneBumpMapped result{.base = std::move(layer), .height = std::move(heights), .scale = scale};
  const auto step_by_pixels = [&](const Image& image) {
    result.step = 1.0F / static_cast<float>(std::max(image.width(), image.height()));
  };
  if (const auto* plain = result.height.get_if<ImageTexture>()) step_by_pixels(*plain->image);
  if (const auto* filtered = result.height.get_if<FilteredImageTexture>()) step_by_pixels(*filtered->pyramid->finest());
  return result;
}

/// A number from 0 to 1, or the luminance of a texture.
[[nodiscard]] inline SceneTexture share_or_texture(const JsonValue& value, const SceneDraft& draft) {
  if (value.json().is_string()) return named(draft.textures, value, "texture");
  return ConstantTexture{Rgb{value.number_where(from_zero_to_one, "a number from 0 to 1, or the name of a texture")}};
}

/// One of the two materials of a blend.
[[nodiscard]] inline SceneLayer layer_named(const JsonValue& name, const SceneDraft& draft) {
  const auto found = draft.layers.find(name.text());
  if (found != draft.layers.end()) return found->second;
  (void)named(draft.materials, name, "material");
  name.fail("the material \"" + name.text() +
            "\" is a blend, or has \"normal_map\", \"bump_map\" or \"opacity\", which what is blended cannot have");
}

[[nodiscard]] inline bool is_blend(const JsonValue& material) {
  const nlohmann::json& json = material.json();
  return json.is_object() && json.contains("type") && json["type"] == "blend";
}

[[nodiscard]] inline SceneMaterial read_blend(JsonObject& object, const SceneDraft& draft) {
  (void)object.require("type");
  SceneLayer first = layer_named(object.require("material0"), draft);
  SceneLayer second = layer_named(object.require("material1"), draft);
  const auto share = object.find("share");
  return SceneBlend{std::move(first), std::move(second),
                    share ? share_or_texture(*share, draft) : SceneTexture(ConstantTexture{Rgb{0.5F}})};
}

/// A material as it was read.
struct ReadMaterial {
  SceneMaterial material;
  std::optional<SceneLayer> layer{};  ///< which it is, where it is no more than that
  std::optional<SceneTexture> opacity{};
};

[[nodiscard]] inline ReadMaterial read_layer(JsonObject& object, const SceneDraft& draft) {
  const auto kind = choice_or(object, "type", MaterialKind::Diffuse, material_kinds);
  SceneLayer layer{read_plain_material(kind, object, draft)};
  layer.two_sided = object.flag_or("twosided", false);
  const auto normals = object.find("normal_map");
  const auto heights = object.find("bump_map");
  if (normals && heights) object.fail("a surface is bent either by \"normal_map\" or by \"bump_map\"");
  if (normals) return {SceneNormalMapped{std::move(layer), named(draft.textures, *normals, "texture")}};
  if (heights) {
    const float scale = object.number_or("bump_scale", 1);
    return {bump_mapped(std::move(layer), named(draft.textures, *heights, "texture"), scale)};
  }
  SceneMaterial material = material_of(layer);
  return {std::move(material), std::move(layer)};
}

[[nodiscard]] inline ReadMaterial read_material(const JsonValue& value, const SceneDraft& draft) {
  JsonObject object(value);
  ReadMaterial result = is_blend(value) ? ReadMaterial{read_blend(object, draft)} : read_layer(object, draft);
  if (const auto opacity = object.find("opacity")) {
    result.opacity = share_or_texture(*opacity, draft);
    result.layer.reset();
  }
  object.finish();
  return result;
}

/// Blends may name others, before or after them, and are read last.
inline void read_materials(JsonObject materials, SceneDraft& draft) {
  const auto members = materials.members();
  for (const bool blends : {false, true}) {
    for (const auto& [name, value] : members) {
      if (is_blend(value) != blends) continue;
      ReadMaterial read = read_material(value, draft);
      draft.materials.emplace(name, read.opacity ? draft.add_material(std::move(read.material), *read.opacity)
                                                 : draft.add_material(std::move(read.material)));
      if (read.layer) draft.layers.emplace(name, *std::move(read.layer));
    }
  }
}

}  // namespace glint::detail
