// SPDX-License-Identifier: MIT
// A slice of the signed distance to a mesh: negative inside. The answers are checked by trying every triangle.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/query/winding.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/constants.hpp>
#include <glint/testing/random_scenes.hpp>

namespace {

constexpr int rows = 24;
constexpr int columns = 48;

glm::vec3 point_at(int row, int column) {
  return {float(column) / columns * 2.4F - 1.2F, 1.2F - float(row) / rows * 2.4F, 0.05F};
}

float tried_each(const glint::TriangleMesh<float>& mesh, const glm::vec3& point) {
  float squared = std::numeric_limits<float>::infinity();
  float angle = 0;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    squared = std::min(squared, glint::length_squared(mesh.closest_point(point, i) - glint::Vec3<float>(point)));
    angle += glint::signed_solid_angle<float>(point, mesh.triangle(i));
  }
  return angle > 2 * glint::pi<float> ? -std::sqrt(squared) : std::sqrt(squared);
}

}  // namespace

int main() {
  const auto buffers = glint::testing::scanned_blob<float>(5000, 1);
  const auto mesh = view(buffers);

  // <region: field>
  const glint::Bvh bvh{mesh};
  const glint::Winding winding{bvh};

  std::vector<float> field;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) field.push_back(signed_distance(winding, point_at(row, column)));

  const bool is_inside = winding.holds({0, 0, 0});
  // </region: field>

  std::size_t wrong = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float distance = field[std::size_t(row) * columns + std::size_t(column)];
      wrong += std::size_t(std::abs(distance - tried_each(mesh, point_at(row, column))) > 1e-6F);
      std::putchar(distance < 0 ? '#' : distance < 0.1F ? '+' : distance < 0.2F ? '.' : ' ');
    }
    std::putchar('\n');
  }
  return wrong == 0 && is_inside ? 0 : 1;
}
