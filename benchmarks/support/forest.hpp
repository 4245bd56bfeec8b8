// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>

#include <glint/geometry/mesh_buffers.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_rays.hpp>

#include <support/mesh_parts.hpp>
#include <support/named_mesh.hpp>

/// Trees on a hill: leaves of two triangles strewn through the air around their twigs.
namespace glint::bench {

namespace detail {

inline void add_twig(MeshBuffers<float>& tree, Random& random, const Vec3<float>& from, const Vec3<float>& to,
                     int leaves) {
  add_tube(tree, from, to, 0.02F, 0.005F, 4);
  for (int i = 0; i < leaves; ++i) {
    const Vec3<float> at = from + (to - from) * (0.3F + 0.7F * random.uniform<float>());
    const auto u = testing::detail::random_unit_vector<float>(random);
    const auto v = testing::detail::random_unit_vector<float>(random);
    add_quad(tree, at + u * 0.15F * random.uniform<float>(), u * 0.07F + v * 0.02F, u * 0.07F - v * 0.02F);
  }
}

/// Six meters high, of about so many triangles.
[[nodiscard]] inline MeshBuffers<float> broadleaf(int triangles, std::uint64_t seed) {
  Random random(seed);
  MeshBuffers<float> tree;
  const Vec3<float> top{0.3F, 5.5F, 0.2F};
  add_tube(tree, {0, -0.5F, 0}, top * 0.5F, 0.25F, 0.15F, 12);
  add_tube(tree, top * 0.5F, top, 0.15F, 0.02F, 12);
  constexpr int twigs_a_branch = 12;
  const int branches = std::clamp(triangles / 400, 3, 40);
  const int leaves = std::max(1, (triangles / (branches * twigs_a_branch) - 8) / 2);
  for (int i = 0; i < branches; ++i) {
    const float height = 0.3F + 0.68F * float(i) / float(branches);
    const float angle = 2.4F * float(i);
    const float length = 2.2F * std::sqrt(std::max(0.05F, 1 - height));
    const Vec3<float> out{std::cos(angle), 0.4F + 0.5F * random.uniform<float>(), std::sin(angle)};
    const Vec3<float> root = top * height;
    add_tube(tree, root, root + out * length, 0.06F, 0.015F, 6);
    for (int k = 0; k < twigs_a_branch; ++k) {
      const Vec3<float> fork = root + out * length * (0.25F + 0.75F * float(k + 1) / twigs_a_branch);
      const auto side = testing::detail::random_unit_vector<float>(random);
      add_twig(tree, random, fork, fork + (side + out * 0.5F) * 0.45F, leaves);
    }
  }
  return tree;
}

/// Turned by an angle about the vertical, scaled, and put on a spot.
inline void add_copy(MeshBuffers<float>& to, const MeshBuffers<float>& tree, float angle, float scale,
                     const Vec3<float>& spot) {
  const auto first = std::uint32_t(to.positions.size());
  const float c = std::cos(angle) * scale;
  const float s = std::sin(angle) * scale;
  for (const Vec3<float>& p : tree.positions)
    to.positions.push_back(spot + Vec3<float>{c * p.x - s * p.z, scale * p.y, s * p.x + c * p.z});
  for (const std::uint32_t index : tree.indices) to.indices.push_back(first + index);
}

}  // namespace detail

/// A hundred trees on 50 × 50 m of ground, of about so many triangles.
[[nodiscard]] inline MeshBuffers<float> forest(std::size_t triangles) {
  constexpr int rows = 10;
  const auto height = [](float x, float z) {
    return 1.5F * std::sin(0.13F * x) + 1.1F * std::cos(0.17F * z + 0.1F * x);
  };
  MeshBuffers<float> all;
  const int cells = int(std::sqrt(double(triangles) / 50));
  add_grid(all, cells, cells, [&](float s, float t) {
    const float x = 50 * s - 25;
    const float z = 50 * t - 25;
    return Vec3<float>{x, height(x, z), z};
  });
  const int each = int(double(triangles) * 0.96 / (rows * rows));
  const MeshBuffers<float> kinds[] = {detail::broadleaf(each, 1), detail::broadleaf(each, 2)};
  Random random(3);
  for (int i = 0; i < rows * rows; ++i) {
    const float x = 5 * float(i % rows) - 22.5F + random.uniform(-1.8F, 1.8F);
    const float z = 5 * float(i / rows) - 22.5F + random.uniform(-1.8F, 1.8F);
    const float angle = random.uniform(0.0F, 2 * pi<float>);
    const float scale = random.uniform(0.6F, 1.2F);
    detail::add_copy(all, kinds[random.below(2)], angle, scale, {x, height(x, z), z});
  }
  return all;
}

[[nodiscard]] inline Viewpoint forest_view() {
  return {.eye = {-6, 9, 36}, .target = {0, 2, 0}, .light = {60, 120, 50}, .half_width = 0.5F};
}

}  // namespace glint::bench
