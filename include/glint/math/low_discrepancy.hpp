// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>

#include <glint/core/config.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>

/// Points that fill the unit interval and the unit square evenly, and how to randomize them without losing that.
///
/// Fractions are words of 32 bits, the first binary digit the highest bit: to_unit_float makes numbers of them.
namespace glint {

/// The bits in opposite order. As a fraction it is van der Corput's sequence: the radical inverse in base two.
[[nodiscard]] GLINT_ALWAYS_INLINE constexpr std::uint32_t reversed_bits(std::uint32_t x) noexcept {
  x = x >> 16 | x << 16;
  x = (x >> 8 & 0x00FF00FFU) | (x & 0x00FF00FFU) << 8;
  x = (x >> 4 & 0x0F0F0F0FU) | (x & 0x0F0F0F0FU) << 4;
  x = (x >> 2 & 0x33333333U) | (x & 0x33333333U) << 2;
  return (x >> 1 & 0x55555555U) | (x & 0x55555555U) << 1;
}

/// The bits in opposite order; each half of the result is the other half's, so that two words are turned at once.
[[nodiscard]] GLINT_ALWAYS_INLINE constexpr std::uint64_t reversed_bits(std::uint64_t x) noexcept {
  x = x >> 32 | x << 32;
  x = (x >> 16 & 0x0000FFFF0000FFFFU) | (x & 0x0000FFFF0000FFFFU) << 16;
  x = (x >> 8 & 0x00FF00FF00FF00FFU) | (x & 0x00FF00FF00FF00FFU) << 8;
  x = (x >> 4 & 0x0F0F0F0F0F0F0F0FU) | (x & 0x0F0F0F0F0F0F0F0FU) << 4;
  x = (x >> 2 & 0x3333333333333333U) | (x & 0x3333333333333333U) << 2;
  return (x >> 1 & 0x5555555555555555U) | (x & 0x5555555555555555U) << 1;
}

/// Flips each bit, or not, by a hash of the seed and the bits below it: Owen's scrambling of a fraction whose bits are
/// in opposite order.
///
/// Ensures:  a bijection; the lowest n bits of the result depend on the seed and the lowest n bits alone.
/// Source:   Laine, Karras, "Stratified Sampling for Stochastic Transparency", EGSR 2011, section 3.1 (the idea);
///           Vegdahl, "Building a Better LK Hash", 2021 (these steps).
[[nodiscard]] GLINT_ALWAYS_INLINE constexpr std::uint32_t scrambled_upward(std::uint32_t x,
                                                                           std::uint32_t seed) noexcept {
  x ^= x * 0x3D20ADEAU;
  x += seed;
  x *= seed >> 16 | 1;
  x ^= x * 0x05526C56U;
  return x ^ x * 0x53A22864U;
}

/// Nested uniform scrambling of a fraction: each digit is flipped, or not, at random by the digits before it. What
/// was in one interval [k, k + 1) / 2ⁿ stays together, and comes to a random other.
///
/// Ensures:  a bijection.
/// Source:   Owen, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences", 1995; Burley, "Practical Hash-based Owen
///           Scrambling", JCGT 9(4), 2020 (by reversing the bits).
[[nodiscard]] GLINT_ALWAYS_INLINE constexpr std::uint32_t owen_scrambled(std::uint32_t fraction,
                                                                         std::uint32_t seed) noexcept {
  return reversed_bits(scrambled_upward(reversed_bits(fraction), seed));
}

/// The second matrix of Sobol' applied to an index: Pascal's triangle modulo two. The fraction is this with its bits
/// reversed, as the first coordinate's is the index reversed.
///
/// C(c, r) is odd if r's bits are among c's (Lucas). So digit r is the sum of the digits c ⊇ r, and that is had one bit
/// of their numbers after the other.
[[nodiscard]] GLINT_ALWAYS_INLINE constexpr std::uint32_t times_pascal(std::uint32_t index) noexcept {
  index ^= index >> 16;
  index ^= index >> 8 & 0x00FF00FFU;
  index ^= index >> 4 & 0x0F0F0F0FU;
  index ^= index >> 2 & 0x33333333U;
  return index ^ (index >> 1 & 0x55555555U);
}

/// The point of Sobol's sequence in two dimensions, as fractions.
///
/// Ensures: a (0, 2)-sequence in base two: of any 2ᵐ points from an index that is a multiple of 2ᵐ on, each rectangle
///          [a, a + 1) / 2ᵏ × [b, b + 1) / 2ᵐ⁻ᵏ of the unit square holds exactly one.
/// Source:  Sobol', "On the Distribution of Points in a Cube and the Approximate Evaluation of Integrals", 1967.
[[nodiscard]] constexpr std::array<std::uint32_t, 2> sobol_point(std::uint32_t index) noexcept {
  return {reversed_bits(index), reversed_bits(times_pascal(index))};
}

/// The index's digits in a base, mirrored at the point: 0.d₀d₁d₂… of …d₂d₁d₀.
///
/// Requires: base ≥ 2.
/// Source:   Halton, "On the Efficiency of Certain Quasi-Random Sequences of Points", 1960.
template <std::floating_point T>
[[nodiscard]] constexpr T radical_inverse(std::uint32_t index, std::uint32_t base) noexcept {
  GLINT_ASSERT(base >= 2);
  std::uint64_t digits = 0;
  std::uint64_t power = 1;
  for (; index != 0; index /= base, power *= base) digits = digits * base + index % base;
  return std::min(static_cast<T>(static_cast<double>(digits) / static_cast<double>(power)), one_minus_epsilon<T>);
}

/// A prime number, and what it takes to scramble radical inverses in that base fast.
class PrimeBase {
 public:
  static constexpr std::uint32_t index_end = 1U << 16;  ///< indices are below

