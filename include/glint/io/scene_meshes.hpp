// SPDX-License-Identifier: MIT
#pragma once
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
#include <glint/io/error.hpp>
#include <glint/io/image.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/mesh_obj.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_mtl.hpp>
#include <glint/math/affine.hpp>

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

/// The light that a whole mesh is. Nothing where it has no area.
[[nodiscard]] inline std::optional<AreaLight<TriangleSampler>> mesh_light(const MeshBuffers<float>& mesh,
                                                                          const Rgb& radiance) {
  std::vector<Triangle<float>> triangles;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    triangles.push_back(
        {mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]]});
  }
  TriangleSampler shape(std::move(triangles));
  if (!(area(shape) > 0)) return std::nullopt;
  return AreaLight<TriangleSampler>{std::move(shape), radiance};
}

/// An OBJ file and, unless the scene names a material for it, its own materials and lamps added to the scene.
struct LoadedMesh {
  MeshBuffers<float> buffers;
  std::vector<std::uint32_t> materials;  ///< one a triangle; empty where it has none of its own
  std::vector<std::uint32_t> lights;     ///< one a triangle, or none at all
};

enum class MtlUse : std::uint8_t { Read, Ignore };

/// The triangles of one of the file's materials.
[[nodiscard]] inline MeshBuffers<float> part_of_mesh(const MeshBuffers<float>& mesh,
                                                     const std::vector<std::uint32_t>& material_ids, std::size_t id) {
  MeshBuffers<float> part{.positions = mesh.positions, .normals = {}, .uvs = {}, .indices = {}};
  for (std::size_t i = 0; i < material_ids.size(); ++i) {
    if (material_ids[i] != id) continue;
    for (std::size_t corner = 3 * i; corner < 3 * i + 3; ++corner) part.indices.push_back(mesh.indices[corner]);
  }
  return part;
}

/// The lamps of a placed mesh: one of each material that shines.
inline void add_lamps(LoadedMesh& mesh, const ObjMesh& obj, SceneDraft& draft) {
  for (std::size_t id = 0; id < obj.materials.size(); ++id) {
    if (is_black(obj.materials[id].emission)) continue;
    auto shape = mesh_light(part_of_mesh(mesh.buffers, obj.material_ids, id), obj.materials[id].emission);
    if (!shape) continue;  // no triangle has this material
    const std::uint32_t light = draft.add_light(*std::move(shape));
    mesh.lights.resize(obj.material_ids.size(), none<std::uint32_t>);
    for (std::size_t i = 0; i < obj.material_ids.size(); ++i) {
      if (obj.material_ids[i] == id) mesh.lights[i] = light;
    }
  }
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
