// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ranges>
#include <span>

#include <glint/core/config.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

namespace detail {

/// The free functions of a primitive, for members that have the same names and would hide them.
template <typename P>
[[nodiscard]] auto bounds_of(const P& primitive) {
  return bounds(primitive);
}
template <typename P, typename Box>
[[nodiscard]] Box clip_of(const P& primitive, const Box& cell) {
  return clip(primitive, cell);
}
template <std::floating_point T, typename P>
[[nodiscard]] Vec3<T> closest_point_of(const Vec3<T>& point, const P& primitive) {
  return closest_point(point, primitive);
}
template <std::floating_point T, typename P>
[[nodiscard]] auto intersect_with(const Ray<T>& ray, const P& primitive) {
  return intersect(ray, primitive);
}
template <typename P, std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface_of(const P& primitive, const Vec3<T>& position, const Hit<T>& hit) {
  if constexpr (requires { surface(primitive, position, hit); }) {
    return surface(primitive, position, hit);
  } else {
    return surface(primitive, position);
  }
}

}  // namespace detail

/// A bound for the error of `ray.at(t)`: what the position is worth where a primitive does not say.
///
/// Three roundings of the point itself, and as much again for a t that is off by a few roundings.
template <std::floating_point T>
[[nodiscard]] Vec3<T> position_error(const Ray<T>& ray, T t) noexcept {
  const Vec3<T> way = abs(ray.direction * t);
  return (abs(ray.origin) + way) * rounding_bound<T>(4) + Vec3<T>(max_component(way) * rounding_bound<T>(4));
}

/// A range of primitives of one type as a set: a view, nothing copied. `Elements{shapes}` for a vector, array or span.
///
/// Requires: the primitives outlive the view; an index of type I can count them.
template <Primitive P, std::unsigned_integral I = std::uint32_t>
class Elements {
 public:
  using Scalar = ScalarOf<P>;
  using Index = I;

  constexpr Elements() noexcept = default;
  constexpr explicit Elements(std::span<const P> primitives) noexcept : primitives_(primitives) {
    GLINT_ASSERT(primitives.size() < none<I>);
  }

  [[nodiscard]] constexpr std::size_t size() const noexcept { return primitives_.size(); }
  /// Requires: i < size().
  [[nodiscard]] constexpr const P& operator[](Index i) const noexcept { return primitives_[i]; }

  /// f(primitive), as sets of primitives of several types have it.
  template <typename F>
  constexpr auto with_primitive(Index i, const F& f) const {
    return f(primitives_[i]);
  }

  [[nodiscard]] Aabb<Scalar> bounds(Index i) const { return detail::bounds_of(primitives_[i]); }

  [[nodiscard]] Aabb<Scalar> clip(Index i, const Aabb<Scalar>& cell) const requires(ClippablePrimitive<P>) {
    return detail::clip_of(primitives_[i], cell);
  }

  [[nodiscard]] Vec3<Scalar> closest_point(const Vec3<Scalar>& point, Index i) const
      requires(ClosestPointPrimitive<P>) {
    return detail::closest_point_of(point, primitives_[i]);
  }

  [[nodiscard]] std::optional<Hit<Scalar, I>> intersect(const Ray<Scalar>& ray, Index i) const {
    const auto hit = detail::intersect_with(ray, primitives_[i]);
    if (!hit) return std::nullopt;
    return Hit<Scalar, I>{.t = hit->t, .uv = hit->uv, .primitive = i};
  }

  /// Where the primitive leaves `position_error` zero, a bound from the ray is put in.
  [[nodiscard]] SurfaceOf<Scalar> surface(const Ray<Scalar>& ray, const Hit<Scalar, I>& hit) const
      requires(ShadablePrimitive<P>) {
    const Hit<Scalar> own{.t = hit.t, .uv = hit.uv};
    auto s = detail::surface_of(primitives_[hit.primitive], ray.at(hit.t), own);
    if (s.position_error == Vec3<Scalar>(Scalar(0))) s.position_error = position_error(ray, hit.t);
    return s;
  }

 private:
  std::span<const P> primitives_;
};

template <std::ranges::contiguous_range R>
explicit Elements(R&&) -> Elements<std::ranges::range_value_t<R>>;

}  // namespace glint
