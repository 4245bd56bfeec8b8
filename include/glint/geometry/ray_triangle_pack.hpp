// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include <glint/core/config.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_packet.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Where a ray crosses N triangles.
template <typename P>
struct Crossings {
  std::uint32_t hit = 0;   ///< bit i: triangle i is hit within the interval
  std::uint32_t tied = 0;  ///< bit i: rounding hides whether it is; it has to be tested by itself
  P t, det, w1, w2;        ///< w1 / det and w2 / det are the weights of vertices 1 and 2
};

/// A triangle test for N triangles at once, by the arithmetic of an intersector to the last bit:
///
///     Prepared                                      // a ray, in all lanes
///     static Prepared prepare(ray, intersector.prepare(ray))
///     Triangles                                     // what is worth keeping of N triangles; a NaN is never hit
///     static Triangles triangles(vertex)            // vertex(i, axis): that coordinate of vertex i of each triangle
///     static Crossings<Pack<T, N, W>> cross(const Triangles&, const Prepared&, T t_max)
///     static Crossings<Pack<T, N, W>> cross_at(vertex, const Prepared&, T t_max)   // nothing kept
///
/// Or for one triangle and N rays, a lane each:
///
///     static Prepared prepare(const RayPacket<T>&)
///     static Crossings<Pack<T, N, W>> cross_one(triangles of another PackedTest, which, const Prepared&, T t_max)
///
/// To be specialized for an intersector; triangles of one without are tested one by one.
template <typename Intersector, std::floating_point T, int N, int W = Pack<T, N>::width>
struct PackedTest;

/// Intersectors with a PackedTest.
template <typename Intersector, typename T, int N>
concept PackedIntersector = requires {
  typename PackedTest<Intersector, T, N>::Triangles;
};

namespace detail {

template <typename P>
using Pack3 = std::array<P, 3>;

template <typename P>
[[nodiscard]] GLINT_ALWAYS_INLINE Pack3<P> minus(const Pack3<P>& a, const Pack3<P>& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <typename P>
[[nodiscard]] GLINT_ALWAYS_INLINE P rounded_dot(const Pack3<P>& a, const Pack3<P>& b) noexcept {
  return fenced(a[0] * b[0]) + fenced(a[1] * b[1]) + fenced(a[2] * b[2]);
}
template <typename P>
[[nodiscard]] GLINT_ALWAYS_INLINE Pack3<P> rounded_cross(const Pack3<P>& a, const Pack3<P>& b) noexcept {
  return {fenced(a[1] * b[2]) - fenced(a[2] * b[1]), fenced(a[2] * b[0]) - fenced(a[0] * b[2]),
          fenced(a[0] * b[1]) - fenced(a[1] * b[0])};
}
template <typename P, typename T>
[[nodiscard]] GLINT_ALWAYS_INLINE Pack3<P> in_all_lanes(const Vec3<T>& v) noexcept {
  return {P::broadcast(v.x), P::broadcast(v.y), P::broadcast(v.z)};
}
template <typename P, typename Q>
[[nodiscard]] GLINT_ALWAYS_INLINE Pack3<P> spread(const Pack3<Q>& points, int lane) noexcept {
  return {P::broadcast(points[0][lane]), P::broadcast(points[1][lane]), P::broadcast(points[2][lane])};
}
template <typename P, typename Vertex>
[[nodiscard]] GLINT_ALWAYS_INLINE Pack3<P> corner(const Vertex& vertex, int i) noexcept {
  return {vertex(i, 0), vertex(i, 1), vertex(i, 2)};
}

}  // namespace detail

/// Source: Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1), 1997.
template <std::floating_point T, int N, int W>
struct PackedTest<MoellerTrumbore, T, N, W> {
  using P = Pack<T, N, W>;
  using Point = detail::Pack3<P>;

  struct Prepared {
    Point origin, direction;
    P t_min;
  };
  /// Keeping the normal as well would win a few percent of the time for a quarter more memory.
  struct Triangles {
    Point v0, back, e2;  ///< back: from vertex 1 to vertex 0
  };

