// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/core/index.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_meshes.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/math/affine.hpp>

/// The part "objects" of a scene file.
namespace glint::detail {

/// The order of SceneFile::shapes.
enum ShapeKind : std::size_t { Triangles, Spheres, Disks, Quads };

/// What an object is made of and whether it shines.
struct ObjectAttributes {
  std::uint32_t material = 0;
  std::optional<Rgb> radiance{};
};

[[nodiscard]] inline Rgb read_emission(JsonObject light) {
  require_type(light, "area");
  const Rgb radiance = light.color_or("radiance", 1);
  light.finish();
  return radiance;
}

[[nodiscard]] inline ObjectAttributes read_attributes(JsonObject& object, SceneDraft& draft) {
  ObjectAttributes result;
  if (const auto light = object.find("light")) result.radiance = read_emission(JsonObject(*light));
  const auto name = object.find("material_name");
  if (!name && !result.radiance) {
    object.fail("the keys \"material_name\" and \"light\" are both missing, expected one of them");
  }
  result.material = name ? named(draft.materials, *name, "material") : draft.black_material();
  if (result.radiance && draft.opacity_of_material.contains(result.material)) {
    name->fail("what shines is opaque, but the material \"" + name->text() + "\" has \"opacity\"");
  }
  return result;
}

/// Adds a shape, and the light that it is.
template <typename Shape>
void add_shape(SceneDraft& draft, ShapeKind kind, std::vector<Shape>& shapes, const Shape& shape,
               const ObjectAttributes& attributes) {
  shapes.push_back(shape);
  draft.scene.attributes[kind].materials.push_back(attributes.material);
  draft.scene.attributes[kind].lights.push_back(
      attributes.radiance ? draft.add_light(AreaLight<Shape>{shape, *attributes.radiance}) : none<std::uint32_t>);
}

[[nodiscard]] inline Sphere<float> read_sphere(JsonObject& object) {
  return {object.vec3_or("center", Vec3<float>(0)), object.positive_or("radius", 1)};
}

[[nodiscard]] inline Disk<float> read_disk(JsonObject& object) {
  return {object.vec3_or("center", Vec3<float>(0)), object.read_or("normal", Vec3<float>{0, 0, 1}, direction_of),
          object.positive_or("radius", 1)};
}

/// The two edges are full lengths; the normal is edge_u × edge_v.
[[nodiscard]] inline Quad<float> read_rectangle(JsonObject& object) {
  const Vec3<float> center = object.vec3_or("center", Vec3<float>(0));
  const Vec3<float> u = object.vec3_or("edge_u", {1, 0, 0});
  const Vec3<float> v = object.vec3_or("edge_v", {0, 1, 0});
  const Quad<float> quad{center - (u + v) * 0.5F, u, v};
  if (!spans_area<float>(glm::cross(u, v), quad)) object.fail("\"edge_u\" and \"edge_v\" span no area");
  return quad;
}

/// p' = transform · p + translate.
[[nodiscard]] inline Affine<float> read_placement(JsonObject& object) {
  Affine<float> result;
  if (const auto transform = object.find("transform")) {
    result = affine_of(*transform);
    if (!inverse(result)) object.source().warn(transform->pointer(), "flattens the mesh: it has no inverse");
  }
  result.translation += object.vec3_or("translate", Vec3<float>(0));
  return result;
}

/// What every triangle of a mesh is made of and which light it is, as the scene says.
inline void attribute_mesh(LoadedMesh& mesh, JsonObject& object, SceneDraft& draft) {
  const ObjectAttributes attributes = read_attributes(object, draft);
  mesh.materials.assign(mesh.buffers.indices.size() / 3, attributes.material);
  if (!attributes.radiance) return;
  mesh.lights = add_mesh_lights(
      mesh.buffers, [&](std::uint32_t /*triangle*/) { return attributes.radiance; }, draft);
  const bool shines =
      std::any_of(mesh.lights.begin(), mesh.lights.end(), [](auto i) { return i != none<std::uint32_t>; });
  if (!shines) object.fail("a mesh without area cannot be a light");
}

inline void read_mesh(JsonObject& object, SceneDraft& draft) {
  const JsonValue path = object.require("path");
  const Affine<float> placement = read_placement(object);
  const MtlUse use = object.has("material_name") || object.has("light") ? MtlUse::Ignore : MtlUse::Read;
  LoadedMesh mesh = read_named_file(
      draft, path, [&](const auto& file) { return load_obj(file, use, placement, draft, object.source()); });
  if (mesh.materials.empty()) attribute_mesh(mesh, object, draft);

  SceneFile& scene = draft.scene;
  if (scene.mesh.positions.size() + mesh.buffers.positions.size() > none<std::uint32_t>) {
    path.fail("the meshes have more than 2^32 vertices together");
  }
  append_mesh(scene.mesh, mesh.buffers);
  auto& [materials, lights] = scene.attributes[Triangles];
  lights.insert(lights.end(), mesh.lights.begin(), mesh.lights.end());
  materials.insert(materials.end(), mesh.materials.begin(), mesh.materials.end());
  lights.resize(materials.size(), none<std::uint32_t>);
}

inline void read_object(JsonObject object, SceneDraft& draft) {
  static constexpr std::array<std::pair<std::string_view, ShapeKind>, 4> kinds{
      {{"mesh", Triangles}, {"sphere", Spheres}, {"rectangle", Quads}, {"disk", Disks}}};
  const ShapeKind kind = choice(object.require("type"), kinds);
  if (kind == Triangles) {
    read_mesh(object, draft);
  } else {
    SceneFile& scene = draft.scene;
    const ObjectAttributes attributes = read_attributes(object, draft);
    if (kind == Spheres) add_shape(draft, kind, scene.spheres, read_sphere(object), attributes);
    if (kind == Disks) add_shape(draft, kind, scene.disks, read_disk(object), attributes);
    if (kind == Quads) add_shape(draft, kind, scene.quads, read_rectangle(object), attributes);
  }
  object.finish();
}

}  // namespace glint::detail
