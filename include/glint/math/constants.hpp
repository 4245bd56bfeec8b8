// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <limits>
#include <numbers>

namespace glint {

template <std::floating_point T>
inline constexpr T pi = std::numbers::pi_v<T>;
template <std::floating_point T>
inline constexpr T inv_pi = std::numbers::inv_pi_v<T>;
template <std::floating_point T>
inline constexpr T infinity = std::numeric_limits<T>::infinity();

/// The largest number below one: what a uniform random number in [0, 1) may reach.
template <std::floating_point T>
inline constexpr T one_minus_epsilon = T(1) - std::numeric_limits<T>::epsilon() / 2;

/// γₙ = n u / (1 − n u), u half an ulp of one: n roundings grow or shrink a value by at most this factor.
///
/// Source: Higham, Accuracy and Stability of Numerical Algorithms (2002), section 3.1.
template <std::floating_point T>
[[nodiscard]] constexpr T rounding_bound(int roundings) noexcept {
  const T u = std::numeric_limits<T>::epsilon() / 2;
  return T(roundings) * u / (T(1) - T(roundings) * u);
}

template <std::floating_point T>
[[nodiscard]] constexpr T radians(T degrees) noexcept {
  return degrees * (pi<T> / T(180));
}

}  // namespace glint
