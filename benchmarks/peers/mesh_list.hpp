// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <glint/math/vec.hpp>

#include <peers/options.hpp>
#include <support/meshes.hpp>
#include <support/named_mesh.hpp>

/// The meshes that options ask for.
namespace glint::bench {

[[nodiscard]] inline std::vector<std::string> mesh_names(const PeerOptions& options) {
  std::vector<std::string> names;
  for (const std::string& file : options.mesh_files) names.push_back(mesh_name(file));
  if (!names.empty()) return names;
  for (const MeshMaker& maker : mesh_makers()) names.push_back(maker.name);
  for (const std::string& file : files_beside_the_source()) names.push_back(mesh_name(file));
  return names;
}

/// One after another, to `measure(NamedMesh)`. Their last vertex is nobody's: Embree reads beyond the last.
template <typename Measure>
void for_each_mesh(const PeerOptions& options, const Measure& measure) {
  const std::vector<std::string> names = mesh_names(options);
  const auto wanted = [&](const std::string& name) { return is_wanted(options, names, name); };
  const auto hand_over = [&](NamedMesh mesh) {
    mesh.buffers.positions.push_back(Vec3<float>{0.0F});
    measure(mesh);
  };
  for (const std::string& file : options.mesh_files) {
    if (std::error_code error; !std::filesystem::is_regular_file(file, error))
      throw std::runtime_error("there is no file '" + file + "'");
  }
  const bool generated = options.mesh_files.empty();
  for (const std::string& file : generated ? files_beside_the_source() : options.mesh_files) {
    if (wanted(mesh_name(file))) hand_over({mesh_name(file), load_mesh(file)});
  }
  if (!generated) return;
  for (const MeshMaker& maker : mesh_makers()) {
    if (wanted(maker.name)) hand_over(maker.make(std::min(maker.triangles, options.max_triangles)));
  }
}

}  // namespace glint::bench
