// SPDX-License-Identifier: MIT
// Which triangles of two surfaces run into each other, and where a mesh runs into itself. The answers are checked by
// trying every pair.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/query/pairs.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/geometry/triangle_triangle.hpp>
#include <glint/testing/random_scenes.hpp>

namespace {

using Mesh = glint::TriangleMesh<float>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs tried_each(const Mesh& a, const Mesh& b) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j)
      if (overlaps(a.triangle(i), b.triangle(j))) pairs.emplace_back(i, j);
  return pairs;
}

}  // namespace

int main() {
  const auto stone = glint::testing::scanned_blob<float>(2000, 1);
  auto other = glint::testing::scanned_blob<float>(1500, 2);
  for (auto& position : other.positions) position.x += 1.1F;

  // <region: pairs>
  const glint::Bvh a{view(stone)};
  const glint::Bvh b{view(other)};

  const bool collide = overlaps(a, b);
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts = overlapping_pairs(a, b);

  const bool is_clean = self_overlaps(a).empty();
  // </region: pairs>

  std::printf("%zu pairs of triangles overlap; the first surface %s\n", contacts.size(),
              is_clean ? "does not run into itself" : "runs into itself");
  const bool right = contacts == tried_each(view(stone), view(other));
  return right && collide && !contacts.empty() && is_clean ? 0 : 1;
}
