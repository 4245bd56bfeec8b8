// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <glint/color/image.hpp>
#include <glint/core/index.hpp>
#include <glint/io/error.hpp>
#include <glint/io/file.hpp>
#include <glint/io/image.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/mesh_obj.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/math/affine.hpp>

namespace glint {

struct SceneReadOptions {
  std::vector<std::string> overrides{};  ///< JSON texts, merged into the file one after the other
  std::string integrator{};              ///< replaces /integrator/type, where not empty
  bool strict = false;                   ///< unknown keys are errors
};

namespace detail {

/// JSON from text. Errors: IoError with line and column.
[[nodiscard]] inline nlohmann::json parse_json(const std::filesystem::path& path, const std::string& text) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    std::string reason = error.what();
    if (const auto colon = reason.find("syntax error"); colon != std::string::npos) reason = reason.substr(colon);
    throw IoError(path, static_cast<std::size_t>(line), "is not JSON: " + reason);
  }
}

/// Objects key by key; everything else, arrays included, replaced.
inline void merge_json(nlohmann::json& target, const nlohmann::json& source) {
  if (!target.is_object() || !source.is_object()) {
    target = source;
    return;
  }
  for (const auto& [key, value] : source.items()) merge_json(target[key], value);
}

/// Turns the JSON of a scene into a SceneFile, part by part.
class SceneJsonReader {
 public:
  SceneJsonReader(SceneFile& scene, JsonSource& source) : scene_(scene), source_(source) {}

  void read(const nlohmann::json& json) {
    JsonObject top(JsonValue(json, "", source_));
    const bool lists_lights = top.has("lights");
    scene_.integrator = read_integrator(JsonObject(top.require("integrator")), lists_lights);
    scene_.film = read_film(JsonObject(top.require("film")));
    scene_.camera = read_camera(JsonObject(top.require("camera")));
    if (const auto sampler = top.find("sampler")) scene_.sampler = read_sampler(JsonObject(*sampler));
    if (const auto found = top.find("accelerator")) scene_.accelerator = read_accelerator(JsonObject(*found));
    if (const auto textures = top.find("textures")) read_textures(JsonObject(*textures));
    if (const auto materials = top.find("materials")) read_materials(JsonObject(*materials));
    for (const JsonValue& object : top.items("objects")) read_object(JsonObject(object));
    for (const JsonValue& light : top.items("lights")) read_light(JsonObject(light));
    if (const auto environment = top.find("environment_map")) read_environment(JsonObject(*environment));
    for (const PointLight& light : scene_.integrator.point_lights) scene_.lights.emplace_back(light);
    top.finish();
  }

 private:
  static constexpr std::uint32_t no_light = none<std::uint32_t>;
  enum Kind : std::size_t { Triangles, Spheres, Disks, Quads };

  /// What an object is made of and whether it shines.
  struct Attributes {
    std::uint32_t material = 0;
    std::optional<Rgb> radiance;
  };

  /// A path of the file, which is relative to the file's folder; noted as read.
  [[nodiscard]] std::filesystem::path resolved(const std::string& path) {
    scene_.inputs.push_back(source_.path.parent_path() / path);
    return scene_.inputs.back();
  }

  // Textures.

  [[nodiscard]] static UvMapping read_mapping(JsonObject& texture) {
    const auto found = texture.find("tex_coordinate_generator");
    if (!found) return {};
    JsonObject mapping(*found);
    static constexpr std::array<std::pair<std::string_view, int>, 1> kinds{{{"uvmapping2d", 0}}};
    (void)choice_or(mapping, "type", 0, kinds);
    const UvMapping result{mapping.vec2_or("scale", {1, 1}), mapping.vec2_or("delta", {0, 0})};
    mapping.finish();
    return result;
  }

  [[nodiscard]] std::shared_ptr<const Image> read_texture_image(const JsonValue& path, Encoding encoding) {
    try {
      return std::make_shared<const Image>(read_image(resolved(path.text()), encoding));
    } catch (const IoError& error) {
      path.fail(error.what());
    }
  }

