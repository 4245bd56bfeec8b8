// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tiny_obj_loader.h>
#include <glm/geometric.hpp>

#include <glint/color/rgb.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/io/error.hpp>
#include <glint/io/file.hpp>
#include <glint/io/obj_check.hpp>
#include <glint/io/polygon.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A material of an MTL file, as its keywords give it. Maps are paths that open from here; empty where there is none.
struct ObjMaterial {
  std::string name{};
  Rgb diffuse{};                         ///< Kd
  Rgb specular{};                        ///< Ks
  Rgb emission{};                        ///< Ke
  Rgb transmission{};                    ///< Tf
  float shininess = 1;                   ///< Ns
  float ior = 1;                         ///< Ni
  float opacity = 1;                     ///< d, or 1 − Tr
  float roughness = 0;                   ///< Pr
  float metallic = 0;                    ///< Pm
  int illumination = 0;                  ///< illum
  std::filesystem::path diffuse_map{};   ///< map_Kd
  std::filesystem::path specular_map{};  ///< map_Ks
  std::filesystem::path emission_map{};  ///< map_Ke
  std::filesystem::path opacity_map{};   ///< map_d
  std::filesystem::path normal_map{};    ///< norm
  std::filesystem::path bump_map{};      ///< bump, map_bump

  [[nodiscard]] friend bool operator==(const ObjMaterial&, const ObjMaterial&) = default;
};

/// What an OBJ file holds, its groups and objects merged.
struct ObjMesh {
  MeshBuffers<float> buffers;
  std::vector<std::uint32_t> material_ids;  ///< one a triangle, into materials; none<std::uint32_t> for no material
  std::vector<ObjMaterial> materials;
  std::vector<std::string> warnings;  ///< what was passed over, such as a missing MTL file

  [[nodiscard]] friend bool operator==(const ObjMesh&, const ObjMesh&) = default;
};

namespace detail {

/// Reads MTL files beside the OBJ file. One that cannot be read is a warning.
class MtlReader final : public tinyobj::MaterialReader {
 public:
  explicit MtlReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials, std::map<std::string, int>* ids,
                  std::string* warnings, std::string* errors) override {
    std::filesystem::path path = folder_ / portable(name);
    try {
      std::istringstream text(read_file(path));
      tinyobj::LoadMtl(ids, materials, &text, warnings, errors);
    } catch (const IoError& error) {
      *warnings += error.what();
      *warnings += '\n';
      return false;
    }
    folders_.resize(materials->size(), path.parent_path());
    return true;
  }

  /// Where the map of a material is.
  [[nodiscard]] std::filesystem::path resolved(std::size_t material, const std::string& map) const {
    return map.empty() ? std::filesystem::path() : folders_[material] / portable(map);
  }

 private:
  /// Files are often written with the separators of Windows.
  [[nodiscard]] static std::string portable(std::string name) {
    for (char& c : name) c = c == '\\' ? '/' : c;
    return name;
  }

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> folders_;  // of each material's file
};

[[nodiscard]] inline std::vector<ObjMaterial> obj_materials(const std::vector<tinyobj::material_t>& parsed,
                                                            const MtlReader& reader) {
  const auto rgb = [](const tinyobj::real_t(&c)[3]) { return Rgb{c[0], c[1], c[2]}; };
  std::vector<ObjMaterial> materials;
  materials.reserve(parsed.size());
  for (const tinyobj::material_t& m : parsed) {
    const auto map = [&](const std::string& name) { return reader.resolved(materials.size(), name); };
    materials.push_back({.name = m.name,
                         .diffuse = rgb(m.diffuse),
                         .specular = rgb(m.specular),
                         .emission = rgb(m.emission),
                         .transmission = rgb(m.transmittance),
                         .shininess = m.shininess,
                         .ior = m.ior,
                         .opacity = m.dissolve,
                         .roughness = m.roughness,
                         .metallic = m.metallic,
                         .illumination = m.illum,
                         .diffuse_map = map(m.diffuse_texname),
                         .specular_map = map(m.specular_texname),
                         .emission_map = map(m.emissive_texname),
                         .opacity_map = map(m.alpha_texname),
                         .normal_map = map(m.normal_texname),
                         .bump_map = map(m.bump_texname)});
  }
  return materials;
}

