// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <glint/io/file.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/json_parse.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_lights.hpp>
#include <glint/io/scene_materials.hpp>
#include <glint/io/scene_objects.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/io/scene_textures.hpp>

namespace glint {

struct SceneReadOptions {
  std::vector<std::string> overrides{};  ///< JSON texts, merged into the file one after the other
  std::string integrator{};              ///< replaces /integrator/type, where not empty
  bool strict = false;                   ///< unknown keys are errors
};

namespace detail {

/// Merges what the options say into the scene's JSON. Errors name the option as the command line does.
inline void apply_options(nlohmann::json& json, const SceneReadOptions& options, JsonSource& source) {
  for (const std::string& text : options.overrides) {
    JsonSource of_override{.path = "--override", .strict = options.strict};
    const nlohmann::json change = parse_json(text, of_override);
    if (!change.is_object()) JsonValue(change, "", of_override).fail_expected("an object");
    merge_json(json, change);
    source.warnings.insert(source.warnings.end(), of_override.warnings.begin(), of_override.warnings.end());
  }
  if (options.integrator.empty()) return;
  const nlohmann::json name = options.integrator;
  JsonSource of_integrator{.path = "--integrator"};
  (void)choice(JsonValue(name, "", of_integrator), integrator_kinds);
  merge_json(json, {{"integrator", {{"type", name}}}});
}

[[nodiscard]] inline SceneFile scene_from_json(const nlohmann::json& json, JsonSource& source) {
  JsonObject top(JsonValue(json, "", source));
  SceneDraft draft;
  SceneFile& scene = draft.scene;
  scene.inputs.push_back(source.path);
  scene.integrator = read_integrator(JsonObject(top.require("integrator")), top.has("lights"));
  scene.film = read_film(JsonObject(top.require("film")));
  scene.camera = read_camera(JsonObject(top.require("camera")));
  if (const auto sampler = top.find("sampler")) scene.sampler = read_sampler(JsonObject(*sampler));
  if (const auto found = top.find("accelerator")) scene.accelerator = read_accelerator(JsonObject(*found));
  if (const auto textures = top.find("textures")) read_textures(JsonObject(*textures), draft);
  if (const auto materials = top.find("materials")) read_materials(JsonObject(*materials), draft);
  for (const JsonValue& object : top.items("objects")) read_object(JsonObject(object), draft);
  for (const JsonValue& light : top.items("lights")) read_light(JsonObject(light), draft);
  if (const auto environment = top.find("environment_map")) read_environment(JsonObject(*environment), draft);
  for (const PointLight& light : scene.integrator.point_lights) scene.lights.emplace_back(light);
  top.finish();
  return std::move(draft).take();
}

}  // namespace detail

/// Reads a scene and everything it names. Paths in it are relative to its folder.
///
/// Errors: IoError that names the file, the line or the JSON pointer, what was found and what was expected.
[[nodiscard]] inline SceneFile read_scene(const std::filesystem::path& path, const SceneReadOptions& options = {}) {
  JsonSource source{.path = path, .strict = options.strict};
  nlohmann::json json = parse_json(read_file(path), source);
  detail::apply_options(json, options, source);
  SceneFile scene = detail::scene_from_json(json, source);
  scene.warnings = std::move(source.warnings);
  return scene;
}

}  // namespace glint
