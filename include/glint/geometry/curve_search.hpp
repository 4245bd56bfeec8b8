// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>

#include <glint/core/fixed_stack.hpp>
#include <glint/geometry/curve.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/vec.hpp>

/// The search for the places of a curve where a ray may meet it.
namespace glint::detail {

/// A curve as a ray sees it: the ray is the z-axis, from a point of it that is near the curve.
template <std::floating_point T>
struct SeenCurve {
  BezierCurve<T> curve;
  T t = 0;         ///< of the z-axis' origin
  T per_unit = 0;  ///< t per unit of z

  SeenCurve(const Ray<T>& ray, const BezierCurve<T>& in_world) noexcept {
    const Vec3<T> corner = in_world.points[0].position;
    const Vec3<T> from_corner = ray.origin - corner;
    const Vec3<T> to_middle = (in_world.points[3].position - corner) * T(0.5) - from_corner;
    const T squared = length_squared(ray.direction);
    t = glm::dot(to_middle, ray.direction) / squared;
    per_unit = T(1) / std::sqrt(squared);
    const Vec3<T> origin = from_corner + ray.direction * t;
    const Frame<T> frame = Frame<T>::around(ray.direction * per_unit);
    for (std::size_t i = 0; i < 4; ++i) {
      const CurvePoint<T>& p = in_world.points[i];
      curve.points[i] = {frame.to_local((p.position - corner) - origin), p.radius};
    }
  }
};

/// A part of a curve: s from `first` to `first + length`.
template <std::floating_point T>
struct CurvePiece {
  BezierCurve<T> curve;
  T first = 0;
  T length = 1;
  int depth = 0;

  [[nodiscard]] T whole_s(T s) const noexcept { return first + length * s; }
};

template <std::floating_point T>
[[nodiscard]] T max_radius(const BezierCurve<T>& c) noexcept {
  return std::max(std::max(c.points[0].radius, c.points[1].radius), std::max(c.points[2].radius, c.points[3].radius));
}

/// Whether the z-axis may come as near to the curve as its radius: along x, along y, and across the chord.
template <std::floating_point T>
[[nodiscard]] bool may_touch_axis(const BezierCurve<T>& c) noexcept {
  const T radius = max_radius(c);
  const auto reaches = [&](T a, T b, T d, T e, T reach) {
    return std::min(std::min(a, b), std::min(d, e)) <= reach && std::max(std::max(a, b), std::max(d, e)) >= -reach;
  };
  const Vec3<T>& a = c.points[0].position;
  const Vec3<T>& b = c.points[1].position;
  const Vec3<T>& d = c.points[2].position;
  const Vec3<T>& e = c.points[3].position;
  if (!reaches(a.x, b.x, d.x, e.x, radius) || !reaches(a.y, b.y, d.y, e.y, radius)) return false;
  const Vec2<T> across{a.y - e.y, e.x - a.x};
  const auto off = [&](const Vec3<T>& p) { return p.x * across.x + p.y * across.y; };
  return reaches(off(a), off(b), off(d), off(e), radius * std::sqrt(glm::dot(across, across)) * T(1.0001));
}

/// Whether the curve, as seen along z, bends so little that its distance from the axis has one minimum: little against
/// its length, or all of it little against its radius.
template <std::floating_point T>
[[nodiscard]] bool is_nearly_straight(const BezierCurve<T>& c) noexcept {
  const auto bend = [&](std::size_t i) {
    const Vec3<T> d = c.points[i].position - c.points[i + 1].position * T(2) + c.points[i + 2].position;
    return d.x * d.x + d.y * d.y;
  };
  const Vec3<T> chord = c.points[3].position - c.points[0].position;
  const T length = chord.x * chord.x + chord.y * chord.y;
  const T radius = max_radius(c);
  const T bends = std::max(bend(0), bend(1));
  return bends <= T(0.01) * length || bends <= T(0.0025) * radius * radius;
}

/// Calls `visit(piece)` for the nearly straight pieces of a curve that the z-axis may touch.
///
/// Cost: pieces bend a quarter as much as what they are a half of, so few are needed; no more than 2⁶.
template <std::floating_point T, typename Visit>
void for_each_near_piece(const BezierCurve<T>& curve, const Visit& visit) {
  constexpr int max_depth = 6;
  FixedStack<CurvePiece<T>, max_depth + 1> pending;
  pending.push({curve});
  while (!pending.empty()) {
    const CurvePiece<T> piece = pending.pop();
    if (!may_touch_axis(piece.curve)) continue;
    if (piece.depth == max_depth || is_nearly_straight(piece.curve)) {
      visit(piece);
      continue;
    }
    const auto [left, right] = halves(piece.curve);
    const T half = piece.length * T(0.5);
    pending.push({right, piece.first + half, half, piece.depth + 1});
    pending.push({left, piece.first, half, piece.depth + 1});
  }
}

/// The s in [0, 1] where a function grows through zero: by secants that keep the sign change between them, halving
/// where these are slow. Where it is positive all along, 0; where negative, 1.
///
/// Source: the Illinois method; Dowell, Jarratt, "A Modified Regula Falsi Method for Computing the Root of an
/// Equation",
///         BIT 11 (1971).
template <std::floating_point T, typename Function>
[[nodiscard]] T rising_zero(const Function& function) noexcept {
  T low = 0;
  T high = 1;
  T at_low = function(low);
  T at_high = function(high);
  if (!(at_low <= T(0))) return low;
  if (!(at_high >= T(0))) return high;
  constexpr T least = T(2) * std::numeric_limits<T>::epsilon();
  T checked_width = high - low;
  int side = 0;  // which end moved last
  for (int i = 0; i < 96 && high - low > T(2) * least; ++i) {
    const T secant = low + (high - low) * (at_low / (at_low - at_high));
    T s = std::clamp(secant, low + least, high - least);  // a root near an end is then soon enclosed
    if (i % 3 == 2) {
      if (!(high - low < T(0.5) * checked_width)) s = low + (high - low) * T(0.5);
      checked_width = high - low;
    }
    const T value = function(s);
    if (value == T(0)) return s;
    const int moved = value < T(0) ? -1 : 1;
    (moved < 0 ? low : high) = s;
    (moved < 0 ? at_low : at_high) = value;
    if (moved == side) (moved < 0 ? at_high : at_low) *= T(0.5);
    side = moved;
  }
  return low + (high - low) * T(0.5);
}

}  // namespace glint::detail