/// Collects triangles and shares equal corners.
class ObjMeshBuilder {
 public:
  using Corner = tinyobj::index_t;

  ObjMeshBuilder(const tinyobj::attrib_t& attributes, bool with_normals, bool with_uvs)
      : attributes_(attributes),
        with_normals_(with_normals),
        with_uvs_(with_uvs),
        first_(attributes.vertices.size() / 3, none<std::uint32_t>) {}

  [[nodiscard]] Vec3<float> position(const Corner& corner) const noexcept {
    return triple(attributes_.vertices, corner.vertex_index);
  }

  void add_triangle(std::array<Corner, 3> corners) {
    if (disagrees_with_normal(corners)) std::swap(corners[1], corners[2]);
    const bool without_uv =
        corners[0].texcoord_index < 0 || corners[1].texcoord_index < 0 || corners[2].texcoord_index < 0;
    for (int i = 0; i < 3; ++i) {
      Corner& corner = corners[static_cast<std::size_t>(i)];
      if (without_uv) corner.texcoord_index = with_uvs_ ? -1 - i : -1;
      buffers_.indices.push_back(vertex(corner));
    }
  }

  [[nodiscard]] MeshBuffers<float> take() && { return std::move(buffers_); }

 private:
  struct Vertex {
    int uv;
    int normal;
    std::uint32_t next;  // with the same position
  };

  [[nodiscard]] static Vec3<float> triple(const std::vector<float>& values, int index) noexcept {
    const float* const v = values.data() + 3 * static_cast<std::size_t>(index);
    return {v[0], v[1], v[2]};
  }

  [[nodiscard]] bool disagrees_with_normal(const std::array<Corner, 3>& corners) const noexcept {
    if (corners[0].normal_index < 0) return false;
    const auto a = position(corners[0]);
    const auto geometric = glm::cross(position(corners[1]) - a, position(corners[2]) - a);
    return glm::dot(geometric, triple(attributes_.normals, corners[0].normal_index)) < 0;
  }

  [[nodiscard]] Vec2<float> uv(int index) const noexcept {
    if (index < 0) return {index == -1 ? 0 : 1, index == -3 ? 1 : 0};
    const float* const v = attributes_.texcoords.data() + 2 * static_cast<std::size_t>(index);
    return {v[0], v[1]};
  }

  /// The vertex of a corner: the one that is there already, or a new one.
  [[nodiscard]] std::uint32_t vertex(const Corner& corner) {
    std::uint32_t& first = first_[static_cast<std::size_t>(corner.vertex_index)];
    for (std::uint32_t i = first; i != none<std::uint32_t>; i = vertices_[i].next) {
      if (vertices_[i].uv == corner.texcoord_index && vertices_[i].normal == corner.normal_index) return i;
    }
    vertices_.push_back({corner.texcoord_index, corner.normal_index, first});
    first = static_cast<std::uint32_t>(vertices_.size() - 1);
    buffers_.positions.push_back(position(corner));
    if (with_uvs_) buffers_.uvs.push_back(uv(corner.texcoord_index));
    if (with_normals_) {
      buffers_.normals.push_back(corner.normal_index < 0 ? Vec3<float>{0}
                                                         : triple(attributes_.normals, corner.normal_index));
    }
    return first;
  }

  const tinyobj::attrib_t& attributes_;
  bool with_normals_;
  bool with_uvs_;
  std::vector<std::uint32_t> first_;  // of each position, the vertex made last
  std::vector<Vertex> vertices_;
  MeshBuffers<float> buffers_;
};

struct ParsedObj {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
};

/// Whether the parser found the faces that the check did, and only finite positions: `0e999` is a number, but not to
/// it.
[[nodiscard]] inline bool is_as_checked(const ParsedObj& parsed, const std::vector<std::uint32_t>& corner_counts) {
  std::size_t faces = 0;
  std::size_t corners = 0;
  for (const auto& shape : parsed.shapes) {
    faces += shape.mesh.material_ids.size();
    corners += shape.mesh.indices.size();
  }
  return faces == corner_counts.size() &&
         corners == std::accumulate(corner_counts.begin(), corner_counts.end(), std::size_t{0}) &&
         std::ranges::all_of(parsed.attributes.vertices, [](float value) { return std::isfinite(value); });
}

