// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/color/rgb.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/io/error.hpp>
#include <glint/io/image.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/mesh_obj.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_mtl.hpp>
#include <glint/light/area.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

/// Meshes on their way from files into a scene.
namespace glint::detail {

/// Where the winding disagrees with a triangle's first normal, corners 2 and 3 are swapped.
inline void wind_by_normals(MeshBuffers<float>& mesh) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vec3<float>& v0 = mesh.positions[mesh.indices[i]];
    const Vec3<float> e1 = mesh.positions[mesh.indices[i + 1]] - v0;
    const Vec3<float> e2 = mesh.positions[mesh.indices[i + 2]] - v0;
    const float agreement = glm::dot(glm::cross(e1, e2), mesh.normals[mesh.indices[i]]);
    if (agreement < 0) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
}

/// Brings a mesh into the world. Normals go by the inverse transpose, and the winding follows them, under mirror images
/// too. A mesh that is flattened keeps no normals but those of its triangles.
inline void place_mesh(MeshBuffers<float>& mesh, const Affine<float>& placement) {
  if (placement == Affine<float>{}) return;
  for (Vec3<float>& p : mesh.positions) p = placement.point(p);
  if (mesh.normals.empty()) return;
  const auto back = inverse(placement);
  if (!back) {
    mesh.normals.clear();
    return;
  }
  for (Vec3<float>& n : mesh.normals) {
    if (n != Vec3<float>(0)) n = transform_normal(*back, n);
  }
  wind_by_normals(mesh);
}

template <typename V>
void append_attribute(std::vector<V>& all, const std::vector<V>& more, std::size_t before, std::size_t after,
                      const V& missing) {
  if (all.empty() && more.empty()) return;
  all.resize(before, missing);
  all.insert(all.end(), more.begin(), more.end());
  all.resize(after, missing);
}

/// Adds a mesh to another. Attributes that only one of them has are marked as missing in the other.
///
/// Requires: together they have fewer than 2³² vertices.
inline void append_mesh(MeshBuffers<float>& all, const MeshBuffers<float>& mesh) {
  const std::size_t before = all.positions.size();
  const std::size_t after = before + mesh.positions.size();
  append_attribute(all.normals, mesh.normals, before, after, Vec3<float>(0));
  append_attribute(all.uvs, mesh.uvs, before, after, missing_uv<float>);
  all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
  all.indices.reserve(all.indices.size() + mesh.indices.size());
  for (const std::uint32_t index : mesh.indices) all.indices.push_back(index + static_cast<std::uint32_t>(before));
}

/// The parallelogram that two triangles are the halves of, with their winding. Nothing where they are not.
[[nodiscard]] inline std::optional<Quad<float>> quad_of(const Triangle<float>& first, const Triangle<float>& second) {
  const std::array a{first.v0, first.v1, first.v2};
  const std::array b{second.v0, second.v1, second.v2};
  for (std::size_t i = 0; i < 9; ++i) {
    const Vec3<float>& begin = a[i % 3];  // of an edge, which the other triangle has the other way round
    const Vec3<float>& end = a[(i + 1) % 3];
    const Vec3<float>& corner = a[(i + 2) % 3];
    if (b[i / 3] != end || b[(i / 3 + 1) % 3] != begin) continue;
    const Quad<float> quad{corner, begin - corner, end - corner};
    const Vec3<float> gap = abs(quad.origin + (quad.edge_u + quad.edge_v) - b[(i / 3 + 2) % 3]);
    const Vec3<float> magnitude = abs(begin) + abs(end) + abs(corner);
    if (max_component(gap) <= rounding_bound<float>(4) * max_component(magnitude)) return quad;
  }
  return std::nullopt;
}

/// Adds the lights that triangles of a mesh are, and returns which one each is. Two in a row that are one parallelogram
/// shine as one, the others each by itself, those without area not at all.
///
/// Shapes: radiance_of(triangle) is an optional Rgb, empty where it does not shine.
template <typename RadianceOf>
[[nodiscard]] std::vector<std::uint32_t> add_mesh_lights(const MeshBuffers<float>& mesh, const RadianceOf& radiance_of,
                                                         SceneDraft& draft) {
  const auto shape = view(mesh);
  const auto count = static_cast<std::uint32_t>(shape.size());
  std::vector<std::uint32_t> lights(count, none<std::uint32_t>);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Triangle<float> triangle = shape.triangle(i);
    const std::optional<Rgb> radiance = radiance_of(i);
    const float size = area(triangle);
    if (!radiance || !(size > 0 && size < infinity<float>)) continue;
    const bool in_pair = i + 1 < count && radiance_of(i + 1) == radiance;
    const auto quad = in_pair ? quad_of(triangle, shape.triangle(i + 1)) : std::nullopt;
    if (quad) {
      lights[i] = lights[i + 1] = draft.add_light(AreaLight<Quad<float>>{*quad, *radiance});
      ++i;
    } else {
      lights[i] = draft.add_light(AreaLight<Triangle<float>>{triangle, *radiance});
    }
  }
  return lights;
}

/// An OBJ file and, unless the scene names a material for it, its own materials and lamps added to the scene.
struct LoadedMesh {
  MeshBuffers<float> buffers;
  std::vector<std::uint32_t> materials;  ///< one a triangle; empty where it has none of its own
  std::vector<std::uint32_t> lights;     ///< one a triangle, or empty where none shines
};

enum class MtlUse : std::uint8_t { Read, Ignore };

/// The lamps of a placed mesh: the triangles whose material shines.
inline void add_lamps(LoadedMesh& mesh, const ObjMesh& obj, SceneDraft& draft) {
  const auto radiance_of = [&](std::uint32_t triangle) -> std::optional<Rgb> {
    const Rgb& emission = obj.materials[obj.material_ids[triangle]].emission;
    return is_black(emission) ? std::nullopt : std::optional(emission);
  };
  mesh.lights = add_mesh_lights(mesh.buffers, radiance_of, draft);
}

/// Reads and places a mesh.
[[nodiscard]] inline LoadedMesh load_obj(const std::filesystem::path& path, MtlUse use, const Affine<float>& placement,
                                         SceneDraft& draft, JsonSource& source) {
  if (lower_case_extension(path) != ".obj") throw IoError(path, "cannot be read as a mesh: expected .obj");
  ObjMesh obj = read_obj(path);
  LoadedMesh result{.buffers = std::move(obj.buffers), .materials = {}, .lights = {}};
  place_mesh(result.buffers, placement);
  if (use == MtlUse::Ignore) return result;
  source.warnings.insert(source.warnings.end(), obj.warnings.begin(), obj.warnings.end());
  if (obj.materials.empty()) {
    if (!obj.warnings.empty()) throw IoError(path, "has no materials, and the scene names none: " + obj.warnings[0]);
    return result;
  }
  MtlMaterials own(draft, source);
  std::vector<std::uint32_t> added;
  for (const ObjMaterial& material : obj.materials) added.push_back(own.add(material));
  for (const std::uint32_t id : obj.material_ids) {
    if (id == none<std::uint32_t>) throw IoError(path, "has faces without a material, expected one for each face");
    result.materials.push_back(added[id]);
  }
  add_lamps(result, obj, draft);
  return result;
}

}  // namespace glint::detail
