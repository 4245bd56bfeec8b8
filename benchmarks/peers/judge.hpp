// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/vec.hpp>

/// Says in double precision which of two answers in single precision is wrong.
namespace glint::bench {

/// How far a line of unit direction passes from a segment.
[[nodiscard]] inline double line_to_segment(const Vec3<double>& origin, const Vec3<double>& direction,
                                            const Vec3<double>& a, const Vec3<double>& b) {
  const auto across = [&](const Vec3<double>& v) { return v - direction * glm::dot(v, direction); };
  const Vec3<double> from = across(a - origin);
  const Vec3<double> along = across(b - a);
  const double squared = glm::dot(along, along);
  const double s = squared > 0 ? std::clamp(-glm::dot(from, along) / squared, 0.0, 1.0) : 0.0;
  return glm::length(from + along * s);
}

/// The tolerance is one of place, across the ray: some roundings of the largest coordinate, relative to the ray's
/// origin. A ray that passes an edge within it may take it for hit or for missed. Along a ray that meets a surface at a
/// slant, the same error of place is the longer the flatter the slant; and depth that is interpolated from the corners
/// loses a rounding as often as a triangle is longer than it is high.
class Judge {
 public:
  /// `reach`: of the coordinates from which rays were brought to the mesh.
  explicit Judge(const MeshBuffers<float>& mesh, double reach = 0) : reach_(reach) {
    mesh_.positions.reserve(mesh.positions.size());
    for (const Vec3<float>& p : mesh.positions) mesh_.positions.emplace_back(p);
    mesh_.indices = mesh.indices;
    tree_ = std::make_unique<Bvh<TriangleMesh<double>>>(view(mesh_));
    for (int axis = 0; axis < 3; ++axis) {
      reach_ = std::max({reach_, std::abs(tree_->bounds().lower[axis]), std::abs(tree_->bounds().upper[axis])});
    }
  }

  /// Whether this may be the closest hit.
  [[nodiscard]] bool is_right(const Ray<float>& ray, const std::optional<Hit<float>>& hit) const {
    const Ray<double> exact = widen(ray);
    if (!hit) return is_clear(ray, exact, std::numeric_limits<double>::infinity(), 0);
    const double slack = slack_along(ray, exact, hit->primitive);
    return is_met(ray, exact, *hit, slack) && is_clear(ray, exact, hit->t, slack);
  }

  /// Whether this may be an answer to whether anything is in the way; `witness` is what whoever says so means.
  [[nodiscard]] bool is_right(const Ray<float>& ray, bool occluded, const std::optional<Hit<float>>& witness) const {
    const Ray<double> exact = widen(ray);
    if (!occluded) return is_clear(ray, exact, std::numeric_limits<double>::infinity(), 0);
    if (tree_->occluded(exact)) return true;
    return witness && is_met(ray, exact, *witness, slack_along(ray, exact, witness->primitive));
  }

 private:
  [[nodiscard]] static Ray<double> widen(const Ray<float>& ray) {
    return {Vec3<double>(ray.origin), Vec3<double>(ray.direction), ray.t_min, ray.t_max, ray.time};
  }

  [[nodiscard]] double tolerance(const Ray<float>& ray) const {
    const Vec3<float> o = glm::abs(ray.origin);
    return roundings_ * double(std::numeric_limits<float>::epsilon()) * (reach_ + double(std::max({o.x, o.y, o.z})));
  }

  /// By how much t may be off.
  [[nodiscard]] double slack_along(const Ray<float>& ray, const Ray<double>& exact, std::uint32_t primitive) const {
    const auto [a, b, c] = tree_->set().vertices(primitive);
    const Vec3<double> normal = glm::cross(b - a, c - a);
    const double area = std::max(glm::length(normal), std::numeric_limits<double>::min());
    const double slant = std::max(std::abs(glm::dot(normal, exact.direction)), std::numeric_limits<double>::min());
    const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - a, c - a), glm::dot(c - b, c - b)});
    return tolerance(ray) * (area / slant + longest / (area * roundings_ * glm::length(exact.direction)));
  }

  [[nodiscard]] double past_edges(const Ray<double>& ray, std::uint32_t primitive) const {
    const auto [a, b, c] = tree_->set().vertices(primitive);
    const Vec3<double> direction = glm::normalize(ray.direction);
    return std::min({line_to_segment(ray.origin, direction, a, b), line_to_segment(ray.origin, direction, b, c),
                     line_to_segment(ray.origin, direction, c, a)});
  }

  /// Whether the ray meets this triangle about there.
  [[nodiscard]] bool is_met(const Ray<float>& ray, const Ray<double>& exact, const Hit<float>& hit,
                            double slack) const {
    const auto [a, b, c] = tree_->set().vertices(hit.primitive);
    const Vec3<double> normal = glm::cross(b - a, c - a);
    const double t = glm::dot(normal, a - exact.origin) / glm::dot(normal, exact.direction);
    const bool is_edge = past_edges(exact, hit.primitive) <= tolerance(ray);
    Ray<double> line = exact;
    line.t_min = -std::numeric_limits<double>::infinity();
    line.t_max = std::numeric_limits<double>::infinity();
    if (!is_edge && !tree_->set().intersect(line, hit.primitive)) return false;
    return !(std::abs(double(hit.t) - t) > slack) || (is_edge && is_among(exact, hit, {a, b, c}, tolerance(ray)));
  }

  /// Whether a triangle seen from its edge is about there at all.
  [[nodiscard]] static bool is_among(const Ray<double>& ray, const Hit<float>& hit,
                                     const std::array<Vec3<double>, 3>& corners, double tolerance) {
    Aabb<double> box;
    for (const Vec3<double>& corner : corners) extend(box, corner);
    return contains(Aabb<double>{box.lower - tolerance, box.upper + tolerance}, ray.at(double(hit.t)));
  }

  /// Whether nothing is before t that the ray could not have missed.
  [[nodiscard]] bool is_clear(const Ray<float>& ray, const Ray<double>& exact, double t, double slack) const {
    Ray<double> rest = exact;
    while (const auto hit = tree_->closest(rest)) {
      const double margin = slack + slack_along(ray, exact, hit->primitive);
      if (hit->t >= t) return true;
      const bool at_end = hit->t > exact.t_max - margin || hit->t < exact.t_min + margin || hit->t >= t - margin;
      if (!at_end && past_edges(exact, hit->primitive) > tolerance(ray)) return false;
      rest.t_min = std::nextafter(hit->t, std::numeric_limits<double>::infinity());
    }
    return true;
  }

  static constexpr double roundings_ = 16;
  MeshBuffers<double> mesh_;
  std::unique_ptr<Bvh<TriangleMesh<double>>> tree_;
  double reach_;
};

}  // namespace glint::bench