  [[nodiscard]] GLINT_ALWAYS_INLINE static Prepared prepare(const Ray<T>& ray,
                                                            MoellerTrumbore::Prepared /*prepared*/) noexcept {
    return {detail::in_all_lanes<P>(ray.origin), detail::in_all_lanes<P>(ray.direction), P::broadcast(ray.t_min)};
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE static Prepared prepare(const RayPacket<T>& rays) noexcept {
    return {rays.origin, rays.direction, rays.t_min};
  }
  template <typename Vertex>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Triangles triangles(const Vertex& vertex) noexcept {
    const Point v0 = detail::corner<P>(vertex, 0);
    return {v0, detail::minus(v0, detail::corner<P>(vertex, 1)), detail::minus(detail::corner<P>(vertex, 2), v0)};
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE static Crossings<P> cross(const Triangles& triangles, const Prepared& ray,
                                                              T t_max) noexcept {
    const Point n = detail::rounded_cross(triangles.e2, triangles.back);
    const Point c = detail::minus(triangles.v0, ray.origin);
    const Point r = detail::rounded_cross(c, ray.direction);
    const P det = detail::rounded_dot(n, ray.direction);
    const P w1 = detail::rounded_dot(r, triangles.e2);
    const P w2 = detail::rounded_dot(r, triangles.back);
    const P w0 = det - (w1 + w2);
    const P zero = P::broadcast(T(0));
    Crossings<P> result;
    const std::uint32_t inside =
        less_equal(zero, min(min(w1, w2), w0)) | less_equal(max(max(w1, w2), w0), zero);  // a NaN stays: w0 is second
    if (N < RayPacket<T>::size && inside == 0) return result;  // of many rays one is inside more often than not
    result.t = detail::rounded_dot(n, c) / det;
    result.hit = inside & (less(det, zero) | less(zero, det)) & less_equal(ray.t_min, result.t) &
                 less_equal(result.t, P::broadcast(t_max));
    result.det = det;
    result.w1 = w1;
    result.w2 = w2;
    return result;
  }
  template <typename Several>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Crossings<P> cross_one(const Several& triangles, int i, const Prepared& rays,
                                                                  T t_max) noexcept {
    const Triangles one{detail::spread<P>(triangles.v0, i), detail::spread<P>(triangles.back, i),
                        detail::spread<P>(triangles.e2, i)};
    return cross(one, rays, t_max);
  }
  template <typename Vertex>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Crossings<P> cross_at(const Vertex& vertex, const Prepared& ray,
                                                                 T t_max) noexcept {
    return cross(triangles(vertex), ray, t_max);
  }
};

/// Source: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
template <std::floating_point T, int N, int W>
struct PackedTest<Watertight, T, N, W> {
  using P = Pack<T, N, W>;
  using Point = detail::Pack3<P>;

  /// The axes are permuted as in Watertight::Prepared.
  struct Prepared {
    std::array<int, 3> axis;
    Point origin;
    P shear_x, shear_y, scale_z;
    P t_min;
  };
  struct Triangles {
    std::array<Point, 3> vertex;
  };

  [[nodiscard]] GLINT_ALWAYS_INLINE static Prepared prepare(const Ray<T>& ray,
                                                            const Watertight::Prepared<T>& shear) noexcept {
    const std::array<int, 3> axis{shear.x, shear.y, shear.z};
    return {axis,
            {P::broadcast(component(ray.origin, axis[0])), P::broadcast(component(ray.origin, axis[1])),
             P::broadcast(component(ray.origin, axis[2]))},
            P::broadcast(shear.shear_x),
            P::broadcast(shear.shear_y),
            P::broadcast(shear.scale_z),
            P::broadcast(ray.t_min)};
  }
  /// Requires: all rays of one course.
  [[nodiscard]] GLINT_ALWAYS_INLINE static Prepared prepare(const RayPacket<T>& rays) noexcept {
    const std::size_t z = rays.longest_axis();
    const std::size_t x = z == 2 ? 0 : z + 1;
    const std::size_t y = x == 2 ? 0 : x + 1;
    const P scale = P::broadcast(T(1)) / rays.direction[z];
    return {{int(x), int(y), int(z)},
            {rays.origin[x], rays.origin[y], rays.origin[z]},
            rays.direction[x] * scale,
            rays.direction[y] * scale,
            scale,
            rays.t_min};
  }
  template <typename Vertex>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Triangles triangles(const Vertex& vertex) noexcept {
    return {{detail::corner<P>(vertex, 0), detail::corner<P>(vertex, 1), detail::corner<P>(vertex, 2)}};
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE static Crossings<P> cross(const Triangles& triangles, const Prepared& ray,
                                                              T t_max) noexcept {
    return cross_at([&](int i, int axis) -> const P& { return triangles.vertex[std::size_t(i)][std::size_t(axis)]; },
                    ray, t_max);
  }
  template <typename Several>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Crossings<P> cross_one(const Several& triangles, int i, const Prepared& rays,
                                                                  T t_max) noexcept {
    const auto vertex = [&](int v, int axis) {
      return P::broadcast(triangles.vertex[std::size_t(v)][std::size_t(axis)][i]);
    };
    return cross_at(vertex, rays, t_max);
  }
  template <typename Vertex>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Crossings<P> cross_at(const Vertex& vertex, const Prepared& ray,
                                                                 T t_max) noexcept {
    const Point a = projected(vertex, 0, ray);
    const Point b = projected(vertex, 1, ray);
    const Point c = projected(vertex, 2, ray);
    // Fenced, a difference is zero just where the rounded products tie.
    const P u = fenced(c[0] * b[1]) - fenced(c[1] * b[0]);
    const P v = fenced(a[0] * c[1]) - fenced(a[1] * c[0]);
    const P w = fenced(b[0] * a[1]) - fenced(b[1] * a[0]);
    const P zero = P::broadcast(T(0));
    const P least = min(min(u, v), w);
    const P most = max(max(u, v), w);
    Crossings<P> result;
    const std::uint32_t inside = less_equal(zero, least) | less_equal(most, zero);
    if (N < RayPacket<T>::size && inside == 0) return result;  // of many rays one is inside more often than not
    const std::uint32_t decided = less(zero, least) | less(most, zero);
    result.tied = inside & ~decided;
    result.det = u + v + w;
    result.t = (fenced(u * a[2]) + fenced(v * b[2]) + fenced(w * c[2])) * ray.scale_z / result.det;
    result.hit = decided & less_equal(ray.t_min, result.t) & less_equal(result.t, P::broadcast(t_max));
    result.w1 = v;
    result.w2 = w;
    return result;
  }

 private:
  /// Vertex i as the ray sees it: x and y across it, z the depth.
  template <typename Vertex>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Point projected(const Vertex& vertex, int i, const Prepared& ray) noexcept {
    const P z = vertex(i, ray.axis[2]) - ray.origin[2];
    return {(vertex(i, ray.axis[0]) - ray.origin[0]) - fenced(ray.shear_x * z),
            (vertex(i, ray.axis[1]) - ray.origin[1]) - fenced(ray.shear_y * z), z};
  }
};

}  // namespace glint
