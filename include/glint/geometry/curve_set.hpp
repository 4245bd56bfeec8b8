// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/core/strided.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/curve.hpp>
#include <glint/geometry/curve_search.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/round_curve.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Curves with the cross-section of a disk: RoundCurve.
struct RoundProfile {
  template <std::floating_point T>
  [[nodiscard]] static std::optional<Hit<T>> intersect(const Ray<T>& ray, const BezierCurve<T>& curve) noexcept {
    return glint::intersect(ray, RoundCurve<T>{curve});
  }

  template <std::floating_point T>
  [[nodiscard]] static SurfaceOf<T> surface(const Ray<T>& ray, const BezierCurve<T>& curve,
                                            const Hit<T>& hit) noexcept {
    return glint::surface(RoundCurve<T>{curve}, ray.at(hit.t), hit);
  }

  [[nodiscard]] friend constexpr bool operator==(const RoundProfile&, const RoundProfile&) noexcept = default;
};

/// Flat curves that turn to face every ray, for hair seen from so far that its roundness does not show: a fraction of
/// RoundProfile's cost. They are hit where the ray passes the center line at less than the radius; the ends are cut off
/// straight.
///
/// A ray that leaves a ribbon sees it turned toward itself. `position_error` is therefore the radius along the normal:
/// just what takes the ray beyond every such turn.
struct RibbonProfile {
  /// Ensures: uv = (s, across), as in RoundCurve.
  template <std::floating_point T>
  [[nodiscard]] static std::optional<Hit<T>> intersect(const Ray<T>& ray, const BezierCurve<T>& curve) noexcept {
    const detail::SeenCurve<T> seen(ray, curve);
    std::optional<Hit<T>> best;
    detail::for_each_near_piece(seen.curve, [&](const detail::CurvePiece<T>& piece) {
      const auto receding = [&](T s) {
        const Vec3<T> p = piece.curve.at(s).position;
        const Vec3<T> d = piece.curve.slope(s).position;
        return p.x * d.x + p.y * d.y;
      };
      if (!(receding(T(0)) <= T(0) && receding(T(1)) >= T(0))) return;
      const T s = detail::rising_zero<T>(receding);
      const CurvePoint<T> p = piece.curve.at(s);
      const T t = seen.t + p.position.z * seen.per_unit;
      const T off = p.position.x * p.position.x + p.position.y * p.position.y;
      if (!(off <= p.radius * p.radius && p.radius > T(0) && t >= ray.t_min && t <= ray.t_max)) return;
      if (!best || t < best->t) best = Hit<T>{.t = t, .uv = {piece.whole_s(s), T(0)}};
    });
    if (best) best->uv.y = detail::fraction_across(seen.curve, best->uv.x);
    return best;
  }

  /// The normal is across the curve, and faces the ray.
  template <std::floating_point T>
  [[nodiscard]] static SurfaceOf<T> surface(const Ray<T>& ray, const BezierCurve<T>& curve,
                                            const Hit<T>& hit) noexcept {
    const CurvePoint<T> center = curve.at(hit.uv.x);
    const Vec3<T> along = curve.slope(hit.uv.x).position;
    const Vec3<T> toward = along * (glm::dot(ray.direction, along) / length_squared(along)) - ray.direction;
    const Vec3<T> normal = glm::normalize(toward);
    const T radius = center.radius + detail::curve_error(curve);
    const Vec3<T> position = ray.at(hit.t);
    return {.position = position,
            .position_error = abs(normal) * radius,
            .normal = normal,
            .shading_normal = normal,
            .tangent = along - normal * glm::dot(along, normal),
            .uv = hit.uv};
  }

  [[nodiscard]] friend constexpr bool operator==(const RibbonProfile&, const RibbonProfile&) noexcept = default;
};

/// What four control points in a row say.
enum class CurveBasis : std::uint8_t { Bezier, BSpline };

/// A set of cubic curve segments with varying width: a view of the user's own buffers, tightly packed or not, nothing
/// copied.
///
/// A strand of n Bézier segments has 3 n + 1 points, and its segments begin at every third; one of n B-spline segments
/// has n + 3 points, and its segments begin at every one. Segments that share points join smoothly. A joint is a sphere
/// of the one segment within the other: rays from outside do not see it.
///
/// Shapes:   `radii` has one value a position, or one for all.
/// Requires: the buffers outlive the view; first + 3 < positions.size() for all `first`.
template <std::floating_point T, typename Profile = RoundProfile>
struct CurveSet {
  using Scalar = T;
  using Index = std::uint32_t;

  Strided<Vec3<T>> positions{};
  Strided<T> radii{};
  Strided<std::uint32_t> firsts{};  ///< a segment's first control point
  CurveBasis basis = CurveBasis::Bezier;
  [[no_unique_address]] Profile profile{};

  [[nodiscard]] std::size_t size() const noexcept { return firsts.size(); }

  [[nodiscard]] BezierCurve<T> segment(Index i) const noexcept {
    const std::uint32_t first = firsts[i];
    std::array<CurvePoint<T>, 4> points;
    for (std::uint32_t k = 0; k < 4; ++k) {
      points[k] = {positions[first + k], radii[radii.size() == 1 ? 0 : first + k]};
    }
    return basis == CurveBasis::Bezier ? BezierCurve<T>{points} : bezier_of_b_spline(points);
  }

  [[nodiscard]] Aabb<T> bounds(Index i) const noexcept { return swept_bounds(segment(i)); }

  [[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, Index i) const noexcept {
    std::optional<Hit<T>> hit = profile.intersect(ray, segment(i));
    if (hit) hit->primitive = i;
    return hit;
  }

  [[nodiscard]] SurfaceOf<T> surface(const Ray<T>& ray, const Hit<T>& hit) const noexcept {
    return profile.surface(ray, segment(hit.primitive), hit);
  }
};

}  // namespace glint
