// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <glint/bvh/query/nearest.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>

/// Points whose closest point on a mesh is asked for, and who answers wrongly.
namespace glint::bench {

using Points = std::vector<Vec3<float>>;

/// Beside the surface, by up to `reach` along each axis.
[[nodiscard]] inline Points points_near(const TriangleMesh<float>& mesh, float reach, std::size_t count) {
  Random random(19);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto any = std::size_t(random.uniform<float>() * float(mesh.size()));
    const auto [a, b, c] = mesh.vertices(std::uint32_t(std::min(any, mesh.size() - 1)));
    const float toward_opposite = random.uniform<float>();
    const float from_a = std::sqrt(random.uniform<float>());
    const Vec3<float> on = glm::mix(a, glm::mix(b, c, toward_opposite), from_a);
    points.push_back(on + (random.uniform_vec3<float>() * 2.0F - 1.0F) * reach);
  }
  return points;
}
/// In the box, made larger.
[[nodiscard]] inline Points points_about(const Aabb<float>& box, float scale, std::size_t count) {
  Random random(23);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(centroid(box) + (random.uniform_vec3<float>() - 0.5F) * (scale * extent(box)));
  return points;
}

/// Says in double precision how far triangles are. The tolerance is some roundings of the coordinates.
class DistanceJudge {
 public:
  explicit DistanceJudge(const MeshBuffers<float>& mesh) {
    for (const Vec3<float>& p : mesh.positions) mesh_.positions.emplace_back(p);
    for (const std::uint32_t corner : mesh.indices) {
      const Vec3<float> p = glm::abs(mesh.positions[corner]);
      reach_ = std::max({reach_, double(p.x), double(p.y), double(p.z)});
    }
    mesh_.indices = mesh.indices;
  }

  /// Whether this may be the closest point within a radius: as far as it says, and no farther than another's answer.
  [[nodiscard]] bool is_right(const Vec3<float>& point, const ClosestPoint<float>& found,
                              const ClosestPoint<float>& other, double radius) const {
    const double distance = std::min(distance_to(point, found.primitive), radius);
    const double least = std::min(distance_to(point, other.primitive), radius);
    const double said = std::min(double(found.distance), radius);
    return distance <= least + tolerance(point) && !(std::abs(distance - said) > tolerance(point));
  }
  /// Whether no triangle at all is closer. Cost: all of them, one by one.
  [[nodiscard]] bool is_least(const Vec3<float>& point, const ClosestPoint<float>& found, double radius) const {
    double least = radius;
    for (std::uint32_t i = 0; i < mesh_.indices.size() / 3; ++i) least = std::min(least, distance_to(point, i));
    return std::min(distance_to(point, found.primitive), radius) <= least + tolerance(point);
  }

 private:
  [[nodiscard]] double tolerance(const Vec3<float>& point) const {
    return 32 * double(std::numeric_limits<float>::epsilon()) * (reach_ + double(glm::length(point)));
  }
  [[nodiscard]] double distance_to(const Vec3<float>& point, std::uint32_t triangle) const {
    if (triangle == none<std::uint32_t>) return infinity<double>;
    const Vec3<double> from(point);
    return glm::length(view(mesh_).closest_point(from, triangle) - from);
  }

  MeshBuffers<double> mesh_;
  double reach_ = 0;
};

}  // namespace glint::bench
