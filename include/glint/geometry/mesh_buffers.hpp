// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>
#include <limits>
#include <vector>

#include <glint/math/vec.hpp>

namespace glint {

/// The texture coordinates of a vertex that has none.
template <std::floating_point T>
inline constexpr Vec2<T> missing_uv{std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN()};

/// The storage of an indexed triangle mesh: what mesh files are read into and what a TriangleMesh views.
template <std::floating_point T>
struct MeshBuffers {
  std::vector<Vec3<T>> positions;
  std::vector<Vec3<T>> normals;        ///< empty, or one a vertex; a zero vector says that the vertex has none
  std::vector<Vec2<T>> uvs;            ///< empty, or one a vertex; missing_uv says that the vertex has none
  std::vector<std::uint32_t> indices;  ///< three a triangle

  [[nodiscard]] friend bool operator==(const MeshBuffers&, const MeshBuffers&) = default;
};

}  // namespace glint
