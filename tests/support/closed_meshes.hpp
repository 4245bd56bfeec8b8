// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <glint/geometry/mesh_buffers.hpp>
#include <glint/math/vec.hpp>

namespace glint::testing {

/// Closed meshes around the origin, wound outward, that are star-shaped: every segment from the origin to a point far
/// away crosses the surface exactly once.

template <std::floating_point T>
[[nodiscard]] MeshBuffers<T> tetrahedron() {
  MeshBuffers<T> mesh;
  mesh.positions = {{T(1), T(1), T(1)}, {T(1), T(-1), T(-1)}, {T(-1), T(1), T(-1)}, {T(-1), T(-1), T(1)}};
  mesh.indices = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
  return mesh;
}

template <std::floating_point T>
[[nodiscard]] MeshBuffers<T> octahedron() {
  MeshBuffers<T> mesh;
  mesh.positions = {{T(1), T(0), T(0)},  {T(0), T(1), T(0)},  {T(0), T(0), T(1)},
                    {T(-1), T(0), T(0)}, {T(0), T(-1), T(0)}, {T(0), T(0), T(-1)}};
  mesh.indices = {0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2, 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5};
  return mesh;
}

/// Splits each triangle in four and moves the vertices out to the unit sphere.
template <std::floating_point T>
[[nodiscard]] MeshBuffers<T> subdivided_sphere(int levels) {
  MeshBuffers<T> mesh = octahedron<T>();
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
      if (is_new) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
      return entry->second;
    };
    std::vector<std::uint32_t> finer;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh.indices = std::move(finer);
  }
  return mesh;
}

/// The subdivided sphere with its vertices moved toward and away from the origin at random: folds, slivers, ridges.
template <std::floating_point T>
[[nodiscard]] MeshBuffers<T> rough_sphere(int levels, unsigned seed) {
  MeshBuffers<T> mesh = subdivided_sphere<T>(levels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<T> radius(T(0.3), T(1.5));
  for (Vec3<T>& position : mesh.positions) position *= radius(random);
  return mesh;
}

}  // namespace glint::testing
