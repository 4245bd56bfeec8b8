// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/common.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The surface of an axis-aligned box, hit from outside and from inside. Normals point outward.
///
/// Parametrization: the two faces across an axis have uv in [0, 1]² along the next two axes: x: (y, z), y: (z, x),
/// z: (x, y).
///
/// Requires: lower ≤ upper; otherwise it is never hit.
template <std::floating_point T>
struct Box {
  Vec3<T> lower{T(0)};
  Vec3<T> upper{T(1)};

  [[nodiscard]] friend bool operator==(const Box&, const Box&) noexcept = default;
};

template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const Box<T>& box) noexcept {
  return {box.lower, box.upper};
}

namespace detail {

/// The part of a line inside a box, and the faces where it enters and leaves: 2 · axis, one more for the upper face.
template <std::floating_point T>
struct BoxCrossing {
  T enter = -infinity<T>;
  T leave = infinity<T>;
  int enter_face = 0;
  int leave_face = 0;
  bool exists = true;

  /// Cuts away what is outside of one pair of faces. Division, since 0 · (1 / 1e-40F) is NaN.
  void cut(int axis, T origin, T direction, T lower, T upper) noexcept {
    if (direction == T(0)) {
      exists = exists && origin >= lower && origin <= upper;
      return;
    }
    const bool down = direction < T(0);
    const T first = ((down ? upper : lower) - origin) / direction;
    const T second = ((down ? lower : upper) - origin) / direction;
    exists = exists && first <= second;  // false for a NaN
    if (first > enter) {
      enter = first;
      enter_face = 2 * axis + (down ? 1 : 0);
    }
    if (second < leave) {
      leave = second;
      leave_face = 2 * axis + (down ? 0 : 1);
    }
  }
};

}  // namespace detail

/// The first crossing of the box's surface within the ray's interval.
///
/// Ensures: uv.x is the face: 0 for lower x, 1 for upper x, 2 for lower y, … 5 for upper z.
/// Errors:  no hit for a zero direction, an empty box, or a NaN.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Box<T>& box) noexcept {
  detail::BoxCrossing<T> line;
  line.cut(0, ray.origin.x, ray.direction.x, box.lower.x, box.upper.x);
  line.cut(1, ray.origin.y, ray.direction.y, box.lower.y, box.upper.y);
  line.cut(2, ray.origin.z, ray.direction.z, box.lower.z, box.upper.z);
  if (!(line.exists && line.enter <= line.leave)) return std::nullopt;

  const auto within = [&](T t) { return t >= ray.t_min && t <= ray.t_max && std::abs(t) < infinity<T>; };
  if (within(line.enter)) return Hit<T>{.t = line.enter, .uv = {T(line.enter_face), T(0)}};
  if (within(line.leave)) return Hit<T>{.t = line.leave, .uv = {T(line.leave_face), T(0)}};
  return std::nullopt;
}

namespace detail {

/// The vector with one component replaced.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3<T> with_component(const Vec3<T>& v, int axis, T value) noexcept {
  return {axis == 0 ? value : v.x, axis == 1 ? value : v.y, axis == 2 ? value : v.z};
}

/// Where x lies between two bounds, in [0, 1]; 0 where they are equal.
template <std::floating_point T>
[[nodiscard]] T fraction_between(T lower, T upper, T x) noexcept {
  return upper > lower ? std::min((x - lower) / (upper - lower), T(1)) : T(0);
}

/// The surface at the point of one face that is nearest to `position`. That point is exact; its error bound says one
/// rounding all the same, since zero would mean unknown.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> box_surface(const Box<T>& box, int face, const Vec3<T>& position) noexcept {
  const int axis = face / 2;
  const int u_axis = (axis + 1) % 3;
  const int v_axis = (axis + 2) % 3;
  const bool is_upper = face % 2 != 0;
  const Vec3<T> inside = glm::clamp(position, box.lower, box.upper);
  const Vec3<T> on_face = with_component(inside, axis, component(is_upper ? box.upper : box.lower, axis));
  const Vec3<T> normal = with_component(Vec3<T>(T(0)), axis, is_upper ? T(1) : T(-1));
  const auto fraction = [&](int a) {
    return fraction_between(component(box.lower, a), component(box.upper, a), component(on_face, a));
  };
  return {.position = on_face,
          .position_error = Vec3<T>(max_component(abs(on_face)) * rounding_bound<T>(1)),
          .normal = normal,
          .shading_normal = normal,
          .tangent = with_component(Vec3<T>(T(0)), u_axis, component(box.upper - box.lower, u_axis)),
          .bitangent = with_component(Vec3<T>(T(0)), v_axis, component(box.upper - box.lower, v_axis)),
          .uv = {fraction(u_axis), fraction(v_axis)}};
}

}  // namespace detail

/// The surface at the point of the face that was hit which is nearest to `position`.
template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const Box<T>& box, const Vec3<T>& position, const Hit<T>& hit) noexcept {
  return detail::box_surface(box, static_cast<int>(hit.uv.x), position);
}

template <std::floating_point T>
[[nodiscard]] T area(const Box<T>& box) noexcept {
  return T(2) * half_area(bounds(box));
}

/// A point uniform by area, from a uniform point of the unit square: u.x chooses the face, and what is left of it the
/// place along the face's u.
template <std::floating_point T>
[[nodiscard]] AreaSample<T> sample_area(const Box<T>& box, const Vec2<T>& u) noexcept {
  const Vec3<T> e = box.upper - box.lower;
  const Vec3<T> face_areas{e.y * e.z, e.z * e.x, e.x * e.y};
  const bool is_upper = u.x >= T(0.5);
  T rest = (T(2) * u.x - (is_upper ? T(1) : T(0))) * half_area(bounds(box));
  int axis = 0;
  for (; axis < 2 && rest >= component(face_areas, axis); ++axis) rest -= component(face_areas, axis);

  const Vec3<T> fractions{detail::fraction_between(T(0), component(face_areas, axis), rest), u.y, T(0)};
  const Vec3<T> along = axis == 0   ? Vec3<T>(T(0), fractions.x, fractions.y)
                        : axis == 1 ? Vec3<T>(fractions.y, T(0), fractions.x)
                                    : fractions;
  return {detail::box_surface(box, 2 * axis + (is_upper ? 1 : 0), box.lower + e * along), T(1) / area(box)};
}

/// The point of the box's surface closest to `point`, from outside or from inside.
template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, const Box<T>& box) noexcept {
  Vec3<T> closest = glm::clamp(point, box.lower, box.upper);
  if (closest != point) return closest;
  const Vec3<T> to_lower = point - box.lower;
  const Vec3<T> to_upper = box.upper - point;
  const Vec3<T> away = glm::min(to_lower, to_upper);
  const int axis = away.x <= away.y && away.x <= away.z ? 0 : away.y <= away.z ? 1 : 2;
  const bool is_lower = component(to_lower, axis) <= component(to_upper, axis);
  closest[axis] = component(is_lower ? box.lower : box.upper, axis);
  return closest;
}

}  // namespace glint
