// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/core/fixed_stack.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/curve.hpp>
#include <glint/geometry/curve_search.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/interval.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// What a sphere sweeps that moves along a Bézier curve and changes its radius on the way: a hair, a rope, a stalk. Its
/// ends are round. Many of them are better a CurveSet.
///
/// Parametrization: uv = (s along the curve, across it). Across is 1/2 where the ray looks at the middle, 0 and 1 where
///                  it grazes. The tangent is along the curve.
///
/// Requires: radii ≥ 0, and a curve that bends gently: |p′|² − r′² > r (√2 |p″| + |r″|) all along it, so that its
/// radius
///           of curvature is at least √2 of its own where it has one width.
template <std::floating_point T>
struct RoundCurve {
  BezierCurve<T> curve;

  [[nodiscard]] friend bool operator==(const RoundCurve&, const RoundCurve&) noexcept = default;
};

template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const RoundCurve<T>& shape) noexcept {
  return swept_bounds(shape.curve);
}

namespace detail {

/// Where the z-axis crosses one of the spheres along a curve.
template <std::floating_point T>
struct SweptCrossing {
  T z;
  T s;
};

/// Where the z-axis enters what a piece of a curve sweeps, and where it leaves it.
template <std::floating_point T>
struct SweptChord {
  SweptCrossing<T> enter{infinity<T>, T(0)};
  SweptCrossing<T> leave{-infinity<T>, T(0)};
};

/// Whether a ray comes in or goes out.
enum class Way { Enter, Leave };

/// The first sphere along a piece that the z-axis enters, or the last that it leaves.
///
/// The sphere at s is crossed at z(s) ∓ √f(s), f = r² − x² − y², where f ≥ 0. As long as the curve bends with more than
/// its radius there is one extreme where f ≥ 0, since the second derivative has one sign wherever the first is zero;
/// and where f < 0, the way is to where f grows.
template <Way way, std::floating_point T>
[[nodiscard]] SweptCrossing<T> extreme_of_piece(const BezierCurve<T>& piece) noexcept {
  constexpr T sign = way == Way::Enter ? T(-1) : T(1);
  const auto slope_at = [&](T s) {
    const CurvePoint<T> p = piece.at(s);
    const CurvePoint<T> d = piece.slope(s);
    const T off = p.position.x * p.position.x + p.position.y * p.position.y;
    const T f = p.radius * p.radius - off;
    const T inward = -(p.position.x * d.position.x + p.position.y * d.position.y);
    if (f > T(0)) return -sign * d.position.z * std::sqrt(f) - (inward + p.radius * d.radius);
    return -(inward + std::sqrt(off) * d.radius);
  };
  SweptCrossing<T> best{-sign * infinity<T>, T(0)};
  for (const T s : {rising_zero<T>(slope_at), T(0), T(1)}) {
    const CurvePoint<T> p = piece.at(s);
    const T f = p.radius * p.radius - p.position.x * p.position.x - p.position.y * p.position.y;
    if (!(f >= T(0) && p.radius > T(0))) continue;
    const T z = p.position.z + sign * std::sqrt(f);
    if (sign * z > sign * best.z) best = {z, s};
  }
  return best;
}

/// The chords of a ray with a curve's pieces. Where they overlap, the ray is inside.
template <std::floating_point T>
class SweptChords {
 public:
  explicit SweptChords(const BezierCurve<T>& seen) noexcept {
    for_each_near_piece(seen, [&](const CurvePiece<T>& piece) {
      SweptChord<T> chord;
      chord.enter = extreme_of_piece<Way::Enter>(piece.curve);
      if (!(chord.enter.z < infinity<T>)) return;
      chord.leave = extreme_of_piece<Way::Leave>(piece.curve);
      chord.enter.s = piece.whole_s(chord.enter.s);
      chord.leave.s = piece.whole_s(chord.leave.s);
      chords_.push(chord);
    });
  }

  /// The first way in or out for which `is_wanted(z)`.
  template <typename IsWanted>
  [[nodiscard]] std::optional<SweptCrossing<T>> first(const IsWanted& is_wanted) noexcept {
    std::optional<SweptCrossing<T>> best;
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      for (const SweptCrossing<T>& crossing : {chords_[i].enter, chords_[i].leave}) {
        if (best && crossing.z >= best->z) continue;
        if (is_wanted(crossing.z) && !is_inside(crossing.z)) best = crossing;
      }
    }
    return best;
  }

 private:
  [[nodiscard]] bool is_inside(T z) noexcept {
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      if (chords_[i].enter.z < z && z < chords_[i].leave.z) return true;
    }
    return false;
  }

  FixedStack<SweptChord<T>, 64> chords_;
};

