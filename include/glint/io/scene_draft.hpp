// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glint/core/index.hpp>
#include <glint/io/error.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_surfaces.hpp>
#include <glint/math/affine.hpp>

/// What the readers of a scene's parts have in common.
namespace glint::detail {

/// A scene in the making, and the names its later parts may use.
struct SceneDraft {
  SceneFile scene{};
  std::map<std::string, SceneTexture> textures{};
  std::map<std::string, std::optional<JsonValue>> other_textures{};  ///< not read yet; no value: being read
  std::map<std::string, std::uint32_t> materials{};
  std::map<std::string, SceneLayer> layers{};                    ///< the materials that blends may name
  std::map<std::uint32_t, std::uint32_t> opacity_of_material{};  ///< indices; of those that are not opaque
  std::optional<std::uint32_t> black{};  ///< the material of lamps that have none, once there is one

  std::uint32_t add_material(SceneMaterial material) {
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  }

  /// A material that lets light pass as far as a texture says.
  std::uint32_t add_material(SceneMaterial material, SceneTexture opacity) {
    const std::uint32_t index = add_material(std::move(material));
    opacity_of_material.emplace(index, static_cast<std::uint32_t>(scene.opacities.size()));
    scene.opacities.push_back(std::move(opacity));
    return index;
  }

  std::uint32_t add_light(SceneLight light) {
    scene.lights.push_back(std::move(light));
    return static_cast<std::uint32_t>(scene.lights.size() - 1);
  }

  [[nodiscard]] std::uint32_t black_material() {
    if (!black) black = add_material(SceneDiffuse{.texture = ConstantTexture{0}});
    return *black;
  }

  /// The scene, done: from the materials' opacity that of each primitive, where anything lets light pass.
  [[nodiscard]] SceneFile take() && {
    if (opacity_of_material.empty()) return std::move(scene);
    for (const PrimitiveAttributes& kind : scene.attributes) {
      for (const std::uint32_t material : kind.materials) {
        const auto found = opacity_of_material.find(material);
        scene.opacity_of_primitive.push_back(found == opacity_of_material.end() ? none<std::uint32_t> : found->second);
      }
    }
    return std::move(scene);
  }
};

/// What has a name. Errors: IoError that tells the nearest name there is.
template <typename T>
[[nodiscard]] const T& named(const std::map<std::string, T>& known, const JsonValue& name, std::string_view what) {
  const std::string wanted = name.text();
  const auto found = known.find(wanted);
  if (found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : known) names.push_back(entry.first);
  name.fail("there is no " + std::string(what) + " named \"" + wanted + "\"" + suggestion(wanted, names));
}

/// Reads a file whose path stands in the scene, relative to the scene's folder; `read(path)` does it.
///
/// Ensures:  the file is noted as an input.
/// Errors:   IoError with the place in the scene and what the reader said.
template <typename Read>
[[nodiscard]] auto read_named_file(SceneDraft& draft, const JsonValue& name, Read&& read) {
  std::string portable = name.text();
  std::replace(portable.begin(), portable.end(), '\\', '/');  // as written on Windows
  if (portable.empty()) name.fail_expected("the path of a file");
  const std::filesystem::path path = name.source().path.parent_path() / portable;
  draft.scene.inputs.push_back(path);
  try {
    return read(path);
  } catch (const IoError& error) {
    name.fail(error.what());
  }
}

/// Sixteen numbers, row by row, the last row 0 0 0 1.
[[nodiscard]] inline Affine<float> affine_of(const JsonValue& transform) {
  const auto affine = Affine<float>::from_row_major(std::span<const float, 16>(transform.numbers(16)));
  if (!affine) transform.fail("found " + transform.json().dump() + ", expected a last row of 0, 0, 0, 1");
  return *affine;
}

/// A vector with a length.
[[nodiscard]] inline Vec3<float> direction_of(const JsonValue& direction) {
  const Vec3<float> result = direction.vec3();
  if (!(length_squared(result) > 0)) direction.fail_expected("a vector that is not zero");
  return result;
}

}  // namespace glint::detail
