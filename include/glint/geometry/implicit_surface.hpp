// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_box.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A function of points that is zero on a surface and negative inside: `T operator()(const Vec3<T>&) const`. Where it
/// also has `Vec3<T> gradient(const Vec3<T>&) const`, normals are taken from that.
template <typename F, typename T>
concept ImplicitFunction = std::copyable<F> && requires(const F& function, const Vec3<T>& point) {
  { function(point) } -> std::convertible_to<T>;
};

/// Where a function of points, as a signed distance, is zero inside of a box. Both sides are hit; where the box cuts
/// the solid, it is open.
///
///     const glint::ImplicitSurface ball{box, [](const Vec3<float>& p) { return glm::length(p) - 1; }};
///
/// A ray walks in steps so large as the function lets it be sure of, but for a floor: so it ends also where it grazes
/// the surface. What is thinner than that floor, the box's diagonal over `resolution`, may be stepped over.
///
/// Units:    scene units times `steepness`: by how much the function changes at most over a unit of length. 1 for true
///           distances; a function that is steeper than it says is stepped through.
/// Requires: the function is right to a few roundings of the box's coordinates; resolution ≥ 1.
/// Source:   Hart, "Sphere Tracing: A Geometric Method for the Antialiased Ray Tracing of Implicit Surfaces", The
/// Visual
///           Computer 12(10), 1996; the floor and the bisection are our own.
template <std::floating_point T, ImplicitFunction<T> F>
struct ImplicitSurface {
  Aabb<T> box;
  F function;
  T steepness = 1;
  int resolution = 1024;

  /// The least step, in scene units.
  [[nodiscard]] T detail() const noexcept { return glm::length(extent(box)) / T(resolution); }
};

template <std::floating_point T, typename F>
ImplicitSurface(Aabb<T>, F) -> ImplicitSurface<T, F>;
template <std::floating_point T, typename F>
ImplicitSurface(Aabb<T>, F, T) -> ImplicitSurface<T, F>;
template <std::floating_point T, typename F>
ImplicitSurface(Aabb<T>, F, T, int) -> ImplicitSurface<T, F>;

namespace detail {

/// A walk along a line from one change of the function's sign to the next. It begins where the line enters the box,
/// wherever the ray does: so that a crossing is found at the same t whichever interval a ray asks for.
template <std::floating_point T, typename F>
class SphereTrace {
 public:
  SphereTrace(const Ray<T>& ray, const ImplicitSurface<T, F>& shape, const Interval<T>& inside) noexcept
      : ray_(ray), shape_(shape), t_(inside.lower), end_(inside.upper), value_(value(t_)) {
    const T speed = glm::length(ray.direction);
    per_value_ = T(1) / (shape.steepness * speed);
    least_ = shape.detail() / speed;
  }

  /// Where the next crossing is.
  [[nodiscard]] std::optional<T> next() {
    while (t_ < end_) {
      const T before = t_;
      const bool was_negative = value_ < T(0);
      t_ = std::min(t_ + std::max(std::abs(value_) * per_value_, least_), end_);
      if (!(t_ > before)) return std::nullopt;
      value_ = value(t_);
      if ((value_ < T(0)) != was_negative) return between(before, t_, was_negative);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] T value(T t) const { return T(shape_.function(ray_.at(t))); }

  /// By halves, until no number is left between.
  [[nodiscard]] T between(T before, T after, bool was_negative) const {
    while (true) {
      const T middle = before + (after - before) / 2;
      if (!(middle > before && middle < after)) return after;
      ((value(middle) < T(0)) == was_negative ? before : after) = middle;
    }
  }

  const Ray<T>& ray_;
  const ImplicitSurface<T, F>& shape_;
  T t_;
  T end_;
  T value_;
  T per_value_ = 0;
  T least_ = 0;
};

/// How the function grows along the axes, by its own gradient or by differences over a detail.
template <std::floating_point T, typename F>
[[nodiscard]] Vec3<T> gradient(const ImplicitSurface<T, F>& shape, const Vec3<T>& p) {
  const F& f = shape.function;
  if constexpr (requires {
                  { f.gradient(p) } -> std::convertible_to<Vec3<T>>;
                }) {
    return f.gradient(p);
  } else {
    const T h = shape.detail();
    const auto along = [&](const Vec3<T>& step) { return T(f(p + step)) - T(f(p - step)); };
    return Vec3<T>(along({h, 0, 0}), along({0, h, 0}), along({0, 0, h})) / (T(2) * h);
  }
}

}  // namespace detail

template <std::floating_point T, typename F>
[[nodiscard]] Aabb<T> bounds(const ImplicitSurface<T, F>& shape) noexcept {
  return shape.box;
}

/// The first crossing within the ray's interval.
///
/// Errors: a NaN or a zero direction reports no hit.
/// Cost:   as many calls of the function as steps, at most `resolution` and those that were larger; and for each
///         crossing one for each bit of t that the step left open.
template <std::floating_point T, typename F>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const ImplicitSurface<T, F>& shape) {
  Ray<T> line = ray;
  line.t_min = -infinity<T>;
  line.t_max = infinity<T>;
  const auto inside = intersect(line, shape.box);
  if (!inside || !(inside->upper >= ray.t_min) || !(inside->lower <= ray.t_max)) return std::nullopt;
  detail::SphereTrace<T, F> trace(line, shape, *inside);
  while (const auto t = trace.next()) {
    if (!(*t <= ray.t_max)) return std::nullopt;
    if (*t >= ray.t_min) return Hit<T>{.t = *t};
  }
  return std::nullopt;
}

/// The normal goes to where the function grows. There are no texture coordinates.
template <std::floating_point T, typename F>
[[nodiscard]] SurfaceOf<T> surface(const ImplicitSurface<T, F>& shape, const Vec3<T>& position) {
  const T magnitude = max_component(glm::max(abs(shape.box.lower), abs(shape.box.upper)));
  const Vec3<T> gradient = detail::gradient(shape, position);
  const T length = glm::length(gradient);
  SurfaceOf<T> at;
  at.position = position;
  if (length > T(0)) {
    at.normal = gradient / length;
    at.position -= at.normal * (T(shape.function(position)) / length);
  }
  at.position_error = Vec3<T>(magnitude * rounding_bound<T>(32));
  at.shading_normal = at.normal;
  return at;
}

}  // namespace glint
