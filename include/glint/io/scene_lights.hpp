// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include <glint/io/json_object.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_objects.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/math/affine.hpp>

/// The parts "lights" and "environment_map" of a scene file.
namespace glint::detail {

enum class LightKind : std::uint8_t { Point, Spot, Directional, Rectangle };

inline constexpr std::array<std::pair<std::string_view, LightKind>, 5> light_kinds{
    {{"point", LightKind::Point},
     {"spot", LightKind::Spot},
     {"directional", LightKind::Directional},
     {"rectangle", LightKind::Rectangle},
     {"area", LightKind::Rectangle}}};

/// Angles are between the axis and the cone's surface.
[[nodiscard]] inline SpotLight read_spot_light(JsonObject& light) {
  SpotLight result{.position = light.require("position").vec3(),
                   .direction = direction_of(light.require("direction")),
                   .intensity = light.require("intensity").color()};
  const float cone = light.number_or("cone_angle", 30);
  const float start = light.number_or("falloff_start", 0.8F * cone);
  if (!(start >= 0 && start <= cone && cone <= 180)) {
    light.fail("expected 0 <= \"falloff_start\" <= \"cone_angle\" <= 180 degrees");
  }
  result.cone_angle_radians = radians(cone);
  result.falloff_start_radians = radians(start);
  return result;
}

[[nodiscard]] inline DirectionalLight read_directional_light(JsonObject& light) {
  return {direction_of(light.require("direction")), light.require("irradiance").color()};
}

inline void read_light(JsonObject light, SceneDraft& draft) {
  const auto kind = choice(light.require("type"), light_kinds);
  SceneFile& scene = draft.scene;
  if (kind == LightKind::Point) scene.lights.emplace_back(read_point_light(light));
  if (kind == LightKind::Spot) scene.lights.emplace_back(read_spot_light(light));
  if (kind == LightKind::Directional) scene.lights.emplace_back(read_directional_light(light));
  if (kind == LightKind::Rectangle) {
    const Rgb radiance = light.require("radiance").color();
    add_shape(draft, Quads, scene.quads, read_rectangle(light), {draft.black_material(), radiance});
  }
  light.finish();
}

/// The table by which directions are chosen is as fine as the image; for other textures, fine enough.
[[nodiscard]] inline Vec2i table_resolution(const SceneTexture& texture) {
  const ImageTexture* image = texture.get_if<ImageTexture>();
  return image == nullptr ? Vec2i{256, 128} : image->image->size();
}

/// Whether light is looked for and met by chance, each weighted: what a compensated choice needs.
[[nodiscard]] inline bool combines_strategies(const SceneIntegrator& integrator) {
  if (const auto* path = integrator.get_if<Path>()) return path->strategy == LightStrategy::Mis;
  const auto* direct = integrator.get_if<Direct>();
  return direct != nullptr && direct->strategy == LightStrategy::Mis;
}

[[nodiscard]] inline EnvironmentChoice read_environment_choice(JsonObject& object, const SceneFile& scene) {
  if (!object.flag_or("mis_compensation", false)) return EnvironmentChoice::Radiance;
  if (!combines_strategies(scene.integrator.integrator)) {
    object.fail(
        "\"mis_compensation\" is right only for the integrators \"path\" and \"direct\" with the profile \"MIS\"");
  }
  return EnvironmentChoice::Compensated;
}

/// The texture as an environment: looked up where it is sampled, so not filtered, and without a seam at the poles.
[[nodiscard]] inline SceneTexture environment_texture(const SceneTexture& texture) {
  ImageTexture image;
  if (const auto* const filtered = texture.get_if<FilteredImageTexture>()) {
    image = {.image = filtered->pyramid->finest(), .mapping = filtered->mapping, .wrap_s = filtered->wrap_s};
  } else if (const auto* const plain = texture.get_if<ImageTexture>()) {
    image = *plain;
  } else {
    return texture;
  }
  image.wrap_t = Wrap::Clamp;
  return image;
}

inline void read_environment(JsonObject object, SceneDraft& draft) {
  SceneTexture texture = environment_texture(named(draft.textures, object.require("texture_name"), "texture"));
  const float scale = object.not_negative_or("scale", 1);
  Affine<float> to_world;
  if (const auto transform = object.find("transform")) {
    to_world = affine_of(*transform);
    if (!inverse(to_world))
      transform->fail("found " + transform->json().dump() + ", expected a matrix with an inverse");
  }
  const EnvironmentChoice choice = read_environment_choice(object, draft.scene);
  object.finish();
  const Vec2i resolution = table_resolution(texture);
  draft.scene.lights.emplace_back(
      EnvironmentLight<SceneTexture>(std::move(texture), resolution, scale, to_world.linear, choice));
}

}  // namespace glint::detail