  [[nodiscard]] SceneTexture read_texture(JsonObject object) {
    enum class TextureKind : std::uint8_t { Constant, Checkerboard, Image };
    static constexpr std::array<std::pair<std::string_view, TextureKind>, 3> kinds{
        {{"constant", TextureKind::Constant},
         {"checkerboard", TextureKind::Checkerboard},
         {"image", TextureKind::Image}}};
    static constexpr std::array<std::pair<std::string_view, Encoding>, 2> encodings{
        {{"srgb", Encoding::Srgb}, {"linear", Encoding::Linear}}};
    const auto kind = choice(object.require("type"), kinds);
    SceneTexture result = ConstantTexture{};
    if (kind == TextureKind::Constant) {
      result = ConstantTexture{object.require("color").color()};
    } else if (kind == TextureKind::Checkerboard) {
      result = Checkerboard{object.color_or("color0", 0.4F), object.color_or("color1", 0.2F), read_mapping(object)};
    } else {
      const auto encoding = choice_or(object, "encoding", Encoding::Srgb, encodings);
      auto image = read_texture_image(object.require("path"), encoding);
      result = ImageTexture{.image = std::move(image), .mapping = read_mapping(object)};
    }
    object.finish();
    return result;
  }

  void read_textures(JsonObject object) {
    for (auto& [name, value] : object.members()) textures_.emplace(name, read_texture(JsonObject(value)));
  }

  template <typename T>
  [[nodiscard]] static const T& named(const std::map<std::string, T>& known, const JsonValue& name,
                                      std::string_view what) {
    const auto found = known.find(name.text());
    if (found != known.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& entry : known) names.push_back(entry.first);
    name.fail("there is no " + std::string(what) + " named \"" + name.text() + "\"" + suggestion(name.text(), names));
  }

  // Materials.

  /// The texture a material names, or in the legacy spelling the color it holds under `legacy_key`.
  [[nodiscard]] SceneTexture material_texture(JsonObject& material, const std::string& legacy_key) {
    if (!material.has("texture_name") && material.has(legacy_key)) {
      const JsonValue legacy = material.require(legacy_key);
      source_.warn(legacy.pointer(), "legacy spelling, better: a constant texture named in \"texture_name\"");
      return ConstantTexture{legacy.color()};
    }
    material.ignore({legacy_key.c_str()});
    return named(textures_, material.require("texture_name"), "texture");
  }

  [[nodiscard]] SceneMaterial read_diffuse(JsonObject& object) {
    const SceneDiffuse diffuse{.texture = material_texture(object, "color")};
    if (object.flag_or("twosided", false)) return TwoSidedMaterial<SceneDiffuse>{diffuse};
    return diffuse;
  }

  [[nodiscard]] SceneMaterial read_rough_conductor(JsonObject& object) {
    const Rgb outside = object.color_or("etaI", 1);
    SceneRoughConductor result{.texture = material_texture(object, "R")};
    result.base.distribution = {object.positive_or("alpha_x", 0.1F), object.positive_or("alpha_y", 0.1F)};
    result.base.eta = object.color_or("etaT", 1) / outside;
    result.base.k = object.color_or("k", 1) / outside;
    if (!is_finite(result.base.eta) || !is_finite(result.base.k)) object.fail("\"etaI\" has to be above 0");
    return result;
  }

  [[nodiscard]] SceneMaterial read_material(JsonObject object) {
    enum class MaterialKind : std::uint8_t { Diffuse, Refraction, Glass, Mirror, RoughConductor };
    static constexpr std::array<std::pair<std::string_view, MaterialKind>, 5> kinds{
        {{"diffuse", MaterialKind::Diffuse},
         {"refraction", MaterialKind::Refraction},
         {"glass", MaterialKind::Glass},
         {"mirror", MaterialKind::Mirror},
         {"roughconductor", MaterialKind::RoughConductor}}};
    const auto kind = choice_or(object, "type", MaterialKind::Diffuse, kinds);
    SceneMaterial result = PerfectRefraction{};
    if (kind == MaterialKind::Refraction) {
      result = PerfectRefraction{.eta = object.positive_or("eta", 1.5F)};
    } else if (kind == MaterialKind::Glass) {
      result = Dielectric{object.color_or("R", 1), object.color_or("T", 1), object.positive_or("eta", 1.5F)};
    } else if (kind == MaterialKind::Mirror) {
      result = Mirror{object.color_or("R", 1)};
    } else if (kind == MaterialKind::RoughConductor) {
      result = read_rough_conductor(object);
    } else {
      result = read_diffuse(object);
    }
    object.finish();
    return result;
  }

  void read_materials(JsonObject object) {
    for (auto& [name, value] : object.members()) {
      materials_.emplace(name, add_material(read_material(JsonObject(value))));
    }
  }

  std::uint32_t add_material(const SceneMaterial& material) {
    scene_.materials.push_back(material);
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }

  /// What lamps without a material are made of.
  [[nodiscard]] std::uint32_t black() {
    if (!black_) black_ = add_material(SceneDiffuse{.texture = ConstantTexture{0}});
    return *black_;
  }

  // Objects.

