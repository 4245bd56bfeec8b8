// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/math/constants.hpp>

namespace glint {

/// The numbers from lower to upper, both included. The default is empty.
template <std::floating_point T>
struct Interval {
  T lower = infinity<T>;
  T upper = -infinity<T>;

  [[nodiscard]] friend constexpr bool operator==(const Interval&, const Interval&) noexcept = default;
};

/// True where no number is inside, or an end is NaN.
template <std::floating_point T>
[[nodiscard]] constexpr bool is_empty(const Interval<T>& interval) noexcept {
  return !(interval.lower <= interval.upper);
}

template <std::floating_point T>
[[nodiscard]] constexpr bool contains(const Interval<T>& interval, T x) noexcept {
  return interval.lower <= x && x <= interval.upper;
}

}  // namespace glint
