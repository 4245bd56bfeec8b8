// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>

#include <glint/core/config.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/rounding.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// True where three points span no area: equal, or on one line.
///
/// Ensures: exact as long as the differences of the points are; for `float` these are formed in `double`.
template <std::floating_point T>
[[nodiscard]] bool is_degenerate(const Vec3<T>& v0, const Vec3<T>& v1, const Vec3<T>& v2) noexcept {
  const Vec3<double> a = Vec3<double>(v1) - Vec3<double>(v0);
  const Vec3<double> b = Vec3<double>(v2) - Vec3<double>(v0);
  return exact_difference(a.y, b.z, a.z, b.y) == 0 && exact_difference(a.z, b.x, a.x, b.z) == 0 &&
         exact_difference(a.x, b.y, a.y, b.x) == 0;
}

/// The triangle test without a preparation of ray or triangle. Rays through an edge may slip between two triangles
/// that share it. The signed volumes are written with the triangle's normal, and every product is rounded by itself, so
/// that tests of several triangles at once can do the same to the last bit.
///
/// Ensures: two-sided; t_min ≤ t ≤ t_max; no tolerance of any kind, so triangles of any size are hit.
/// Errors:  a NaN, a zero direction, and a triangle without area report no hit.
/// Source:  Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1), 1997.
struct MoellerTrumbore {
  struct Prepared {};

  template <std::floating_point T>
  [[nodiscard]] static constexpr Prepared prepare(const Ray<T>& /*ray*/) noexcept {
    return {};
  }

  template <std::floating_point T>
  [[nodiscard]] static std::optional<Hit<T>> intersect(const Ray<T>& ray, Prepared /*prepared*/, const Vec3<T>& v0,
                                                       const Vec3<T>& v1, const Vec3<T>& v2) noexcept {
    const Vec3<T> back = v0 - v1;
    const Vec3<T> e2 = v2 - v0;
    const Vec3<T> n = rounded_cross(e2, back);
    const Vec3<T> c = v0 - ray.origin;
    const Vec3<T> r = rounded_cross(c, ray.direction);
    const T det = rounded_dot(n, ray.direction);
    const T w1 = rounded_dot(r, e2);
    const T w2 = rounded_dot(r, back);
    const T w0 = det - (w1 + w2);
    // Two branches that are seldom taken instead of three that are hard to foresee; a NaN compares false.
    const bool left = (w0 >= T(0)) & (w1 >= T(0)) & (w2 >= T(0));
    const bool right = (w0 <= T(0)) & (w1 <= T(0)) & (w2 <= T(0));
    if (!(left | right)) return std::nullopt;
    const T t = rounded_dot(n, c) / det;
    if (!(t >= ray.t_min && t <= ray.t_max) || det == T(0) || is_degenerate(v0, v1, v2)) return std::nullopt;
    const T scale = T(1) / det;
    return Hit<T>{.t = t, .uv = {w1 * scale, w2 * scale}};
  }

  [[nodiscard]] friend constexpr bool operator==(const MoellerTrumbore&, const MoellerTrumbore&) noexcept = default;

 private:
  template <std::floating_point T>
  [[nodiscard]] GLINT_ALWAYS_INLINE static T rounded_dot(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    return fenced(a.x * b.x) + fenced(a.y * b.y) + fenced(a.z * b.z);
  }
  template <std::floating_point T>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Vec3<T> rounded_cross(const Vec3<T>& a, const Vec3<T>& b) noexcept {
    return {fenced(a.y * b.z) - fenced(a.z * b.y), fenced(a.z * b.x) - fenced(a.x * b.z),
            fenced(a.x * b.y) - fenced(a.y * b.x)};
  }
};

/// The triangle test that no ray slips through: one that passes through an edge or a vertex of a closed mesh hits at
/// least one of the triangles there.
///
/// The ray is sheared onto the axis in which it is longest, so that each vertex becomes a point in a plane, the same
/// for all triangles that share it; the sides on which the ray passes the edges are then decided exactly. Winding is
/// of no interest, hence the axes are not swapped to preserve it. Every product is rounded by itself, so that tests of
/// several triangles at once can do the same to the last bit.
///
/// Ensures: two-sided; edges count as inside; t_min ≤ t ≤ t_max; no tolerance of any kind.
/// Errors:  a NaN, a zero direction, and a triangle without area report no hit.
/// Source:  Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
struct Watertight {
  /// Along z the ray goes furthest; x and y are the other two axes, in cyclic order.
  template <std::floating_point T>
  struct Prepared {
    int x = 1;
    int y = 2;
    int z = 0;
    T shear_x = 0;
    T shear_y = 0;
    T scale_z = 1;
  };

