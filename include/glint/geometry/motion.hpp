// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <span>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// Where a moment lies among K keyframes, which are evenly spaced from time 0 to 1: between `key` and the next one,
/// that have these weights. Earlier times count as 0, later ones as 1; a NaN has weights of NaN.
///
/// Requires: K ≥ 2.
template <std::floating_point T, std::size_t K>
struct Moment {
  std::size_t key = 0;
  T before = 1;
  T after = 0;

  explicit Moment(T time) noexcept {
    const T at = std::min(std::max(time, T(0)), T(1)) * T(K - 1);
    while (key + 2 < K && at >= T(key + 1)) ++key;
    after = at - T(key);
    before = T(1) - after;
  }
  /// Each product is rounded by itself, so that many can be mixed at once to the same bits; a key has weight 1 in its
  /// own moment, and is then exact.
  [[nodiscard]] Vec3<T> mix(const Vec3<T>& a, const Vec3<T>& b) const noexcept {
    return {fenced(a.x * before) + fenced(b.x * after), fenced(a.y * before) + fenced(b.y * after),
            fenced(a.z * before) + fenced(b.z * after)};
  }
};

/// Two boxes: what moves is, at each time t from 0 to 1, within (1 − t) · begin + t · end, plane by plane.
template <std::floating_point T>
struct MotionBounds {
  Aabb<T> begin{};
  Aabb<T> end{};

  [[nodiscard]] friend bool operator==(const MotionBounds&, const MotionBounds&) noexcept = default;
};

/// A set whose primitives move, and that knows more of where they are than one box for all times: `motion_bounds(i)`.
///
/// Law: at no time is a primitive outside its motion bounds, but for a few roundings; both lie within `bounds(i)`.
template <typename S>
concept MovingSet = BoundedSet<S> && requires(const S& set, typename S::Index i) {
  { set.motion_bounds(i) } -> std::same_as<MotionBounds<typename S::Scalar>>;
};

/// The motion bounds of a primitive of any set: of one that stands still, its box twice.
template <BoundedSet S>
[[nodiscard]] MotionBounds<typename S::Scalar> motion_bounds(const S& set, typename S::Index i) {
  if constexpr (MovingSet<S>) {
    return set.motion_bounds(i);
  } else {
    const Aabb<typename S::Scalar> box = set.bounds(i);
    return {box, box};
  }
}

/// The box of all times, and around it what mixing keyframes may round.
template <std::floating_point T>
[[nodiscard]] Aabb<T> swept_bounds(std::span<const Aabb<T>> keys) noexcept {
  Aabb<T> swept;
  for (const Aabb<T>& key : keys) {
    if (!is_bounded(key)) return {};
    extend(swept, key);
  }
  const Vec3<T> rounded = max(abs(swept.lower), abs(swept.upper)) * rounding_bound<T>(4);
  return {swept.lower - rounded, swept.upper + rounded};
}

/// Motion bounds of what moves from key to key in straight lines, given its boxes there: the planes of the first and
/// the last key, shifted outward together by what some key between is further out.
///
/// Errors: empty where some key's box is not bounded.
/// Source: Woop, Áfra, Benthin, "STBVH: A Spatial-Temporal BVH for Efficient Multi-Segment Motion Blur", HPG 2017
///         (its linear bounds).
template <std::floating_point T>
[[nodiscard]] MotionBounds<T> linear_bounds(std::span<const Aabb<T>> keys) noexcept {
  const Aabb<T> swept = swept_bounds(keys);
  if (is_empty(swept)) return {};
  MotionBounds<T> bounds{keys.front(), keys.back()};
  if (keys.size() <= 2) return bounds;
  Vec3<T> below(T(0));
  Vec3<T> above(T(0));
  for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
    const T time = T(i) / T(keys.size() - 1);
    below = max(below, bounds.begin.lower * (T(1) - time) + bounds.end.lower * time - keys[i].lower);
    above = max(above, keys[i].upper - bounds.begin.upper * (T(1) - time) - bounds.end.upper * time);
  }
  // A time is rounded once more for each key that it passes, and moves what is there by so much.
  const Vec3<T> rounded =
      max(abs(swept.lower), abs(swept.upper)) * rounding_bound<T>(int(std::min<std::size_t>(8 * keys.size(), 1024)));
  below += rounded;
  above += rounded;
  return {{bounds.begin.lower - below, bounds.begin.upper + above},
          {bounds.end.lower - below, bounds.end.upper + above}};
}

/// A moving set as it is in the middle of its time, boxes only: trees over it are good ones for all times.
template <MovingSet S>
struct Midway {
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;
  const S& set;

  [[nodiscard]] std::size_t size() const noexcept { return set.size(); }
  [[nodiscard]] Aabb<Scalar> bounds(Index i) const {
    if (!is_bounded(set.bounds(i))) return {};
    const MotionBounds<Scalar> motion = set.motion_bounds(i);
    return {motion.begin.lower * Scalar(0.5) + motion.end.lower * Scalar(0.5),
            motion.begin.upper * Scalar(0.5) + motion.end.upper * Scalar(0.5)};
  }
};

}  // namespace glint