  [[nodiscard]] static Rgb read_area_light(JsonObject light) {
    static constexpr std::array<std::pair<std::string_view, int>, 1> kinds{{{"area", 0}}};
    (void)choice_or(light, "type", 0, kinds);
    const Rgb radiance = light.color_or("radiance", 1);
    light.finish();
    return radiance;
  }

  [[nodiscard]] Attributes read_attributes(JsonObject& object) {
    Attributes result;
    if (const auto light = object.find("light")) result.radiance = read_area_light(JsonObject(*light));
    const auto name = object.find("material_name");
    if (!name && !result.radiance) {
      object.fail("the keys \"material_name\" and \"light\" are both missing, expected one of them");
    }
    result.material = name ? named(materials_, *name, "material") : black();
    return result;
  }

  /// Registers a light over a shape and returns its index.
  template <typename Shape>
  [[nodiscard]] std::uint32_t add_light(const std::optional<Rgb>& radiance, const Shape& shape) {
    if (!radiance) return no_light;
    scene_.lights.emplace_back(AreaLight<Shape>{shape, *radiance});
    return static_cast<std::uint32_t>(scene_.lights.size() - 1);
  }

  template <typename Shape>
  void add_shape(Kind kind, std::vector<Shape>& shapes, const Shape& shape, const Attributes& attributes) {
    shapes.push_back(shape);
    scene_.attributes[kind].materials.push_back(attributes.material);
    scene_.attributes[kind].lights.push_back(add_light(attributes.radiance, shape));
  }

  [[nodiscard]] static Affine<float> read_placement(JsonObject& object) {
    Affine<float> result;
    if (const auto transform = object.find("transform")) {
      const auto affine = Affine<float>::from_row_major(std::span<const float, 16>(transform->numbers(16)));
      if (!affine) transform->fail("the last row of a transform has to be 0 0 0 1");
      result = *affine;
    }
    result.translation += object.vec3_or("translate", Vec3<float>(0));
    return result;
  }

  void read_object(JsonObject object) {
    enum class ObjectKind : std::uint8_t { Mesh, Sphere, Rectangle, Disk };
    static constexpr std::array<std::pair<std::string_view, ObjectKind>, 4> kinds{{{"mesh", ObjectKind::Mesh},
                                                                                   {"sphere", ObjectKind::Sphere},
                                                                                   {"rectangle", ObjectKind::Rectangle},
                                                                                   {"disk", ObjectKind::Disk}}};
    const auto kind = choice(object.require("type"), kinds);
    if (kind == ObjectKind::Mesh) {
      read_mesh(object);
    } else if (kind == ObjectKind::Sphere) {
      const Attributes attributes = read_attributes(object);
      add_shape(Spheres, scene_.spheres, read_sphere(object), attributes);
    } else if (kind == ObjectKind::Disk) {
      const Attributes attributes = read_attributes(object);
      add_shape(Disks, scene_.disks, read_disk(object), attributes);
    } else {
      const Attributes attributes = read_attributes(object);
      add_shape(Quads, scene_.quads, read_rectangle(object), attributes);
    }
    object.finish();
  }

  [[nodiscard]] static Sphere<float> read_sphere(JsonObject& object) {
    return {object.vec3_or("center", Vec3<float>(0)), object.positive_or("radius", 1)};
  }

  [[nodiscard]] static Disk<float> read_disk(JsonObject& object) {
    const Disk<float> disk{object.vec3_or("center", Vec3<float>(0)), object.vec3_or("normal", {0, 0, 1}),
                           object.positive_or("radius", 1)};
    if (!(length_squared(disk.normal) > 0)) object.fail("\"normal\" has no length");
    return disk;
  }

  [[nodiscard]] static Quad<float> read_rectangle(JsonObject& object) {
    const Vec3<float> center = object.vec3_or("center", Vec3<float>(0));
    const Vec3<float> u = object.vec3_or("edge_u", {1, 0, 0});
    const Vec3<float> v = object.vec3_or("edge_v", {0, 1, 0});
    if (!(length_squared(glm::cross(u, v)) > 0)) object.fail("\"edge_u\" and \"edge_v\" span no area");
    return {center - (u + v) * 0.5F, u, v};
  }

  // Meshes.

  /// A mesh's own materials, or the one it is given.
  [[nodiscard]] std::vector<std::uint32_t> mesh_materials(JsonObject& object, const ObjMesh& obj,
                                                          const std::optional<Attributes>& attributes) {
    const std::size_t triangles = obj.buffers.indices.size() / 3;
    if (attributes) return std::vector<std::uint32_t>(triangles, attributes->material);
    std::vector<std::uint32_t> own;
    for (const ObjMaterial& material : obj.materials) own.push_back(add_material(read_mtl(material)));
    std::vector<std::uint32_t> result;
    for (const std::uint32_t id : obj.material_ids) {
      if (id == none<std::uint32_t>) {
        object.fail("without \"material_name\" each face needs a material of the mesh's MTL file, and some have none");
      }
      result.push_back(own[id]);
    }
    return result;
  }

