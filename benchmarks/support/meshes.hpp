// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <glint/geometry/mesh_buffers.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/forest.hpp>
#include <support/interior.hpp>
#include <support/named_mesh.hpp>

/// Meshes made by rule that stand in for those people render. Equal arguments give equal meshes.
namespace glint::bench {

/// Smooth noise in [−1, 1] from random numbers at the points of a lattice.
class LatticeNoise {
 public:
  explicit LatticeNoise(std::uint64_t seed) : seed_(seed) {}

  [[nodiscard]] float operator()(const Vec3<float>& p) const {
    const Vec3<float> cell = glm::floor(p);
    const Vec3<float> f = p - cell;
    const Vec3<float> s = f * f * f * (f * (f * 6.0F - 15.0F) + 10.0F);
    const auto edge = [&](float y, float z) {
      return glm::mix(at(cell + Vec3<float>{0, y, z}), at(cell + Vec3<float>{1, y, z}), s.x);
    };
    return glm::mix(glm::mix(edge(0, 0), edge(1, 0), s.y), glm::mix(edge(0, 1), edge(1, 1), s.y), s.z);
  }

  /// Octaves, each twice as fine as the one before, and `roughness` times as high.
  [[nodiscard]] float fractal(const Vec3<float>& p, int octaves, float roughness) const {
    float sum = 0;
    float height = 1;
    Vec3<float> q = p;
    for (int i = 0; i < octaves; ++i, height *= roughness, q = q * 2.03F + 7.1F) sum += height * (*this)(q);
    return sum;
  }

 private:
  [[nodiscard]] float at(const Vec3<float>& corner) const {
    const auto word = [](float x) { return std::uint64_t(std::int64_t(x)); };
    const std::uint64_t bits = mix(mix(word(corner.x), word(corner.y)), mix(word(corner.z), seed_));
    return 2 * to_unit_float<float>(bits) - 1;
  }

  std::uint64_t seed_;
};

/// A statue as a scanner sees it: folded and bent on the large, rough down to its triangles, which are about alike.
[[nodiscard]] inline MeshBuffers<float> rough_blob(std::size_t triangles) {
  const auto cuts = std::uint32_t(std::max(1.0, std::sqrt(double(triangles) / 8)));
  const testing::detail::OctahedralGrid grid(cuts);
  const LatticeNoise bend_x(1);
  const LatticeNoise bend_y(2);
  const LatticeNoise bend_z(3);
  const LatticeNoise skin(4);
  MeshBuffers<float> mesh{.positions = grid.directions<float>(), .normals = {}, .uvs = {}, .indices = grid.indices()};
  for (Vec3<float>& p : mesh.positions) {
    const Vec3<float> bend{bend_x.fractal(p * 1.7F, 3, 0.5F), bend_y.fractal(p * 1.7F, 3, 0.5F),
                           bend_z.fractal(p * 1.7F, 3, 0.5F)};
    const float fold = 1 - std::abs(skin.fractal(p * 2.5F, 4, 0.5F));
    const float detail = skin.fractal(p * 12.0F, 7, 0.55F);
    p = p * (0.75F + 0.2F * fold + 0.03F * detail) + bend * 0.35F;
  }
  return mesh;
}

/// Long thin triangles that lie across the axes, like hair, cables and splinters.
[[nodiscard]] inline MeshBuffers<float> splinters(std::size_t triangles) {
  Random random(5);
  MeshBuffers<float> mesh;
  const auto anywhere = [&] { return random.uniform_vec3<float>() * 2.0F - 1.0F; };
  for (std::size_t i = 0; i < triangles; ++i) {
    const Vec3<float> center = anywhere();
    const Vec3<float> diagonal = glm::sign(anywhere()) + anywhere() * 0.4F;
    const Vec3<float> half = diagonal * (0.02F + 0.05F * random.uniform<float>());
    testing::detail::add_triangle<float>(mesh, center - half, center + half, center + anywhere() * 0.002F);
  }
  return mesh;
}

/// A file that is used where it is found beside the source tree.
[[nodiscard]] inline std::vector<std::string> files_beside_the_source() {
  const auto file =
      std::filesystem::path(GLINT_SOURCE_DIR) / ".." / "shared" / "scenes" / "oracles" / "mesh" / "bunny.obj";
  if (std::error_code error; !std::filesystem::exists(file, error)) return {};
  return {file.string()};
}

/// The meshes that peers are measured with.
struct MeshMaker {
  std::string name;
  std::size_t triangles;  ///< about as many
  NamedMesh (*make)(std::size_t triangles);
};

[[nodiscard]] inline std::vector<MeshMaker> mesh_makers() {
  return {
      {"blob70k", 70'000,
       [](std::size_t n) {
         return NamedMesh{"blob70k", rough_blob(n)};
       }},
      {"blob1m", 1'000'000,
       [](std::size_t n) {
         return NamedMesh{"blob1m", rough_blob(n)};
       }},
      {"interior", 250'000,
       [](std::size_t n) {
         return NamedMesh{"interior", interior(n), interior_view()};
       }},
      {"forest", 2'000'000,
       [](std::size_t n) {
         return NamedMesh{"forest", forest(n), forest_view()};
       }},
      {"slivers", 100'000,
       [](std::size_t n) {
         return NamedMesh{"slivers", splinters(n)};
       }},
      {"soup", 200'000,
       [](std::size_t n) {
         return NamedMesh{"soup", testing::triangle_soup<float>(n, 2)};
       }},
  };
}

}  // namespace glint::bench
