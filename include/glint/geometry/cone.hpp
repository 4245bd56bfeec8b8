// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/interval.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Whether a tube is closed by disks. It is a value and not a type, so that one range holds both.
enum class Ends : std::uint8_t { Capped, Open };

/// A circular cone from base to top, truncated unless a radius is 0. Its outer side is away from the axis, and of the
/// caps away from the middle; both sides are hit.
///
/// Parametrization: of the side uv = (φ/2π, distance along the axis / height), φ from the x toward the y of
///                  Frame::around(top − base); of the caps uv = (distance from the axis / radius, φ/2π).
///
/// Requires: radii ≥ 0. Where base and top are one point, or both radii are 0, it is never hit.
template <std::floating_point T>
struct Cone {
  Vec3<T> base{T(0)};
  Vec3<T> top{T(0), T(0), T(1)};
  T base_radius = 1;
  T top_radius = 0;
  Ends ends = Ends::Capped;

  [[nodiscard]] friend bool operator==(const Cone&, const Cone&) noexcept = default;
};

namespace detail {

/// How far a circle about a unit axis reaches along the world's axes.
template <std::floating_point T>
[[nodiscard]] Vec3<T> circle_reach(const Vec3<T>& axis, T radius) noexcept {
  const Vec3<T> n = axis * axis;
  return Vec3<T>(std::sqrt(n.y + n.z), std::sqrt(n.z + n.x), std::sqrt(n.x + n.y)) * radius;
}

/// A cone in its own coordinates: the base in the origin, the axis along z.
template <std::floating_point T>
struct ConeProfile {
  Frame<T> frame;
  T height;
  T slope;  ///< by how much the radius grows along the axis

  explicit ConeProfile(const Cone<T>& cone) noexcept {
    const Vec3<T> axis = cone.top - cone.base;
    height = std::sqrt(length_squared(axis));
    frame = Frame<T>::around(axis * (T(1) / height));
    slope = (cone.top_radius - cone.base_radius) / height;
  }
};

/// Where a line is inside a cone without ends whose radius is `radius` + `slope` z: an interval, since the nappe beyond
/// the apex does not count.
///
/// With o and d across the axis, R the radius at o and g how the radius grows along d, the discriminant of the
/// quadratic equation is |R d − g o|² − (o × d)²: a difference of two squares that are close only where the line
/// grazes, while b² − ac cancels everywhere.
template <std::floating_point T>
[[nodiscard]] Interval<T> inside_cone(const Vec3<T>& o, const Vec3<T>& d, T radius, T slope) noexcept {
  const T growth = slope * d.z;
  const T r = radius + slope * o.z;
  const T a = d.x * d.x + d.y * d.y - growth * growth;
  const T half_b = o.x * d.x + o.y * d.y - r * growth;
  const T c = o.x * o.x + o.y * o.y - r * r;
  const T across = o.x * d.y - o.y * d.x;
  const T along_x = r * d.x - growth * o.x;
  const T along_y = r * d.y - growth * o.y;
  T discriminant = along_x * along_x + along_y * along_y - across * across;
  if (a < T(0)) discriminant = std::max(discriminant, T(0));  // such a line always crosses both nappes
  if (!(discriminant >= T(0))) return {};
  if (a == T(0) && half_b == T(0)) return c <= T(0) ? Interval<T>{-infinity<T>, infinity<T>} : Interval<T>{};

  const T q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));  // equal signs do not cancel
  const T other = q == T(0) ? T(0) : c / q;
  const T one = a == T(0) ? other : q / a;
  const auto [near, far] = std::minmax({one, other});
  if (a > T(0)) return r - growth * (half_b / a) >= T(0) ? Interval<T>{near, far} : Interval<T>{};
  return growth > T(0) ? Interval<T>{far, infinity<T>} : Interval<T>{-infinity<T>, near};
}

/// The parts of a cone's surface, as hits name them in uv.x.
enum ConePart : std::uint8_t { ConeSide, ConeBase, ConeTop };

/// A crossing of the surface of a solid.
template <std::floating_point T>
struct PartCrossing {
  T t;
  ConePart part;
};

/// The two crossings of a capped cone: the solid is what the endless cone and the slab between the ends have in common,
/// so no line slips through where they meet.
template <std::floating_point T>
[[nodiscard]] std::pair<PartCrossing<T>, PartCrossing<T>> cut_by_ends(const Interval<T>& side, T z, T speed,
                                                                      T height) noexcept {
  PartCrossing<T> enter{side.lower, ConeSide};
  PartCrossing<T> leave{side.upper, ConeSide};
  if (speed == T(0)) {
    if (!(z >= T(0) && z <= height)) leave.t = -infinity<T>;
    return {enter, leave};
  }
  PartCrossing<T> first{-z / speed, ConeBase};
  PartCrossing<T> second{(height - z) / speed, ConeTop};
  if (speed < T(0)) std::swap(first, second);
  if (first.t > enter.t) enter = first;
  if (second.t < leave.t) leave = second;
  return {enter, leave};
}

}  // namespace detail

