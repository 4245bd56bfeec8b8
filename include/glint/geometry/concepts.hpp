// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>

namespace glint {

/// The scalar of a box type: how the library learns a primitive's precision from its `bounds`.
template <typename Box>
struct ScalarOfBox;
template <std::floating_point T>
struct ScalarOfBox<Aabb<T>> {
  using type = T;
};
template <typename P>
using ScalarOf = typename ScalarOfBox<std::remove_cvref_t<decltype(bounds(std::declval<const P&>()))>>::type;

/// A shape of the user's or the library's: two free functions found by argument-dependent lookup.
///
///     Aabb<T> bounds(const P&);                                      // holds every point a ray can hit
///     std::optional<Hit<T>> intersect(const Ray<T>&, const P&);      // the first hit with t_min ≤ t ≤ t_max
///
/// Laws: testing/primitive_laws.hpp. A hit's `primitive` and `inner` are left alone; sets fill them.
template <typename P>
concept Primitive = requires(const P& primitive) {
  {bounds(primitive)};
  typename ScalarOf<P>;
}
&&requires(const P& primitive, const Ray<ScalarOf<P>>& ray) {
  { intersect(ray, primitive) } -> std::same_as<std::optional<Hit<ScalarOf<P>>>>;
};

/// A primitive that can be shaded. `position` is the hit point computed from the ray; the primitive may refine it.
///
///     SurfaceOf<T> surface(const P&, const Vec3<T>& position, const Hit<T>&);   // or without the hit, where
///     SurfaceOf<T> surface(const P&, const Vec3<T>& position);                  // the position says everything
template <typename P>
concept ShadablePrimitive = Primitive<P> &&(
    requires(const P& primitive, const Vec3<ScalarOf<P>>& position, const Hit<ScalarOf<P>>& hit) {
      { surface(primitive, position, hit) } -> std::same_as<SurfaceOf<ScalarOf<P>>>;
    } ||
    requires(const P& primitive, const Vec3<ScalarOf<P>>& position) {
      { surface(primitive, position) } -> std::same_as<SurfaceOf<ScalarOf<P>>>;
    });

/// A primitive whose surface can be sampled uniformly by area: what area lights stand on.
template <typename P>
concept SampleablePrimitive = Primitive<P> && requires(const P& primitive, const Vec2<ScalarOf<P>>& u) {
  { area(primitive) } -> std::same_as<ScalarOf<P>>;
  { sample_area(primitive, u) } -> std::same_as<AreaSample<ScalarOf<P>>>;
};

/// A primitive that knows which part of it lies in a cell: a box that holds every point of the primitive in the cell,
/// and what next to the cell a ray may hit by rounding. Builders then cut the primitive, not its box.
///
///     Aabb<T> clip(const P&, const Aabb<T>& cell);      // empty where there is nothing
template <typename P>
concept ClippablePrimitive = Primitive<P> && requires(const P& primitive, const Aabb<ScalarOf<P>>& cell) {
  { clip(primitive, cell) } -> std::same_as<Aabb<ScalarOf<P>>>;
};

/// A primitive that knows its point closest to another: `Vec3<T> closest_point(const Vec3<T>& point, const P&)`.
template <typename P>
concept ClosestPointPrimitive = Primitive<P> && requires(const P& primitive, const Vec3<ScalarOf<P>>& point) {
  { closest_point(point, primitive) } -> std::same_as<Vec3<ScalarOf<P>>>;
};

/// Boxes by index: all that a tree builder asks for.
template <typename S>
concept BoundedSet = requires(const S& set, typename S::Index i) {
  typename S::Scalar;
  typename S::Index;
  { set.size() } -> std::convertible_to<std::size_t>;
  { set.bounds(i) } -> std::same_as<Aabb<typename S::Scalar>>;
};

/// A set of clippable primitives: `clip(i, cell)` as in ClippablePrimitive.
template <typename S>
concept ClippableSet = BoundedSet<S> &&
    requires(const S& set, typename S::Index i, const Aabb<typename S::Scalar>& cell) {
  { set.clip(i, cell) } -> std::same_as<Aabb<typename S::Scalar>>;
};

/// Primitives by index. Returned hits carry the index in `primitive`.
///
/// A set may also offer `prepare(ray)`, a value computed once a ray (a watertight triangle test's shear, say), and
/// take it back in `intersect(ray, prepared, i)`; traversal then does so.
template <typename S>
concept PrimitiveSet = BoundedSet<S> &&
    requires(const S& set, typename S::Index i, const Ray<typename S::Scalar>& ray) {
  { set.intersect(ray, i) } -> std::same_as<std::optional<Hit<typename S::Scalar, typename S::Index>>>;
};

/// A set with a once-a-ray value.
template <typename S>
concept PreparedSet = PrimitiveSet<S> &&
    requires(const S& set, typename S::Index i, const Ray<typename S::Scalar>& ray) {
  {
    set.intersect(ray, set.prepare(ray), i)
    } -> std::same_as<std::optional<Hit<typename S::Scalar, typename S::Index>>>;
};

/// A set whose hits can be shaded: `surface(ray, hit)`, for a hit this set returned for this ray.
template <typename S>
concept ShadableSet = PrimitiveSet<S> &&
    requires(const S& set, const Ray<typename S::Scalar>& ray, const Hit<typename S::Scalar, typename S::Index>& hit) {
  { set.surface(ray, hit) } -> std::same_as<SurfaceOf<typename S::Scalar>>;
};

/// A set whose primitives know their point closest to another: `closest_point(point, i)`.
template <typename S>
concept ClosestPointSet = PrimitiveSet<S> &&
    requires(const S& set, typename S::Index i, const Vec3<typename S::Scalar>& point) {
  { set.closest_point(point, i) } -> std::same_as<Vec3<typename S::Scalar>>;
};

/// A set that answers faster whether a ray meets a primitive than where: `occluded(ray, i)` is
/// `intersect(ray, i).has_value()`.
template <typename S>
concept OccluderSet = PrimitiveSet<S> &&
    requires(const S& set, typename S::Index i, const Ray<typename S::Scalar>& ray) {
  { set.occluded(ray, i) } -> std::same_as<bool>;
};

/// How many values `inner` may have in the hits of a set, `none` among them: one, where nothing is nested.
template <BoundedSet S>
[[nodiscard]] constexpr std::size_t inner_values(const S& set) noexcept {
  if constexpr (requires { set.inner_values(); }) {
    return set.inner_values();
  } else {
    return 1;
  }
}

/// Something that answers ray queries over a whole scene.
///
/// Laws (testing/ray_caster_laws.hpp): `occluded(ray) == closest(ray).has_value()`, and both agree with BruteForce.
template <typename G>
concept RayCaster = requires(const G& geometry, const Ray<typename G::Scalar>& ray) {
  typename G::Scalar;
  typename G::Index;
  { geometry.bounds() } -> std::same_as<Aabb<typename G::Scalar>>;
  { geometry.closest(ray) } -> std::same_as<std::optional<Hit<typename G::Scalar, typename G::Index>>>;
  { geometry.occluded(ray) } -> std::same_as<bool>;
};

}  // namespace glint