  [[nodiscard]] SceneMaterial read_mtl(const ObjMaterial& material) {
    SceneDiffuse diffuse{.texture = ConstantTexture{material.diffuse}};
    if (!material.diffuse_map.empty()) {
      scene_.inputs.emplace_back(material.diffuse_map);
      diffuse.texture = ImageTexture{.image = std::make_shared<const Image>(read_image(material.diffuse_map))};
    }
    return TwoSidedMaterial<SceneDiffuse>{diffuse};
  }

  void read_mesh(JsonObject& object) {
    const JsonValue path = object.require("path");
    const Affine<float> placement = read_placement(object);
    ObjMesh obj = load(path);
    const bool own_materials = !obj.materials.empty() && !object.has("material_name") && !object.has("light");
    std::optional<Attributes> attributes;
    if (own_materials) {
      object.ignore({"material_name", "light"});
    } else {
      attributes = read_attributes(object);
    }
    const auto materials = mesh_materials(object, obj, attributes);
    place(obj.buffers, placement, path);
    const std::uint32_t light = attributes ? add_mesh_light(obj.buffers, attributes->radiance, object) : no_light;
    append(obj.buffers);
    auto& of_triangle = scene_.attributes[Triangles];
    of_triangle.materials.insert(of_triangle.materials.end(), materials.begin(), materials.end());
    of_triangle.lights.resize(of_triangle.materials.size(), light);
  }

  [[nodiscard]] ObjMesh load(const JsonValue& path) {
    try {
      ObjMesh result = read_obj(resolved(path.text()));
      for (const std::string& warning : result.warnings) source_.warnings.push_back(warning);
      return result;
    } catch (const IoError& error) {
      path.fail(error.what());
    }
  }

  /// Brings a mesh into the world. Normals go by the inverse transpose; where the winding then disagrees with a
  /// triangle's first normal, as under mirror images, corners 2 and 3 are swapped.
  static void place(MeshBuffers<float>& mesh, const Affine<float>& placement, const JsonValue& path) {
    if (placement == Affine<float>{}) return;
    const auto back = inverse(placement);
    if (!back) path.fail("the mesh is flattened: its transform has no inverse");
    for (Vec3<float>& p : mesh.positions) p = placement.point(p);
    for (Vec3<float>& n : mesh.normals) n = n == Vec3<float>(0) ? n : transform_normal(*back, n);
    if (!mesh.normals.empty()) wind_by_normals(mesh);
  }

  static void wind_by_normals(MeshBuffers<float>& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const Vec3<float>& v0 = mesh.positions[mesh.indices[i]];
      const Vec3<float> e1 = mesh.positions[mesh.indices[i + 1]] - v0;
      const Vec3<float> e2 = mesh.positions[mesh.indices[i + 2]] - v0;
      const float agreement = glm::dot(glm::cross(e1, e2), mesh.normals[mesh.indices[i]]);
      if (agreement < 0) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
  }