/// The smallest box: it touches both rims.
template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const Cone<T>& cone) noexcept {
  const Vec3<T> reach = detail::circle_reach(glm::normalize(cone.top - cone.base), T(1));
  const Aabb<T> base{cone.base - reach * cone.base_radius, cone.base + reach * cone.base_radius};
  return join(base, {cone.top - reach * cone.top_radius, cone.top + reach * cone.top_radius});
}

/// The first crossing of a cone's side or caps within the ray's interval, from outside or from inside.
///
/// The ray is first moved to where it passes the cone's middle, so that its distance costs no more than the rounding of
/// its own origin.
///
/// Ensures: uv.x is the part: 0 for the side, 1 for the base's cap, 2 for the top's.
/// Errors:  a NaN, a zero direction, or a cone without height or radius reports no hit. Squares of sizes, distances and
///          |direction| must be in T's range.
/// Source:  Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems
///          (2019), ch. 7, for the move. The discriminant is our own.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Cone<T>& cone) noexcept {
  const detail::ConeProfile<T> profile(cone);
  if (!(profile.height > T(0) && cone.base_radius >= T(0) && cone.top_radius >= T(0))) return std::nullopt;
  if (!(cone.base_radius + cone.top_radius > T(0))) return std::nullopt;

  const Vec3<T> from_base = ray.origin - cone.base;
  const Vec3<T> to_middle = (cone.top - cone.base) * T(0.5) - from_base;
  const T shift = glm::dot(to_middle, ray.direction) / length_squared(ray.direction);
  const Vec3<T> o = profile.frame.to_local(from_base + ray.direction * shift);
  const Vec3<T> d = profile.frame.to_local(ray.direction);
  const Interval<T> side = detail::inside_cone(o, d, cone.base_radius, profile.slope);
  if (is_empty(side)) return std::nullopt;

  const auto hit_at = [&](T local_t, detail::ConePart part) -> std::optional<Hit<T>> {
    const T t = shift + local_t;
    if (!(t >= ray.t_min && t <= ray.t_max && std::abs(t) < infinity<T>)) return std::nullopt;
    return Hit<T>{.t = t, .uv = {T(part), T(0)}};
  };
  if (cone.ends == Ends::Capped) {
    const auto [enter, leave] = detail::cut_by_ends(side, o.z, d.z, profile.height);
    if (!(enter.t <= leave.t)) return std::nullopt;
    if (const auto hit = hit_at(enter.t, enter.part)) return hit;
    return hit_at(leave.t, leave.part);
  }
  for (const T t : {side.lower, side.upper}) {
    const T z = o.z + d.z * t;
    if (!(z >= T(0) && z <= profile.height)) continue;
    if (const auto hit = hit_at(t, detail::ConeSide)) return hit;
  }
  return std::nullopt;
}

namespace detail {

/// φ/2π in [0, 1) of a direction across the axis.
template <std::floating_point T>
[[nodiscard]] T turns_of(T x, T y) noexcept {
  const T turns = std::atan2(y, x) * (inv_pi<T> / T(2));
  return turns < T(0) ? std::min(turns + T(1), one_minus_epsilon<T>) : turns;
}

/// The surface of one part at an angle, given by its cosine and sine, at a height and a distance from the axis.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> cone_surface(const Cone<T>& cone, const ConeProfile<T>& profile, ConePart part,
                                        const Vec2<T>& angle, T z, T distance) noexcept {
  const Frame<T>& frame = profile.frame;
  const Vec3<T> outward = frame.x * angle.x + frame.y * angle.y;
  const Vec3<T> position = cone.base + (outward * distance + frame.z * z);
  const T size = profile.height + std::max(cone.base_radius, cone.top_radius);
  const T off = size * rounding_bound<T>(24) + max_component(abs(position)) * rounding_bound<T>(2);
  const T turns = turns_of(angle.x, angle.y);
  const Vec3<T> around = (frame.y * angle.x - frame.x * angle.y) * (T(2) * pi<T> * distance);
  if (part == ConeSide) {
    const Vec3<T> normal = glm::normalize(outward - frame.z * profile.slope);
    return {.position = position,
            .position_error = Vec3<T>(off),
            .normal = normal,
            .shading_normal = normal,
            .tangent = around,
            .bitangent = (outward * profile.slope + frame.z) * profile.height,
            .uv = {turns, z / profile.height}};
  }
  const T radius = part == ConeBase ? cone.base_radius : cone.top_radius;
  const Vec3<T> normal = part == ConeBase ? -frame.z : frame.z;
  return {.position = position,
          .position_error = Vec3<T>(off),
          .normal = normal,
          .shading_normal = normal,
          .tangent = outward * radius,
          .bitangent = around,
          .uv = {radius > T(0) ? std::min(distance / radius, T(1)) : T(0), turns}};
}

/// The direction of a point across the axis as cosine and sine, and its distance from the axis.
template <std::floating_point T>
[[nodiscard]] std::pair<Vec2<T>, T> polar(const Vec3<T>& local) noexcept {
  const T distance = std::sqrt(local.x * local.x + local.y * local.y);
  if (!(distance > T(0))) return {Vec2<T>(T(1), T(0)), T(0)};
  return {Vec2<T>(local.x / distance, local.y / distance), distance};
}

}  // namespace detail

