// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include <glint/color/image.hpp>
#include <glint/io/image.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_settings.hpp>

/// The part "textures" of a scene file.
namespace glint::detail {

enum class TextureKind : std::uint8_t { Constant, Checkerboard, Image };

inline constexpr std::array<std::pair<std::string_view, TextureKind>, 3> texture_kinds{
    {{"constant", TextureKind::Constant}, {"checkerboard", TextureKind::Checkerboard}, {"image", TextureKind::Image}}};
inline constexpr std::array<std::pair<std::string_view, Encoding>, 2> texture_encodings{
    {{"srgb", Encoding::Srgb}, {"linear", Encoding::Linear}}};

[[nodiscard]] inline UvMapping read_uv_mapping(JsonObject& texture) {
  const auto found = texture.find("tex_coordinate_generator");
  if (!found) return {};
  JsonObject mapping(*found);
  require_type(mapping, "uvmapping2d");
  const UvMapping result{mapping.vec2_or("scale", {1, 1}), mapping.vec2_or("delta", {0, 0})};
  mapping.finish();
  return result;
}

[[nodiscard]] inline SceneTexture read_image_texture(JsonObject& object, SceneDraft& draft) {
  const auto encoding = choice_or(object, "encoding", Encoding::Srgb, texture_encodings);
  const auto read = [&](const auto& path) { return std::make_shared<const Image>(read_image(path, encoding)); };
  auto image = read_named_file(draft, object.require("path"), read);
  return ImageTexture{.image = std::move(image), .mapping = read_uv_mapping(object)};
}

[[nodiscard]] inline SceneTexture read_texture(JsonObject object, SceneDraft& draft) {
  const auto kind = choice(object.require("type"), texture_kinds);
  SceneTexture result = ConstantTexture{};
  if (kind == TextureKind::Constant) {
    result = ConstantTexture{object.require("color").color()};
  } else if (kind == TextureKind::Checkerboard) {
    result = Checkerboard{object.color_or("color0", 0.4F), object.color_or("color1", 0.2F), read_uv_mapping(object)};
  } else {
    result = read_image_texture(object, draft);
  }
  object.finish();
  return result;
}

inline void read_textures(JsonObject textures, SceneDraft& draft) {
  for (const auto& [name, value] : textures.members()) {
    draft.textures.emplace(name, read_texture(JsonObject(value), draft));
  }
}

}  // namespace glint::detail
