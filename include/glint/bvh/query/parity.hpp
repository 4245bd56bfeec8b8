// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <optional>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/query/hits.hpp>
#include <glint/bvh/query/winding.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

namespace glint {

namespace detail {

/// How often a ray crosses a mesh. Nothing where it comes so close to an edge that both triangles there may count, or
/// neither.
template <TriangleSet S, LayoutChoice L>
[[nodiscard]] std::optional<std::size_t> crossings(const Bvh<S, L>& bvh, const Ray<typename S::Scalar>& ray) {
  using T = typename S::Scalar;
  constexpr T margin = rounding_bound<T>(64);
  std::size_t count = 0;
  const Walk end = for_each_hit(bvh, ray, [&](const Hit<T, typename S::Index>& hit) {
    const T least = std::min({hit.uv.x, hit.uv.y, T(1) - hit.uv.x - hit.uv.y});
    ++count;
    return least > margin ? Walk::Continue : Walk::Stop;
  });
  return end == Walk::Stop ? std::nullopt : std::optional(count);
}

}  // namespace detail

/// Whether a point is inside a closed mesh: whether a ray from there crosses it an odd number of times. Which sides are
/// outer does not matter. What is inside of two parts that overlap is outside, and a ray through a hole errs: Winding
/// takes both.
///
/// A ray that comes close to an edge is given up for another one. Their directions are always the same.
///
/// Requires: every edge belongs to two triangles; a watertight intersector.
/// Errors:   of no meaning on the surface.
/// Cost:     about that of a ray; a tree that has primitives in parts allocates.
/// Threads:  may be called by many at once.
template <TriangleSet S, LayoutChoice L>
[[nodiscard]] bool inside_by_parity(const Bvh<S, L>& bvh, const Vec3<typename S::Scalar>& point) {
  using T = typename S::Scalar;
  constexpr int attempts = 64;
  Random random(0);
  for (int i = 0; i < attempts; ++i) {
    const Vec3<T> direction = uniform_sphere(random.uniform_vec2<T>());
    if (const auto count = detail::crossings(bvh, Ray<T>{.origin = point, .direction = direction}))
      return *count % 2 == 1;
  }
  return false;
}

}  // namespace glint
