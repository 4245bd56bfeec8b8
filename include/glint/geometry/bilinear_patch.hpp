// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The surface that four corners span: straight lines from the edge p00 p01 to the edge p10 p11. Corners in a plane
/// make any flat quadrilateral, and equal corners a triangle; otherwise it is a piece of a saddle.
///
/// Parametrization: uv as in the corners' names: p10 is at u = 1, v = 0. Its outer side is the one that ∂p/∂u × ∂p/∂v
///                  points to.
template <std::floating_point T>
struct BilinearPatch {
  Vec3<T> p00{T(0)};
  Vec3<T> p10{T(1), T(0), T(0)};
  Vec3<T> p01{T(0), T(1), T(0)};
  Vec3<T> p11{T(1), T(1), T(0)};

  [[nodiscard]] friend bool operator==(const BilinearPatch&, const BilinearPatch&) noexcept = default;
};

/// The box of the corners, which is the smallest.
template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const BilinearPatch<T>& patch) noexcept {
  Aabb<T> box{patch.p00, patch.p00};
  extend(box, patch.p10);
  extend(box, patch.p01);
  extend(box, patch.p11);
  return box;
}

namespace detail {

/// The u whose line from edge to edge the ray meets: at most two. A NaN is none.
template <std::floating_point T>
[[nodiscard]] std::array<T, 2> roots_of_patch(T a, T b, T c) noexcept {
  const T discriminant = b * b - T(4) * a * c;
  const T q = T(-0.5) * (b + std::copysign(std::sqrt(discriminant), b));  // equal signs do not cancel
  return {a / q, q / c};
}

/// Where a ray from the origin passes the line start + v way nearest, as t and v.
template <std::floating_point T>
[[nodiscard]] Vec2<T> nearest_on_line(const Vec3<T>& direction, const Vec3<T>& start, const Vec3<T>& way) noexcept {
  const Vec3<T> across = glm::cross(direction, way);
  const Vec3<T> turned = glm::cross(across, start);
  const T inverse = T(1) / length_squared(across);
  return {glm::dot(turned, way) * inverse, glm::dot(turned, direction) * inverse};
}

}  // namespace detail

/// The first crossing of a patch within the ray's interval, from either side.
///
/// The ray is first moved to where it passes the patch, so that its distance costs no more than the rounding of its own
/// origin. A flat patch needs no case of its own: one root then moves out to infinity, and the other one is not formed
/// from a difference of close numbers.
///
/// Ensures: uv are the parameters of the point, all four edges included. Rays through an edge that patches share may
/// slip
///          between them; triangles do not let them.
/// Errors:  no hit for a NaN, a zero direction, a ray in a flat patch's plane, or a patch without area.
/// Source:  Reshetov, "Cool Patches: A Geometric Approach to Ray/Bilinear Patch Intersections", Ray Tracing Gems
/// (2019),
///          ch. 8. Here both crossings are tried in the order of t, since an interval may begin between them.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const BilinearPatch<T>& patch) noexcept {
  const Vec3<T> edge_u = patch.p10 - patch.p00;
  const Vec3<T> edge_v = patch.p01 - patch.p00;
  const Vec3<T> far_edge_v = patch.p11 - patch.p10;
  const Vec3<T> from_corner = ray.origin - patch.p00;
  const Vec3<T> to_middle = (edge_u + edge_v) * T(0.5) - from_corner;
  const T shift = glm::dot(to_middle, ray.direction) / length_squared(ray.direction);
  const Vec3<T> p00 = -(from_corner + ray.direction * shift);
  const Vec3<T> p10 = p00 + edge_u;

  const T a = glm::dot(glm::cross(p00, ray.direction), edge_v);
  const T c = glm::dot(glm::cross(edge_u, edge_v - far_edge_v), ray.direction);
  const T b = glm::dot(glm::cross(p10, ray.direction), far_edge_v) - (a + c);
  std::array<Hit<T>, 2> hits;
  const std::array<T, 2> roots = detail::roots_of_patch(a, b, c);
  for (std::size_t i = 0; i < 2; ++i) {
    const T u = roots[i];
    const Vec3<T> way = edge_v + (far_edge_v - edge_v) * u;
    const Vec2<T> at = detail::nearest_on_line(ray.direction, p00 + edge_u * u, way);
    const bool is_inside = u >= T(0) && u <= T(1) && at.y >= T(0) && at.y <= T(1);
    hits[i] = {.t = is_inside ? shift + at.x : infinity<T>, .uv = {u, at.y}};
  }
  if (hits[1].t < hits[0].t) std::swap(hits[0], hits[1]);
  for (const Hit<T>& hit : hits) {
    if (hit.t >= ray.t_min && hit.t <= ray.t_max && std::abs(hit.t) < infinity<T>) return hit;
  }
  return std::nullopt;
}

namespace detail {

template <std::floating_point T>
[[nodiscard]] Vec3<T> patch_normal(const Vec3<T>& along_u, const Vec3<T>& along_v) noexcept {
  const T scale = T(1) / (max_component(abs(along_u)) * max_component(abs(along_v)));
  return glm::cross(along_u, along_v) * scale;
}

}  // namespace detail

/// The surface at a hit, at the point that the hit's parameters name.
///
/// Ensures: `position_error` bounds the distance to the patch, alike on all axes. In a corner where the derivatives
/// have
///          no normal, it is the one a little inward.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const BilinearPatch<T>& patch, const Vec3<T>& /*position*/,
                                   const Hit<T>& hit) noexcept {
  const Vec3<T> edge_u = patch.p10 - patch.p00;
  const Vec3<T> edge_v = patch.p01 - patch.p00;
  const Vec3<T> twist = (patch.p11 - patch.p01) - edge_u;
  const auto along_u = [&](const Vec2<T>& uv) { return edge_u + twist * uv.y; };
  const auto along_v = [&](const Vec2<T>& uv) { return edge_v + twist * uv.x; };
  Vec3<T> normal = detail::patch_normal(along_u(hit.uv), along_v(hit.uv));
  if (!(length_squared(normal) > T(1e-6))) {
    const Vec2<T> inward = hit.uv + (T(0.5) - hit.uv) * T(1.0 / 64);
    normal = detail::patch_normal(along_u(inward), along_v(inward));
  }
  normal = glm::normalize(normal);
  const Vec3<T> tangent = along_u(hit.uv);
  const Vec3<T> local = edge_u * hit.uv.x + along_v(hit.uv) * hit.uv.y;
  const Vec3<T> position = patch.p00 + local;
  const T size = max_component(abs(edge_u)) + max_component(abs(edge_v)) + max_component(abs(twist));
  return {.position = position,
          .position_error = Vec3<T>(size * rounding_bound<T>(16) + max_component(abs(position)) * rounding_bound<T>(2)),
          .normal = normal,
          .shading_normal = normal,
          .tangent = tangent - normal * glm::dot(tangent, normal),
          .uv = hit.uv};
}

}  // namespace glint
