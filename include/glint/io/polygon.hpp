// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glint/math/vec.hpp>

namespace glint::detail {

/// Cuts a planar polygon into triangles; scratch memory is kept from one polygon to the next.
///
/// Quads are split along the shorter of their diagonals that lie inside; larger polygons lose ear after ear. Both work
/// in the coordinate plane in which the polygon is largest, in double precision.
///
/// Errors:   a polygon that crosses itself, or has no area, gives as many triangles, some of them overlapping.
/// Cost:     linear for convex polygons; n times the number of reflex corners in general.
/// Source:   Meisters, "Polygons Have Ears", The American Mathematical Monthly 82 (1975).
class PolygonCutter {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// The triangles, as indices into the corners, wound as the polygon is; valid until the next call.
  ///
  /// Requires: at least 3 corners.
  /// Ensures:  corners.size() − 2 triangles.
  [[nodiscard]] const std::vector<Triangle>& cut(std::span<const Vec3<float>> corners) {
    triangles_.clear();
    if (corners.size() == 3) {
      triangles_.push_back({0, 1, 2});
      return triangles_;
    }
    flatten(corners);
    if (corners.size() == 4) {
      cut_quad(corners);
    } else {
      cut_ears();
    }
    return triangles_;
  }

 private:
  /// Projects along the largest axis of Newell's normal, so that the polygon runs counterclockwise.
  void flatten(std::span<const Vec3<float>> corners) {
    Vec3<double> normal{0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3<double> a(corners[i] - corners[0]);
      const Vec3<double> b(corners[(i + 1) % corners.size()] - corners[0]);
      normal += Vec3<double>{(a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y)};
    }
    const int axis = max_axis(glint::abs(normal));
    const bool flipped = component(normal, axis) < 0;
    flat_.resize(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3<double> p(corners[i]);
      const double u = component(p, (axis + 1) % 3);
      const double v = component(p, (axis + 2) % 3);
      flat_[i] = flipped ? Vec2<double>{v, u} : Vec2<double>{u, v};
    }
  }

  /// Twice the signed area of a triangle: positive where it runs counterclockwise.
  [[nodiscard]] double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const noexcept {
    const Vec2<double> u = flat_[b] - flat_[a];
    const Vec2<double> v = flat_[c] - flat_[a];
    return u.x * v.y - u.y * v.x;
  }

  void cut_quad(std::span<const Vec3<float>> corners) {
    const bool first_inside = area(0, 1, 2) > 0 && area(0, 2, 3) > 0;
    const bool second_inside = area(0, 1, 3) > 0 && area(1, 2, 3) > 0;
    const bool first_shorter = length_squared(corners[2] - corners[0]) < length_squared(corners[3] - corners[1]);
    if (first_inside == second_inside ? first_shorter : first_inside) {
      triangles_ = {{0, 1, 2}, {0, 2, 3}};
    } else {
      triangles_ = {{0, 1, 3}, {1, 2, 3}};
    }
  }

  void cut_ears() {
    const auto count = static_cast<std::uint32_t>(flat_.size());
    next_.resize(count);
    previous_.resize(count);
    reflex_.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      previous_[i] = (i + count - 1) % count;
      if (area(previous_[i], i, next_[i]) <= 0) reflex_.push_back(i);
    }
    std::uint32_t corner = 1;
    std::uint32_t refused =
        0;  // corners in a row that are no ears: a whole round of them, and the next one goes anyway
    for (std::uint32_t left = count; left > 3;) {
      if (!is_ear(corner) && ++refused < left) {
        corner = next_[corner];
        continue;
      }
      clip(corner);
      corner = next_[next_[corner]];
      refused = 0;
      --left;
    }
    triangles_.push_back({previous_[corner], corner, next_[corner]});
  }

  /// An ear turns left and contains none of the reflex corners.
  [[nodiscard]] bool is_ear(std::uint32_t corner) const noexcept {
    const std::uint32_t a = previous_[corner];
    const std::uint32_t c = next_[corner];
    if (area(a, corner, c) <= 0) return false;
    return std::ranges::none_of(reflex_, [&](std::uint32_t p) {
      const auto at_end = [&](std::uint32_t end) { return flat_[p] == flat_[end]; };
      if (at_end(a) || at_end(corner) || at_end(c)) return false;
      return area(a, corner, p) >= 0 && area(corner, c, p) >= 0 && area(c, a, p) >= 0;
    });
  }

  void clip(std::uint32_t corner) {
    const std::uint32_t a = previous_[corner];
    const std::uint32_t c = next_[corner];
    triangles_.push_back({a, corner, c});
    next_[a] = c;
    previous_[c] = a;
    std::erase_if(reflex_, [&](std::uint32_t p) {
      return p == corner || ((p == a || p == c) && area(previous_[p], p, next_[p]) > 0);
    });
  }

  std::vector<Vec2<double>> flat_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> reflex_;
  std::vector<Triangle> triangles_;
};

}  // namespace glint::detail