/// A builder that keeps the attributes which any corner has.
[[nodiscard]] inline ObjMeshBuilder builder_for(const ParsedObj& parsed) {
  bool with_normals = false;
  bool with_uvs = false;
  for (const auto& shape : parsed.shapes) {
    for (const auto& corner : shape.mesh.indices) {
      with_normals = with_normals || corner.normal_index >= 0;
      with_uvs = with_uvs || corner.texcoord_index >= 0;
    }
  }
  return ObjMeshBuilder(parsed.attributes, with_normals, with_uvs);
}

/// Cuts every face into triangles. `corner_counts` are those of all faces in the file's order: tinyobjloader's own end
/// at 255, and its triangulation fails for many concave polygons.
inline void triangulate_obj(const ParsedObj& parsed, const std::vector<std::uint32_t>& corner_counts, ObjMesh& mesh) {
  ObjMeshBuilder builder = builder_for(parsed);
  PolygonCutter cutter;
  std::vector<Vec3<float>> corners;
  std::size_t face = 0;
  for (const auto& shape : parsed.shapes) {
    const tinyobj::index_t* first = shape.mesh.indices.data();
    for (const int material : shape.mesh.material_ids) {
      const std::uint32_t count = corner_counts[face++];
      corners.clear();
      for (std::uint32_t i = 0; i < count; ++i) corners.push_back(builder.position(first[i]));
      const auto& triangles = cutter.cut(corners);
      for (const auto& [a, b, c] : triangles) builder.add_triangle({first[a], first[b], first[c]});
      mesh.material_ids.insert(mesh.material_ids.end(), triangles.size(),
                               material < 0 ? none<std::uint32_t> : static_cast<std::uint32_t>(material));
      first += count;
    }
  }
  mesh.buffers = std::move(builder).take();
}

/// The lines of a text, each once, named after the file.
[[nodiscard]] inline std::vector<std::string> distinct_lines(const std::filesystem::path& path,
                                                             const std::string& text) {
  std::vector<std::string> lines;
  std::set<std::string> seen;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && seen.insert(line).second) lines.push_back(path.string() + ": " + line);
  }
  return lines;
}

}  // namespace detail

/// Reads a Wavefront OBJ file, and the MTL files it names, into one indexed mesh.
///
/// Shapes:   corners with the same position, normal and texture coordinate share a vertex. Polygons are cut into
///           triangles. Where a triangle's first normal disagrees with its winding, its corners 2 and 3 are swapped.
///           Normals stay as in the file; corners without one get a zero vector, where others have one. Texture
///           coordinates stay as in the file, v is not flipped; a triangle without them gets (0,0), (1,0), (1,1),
///           where others have them. Points and lines are passed over.
/// Errors:   IoError with the line: unreadable or infinite numbers, indices of what is not there, faces of fewer than 3
///           corners; and for a file without faces. A missing MTL file or material is a warning.
[[nodiscard]] inline ObjMesh read_obj(const std::filesystem::path& path) {
  std::string text = read_file(path);
  const auto corner_counts = detail::ObjCheck(path).corner_counts(text);
  std::istringstream stream(std::move(text));
  detail::ParsedObj parsed;
  detail::MtlReader reader(path.parent_path());
  std::string warnings;
  std::string errors;
  const bool parsable = tinyobj::LoadObj(&parsed.attributes, &parsed.shapes, &parsed.materials, &warnings, &errors,
                                         &stream, &reader, false);
  if (!parsable) throw IoError(path, "cannot be parsed: " + errors);
  if (!detail::is_as_checked(parsed, corner_counts)) throw IoError(path, "cannot be parsed: unusual numbers or lines");
  ObjMesh mesh;
  mesh.materials = detail::obj_materials(parsed.materials, reader);
  mesh.warnings = detail::distinct_lines(path, warnings);
  detail::triangulate_obj(parsed, corner_counts, mesh);
  return mesh;
}

}  // namespace glint
