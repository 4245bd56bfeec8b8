// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <type_traits>

namespace glint {

/// The type that exact products are formed in: products of two `float` fit in a `double`.
template <std::floating_point T>
using Wide = std::conditional_t<std::same_as<T, float>, double, T>;

/// a·b − c·d with the exact sign, zero only where the two products are equal.
///
/// Rounding is monotone, so rounded products that differ are ordered like the exact ones, and a compiler that fuses one
/// product into the subtraction does not change the sign. Only where the rounded products are equal can it make one up,
/// and differently for c·d − a·b: there, what was rounded away decides.
///
/// Ensures: exact_difference(a, b, c, d) and exact_difference(c, d, a, b) have opposite signs.
/// Errors:  for `double`, products below the normal range may compare equal. A NaN gives a NaN.
/// Cost:    cold: it calls std::fma for `double`.
template <std::floating_point T>
[[nodiscard]] Wide<T> exact_difference(T a, T b, T c, T d) noexcept {
  if constexpr (std::same_as<T, float>) {
    return Wide<T>(a) * Wide<T>(b) - Wide<T>(c) * Wide<T>(d);  // exact products: fused or not, it is one rounding
  } else {
    const T left = a * b;
    const T right = c * d;
    if (left != right) return left - right;
    return std::fma(a, b, -left) - std::fma(c, d, -right);
  }
}

}  // namespace glint
