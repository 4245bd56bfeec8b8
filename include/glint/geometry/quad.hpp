// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A parallelogram: the points origin + a · edge_u + b · edge_v with a and b in [0, 1], and uv = (a, b).
///
/// Both sides are hit. Its outer side is the one that edge_u × edge_v points to.
template <std::floating_point T>
struct Quad {
  Vec3<T> origin{T(0)};
  Vec3<T> edge_u{T(1), T(0), T(0)};
  Vec3<T> edge_v{T(0), T(1), T(0)};

  [[nodiscard]] friend bool operator==(const Quad&, const Quad&) noexcept = default;
};

template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const Quad<T>& quad) noexcept {
  Aabb<T> box{quad.origin, quad.origin};
  extend(box, quad.origin + quad.edge_u);
  extend(box, quad.origin + quad.edge_v);
  extend(box, quad.origin + (quad.edge_u + quad.edge_v));
  return box;
}

namespace detail {

/// Whether edge_u × edge_v is more than the rounding noise that it may be for parallel edges.
template <std::floating_point T>
[[nodiscard]] bool spans_area(const Vec3<T>& normal, const Quad<T>& quad) noexcept {
  const T noise = rounding_bound<T>(4) * max_component(abs(quad.edge_u)) * max_component(abs(quad.edge_v));
  return max_component(abs(normal)) > noise;
}

}  // namespace detail

/// The crossing of a parallelogram, by Cramer's rule.
///
/// Ensures: uv = (a, b), all four edges included.
/// Errors:  no hit for a ray in the quad's plane, a quad without area, or a NaN.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Quad<T>& quad) noexcept {
  const Vec3<T> normal = glm::cross(quad.edge_u, quad.edge_v);
  const T determinant = glm::dot(normal, ray.direction);
  if (!(std::abs(determinant) < infinity<T>)) return std::nullopt;

  const T inv_determinant = T(1) / determinant;  // of zero: infinite or NaN below, which no comparison lets through
  const Vec3<T> to_origin = quad.origin - ray.origin;
  const T t = glm::dot(normal, to_origin) * inv_determinant;
  if (!(t >= ray.t_min && t <= ray.t_max && t < infinity<T>)) return std::nullopt;

  const Vec3<T> moment = glm::cross(to_origin, ray.direction);
  const T a = glm::dot(quad.edge_v, moment) * inv_determinant;
  const T b = -glm::dot(quad.edge_u, moment) * inv_determinant;
  if (!(a >= T(0) && a <= T(1) && b >= T(0) && b <= T(1))) return std::nullopt;
  if (!detail::spans_area(normal, quad)) return std::nullopt;  // last, since few rays come this far
  return Hit<T>{.t = t, .uv = {a, b}};
}

namespace detail {

/// The surface at the parameters (a, b) of a parallelogram.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> quad_surface(const Quad<T>& quad, const Vec2<T>& uv) noexcept {
  const Vec3<T> along_u = quad.edge_u * uv.x;
  const Vec3<T> along_v = quad.edge_v * uv.y;
  const T magnitude = max_component(abs(quad.origin) + abs(along_u) + abs(along_v));
  const Vec3<T> normal = glm::normalize(glm::cross(quad.edge_u, quad.edge_v));
  return {.position = quad.origin + (along_u + along_v),
          .position_error = Vec3<T>(magnitude * rounding_bound<T>(4)),
          .normal = normal,
          .shading_normal = normal,
          .tangent = quad.edge_u,
          .bitangent = quad.edge_v,
          .uv = uv};
}

}  // namespace detail

/// The surface at a hit, at the point that the hit's parameters name: nearer to the plane than the ray's.
///
/// Ensures: `position_error` bounds the distance to the quad, alike on all axes, so that it is not zero for planes
///          through the world's origin.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const Quad<T>& quad, const Vec3<T>& /*position*/, const Hit<T>& hit) noexcept {
  return detail::quad_surface(quad, hit.uv);
}

template <std::floating_point T>
[[nodiscard]] T area(const Quad<T>& quad) noexcept {
  return glm::length(glm::cross(quad.edge_u, quad.edge_v));
}

/// A point uniform by area, from a uniform point of the unit square: uv is that point.
template <std::floating_point T>
[[nodiscard]] AreaSample<T> sample_area(const Quad<T>& quad, const Vec2<T>& u) noexcept {
  return {detail::quad_surface(quad, u), T(1) / area(quad)};
}

/// The point of the parallelogram closest to `point`: of its two triangles.
template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, const Quad<T>& quad) noexcept {
  const Vec3<T> u = quad.origin + quad.edge_u;
  const Vec3<T> v = quad.origin + quad.edge_v;
  const Vec3<T> first = closest_point(point, Triangle<T>{quad.origin, u, v});
  const Vec3<T> second = closest_point(point, Triangle<T>{v, u, quad.origin + (quad.edge_u + quad.edge_v)});
  return length_squared(first - point) <= length_squared(second - point) ? first : second;
}

}  // namespace glint