/// Where across a curve the z-axis passes: 0 and 1 are the rims.
template <std::floating_point T>
[[nodiscard]] T fraction_across(const BezierCurve<T>& seen, T s) noexcept {
  const CurvePoint<T> p = seen.at(s);
  const Vec3<T> d = seen.slope(s).position;
  const T off = (p.position.x * d.y - p.position.y * d.x) / (std::sqrt(d.x * d.x + d.y * d.y) * p.radius);
  return off >= T(-1) && off <= T(1) ? T(0.5) + T(0.5) * off : T(0.5);
}

}  // namespace detail

/// The first crossing of a round curve within the ray's interval, from outside or from inside.
///
/// The curve is seen from the ray and halved until its pieces bend little; of each piece that the ray may touch, the
/// first sphere that the ray enters is found as the root of a derivative. So nothing is approximated by cones or
/// facets, and the error of t is that of the roots squared.
///
/// Errors:  a NaN, a zero direction, or a curve without width reports no hit. Squares of sizes, distances and
///          |direction| must be in T's range.
/// Cost:    one or two pieces, five to ten steps each, for a segment of hair.
/// Source:  van Wijk, "Ray Tracing Objects Defined by Sweeping a Sphere", Eurographics 1984, for the surface; Nakamaru,
///          Ohno, "Ray Tracing for Curves Primitive", WSCG 2002, for the halving as seen from the ray. Sphere by sphere
///          instead of the polynomial of degree ten.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const RoundCurve<T>& shape) noexcept {
  const detail::SeenCurve<T> seen(ray, shape.curve);
  if (!detail::may_touch_axis(seen.curve)) return std::nullopt;
  detail::SweptChords<T> chords(seen.curve);
  const auto t_of = [&](T z) { return seen.t + z * seen.per_unit; };
  const auto is_wanted = [&](T z) { return t_of(z) >= ray.t_min && t_of(z) <= ray.t_max && std::abs(z) < infinity<T>; };
  const auto crossing = chords.first(is_wanted);
  if (!crossing) return std::nullopt;
  return Hit<T>{.t = t_of(crossing->z), .uv = {crossing->s, detail::fraction_across(seen.curve, crossing->s)}};
}

namespace detail {

/// The s near a first guess whose sphere touches the surface at `position`: there the way to the position is
/// perpendicular to the curve, but for the growth of the radius.
template <std::floating_point T>
[[nodiscard]] T refined_s(const BezierCurve<T>& curve, const Vec3<T>& position, T s) noexcept {
  for (int i = 0; i < 2; ++i) {
    const CurvePoint<T> p = curve.at(s);
    const CurvePoint<T> d = curve.slope(s);
    const T along = glm::dot(position - p.position, d.position) + p.radius * d.radius;
    const T step = along / length_squared(d.position);
    if (!(std::abs(step) < T(0.125))) break;
    s = std::clamp(s + step, T(0), T(1));
  }
  return s;
}

/// A bound for what rounding does to points of a curve that are computed from its first.
template <std::floating_point T>
[[nodiscard]] T curve_error(const BezierCurve<T>& curve) noexcept {
  T size = max_radius(curve);
  for (const CurvePoint<T>& p : curve.points) {
    size = std::max(size, max_component(abs(p.position - curve.points[0].position)));
  }
  return size * rounding_bound<T>(32);
}

}  // namespace detail

/// The surface at the point nearest to `position` of the sphere that the hit names.
///
/// Ensures: `position_error` bounds the distance to the surface, alike on all axes.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const RoundCurve<T>& shape, const Vec3<T>& position, const Hit<T>& hit) noexcept {
  const Vec3<T> corner = shape.curve.points[0].position;
  BezierCurve<T> local = shape.curve;
  for (CurvePoint<T>& p : local.points) p.position -= corner;
  const T s = detail::refined_s<T>(local, position - corner, hit.uv.x);
  const CurvePoint<T> center = local.at(s);
  const Vec3<T> outward = (position - corner) - center.position;
  const T squared = length_squared(outward);
  const Vec3<T> along = local.slope(s).position;
  const Vec3<T> normal = squared > T(0) ? outward * (T(1) / std::sqrt(squared)) : Vec3<T>(T(0), T(0), T(1));
  const Vec3<T> on_surface = corner + (center.position + normal * center.radius);
  const T off = detail::curve_error(shape.curve) + max_component(abs(on_surface)) * rounding_bound<T>(2);
  return {.position = on_surface,
          .position_error = Vec3<T>(off),
          .normal = normal,
          .shading_normal = normal,
          .tangent = along - normal * glm::dot(along, normal),
          .uv = {s, hit.uv.y}};
}

}  // namespace glint
