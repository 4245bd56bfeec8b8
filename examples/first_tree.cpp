// SPDX-License-Identifier: MIT
// A tree over a mesh in buffers of one's own: the torus it finds is drawn in letters.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/constants.hpp>

namespace {

// <region: buffers>
struct Vertex {  // as some other program may have it
  std::uint32_t color = 0xFFFFFFFF;
  glm::vec3 position{0};
};
using Corners = std::array<std::uint16_t, 3>;

struct Torus {
  std::vector<Vertex> vertices;
  std::vector<Corners> triangles;
};
// </region: buffers>

Torus torus(int around, int across) {
  Torus result;
  const auto index = [&](int i, int j) { return static_cast<std::uint16_t>(i % around * across + j % across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const float u = 2 * glint::pi<float> * static_cast<float>(i) / static_cast<float>(around);
      const float v = 2 * glint::pi<float> * static_cast<float>(j) / static_cast<float>(across);
      const float r = 1 + 0.4F * std::cos(v);
      result.vertices.push_back({.position = {r * std::cos(u), r * std::sin(u), 0.4F * std::sin(v)}});
      result.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      result.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return result;
}

}  // namespace

int main() {
  const Torus buffers = torus(64, 32);
  // <region: tree>
  const glint::TriangleMesh<float, std::uint16_t> mesh{
      .positions = glint::strided_member(std::span(buffers.vertices), &Vertex::position),
      .triangles = buffers.triangles};
  const glint::Bvh bvh{mesh};
  // </region: tree>

  // <region: rays>
  constexpr int width = 72;
  constexpr int height = 28;
  const auto camera = glint::Perspective{.eye = {0, -2.6F, 2.2F}, .target = {0, 0, 0}}.rays(1.3F);
  for (int y = 0; y < height; ++y) {
    std::string line(width, ' ');
    for (int x = 0; x < width; ++x) {
      const glm::vec2 film{(static_cast<float>(x) + 0.5F) / width, 1 - (static_cast<float>(y) + 0.5F) / height};
      const auto ray = camera.ray(film, {});
      const auto hit = bvh.closest(ray);
      if (!hit) continue;
      const float facing = -glm::dot(bvh.surface(ray, *hit).normal, ray.direction);
      line[static_cast<std::size_t>(x)] = ".:-=+*#%@"[static_cast<int>(8 * std::abs(facing))];
    }
    std::puts(line.c_str());
  }
  // </region: rays>
  std::printf("%zu triangles, %zu leaves, %zu bytes\n", mesh.size(), bvh.statistics().leaves, bvh.bytes());
}
