// SPDX-License-Identifier: MIT
// What overlaps a box, a ball, and what a camera sees: to cull, to edit with a brush, to collect what a cell of a grid
// holds. The answers are checked by trying every triangle.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/query/overlap.hpp>
#include <glint/geometry/region.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

int main() {
  const auto buffers = glint::testing::scanned_blob<float>(20000, 1);
  const auto mesh = view(buffers);

  // <region: regions>
  const glint::Bvh bvh{mesh};

  const glint::Aabb<float> cell{{0.1F, 0.2F, 0}, {0.5F, 0.6F, 0.9F}};
  const std::vector<std::uint32_t> in_cell = overlapping(bvh, cell);

  const glint::Ball<float> brush{.center = {0, 0.6F, 0.2F}, .radius = 0.3F};
  std::size_t touched = 0;
  for_each_overlapping(bvh, brush, [&](std::uint32_t /*triangle*/) { ++touched; });

  const glm::mat4 camera = glm::perspective(0.3F, 1.5F, 0.1F, 10.0F) *
                           glm::lookAt(glm::vec3(3, 2, 1), glm::vec3(0.2F, 0, 0), glm::vec3(0, 1, 0));
  const bool is_seen = overlaps(bvh, glint::frustum_of(camera));
  // </region: regions>

  std::printf("%zu of %zu triangles in the cell, %zu under the brush, and the camera sees %s\n", in_cell.size(),
              mesh.size(), touched, is_seen ? "some" : "none");
  const glint::BruteForce all(mesh);
  const bool right = in_cell == overlapping(all, cell) && touched == overlapping(all, brush).size() &&
                     overlapping(bvh, glint::frustum_of(camera)) == overlapping(all, glint::frustum_of(camera));
  return right && is_seen && !in_cell.empty() && touched > 0 ? 0 : 1;
}
