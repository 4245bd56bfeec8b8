// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/geometry/mesh_buffers.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_scenes.hpp>

/// What scenes are put together from.
namespace glint::bench {

/// The parallelogram of four corners, as two triangles.
inline void add_quad(MeshBuffers<float>& mesh, const Vec3<float>& corner, const Vec3<float>& u, const Vec3<float>& v) {
  testing::detail::add_triangle<float>(mesh, corner, corner + u, corner + u + v);
  testing::detail::add_triangle<float>(mesh, corner, corner + u + v, corner + v);
}

/// A box along three edges.
inline void add_box(MeshBuffers<float>& mesh, const Vec3<float>& corner, const Vec3<float>& u, const Vec3<float>& v,
                    const Vec3<float>& w) {
  add_quad(mesh, corner, u, v);
  add_quad(mesh, corner + w, u, v);
  add_quad(mesh, corner, v, w);
  add_quad(mesh, corner + u, v, w);
  add_quad(mesh, corner, w, u);
  add_quad(mesh, corner + v, w, u);
}

/// A grid of rows × columns quads whose vertices are point(row / rows, column / columns).
template <typename Point>
void add_grid(MeshBuffers<float>& mesh, int rows, int columns, const Point& point) {
  const auto first = std::uint32_t(mesh.positions.size());
  const auto width = std::uint32_t(columns + 1);
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column)
      mesh.positions.push_back(point(float(row) / float(rows), float(column) / float(columns)));
  }
  for (std::uint32_t row = 0; row < std::uint32_t(rows); ++row) {
    for (std::uint32_t column = 0; column + 1 < width; ++column) {
      const std::uint32_t a = first + row * width + column;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + width, a + 1, a + width + 1, a + width});
    }
  }
}

/// A point of an outline: radius and height.
using Outline = std::vector<Vec2<float>>;

/// An outline turned about the vertical through `base`.
inline void add_turned(MeshBuffers<float>& mesh, const Vec3<float>& base, const Outline& outline, float scale,
                       int around) {
  const int rows = int(outline.size()) - 1;
  add_grid(mesh, rows, around, [&](float s, float t) {
    const Vec2<float> at = outline[std::size_t(std::lround(s * float(rows)))] * scale;
    const float angle = 2 * pi<float> * t;
    return base + Vec3<float>{at.x * std::cos(angle), at.y, at.x * std::sin(angle)};
  });
}

/// A tapered tube.
inline void add_tube(MeshBuffers<float>& mesh, const Vec3<float>& from, const Vec3<float>& to, float from_radius,
                     float to_radius, int around) {
  const auto frame = Frame<float>::around(glm::normalize(to - from));
  add_grid(mesh, 1, around, [&](float s, float t) {
    const float angle = 2 * pi<float> * t;
    const float radius = from_radius + (to_radius - from_radius) * s;
    return from + (to - from) * s + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * radius;
  });
}

}  // namespace glint::bench