  [[nodiscard]] std::uint32_t add_mesh_light(const MeshBuffers<float>& mesh, const std::optional<Rgb>& radiance,
                                             const JsonObject& object) {
    if (!radiance) return no_light;
    std::vector<Triangle<float>> triangles;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      triangles.push_back(
          {mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]]});
    }
    const TriangleSampler shape(std::move(triangles));
    if (!(area(shape) > 0)) object.fail("a mesh without area cannot be a light");
    return add_light(radiance, shape);
  }

  /// Adds a mesh to the scene's one mesh. Attributes that only some meshes have are marked as missing in the others.
  void append(const MeshBuffers<float>& mesh) {
    MeshBuffers<float>& all = scene_.mesh;
    const std::size_t before = all.positions.size();
    const std::size_t after = before + mesh.positions.size();
    if (after > none<std::uint32_t>) throw IoError(source_.path, "the meshes have more than 2^32 vertices together");
    append_attribute(all.normals, mesh.normals, before, after, Vec3<float>(0));
    append_attribute(all.uvs, mesh.uvs, before, after, missing_uv<float>);
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    all.indices.reserve(all.indices.size() + mesh.indices.size());
    for (const std::uint32_t index : mesh.indices) all.indices.push_back(index + static_cast<std::uint32_t>(before));
  }

  template <typename V>
  static void append_attribute(std::vector<V>& all, const std::vector<V>& more, std::size_t before, std::size_t after,
                               const V& missing) {
    if (all.empty() && more.empty()) return;
    all.resize(before, missing);
    all.insert(all.end(), more.begin(), more.end());
    all.resize(after, missing);
  }

  // Lights.

  [[nodiscard]] static SpotLight read_spot(JsonObject& light) {
    SpotLight result{.position = light.require("position").vec3(),
                     .direction = light.require("direction").vec3(),
                     .intensity = light.require("intensity").color()};
    const float cone = light.number_or("cone_angle", 30);
    const float start = light.number_or("falloff_start", 0.8F * cone);
    if (!(length_squared(result.direction) > 0)) light.fail("\"direction\" has no length");
    if (!(start >= 0 && start <= cone && cone <= 180)) {
      light.fail("expected 0 <= \"falloff_start\" <= \"cone_angle\" <= 180 degrees");
    }
    result.cone_angle_radians = radians(cone);
    result.falloff_start_radians = radians(start);
    return result;
  }

  void read_light(JsonObject light) {
    enum class LightKind : std::uint8_t { Point, Spot, Directional, Rectangle };
    static constexpr std::array<std::pair<std::string_view, LightKind>, 4> kinds{
        {{"point", LightKind::Point},
         {"spot", LightKind::Spot},
         {"directional", LightKind::Directional},
         {"rectangle", LightKind::Rectangle}}};
    const auto kind = choice(light.require("type"), kinds);
    if (kind == LightKind::Point) {
      scene_.lights.emplace_back(read_point_light(std::move(light)));
      return;
    }
    if (kind == LightKind::Spot) {
      scene_.lights.emplace_back(read_spot(light));
    } else if (kind == LightKind::Directional) {
      const DirectionalLight sun{light.require("direction").vec3(), light.require("irradiance").color()};
      if (!(length_squared(sun.direction) > 0)) light.fail("\"direction\" has no length");
      scene_.lights.emplace_back(sun);
    } else {
      const Quad<float> quad = read_rectangle(light);
      add_shape(Quads, scene_.quads, quad, {black(), light.require("radiance").color()});
    }
    light.finish();
  }

  /// The table by which directions are chosen is as fine as the image; for other textures, fine enough.
  [[nodiscard]] static Vec2i table_resolution(const SceneTexture& texture) {
    const ImageTexture* image = texture.get_if<ImageTexture>();
    return image == nullptr ? Vec2i{256, 128} : image->image->size();
  }

  void read_environment(JsonObject object) {
    SceneTexture texture = named(textures_, object.require("texture_name"), "texture");
    const float scale = object.number_or("scale", 1);
    if (!(scale >= 0)) object.fail("\"scale\" is below 0");
    Affine<float> to_world;
    if (const auto transform = object.find("transform")) {
      const auto affine = Affine<float>::from_row_major(std::span<const float, 16>(transform->numbers(16)));
      if (!affine || !inverse(*affine)) transform->fail("expected a transform with last row 0 0 0 1 and an inverse");
      to_world = *affine;
    }
    object.finish();
    if (const ImageTexture* image = texture.get_if<ImageTexture>()) {  // the poles are no seam
      ImageTexture clamped = *image;
      clamped.wrap_t = Wrap::Clamp;
      texture = clamped;
    }
    const Vec2i resolution = table_resolution(texture);
    scene_.lights.emplace_back(EnvironmentLight<SceneTexture>(std::move(texture), resolution, scale, to_world.linear));
  }

  SceneFile& scene_;
  JsonSource& source_;
  std::map<std::string, SceneTexture> textures_;
  std::map<std::string, std::uint32_t> materials_;
  std::optional<std::uint32_t> black_;
};

}  // namespace detail

/// Reads a scene and everything it names.
///
/// Errors: IoError that names the file, the line or the JSON pointer, what was found and what was expected.
[[nodiscard]] inline SceneFile read_scene(const std::filesystem::path& path, const SceneReadOptions& options = {}) {
  nlohmann::json json = detail::parse_json(path, read_file(path));
  for (const std::string& text : options.overrides) detail::merge_json(json, detail::parse_json("--override", text));
  if (!options.integrator.empty()) detail::merge_json(json, {{"integrator", {{"type", options.integrator}}}});
  SceneFile scene;
  scene.inputs.push_back(path);
  JsonSource source{.path = path, .strict = options.strict};
  detail::SceneJsonReader(scene, source).read(json);
  scene.warnings = std::move(source.warnings);
  return scene;
}

}  // namespace glint
