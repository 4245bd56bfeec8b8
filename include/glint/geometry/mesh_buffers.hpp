// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>
#include <vector>

#include <glint/math/vec.hpp>

namespace glint {

/// The storage of an indexed triangle mesh: what mesh files are read into and what a TriangleMesh views.
template <std::floating_point T>
struct MeshBuffers {
  std::vector<Vec3<T>> positions;
  std::vector<Vec3<T>> normals;        ///< empty, or one a vertex; a zero vector says that the vertex has none
  std::vector<Vec2<T>> uvs;            ///< empty, or one a vertex
  std::vector<std::uint32_t> indices;  ///< three a triangle

  [[nodiscard]] friend bool operator==(const MeshBuffers&, const MeshBuffers&) = default;
};

}  // namespace glint
