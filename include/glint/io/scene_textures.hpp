// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <glint/color/image.hpp>
#include <glint/io/image.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/texture/filtered_image_texture.hpp>
#include <glint/texture/mip_map.hpp>
#include <glint/texture/mix.hpp>
#include <glint/texture/noise.hpp>
#include <glint/texture/triplanar.hpp>

/// The part "textures" of a scene file.
namespace glint::detail {

enum class TextureKind : std::uint8_t { Constant, Checkerboard, Image, Noise, Mix, Triplanar };

inline constexpr std::array<std::pair<std::string_view, TextureKind>, 6> texture_kinds{
    {{"constant", TextureKind::Constant},
     {"checkerboard", TextureKind::Checkerboard},
     {"image", TextureKind::Image},
     {"noise", TextureKind::Noise},
     {"mix", TextureKind::Mix},
     {"triplanar", TextureKind::Triplanar}}};
inline constexpr std::array<std::pair<std::string_view, Encoding>, 2> texture_encodings{
    {{"srgb", Encoding::Srgb}, {"linear", Encoding::Linear}}};
enum class ImageFilter : std::uint8_t { Nearest, Bilinear, Trilinear, Ewa };

inline constexpr std::array<std::pair<std::string_view, ImageFilter>, 4> texture_filters{
    {{"nearest", ImageFilter::Nearest},
     {"bilinear", ImageFilter::Bilinear},
     {"trilinear", ImageFilter::Trilinear},
     {"ewa", ImageFilter::Ewa}}};
inline constexpr std::array<std::pair<std::string_view, Wrap>, 4> texture_wraps{
    {{"repeat", Wrap::Repeat}, {"clamp", Wrap::Clamp}, {"mirror", Wrap::Mirror}, {"border", Wrap::Border}}};
inline constexpr std::array<std::pair<std::string_view, NoisePattern>, 2> noise_patterns{
    {{"fbm", NoisePattern::Fbm}, {"turbulence", NoisePattern::Turbulence}}};

/// `scale` and `offset` of the texture itself, or in the older spelling of its `tex_coordinate_generator`.
[[nodiscard]] inline UvMapping read_uv_mapping(JsonObject& texture) {
  const bool has_own = texture.has("scale") || texture.has("offset");
  const UvMapping own{texture.vec2_or("scale", {1, 1}), texture.vec2_or("offset", {0, 0})};
  const auto found = texture.find("tex_coordinate_generator");
  if (!found) return own;
  if (has_own) found->fail("stands beside \"scale\" or \"offset\", which say the same");
  JsonObject mapping(*found);
  require_type(mapping, "uvmapping2d");
  const UvMapping result{mapping.vec2_or("scale", {1, 1}), mapping.vec2_or("delta", {0, 0})};
  mapping.finish();
  return result;
}

/// One name for both directions, or one for each.
[[nodiscard]] inline std::array<Wrap, 2> read_wrap(JsonObject& texture) {
  const auto found = texture.find("wrap");
  if (!found) return {Wrap::Repeat, Wrap::Repeat};
  if (!found->json().is_array()) {
    const Wrap both = choice(*found, texture_wraps);
    return {both, both};
  }
  const auto each = found->items();
  if (each.size() != 2) found->fail_expected("a name, or an array of 2");
  return {choice(each[0], texture_wraps), choice(each[1], texture_wraps)};
}

/// An image texture by its pyramid. Requires: `filter` is Trilinear or Ewa.
[[nodiscard]] inline FilteredImageTexture filtered_texture(JsonObject& object, const ImageTexture& plain,
                                                           ImageFilter filter) {
  FilteredImageTexture result{.pyramid = std::make_shared<const MipMap>(plain.image),
                              .mapping = plain.mapping,
                              .filter = TextureFilter::Trilinear,
                              .wrap_s = plain.wrap_s,
                              .wrap_t = plain.wrap_t};
  if (filter == ImageFilter::Trilinear) return result;
  result.filter = TextureFilter::Ewa;
  result.max_anisotropy = object.read_or("max_anisotropy", result.max_anisotropy, [](const JsonValue& v) {
    return v.number_where([](float number) { return number >= 1 && number <= 64; }, "a number from 1 to 64");
  });
  return result;
}

[[nodiscard]] inline SceneTexture read_image_texture(JsonObject& object, SceneDraft& draft) {
  const auto encoding = choice_or(object, "encoding", Encoding::Srgb, texture_encodings);
  const auto read = [&](const auto& path) { return std::make_shared<const Image>(read_image(path, encoding)); };
  auto image = read_named_file(draft, object.require("path"), read);
  const auto [wrap_s, wrap_t] = read_wrap(object);
  const UvMapping mapping = read_uv_mapping(object);
  const auto filter = choice_or(object, "filter", ImageFilter::Bilinear, texture_filters);
  const auto between = filter == ImageFilter::Nearest ? Interpolation::Nearest : Interpolation::Bilinear;
  ImageTexture plain{std::move(image), mapping, between, wrap_s, wrap_t};
  if (filter == ImageFilter::Nearest || filter == ImageFilter::Bilinear) return plain;
  draft.scene.filters_textures = true;
  return filtered_texture(object, plain, filter);
}

[[nodiscard]] inline SceneTexture read_noise(JsonObject& object) {
  NoiseTexture noise{.color0 = object.color_or("color0", 0),
                     .color1 = object.color_or("color1", 1),
                     .scale = object.vec3_or("scale", {1, 1, 1}),
                     .offset = object.vec3_or("offset", {0, 0, 0}),
                     .pattern = choice_or(object, "pattern", NoisePattern::Fbm, noise_patterns)};
  noise.octaves.count = object.integer_or("octaves", noise.octaves.count, 1, 32);
  noise.octaves.gain = object.not_negative_or("gain", noise.octaves.gain);
  noise.octaves.lacunarity = object.positive_or("lacunarity", noise.octaves.lacunarity);
  const auto seed = [](const JsonValue& v) { return v.seed(); };
  noise.octaves.seed = object.read_or("seed", noise.octaves.seed, seed);
  return AnyTexture(noise);
}

[[nodiscard]] inline SceneTexture read_texture(JsonObject object, SceneDraft& draft);

/// A texture that another one names, read now where it has not been yet.
[[nodiscard]] inline SceneTexture part_of_texture(const JsonValue& name, SceneDraft& draft) {
  const auto waiting = draft.other_textures.find(name.text());
  if (waiting == draft.other_textures.end()) return named(draft.textures, name, "texture");
  const auto value = std::exchange(waiting->second, std::nullopt);
  if (!value) name.fail("the texture \"" + name.text() + "\" is made of itself");
  SceneTexture result = read_texture(JsonObject(*value), draft);
  draft.textures.emplace(name.text(), result);
  draft.other_textures.erase(name.text());
  return result;
}

[[nodiscard]] inline SceneTexture read_mix(JsonObject& object, SceneDraft& draft) {
  const auto first = part_of_texture(object.require("texture0"), draft);
  const auto second = part_of_texture(object.require("texture1"), draft);
  const auto share = object.find("share");
  if (share && share->json().is_string()) return AnyTexture(Mix{first, second, part_of_texture(*share, draft)});
  const auto from_0_to_1 = [](float number) { return number >= 0 && number <= 1; };
  const float same = share ? share->number_where(from_0_to_1, "a number from 0 to 1, or the name of a texture") : 0.5F;
  return AnyTexture(Mix{first, second, ConstantTexture{same}});
}

[[nodiscard]] inline SceneTexture read_triplanar(JsonObject& object, SceneDraft& draft) {
  const auto texture = part_of_texture(object.require("texture_name"), draft);
  return AnyTexture(Triplanar{texture, object.positive_or("scale", 1)});
}

[[nodiscard]] inline SceneTexture read_kind_of_texture(TextureKind kind, JsonObject& object, SceneDraft& draft) {
  switch (kind) {
    case TextureKind::Checkerboard:
      return Checkerboard{object.color_or("color0", 0.4F), object.color_or("color1", 0.2F), read_uv_mapping(object)};
    case TextureKind::Image:
      return read_image_texture(object, draft);
    case TextureKind::Noise:
      return read_noise(object);
    case TextureKind::Mix:
      return read_mix(object, draft);
    case TextureKind::Triplanar:
      return read_triplanar(object, draft);
    case TextureKind::Constant:
      break;
  }
  return ConstantTexture{object.require("color").color()};
}

[[nodiscard]] inline SceneTexture read_texture(JsonObject object, SceneDraft& draft) {
  const auto kind = choice(object.require("type"), texture_kinds);
  SceneTexture result = read_kind_of_texture(kind, object, draft);
  object.finish();
  return result;
}

/// Textures may name others, before or after them. Those that do are read last, so that an error about a name knows
/// all the others.
inline void read_textures(JsonObject textures, SceneDraft& draft) {
  const auto members = textures.members();
  const auto names_others = [](const JsonValue& value) {
    const nlohmann::json& json = value.json();
    return json.is_object() && (json.contains("texture_name") || json.contains("texture0"));
  };
  for (const auto& [name, value] : members) {
    if (names_others(value)) draft.other_textures.emplace(name, value);
  }
  for (const auto& [name, value] : members) {
    if (!names_others(value)) draft.textures.emplace(name, read_texture(JsonObject(value), draft));
  }
  while (!draft.other_textures.empty()) {
    const nlohmann::json name = draft.other_textures.begin()->first;
    (void)part_of_texture(JsonValue(name, textures.pointer(), textures.source()), draft);
  }
}

}  // namespace glint::detail
