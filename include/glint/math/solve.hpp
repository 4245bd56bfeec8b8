// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <optional>

#include <glint/math/vec.hpp>

namespace glint {

/// a·b − c·d without the loss of digits that near-equal products cause.
///
/// Ensures:  within 1.5 ulp of the exact value, barring overflow and underflow.
/// Cost:     two fused multiply-adds, which are slow library calls where the target has no such instruction: not for
///           hot loops.
/// Source:   Jeannerod, Louvet, Muller, "Further Analysis of Kahan's Algorithm for the Accurate Computation of 2 × 2
///           Determinants", Mathematics of Computation 82 (2013).
template <std::floating_point T>
[[nodiscard]] T difference_of_products(T a, T b, T c, T d) noexcept {
  const T cd = c * d;
  const T lost = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + lost;
}

/// The cross product with every component within 1.5 ulp; `glm::cross` is faster and may cancel.
template <std::floating_point T>
[[nodiscard]] Vec3<T> accurate_cross(const Vec3<T>& a, const Vec3<T>& b) noexcept {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

/// The real roots of a x² + b x + c, the smaller first.
///
/// A double root, and the one root where a = 0, is given twice.
///
/// Ensures:  both roots within a few ulp: neither the discriminant nor the sum under the fraction cancels.
/// Errors:   none where there is no real root, where a = b = 0, or where anything is NaN. Squares of the coefficients
///           must neither overflow nor underflow.
/// Source:   Press et al., Numerical Recipes (2007), section 5.6; the discriminant by difference_of_products.
template <std::floating_point T>
[[nodiscard]] std::optional<std::array<T, 2>> solve_quadratic(T a, T b, T c) noexcept {
  if (a == T(0)) {
    if (b == T(0) || std::isnan(b) || std::isnan(c)) return std::nullopt;
    return std::array{-c / b, -c / b};
  }
  const T half_b = b / T(2);
  const T discriminant = difference_of_products(half_b, half_b, a, c);
  if (!(discriminant >= T(0))) return std::nullopt;
  const T q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
  const T one = q / a;
  const T other = q == T(0) ? one : c / q;
  return one < other ? std::array{one, other} : std::array{other, one};
}

}  // namespace glint
