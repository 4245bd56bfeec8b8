// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glint/core/config.hpp>
#include <glint/core/strided.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/clip.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A set of triangles that share vertices: a view of the user's own buffers, tightly packed or not, nothing copied.
///
/// Shapes:   `normals` and `uvs` are empty, or one a vertex. A zero normal or a missing_uv says that the vertex has
///           none.
/// Requires: the buffers outlive the view; all indices are less than the number of vertices.
/// Ensures:  the geometric normal is on the side that sees the vertices counterclockwise.
template <std::floating_point T, std::unsigned_integral VertexIndex = std::uint32_t, typename Intersector = Watertight>
struct TriangleMesh {
  using Scalar = T;
  using Index = std::uint32_t;

  Strided<Vec3<T>> positions{};
  Strided<std::array<VertexIndex, 3>> triangles{};
  Strided<Vec3<T>> normals{};
  Strided<Vec2<T>> uvs{};
  [[no_unique_address]] Intersector intersector{};

  [[nodiscard]] std::size_t size() const noexcept { return triangles.size(); }

  [[nodiscard]] std::array<Vec3<T>, 3> vertices(Index i) const noexcept { return corners(positions, i); }
  [[nodiscard]] Triangle<T> triangle(Index i) const noexcept {
    const auto [v0, v1, v2] = vertices(i);
    return {v0, v1, v2};
  }
  template <typename F>
  auto with_primitive(Index i, const F& f) const {
    return f(triangle(i));
  }

  [[nodiscard]] Aabb<T> bounds(Index i) const noexcept {
    Aabb<T> box;
    for (const Vec3<T>& vertex : vertices(i)) extend(box, vertex);
    return box;
  }

  [[nodiscard]] Aabb<T> clip(Index i, const Aabb<T>& cell) const noexcept { return clipped_bounds(vertices(i), cell); }

  [[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, Index i) const noexcept {
    return glint::closest_point(point, triangle(i));
  }

  [[nodiscard]] auto prepare(const Ray<T>& ray) const noexcept { return intersector.prepare(ray); }

  template <typename Prepared>
  [[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Prepared& prepared, Index i) const noexcept {
    const auto [v0, v1, v2] = vertices(i);
    std::optional<Hit<T>> hit = intersector.intersect(ray, prepared, v0, v1, v2);
    if (hit) hit->primitive = i;
    return hit;
  }
  [[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, Index i) const noexcept {
    return intersect(ray, prepare(ray), i);
  }

  /// The shading normal is interpolated where there are normals; uv and tangents follow the uvs where there are any,
  /// else they are the triangle's own. The tangents are zero where the uvs span no area.
  [[nodiscard]] GLINT_ALWAYS_INLINE SurfaceOf<T> surface(const Ray<T>& /*ray*/, const Hit<T>& hit) const noexcept {
    const Index i = hit.primitive;
    const Triangle<T> shape = triangle(i);
    const T w1 = hit.uv.x;
    const T w2 = hit.uv.y;
    const T w0 = T(1) - w1 - w2;
    SurfaceOf<T> s = surface_at(shape, w1, w2);
    if (!normals.empty()) {
      const auto [n0, n1, n2] = corners(normals, i);
      const Vec3<T> n = n0 * w0 + n1 * w1 + n2 * w2;
      const T squared = length_squared(n);
      if (squared > T(0) && std::isfinite(squared)) s.shading_normal = n * (T(1) / std::sqrt(squared));
    }
    if (!uvs.empty()) {
      const auto [uv0, uv1, uv2] = corners(uvs, i);
      const Vec2<T> uv = uv0 * w0 + uv1 * w1 + uv2 * w2;
      if (std::isnan(uv.x)) return s;
      s.uv = uv;
      set_tangents(s, shape, uv1 - uv0, uv2 - uv0);
    }
    return s;
  }

 private:
  template <typename V>
  [[nodiscard]] std::array<V, 3> corners(const Strided<V>& of, Index i) const noexcept {
    const std::array<VertexIndex, 3> at = triangles[i];
    return {of[at[0]], of[at[1]], of[at[2]]};
  }

  static void set_tangents(SurfaceOf<T>& s, const Triangle<T>& t, const Vec2<T>& d1, const Vec2<T>& d2) noexcept {
    const T inverse = T(1) / (d1.x * d2.y - d1.y * d2.x);
    const Vec3<T> e1 = t.v1 - t.v0;
    const Vec3<T> e2 = t.v2 - t.v0;
    const Vec3<T> along_u = (e1 * d2.y - e2 * d1.y) * inverse;
    const Vec3<T> along_v = (e2 * d1.x - e1 * d2.x) * inverse;
    s.tangent = is_finite(along_u) ? along_u : Vec3<T>(T(0));
    s.bitangent = is_finite(along_v) ? along_v : Vec3<T>(T(0));
  }
};

/// The mesh in these buffers, which must outlive the view. An incomplete last triangle is left out.
template <typename Intersector = Watertight, std::floating_point T>
[[nodiscard]] TriangleMesh<T, std::uint32_t, Intersector> view(const MeshBuffers<T>& mesh) noexcept {
  return {.positions = mesh.positions,
          .triangles = {mesh.indices.data(), mesh.indices.size() / 3},
          .normals = mesh.normals,
          .uvs = mesh.uvs};
}

}  // namespace glint
