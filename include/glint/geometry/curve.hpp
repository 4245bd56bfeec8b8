// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <utility>

#include <glint/geometry/aabb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/interval.hpp>
#include <glint/math/solve.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A control point of a curve, and half the curve's width there.
template <std::floating_point T>
struct CurvePoint {
  Vec3<T> position{T(0)};
  T radius = 1;

  [[nodiscard]] friend CurvePoint operator+(const CurvePoint& a, const CurvePoint& b) noexcept {
    return {a.position + b.position, a.radius + b.radius};
  }
  [[nodiscard]] friend CurvePoint operator-(const CurvePoint& a, const CurvePoint& b) noexcept {
    return {a.position - b.position, a.radius - b.radius};
  }
  [[nodiscard]] friend CurvePoint operator*(const CurvePoint& a, T factor) noexcept {
    return {a.position * factor, a.radius * factor};
  }
  [[nodiscard]] friend bool operator==(const CurvePoint&, const CurvePoint&) noexcept = default;
};

/// A cubic Bézier curve whose width is a cubic as well.
///
/// Requires: radii ≥ 0.
template <std::floating_point T>
struct BezierCurve {
  std::array<CurvePoint<T>, 4> points;

  /// Ensures: exact at s = 0 and at s = 1.
  [[nodiscard]] CurvePoint<T> at(T s) const noexcept {
    const T r = T(1) - s;
    return points[0] * (r * r * r) + points[1] * (T(3) * s * r * r) + points[2] * (T(3) * s * s * r) +
           points[3] * (s * s * s);
  }
  /// The derivative by s.
  [[nodiscard]] CurvePoint<T> slope(T s) const noexcept {
    const T r = T(1) - s;
    return (points[1] - points[0]) * (T(3) * r * r) + (points[2] - points[1]) * (T(6) * s * r) +
           (points[3] - points[2]) * (T(3) * s * s);
  }

  [[nodiscard]] friend bool operator==(const BezierCurve&, const BezierCurve&) noexcept = default;
};

/// The Bézier curve that is one segment of a uniform cubic B-spline, given by four points in a row. Segments that share
/// three points meet without a kink, and in the same point to the last bit.
template <std::floating_point T>
[[nodiscard]] BezierCurve<T> bezier_of_b_spline(const std::array<CurvePoint<T>, 4>& p) noexcept {
  const auto knot = [](const auto& a, const auto& b, const auto& c) { return (a + c + b * T(4)) * (T(1) / T(6)); };
  const auto third = [](const auto& near, const auto& far) { return (near * T(2) + far) * (T(1) / T(3)); };
  return {{knot(p[0], p[1], p[2]), third(p[1], p[2]), third(p[2], p[1]), knot(p[1], p[2], p[3])}};
}

/// The halves of a curve.
///
/// Source: de Casteljau's algorithm; Farin, Curves and Surfaces for CAGD (2002), section 4.2.
template <std::floating_point T>
[[nodiscard]] std::pair<BezierCurve<T>, BezierCurve<T>> halves(const BezierCurve<T>& curve) noexcept {
  const auto middle = [](const CurvePoint<T>& a, const CurvePoint<T>& b) { return (a + b) * T(0.5); };
  const auto& [p0, p1, p2, p3] = curve.points;
  const CurvePoint<T> a = middle(p0, p1);
  const CurvePoint<T> b = middle(p1, p2);
  const CurvePoint<T> c = middle(p2, p3);
  const CurvePoint<T> ab = middle(a, b);
  const CurvePoint<T> bc = middle(b, c);
  const CurvePoint<T> center = middle(ab, bc);
  return {{{p0, a, ab, center}}, {{center, bc, c, p3}}};
}

namespace detail {

/// The values of a cubic on [0, 1], by its Bernstein coefficients, widened by its rounding.
template <std::floating_point T>
[[nodiscard]] Interval<T> range_of_cubic(const std::array<T, 4>& c) noexcept {
  Interval<T> range{std::min(c[0], c[3]), std::max(c[0], c[3])};
  const T first = c[1] - c[0];
  const T second = c[2] - c[1];
  const T third = c[3] - c[2];
  const auto turns = solve_quadratic(first - T(2) * second + third, T(2) * (second - first), first);
  for (const T s : turns.value_or(std::array<T, 2>{T(0), T(0)})) {
    if (!(s > T(0) && s < T(1))) continue;
    const T r = T(1) - s;
    const T value = c[0] * (r * r * r) + c[1] * (T(3) * s * r * r) + c[2] * (T(3) * s * s * r) + c[3] * (s * s * s);
    range = {std::min(range.lower, value), std::max(range.upper, value)};
  }
  const T magnitude = std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2]), std::abs(c[3])});
  const T pad = magnitude * rounding_bound<T>(8);
  return {range.lower - pad, range.upper + pad};
}

/// What a sphere sweeps along the curve, on one axis.
template <std::floating_point T>
[[nodiscard]] Interval<T> swept_range(const BezierCurve<T>& curve, int axis) noexcept {
  std::array<T, 4> lower;
  std::array<T, 4> upper;
  for (std::size_t i = 0; i < 4; ++i) {
    const T center = component(curve.points[i].position, axis);
    lower[i] = center - curve.points[i].radius;
    upper[i] = center + curve.points[i].radius;
  }
  return {range_of_cubic(lower).lower, range_of_cubic(upper).upper};
}

}  // namespace detail

/// The smallest box, but for roundings, of all spheres around points of the curve.
template <std::floating_point T>
[[nodiscard]] Aabb<T> swept_bounds(const BezierCurve<T>& curve) noexcept {
  const Interval<T> x = detail::swept_range(curve, 0);
  const Interval<T> y = detail::swept_range(curve, 1);
  const Interval<T> z = detail::swept_range(curve, 2);
  return {{x.lower, y.lower, z.lower}, {x.upper, y.upper, z.upper}};
}

}  // namespace glint
