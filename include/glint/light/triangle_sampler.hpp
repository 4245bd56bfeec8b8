// SPDX-License-Identifier: MIT
#pragma once
#include <utility>
#include <vector>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/distribution.hpp>

namespace glint {

/// Triangles as one surface that can be sampled uniformly by area: what makes a light of a mesh.
///
/// Cost: O(1) a sample, whatever the number of triangles.
class TriangleSampler {
 public:
  TriangleSampler() = default;
  explicit TriangleSampler(std::vector<Triangle<float>> triangles)
      : triangles_(std::move(triangles)), choice_(areas(triangles_)), area_(static_cast<float>(choice_.total())) {
    for (const Triangle<float>& triangle : triangles_) box_ = join(box_, bounds(triangle));
  }

  [[nodiscard]] const std::vector<Triangle<float>>& triangles() const noexcept { return triangles_; }

  [[nodiscard]] friend Aabb<float> bounds(const TriangleSampler& shape) noexcept { return shape.box_; }

  [[nodiscard]] friend float area(const TriangleSampler& shape) noexcept { return shape.area_; }

  /// Requires: area > 0. One of the two numbers chooses the triangle first, and what is left of it is used again.
  [[nodiscard]] friend AreaSample<float> sample_area(const TriangleSampler& shape, const Vec2<float>& u) noexcept {
    const auto chosen = shape.choice_.sample(u.x);
    AreaSample<float> result = sample_area(shape.triangles_[chosen.index], Vec2<float>{chosen.remainder, u.y});
    result.pdf = 1 / shape.area_;
    return result;
  }

 private:
  [[nodiscard]] static std::vector<float> areas(const std::vector<Triangle<float>>& triangles) {
    std::vector<float> result;
    result.reserve(triangles.size());
    for (const Triangle<float>& triangle : triangles) {
      const float a = area(triangle);
      result.push_back(a > 0 && a < infinity<float> ? a : 0.0F);
    }
    return result;
  }

  std::vector<Triangle<float>> triangles_;
  AliasTable choice_;
  Aabb<float> box_{};
  float area_ = 0;
};

}  // namespace glint