  template <std::floating_point T>
  [[nodiscard]] static Prepared<T> prepare(const Ray<T>& ray) noexcept {
    const Vec3<T> size = abs(ray.direction);
    const std::array<T, 3> d{ray.direction.x, ray.direction.y, ray.direction.z};
    const std::array<T, 3> inverse{T(1) / d[0], T(1) / d[1], T(1) / d[2]};  // all, so that the choice comes last
    constexpr std::array<std::size_t, 5> axes{0, 1, 2, 0, 1};
    const auto row = std::size_t(size.y > size.x);
    const std::size_t z = size.z > std::max(size.x, size.y) ? 2 : row;
    const std::size_t x = axes[z + 1];
    const std::size_t y = axes[z + 2];
    return {int(x), int(y), int(z), d[x] * inverse[z], d[y] * inverse[z], inverse[z]};
  }

  template <std::floating_point T>
  [[nodiscard]] static std::optional<Hit<T>> intersect(const Ray<T>& ray, const Prepared<T>& shear, const Vec3<T>& v0,
                                                       const Vec3<T>& v1, const Vec3<T>& v2) noexcept {
    const Vec3<T> a = project(v0 - ray.origin, shear);
    const Vec3<T> b = project(v1 - ray.origin, shear);
    const Vec3<T> c = project(v2 - ray.origin, shear);
    // Twice the signed areas that the ray's point spans with the edges, each as the difference of two products.
    const T u_plus = fenced(c.x * b.y);
    const T v_plus = fenced(a.x * c.y);
    const T w_plus = fenced(b.x * a.y);
    const T u_minus = fenced(c.y * b.x);
    const T v_minus = fenced(a.y * c.x);
    const T w_minus = fenced(b.y * a.x);
    const bool left = (u_plus < u_minus) | (v_plus < v_minus) | (w_plus < w_minus);
    const bool right = (u_plus > u_minus) | (v_plus > v_minus) | (w_plus > w_minus);
    if (left & right) return std::nullopt;
    Vec3<T> areas{u_plus - u_minus, v_plus - v_minus, w_plus - w_minus};
    const bool tied = (u_plus == u_minus) | (v_plus == v_minus) | (w_plus == w_minus);
    if (tied && !settle_ties(a, b, c, areas)) return std::nullopt;
    const T det = areas.x + areas.y + areas.z;
    const T t = (fenced(areas.x * a.z) + fenced(areas.y * b.z) + fenced(areas.z * c.z)) * shear.scale_z / det;
    if (!(t >= ray.t_min && t <= ray.t_max) || is_degenerate(v0, v1, v2)) return std::nullopt;
    const T scale = T(1) / det;
    return Hit<T>{.t = t, .uv = {areas.y * scale, areas.z * scale}};
  }

  [[nodiscard]] friend constexpr bool operator==(const Watertight&, const Watertight&) noexcept = default;

 private:
  /// A vertex seen along the ray: x and y in the plane across it, z the depth.
  template <std::floating_point T>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Vec3<T> project(const Vec3<T>& v, const Prepared<T>& shear) noexcept {
    const T z = component(v, shear.z);
    return {component(v, shear.x) - fenced(shear.shear_x * z), component(v, shear.y) - fenced(shear.shear_y * z), z};
  }

  /// Where rounded products tie, the exact areas decide. False where the ray passes outside.
  template <std::floating_point T>
  [[nodiscard]] GLINT_NO_INLINE static bool settle_ties(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c,
                                                        Vec3<T>& areas) noexcept {
    const auto u = exact_difference(c.x, b.y, c.y, b.x);
    const auto v = exact_difference(a.x, c.y, a.y, c.x);
    const auto w = exact_difference(b.x, a.y, b.y, a.x);
    areas = {T(u), T(v), T(w)};
    const bool left = u < 0 || v < 0 || w < 0;
    const bool right = u > 0 || v > 0 || w > 0;
    return !(left && right);
  }
};

}  // namespace glint