/// The surface at the point of the part that was hit which is nearest to `position`, by height or by distance from the
/// axis.
///
/// Ensures: `position_error` bounds the distance to the cone, alike on all axes.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const Cone<T>& cone, const Vec3<T>& position, const Hit<T>& hit) noexcept {
  const detail::ConeProfile<T> profile(cone);
  const Vec3<T> local = profile.frame.to_local(position - cone.base);
  const auto [angle, distance] = detail::polar(local);
  const auto part = static_cast<detail::ConePart>(hit.uv.x);
  if (part == detail::ConeSide) {
    const T z = std::clamp(local.z, T(0), profile.height);
    return detail::cone_surface(cone, profile, part, angle, z, cone.base_radius + profile.slope * z);
  }
  const T radius = part == detail::ConeBase ? cone.base_radius : cone.top_radius;
  const T z = part == detail::ConeBase ? T(0) : profile.height;
  return detail::cone_surface(cone, profile, part, angle, z, std::min(distance, radius));
}

namespace detail {

/// The areas of side, base and top.
template <std::floating_point T>
[[nodiscard]] Vec3<T> part_areas(const Cone<T>& cone) noexcept {
  const T difference = cone.top_radius - cone.base_radius;
  const T slant = std::sqrt(length_squared(cone.top - cone.base) + difference * difference);
  const T caps = cone.ends == Ends::Capped ? pi<T> : T(0);
  return {pi<T> * (cone.base_radius + cone.top_radius) * slant, caps * cone.base_radius * cone.base_radius,
          caps * cone.top_radius * cone.top_radius};
}

}  // namespace detail

template <std::floating_point T>
[[nodiscard]] T area(const Cone<T>& cone) noexcept {
  const Vec3<T> parts = detail::part_areas(cone);
  return parts.x + parts.y + parts.z;
}

/// A point uniform by area, from a uniform point of the unit square: u.x chooses the part, and what is left of it the
/// place along the profile.
template <std::floating_point T>
[[nodiscard]] AreaSample<T> sample_area(const Cone<T>& cone, const Vec2<T>& u) noexcept {
  const detail::ConeProfile<T> profile(cone);
  const Vec3<T> parts = detail::part_areas(cone);
  const T total = parts.x + parts.y + parts.z;
  const Vec2<T> angle{std::cos(T(2) * pi<T> * u.y), std::sin(T(2) * pi<T> * u.y)};
  const T pick = u.x * total;
  const auto sample = [&](detail::ConePart part, T z, T distance) {
    return AreaSample<T>{detail::cone_surface(cone, profile, part, angle, z, distance), T(1) / total};
  };
  if (pick < parts.x || cone.ends == Ends::Open) {  // squares of the radius are uniform along the side
    const T fraction = std::min(pick / parts.x, T(1));
    const T base = cone.base_radius;
    const T sum = base + cone.top_radius;
    const T radius = std::sqrt(base * base + fraction * (cone.top_radius - base) * sum);
    const T along = radius > T(0) ? std::min(fraction * sum / (radius + base), T(1)) : T(0);
    return sample(detail::ConeSide, along * profile.height, radius);
  }
  const bool is_base = pick < parts.x + parts.y || parts.z == T(0);
  const T rest = is_base ? (pick - parts.x) / parts.y : (pick - parts.x - parts.y) / parts.z;
  const T fraction = std::sqrt(std::clamp(rest, T(0), T(1)));
  return is_base ? sample(detail::ConeBase, T(0), fraction * cone.base_radius)
                 : sample(detail::ConeTop, profile.height, fraction * cone.top_radius);
}

/// The point of the cone's surface closest to `point`, from outside or from inside; of its axis, one along the x of
/// Frame::around(top − base).
template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, const Cone<T>& cone) noexcept {
  const detail::ConeProfile<T> profile(cone);
  const Vec3<T> local = profile.frame.to_local(point - cone.base);
  const auto [angle, distance] = detail::polar(local);
  const T step = (distance - cone.base_radius) * profile.slope + local.z;
  const T z = std::clamp(step / (T(1) + profile.slope * profile.slope), T(0), profile.height);
  Vec2<T> best{cone.base_radius + profile.slope * z, z};
  const auto consider = [&, from = distance](T radius, T height) {
    const Vec2<T> candidate{std::min(from, radius), height};
    const auto squared = [&](const Vec2<T>& p) {
      return glm::dot(p - Vec2<T>(from, local.z), p - Vec2<T>(from, local.z));
    };
    if (squared(candidate) < squared(best)) best = candidate;
  };
  if (cone.ends == Ends::Capped) {
    consider(cone.base_radius, T(0));
    consider(cone.top_radius, profile.height);
  }
  const Vec3<T> outward = profile.frame.x * angle.x + profile.frame.y * angle.y;
  return cone.base + (outward * best.x + profile.frame.z * best.y);
}

}  // namespace glint
