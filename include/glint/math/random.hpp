// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>

#include <glint/core/config.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Four random words as a pure function of a counter and a key: no state, any order, any thread.
///
/// Ensures:  a bijection of the counter for each key, so distinct counters never give equal blocks.
/// Cost:     two 32 × 32 → 64 bit products a round. Seven rounds pass BigCrush, ten are the authors' safety margin.
/// Source:   Salmon, Moraes, Dror, Shaw, "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011, sections 3.3 and 4.
template <int Rounds = 10>
[[nodiscard]] constexpr std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                                                std::array<std::uint32_t, 2> key) noexcept {
  constexpr std::uint64_t multiplier_0 = 0xD2511F53U;
  constexpr std::uint64_t multiplier_1 = 0xCD9E8D57U;
  constexpr std::uint32_t golden_ratio = 0x9E3779B9U;      // 2³² (√5 − 1) / 2
  constexpr std::uint32_t sqrt_3_minus_one = 0xBB67AE85U;  // 2³² (√3 − 1)
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  for (int round = 0; round < Rounds; ++round) {
    const std::uint64_t a = multiplier_0 * counter[0];
    const std::uint64_t b = multiplier_1 * counter[2];
    counter = {high(b) ^ counter[1] ^ key[0], low(b), high(a) ^ counter[3] ^ key[1], low(a)};
    key = {key[0] + golden_ratio, key[1] + sqrt_3_minus_one};
  }
  return counter;
}

/// A uniform number in [0, 1) from uniform bits: the leading ones, as many as T holds, so one is never reached.
template <std::floating_point T, std::unsigned_integral Bits>
[[nodiscard]] constexpr T to_unit_float(Bits bits) noexcept {
  constexpr int width = std::numeric_limits<Bits>::digits;
  constexpr int kept = std::numeric_limits<T>::digits < width ? std::numeric_limits<T>::digits : width;
  constexpr T scale = T(1) / static_cast<T>(std::uint64_t{1} << (kept - 1)) / T(2);
  return static_cast<T>(static_cast<std::int64_t>(bits >> (width - kept))) * scale;  // signed converts faster
}

/// A hash of one word: every bit of the argument changes every bit of the result with a chance near one half.
///
/// Ensures:  a bijection.
/// Source:   Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014 (the output function of
///           SplitMix64, Stafford's variant 13).
[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

/// A hash of two words; the order matters.
[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t x, std::uint64_t y) noexcept {
  return mix(mix(x + 0x9E3779B97F4A7C15U) ^ y);  // the constant keeps (0, 0) from hashing to 0
}

/// Random numbers one after the other, for tests and builders; a renderer uses a SampleSequence.
///
/// Ensures:  equal seeds and streams give equal numbers on every platform; distinct ones are independent.
/// Threads:  one per thread, told apart by `stream`.
class Random {
 public:
  constexpr Random() noexcept = default;
  constexpr explicit Random(std::uint64_t seed, std::uint64_t stream = 0) noexcept : seed_(seed), stream_(stream) {}

  /// 32 uniform bits.
  [[nodiscard]] constexpr std::uint32_t bits() noexcept {
    if (used_ == 4) refill();
    return block_[used_++];
  }

  /// Uniform in [0, 1).
  template <std::floating_point T>
  [[nodiscard]] constexpr T uniform() noexcept {
    if constexpr (std::numeric_limits<T>::digits <= 32) {
      return to_unit_float<T>(bits());
    } else {
      const std::uint64_t high = bits();
      return to_unit_float<T>(high << 32 | bits());
    }
  }

  /// Uniform in [lower, upper]; rounding may reach the upper end.
  template <std::floating_point T>
  [[nodiscard]] constexpr T uniform(T lower, T upper) noexcept {
    return lower + (upper - lower) * uniform<T>();
  }

  /// Uniform in [0, 1)².
  template <std::floating_point T = float>
  [[nodiscard]] constexpr Vec2<T> uniform_vec2() noexcept {
    const T x = uniform<T>();
    const T y = uniform<T>();
    return {x, y};
  }

  /// Uniform in [0, 1)³.
  template <std::floating_point T = float>
  [[nodiscard]] constexpr Vec3<T> uniform_vec3() noexcept {
    const T x = uniform<T>();
    const T y = uniform<T>();
    const T z = uniform<T>();
    return {x, y, z};
  }

  /// Uniform in {0, …, count − 1}, to within count / 2³².
  ///
  /// Requires: count > 0.
  [[nodiscard]] constexpr std::uint32_t below(std::uint32_t count) noexcept {
    GLINT_ASSERT(count > 0);
    return static_cast<std::uint32_t>(std::uint64_t{bits()} * count >> 32);
  }

 private:
  constexpr void refill() noexcept {
    const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
    block_ =
        philox4x32<7>({low(next_), low(next_ >> 32), low(stream_), low(stream_ >> 32)}, {low(seed_), low(seed_ >> 32)});
    ++next_;
    used_ = 0;
  }

  std::uint64_t seed_ = 0;
  std::uint64_t stream_ = 0;
  std::uint64_t next_ = 0;
  std::array<std::uint32_t, 4> block_{};
  std::uint32_t used_ = 4;
};

}  // namespace glint
