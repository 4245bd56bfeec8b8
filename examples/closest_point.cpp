// SPDX-License-Identifier: MIT
// The point of a surface that is closest to another, and the nearest few triangles. The answers are checked by trying
// every triangle.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/query/nearest.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

int main() {
  const auto buffers = glint::testing::scanned_blob<float>(20000, 1);
  const auto mesh = view(buffers);

  // <region: nearest>
  const glint::Bvh bvh{mesh};
  const glm::vec3 point{0.3F, 1.2F, 0.4F};

  const auto closest = closest_point(bvh, point);
  if (!closest) return 1;  // an empty mesh, or nothing within the distance that may be given as well
  std::printf("triangle %u, %.3f away, at %.3f %.3f %.3f\n", closest->primitive, double(closest->distance),
              double(closest->position.x), double(closest->position.y), double(closest->position.z));

  std::array<glint::ClosestPoint<float>, 4> few;
  const std::size_t count = nearest_primitives(bvh, point, few);
  // </region: nearest>

  std::vector<float> distances;
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    distances.push_back(std::sqrt(glint::length_squared(mesh.closest_point(point, i) - point)));
  std::sort(distances.begin(), distances.end());
  bool right = closest->distance == distances[0] && count == few.size();
  for (std::size_t i = 0; i < count; ++i) right = right && few[i].distance == distances[i];
  return right ? 0 : 1;
}
