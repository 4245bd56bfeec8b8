// SPDX-License-Identifier: MIT
// Leaves cut out of rectangles: rays pass where the filter says that there is no leaf, and so do those that ask for
// shadow. A ball hangs behind them, in the same tree.
#include <cstdio>
#include <string>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>

namespace {

/// Three by three squares side by side, each with the texture coordinates of a whole leaf.
glint::MeshBuffers<float> squares() {
  glint::MeshBuffers<float> buffers;
  for (unsigned i = 0; i < 9; ++i) {
    const unsigned row = i / 3;
    const unsigned column = i % 3;
    const glm::vec3 corner{float(column) * 2 - 3, float(row) * 2 - 3, 0.3F * float(i % 2)};
    for (const glm::vec2 uv : {glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      buffers.positions.push_back(corner + glm::vec3(uv * 2.0F, 0));
      buffers.uvs.emplace_back(uv);
    }
    for (const unsigned k : {0U, 1U, 2U, 0U, 2U, 3U}) buffers.indices.push_back(4 * i + k);
  }
  return buffers;
}

}  // namespace

int main() {
  const glint::MeshBuffers<float> buffers = squares();
  const std::vector<glint::Sphere<float>> balls{{.center = {0, 0, -2}, .radius = 1.5F}};

  // <region: filter>
  const auto mesh = view(buffers);
  const auto is_leaf = [mesh](const glint::Ray<float>& ray, const glint::Hit<float>& hit) {
    const glm::vec2 p = mesh.surface(ray, hit).uv - 0.5F;
    return p.x * p.x + p.y * p.y < 0.2F;  // or look up the alpha of a texture
  };
  const glint::Bvh world{glint::Joined{glint::Filtered{mesh, is_leaf}, glint::Elements{balls}}};
  // </region: filter>

  int leaves = 0;
  int ball = 0;
  std::string picture;
  for (int y = 11; y >= -12; --y) {
    for (int x = -24; x < 24; ++x) {
      const glint::Ray<float> ray{.origin = {float(x) / 8 + 0.06F, float(y) / 4 + 0.13F, 5}, .direction = {0, 0, -1}};
      const auto hit = world.closest(ray);
      if (world.occluded(ray) != hit.has_value()) return 1;
      // <region: locate>
      const bool is_ball = hit && world.set().locate(hit->primitive).set == 1;
      // </region: locate>
      leaves += int(hit && !is_ball);
      ball += int(is_ball);
      picture += !hit ? ' ' : is_ball ? 'o' : '#';
    }
    picture += '\n';
  }
  std::printf("%s%d pixels of leaves, %d of the ball between them\n", picture.c_str(), leaves, ball);
  // A disk of radius √0.2 covers 0.63 of its square, and the ball is seen through what is left of the middle.
  return leaves > 650 && leaves < 800 && ball > 40 ? 0 : 1;
}
