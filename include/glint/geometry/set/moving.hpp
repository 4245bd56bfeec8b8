// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <glint/core/config.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/motion.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/vec.hpp>

namespace glint {

template <typename Mesh, std::size_t K = 2>
class Moving;

/// A mesh in motion, given by K keyframes, evenly spaced from time 0 to 1; a ray meets it as it is at the ray's `time`.
/// Between two keys each vertex moves along a straight line at one speed.
///
///     const glint::Bvh bvh{glint::Moving{view(when_it_opens), view(when_it_closes)}};
///     bvh.closest({.origin = from, .direction = to, .time = 0.25F});
///
/// Trees over it have boxes that move along, unless they are told otherwise (layout/motion.hpp). A view: nothing is
/// copied.
///
/// Shapes:   triangles and uvs are those of the first key; vertices and their normals are of each. Normals count where
///           all keys have them.
/// Requires: the buffers outlive the view; as many vertices in each key.
/// Errors:   a triangle that is not finite at some key is never hit; one without area is not hit at that time.
template <std::floating_point T, std::unsigned_integral V, typename Intersector, std::size_t K>
  requires(K >= 2)
class Moving<TriangleMesh<T, V, Intersector>, K> {
 public:
  using Mesh = TriangleMesh<T, V, Intersector>;
  using Scalar = T;
  using Index = typename Mesh::Index;
  using Weights = Moment<T, K>;

  template <std::same_as<Mesh>... Meshes>
    requires(sizeof...(Meshes) == K)
  explicit Moving(const Meshes&... keys) noexcept : keys_{keys...} {}

  [[nodiscard]] std::size_t size() const noexcept { return keys_[0].size(); }
  /// Requires: k < K.
  [[nodiscard]] const Mesh& key(std::size_t k) const noexcept { return keys_[k]; }

  /// Of the triangle in a key, by the first key's indices.
  [[nodiscard]] std::array<Vec3<T>, 3> vertices(std::size_t k, Index i) const noexcept {
    const std::array<V, 3> at = keys_[0].triangles[i];
    return {keys_[k].positions[at[0]], keys_[k].positions[at[1]], keys_[k].positions[at[2]]};
  }
  [[nodiscard]] std::array<Vec3<T>, 3> vertices(const Weights& moment, Index i) const noexcept {
    const auto a = vertices(moment.key, i);
    const auto b = vertices(moment.key + 1, i);
    return {moment.mix(a[0], b[0]), moment.mix(a[1], b[1]), moment.mix(a[2], b[2])};
  }

  /// Of all times.
  [[nodiscard]] Aabb<T> bounds(Index i) const noexcept { return swept_bounds<T>(key_bounds(i)); }
  [[nodiscard]] MotionBounds<T> motion_bounds(Index i) const noexcept { return linear_bounds<T>(key_bounds(i)); }

  struct Prepared {
    decltype(std::declval<const Intersector&>().prepare(std::declval<const Ray<T>&>())) ray;
    Weights moment;
  };
  [[nodiscard]] Prepared prepare(const Ray<T>& ray) const noexcept {
    return {keys_[0].intersector.prepare(ray), Weights(ray.time)};
  }
  [[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Prepared& prepared, Index i) const noexcept {
    const auto [v0, v1, v2] = vertices(prepared.moment, i);
    std::optional<Hit<T>> hit = keys_[0].intersector.intersect(ray, prepared.ray, v0, v1, v2);
    if (hit) hit->primitive = i;
    return hit;
  }
  [[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, Index i) const noexcept {
    return intersect(ray, prepare(ray), i);
  }

  /// That of the mesh at the ray's time.
  [[nodiscard]] SurfaceOf<T> surface(const Ray<T>& ray, const Hit<T>& hit) const noexcept {
    const Weights moment(ray.time);
    const std::array<Vec3<T>, 3> positions = vertices(moment, hit.primitive);
    const std::array<V, 3> at = keys_[0].triangles[hit.primitive];
    const std::array<std::array<V, 3>, 1> one{{{V(0), V(1), V(2)}}};
    Mesh now{.positions = positions, .triangles = one};
    std::array<Vec3<T>, 3> normals;
    const Mesh& a = keys_[moment.key];
    const Mesh& b = keys_[moment.key + 1];
    if (!a.normals.empty() && !b.normals.empty()) {
      for (std::size_t i = 0; i < 3; ++i) normals[i] = moment.mix(a.normals[at[i]], b.normals[at[i]]);
      now.normals = normals;
    }
    std::array<Vec2<T>, 3> uvs;
    if (!keys_[0].uvs.empty()) {
      uvs = {keys_[0].uvs[at[0]], keys_[0].uvs[at[1]], keys_[0].uvs[at[2]]};
      now.uvs = uvs;
    }
    Hit<T> first = hit;
    first.primitive = 0;
    return now.surface(ray, first);
  }

 private:
  [[nodiscard]] std::array<Aabb<T>, K> key_bounds(Index i) const noexcept {
    std::array<Aabb<T>, K> boxes;
    for (std::size_t k = 0; k < K; ++k)
      for (const Vec3<T>& vertex : vertices(k, i)) extend(boxes[k], vertex);
    return boxes;
  }

  std::array<Mesh, K> keys_;
};

template <typename Mesh, std::same_as<Mesh>... Rest>
explicit Moving(const Mesh&, const Rest&...) -> Moving<Mesh, 1 + sizeof...(Rest)>;

}  // namespace glint
