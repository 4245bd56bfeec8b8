// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <stdexcept>
#include <string>

#include <glint/geometry/mesh_buffers.hpp>
#include <glint/math/vec.hpp>

#if __has_include(<tiny_obj_loader.h>) && __has_include(<nlohmann/json.hpp>)
#include <glint/io/mesh_obj.hpp>
#endif

namespace glint::bench {

/// Where to look at a mesh from, and where its light is.
struct Viewpoint {
  Vec3<float> eye{0.0F};
  Vec3<float> target{0.0F};
  Vec3<float> light{0.0F};
  float half_width = 0.35F;  ///< of the image, at distance 1
};

struct NamedMesh {
  std::string name;
  MeshBuffers<float> buffers;
  std::optional<Viewpoint> viewpoint{};  ///< none: from outside, at all of it
};

[[nodiscard]] inline MeshBuffers<float> load_mesh(const std::string& file) {
#if __has_include(<tiny_obj_loader.h>) && __has_include(<nlohmann/json.hpp>)
  return read_obj(file).buffers;
#else
  throw std::runtime_error(file + ": built without tinyobjloader");
#endif
}

/// What is left of a file's name without its directory and ending.
[[nodiscard]] inline std::string mesh_name(const std::string& file) {
  const std::string name = file.substr(file.find_last_of('/') + 1);
  return name.substr(0, name.find_last_of('.'));
}

}  // namespace glint::bench
