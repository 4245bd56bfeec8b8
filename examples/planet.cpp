// SPDX-License-Identifier: MIT
// Double precision, where float does not do: a paved square of cells half a unit wide on a planet of radius 1e7. In
// float its vertices fall together, for numbers there are a unit apart; in double each cell is met where it is.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/vec.hpp>

namespace {

constexpr double radius = 1e7;
constexpr std::uint32_t cells = 64;
constexpr double cell = 0.5;

/// On the plane that touches the planet above its pole, far along x.
glint::Vec3<double> corner(std::uint32_t i, std::uint32_t j) {
  return {radius + cell * i, radius, cell * j};
}

// <region: mesh>
/// Two triangles a cell. The scalar is the mesh's, the tree's and the rays'.
template <typename T>
glint::MeshBuffers<T> pavement() {
  glint::MeshBuffers<T> mesh;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) mesh.positions.emplace_back(glint::Vec3<T>(corner(i, j)));
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i;
      const std::uint32_t c = a + cells + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, c + 1, a, c + 1, c});
    }
  }
  return mesh;
}

/// How many cells a ray from half a unit above their middles finds, and at the right distance.
template <typename T>
std::uint32_t cells_found() {
  const auto mesh = pavement<T>();
  const glint::Bvh bvh{view(mesh)};
  std::uint32_t found = 0;
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const glint::Vec3<double> above = corner(i, j) + glint::Vec3<double>(0.6 * cell, 0.5, 0.3 * cell);
      const auto hit = bvh.closest({.origin = glint::Vec3<T>(above), .direction = {0, -1, 0}});
      if (hit && hit->primitive == 2 * (j * cells + i) && std::abs(double(hit->t) - 0.5) < 1e-8) ++found;
    }
  }
  return found;
}
// </region: mesh>

}  // namespace

int main() {
  const std::uint32_t in_double = cells_found<double>();
  const std::uint32_t in_float = cells_found<float>();
  std::printf("of %u cells of %g units, %g units from the origin: %u found in double, %u in float\n", cells * cells,
              cell, radius, in_double, in_float);
  return in_double == cells * cells && in_float < cells * cells / 2 ? 0 : 1;
}