  /// Requires: a prime number below 256.
  constexpr explicit PrimeBase(std::uint32_t prime) noexcept : prime_(prime), reciprocal_((1U << 24) / prime + 1) {
    GLINT_ASSERT(prime >= 2 && prime < 256);
    while (end_ < index_end) end_ *= prime_;
  }

  /// The radical inverse of the index, scrambled as Owen does, by a hash of the key and the digits before. Digits
  /// beyond those that indices have are random: they would be zeros scrambled each by itself.
  ///
  /// A digit d becomes (a d + c) mod prime with random a ≠ 0 and c, which sends two digits to all pairs equally often.
  /// That is all on which the variance of integrals depends.
  ///
  /// Requires: index < index_end.
  /// Ensures:  over all keys uniform in [0, 1).
  /// Cost:     a hash a digit: log(65536) / log(prime) of them.
  /// Source:   Owen, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences", 1995; Matoušek, "On the L2-Discrepancy for
  ///           Anchored Boxes", Journal of Complexity 14, 1998 (linear permutations).
  [[nodiscard]] constexpr float scrambled_inverse(std::uint32_t index, std::uint64_t key) const noexcept {
    GLINT_ASSERT(index < index_end);
    std::uint32_t rest = index;
    std::uint32_t result = 0;
    for (std::uint32_t power = 1; power < end_; power *= prime_) {
      const std::uint32_t quotient = divided(rest);
      const std::uint32_t digit = rest - quotient * prime_;
      const std::uint64_t hash = hashed(key, index - rest * power + power);
      const auto factor = 1 + static_cast<std::uint32_t>((hash & 0xFFFFFFFFU) * (prime_ - 1) >> 32);
      const auto shift = static_cast<std::uint32_t>((hash >> 32) * prime_ >> 32);
      const std::uint32_t image = factor * digit + shift;
      result = result * prime_ + (image - divided(image) * prime_);
      rest = quotient;
    }
    const std::uint64_t beyond = hashed(key, index + end_) >> 32;
    const std::uint64_t numerator = (std::uint64_t{result} << 32 | beyond) / end_;
    return to_unit_float<float>(static_cast<std::uint32_t>(numerator));
  }

  [[nodiscard]] friend constexpr bool operator==(const PrimeBase&, const PrimeBase&) noexcept = default;

 private:
  /// n / prime. Exact below 2¹⁶: the reciprocal exceeds 2²⁴ / prime by at most 1, so the product n · reciprocal exceeds
  /// 2²⁴ n / prime by less than 2¹⁶, and the next integer is at least 2²⁴ / prime > 2¹⁶ away.
  [[nodiscard]] constexpr std::uint32_t divided(std::uint32_t n) const noexcept {
    return static_cast<std::uint32_t>(std::uint64_t{n} * reciprocal_ >> 24);
  }

  /// Nodes: the digits so far, with a leading 1 in front of them.
  [[nodiscard]] static constexpr std::uint64_t hashed(std::uint64_t key, std::uint32_t node) noexcept {
    return mix(key + 0x9E3779B97F4A7C15U * node);
  }

  std::uint32_t prime_;
  std::uint32_t reciprocal_;
  std::uint32_t end_ = 1;  ///< the least power not below index_end
};

}  // namespace glint
