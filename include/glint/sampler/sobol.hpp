// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include <glint/core/config.hpp>
#include <glint/math/low_discrepancy.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/sampler/concepts.hpp>

namespace glint {

/// The numbers of one path of a sequence made of Sobol's points: of a Sobol or a ZSobol.
///
/// Each dimension takes points of its own order, and scrambles them by itself: a hash of the key and the dimension.
class SobolSampler {
 public:
  /// The point of this index. Where there is another, half of the dimensions, chosen at random, take the other.
  constexpr SobolSampler(std::uint64_t key, std::uint32_t index, std::uint32_t other) noexcept
      : key_(key), reversed_indices_{reversed_bits(index), reversed_bits(other)} {}
  constexpr SobolSampler(std::uint64_t key, std::uint32_t index) noexcept
      : key_(key), reversed_indices_{reversed_bits(index), 0} {
    reversed_indices_[1] = reversed_indices_[0];
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE constexpr float next_1d() noexcept {
    const std::uint64_t key = next_key();
    const auto seed = static_cast<std::uint32_t>(key);
    return to_unit_float<float>(reversed_bits(scrambled_upward(index(key), seed)));
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE constexpr Vec2<float> next_2d() noexcept {
    const std::uint64_t key = next_key();
    const std::uint32_t i = index(key);
    const std::uint32_t x = scrambled_upward(i, static_cast<std::uint32_t>(key));
    const std::uint32_t y = scrambled_upward(times_pascal(i), static_cast<std::uint32_t>(key >> 32));
    const std::uint64_t both = reversed_bits(std::uint64_t{x} << 32 | y);
    return {to_unit_float<float>(static_cast<std::uint32_t>(both)), to_unit_float<float>(both)};
  }

 private:
  /// SplitMix: a hash of a counter.
  [[nodiscard]] GLINT_ALWAYS_INLINE constexpr std::uint64_t next_key() noexcept {
    key_ += 0x9E3779B97F4A7C15U;
    return mix(key_);
  }

  /// The place of this path's point in the dimension's order. Scrambling indices keeps blocks of 2ᵐ together.
  [[nodiscard]] GLINT_ALWAYS_INLINE constexpr std::uint32_t index(std::uint64_t key) const noexcept {
    const std::uint64_t order = key * 0xD1342543DE82EF95U >> 31;
    return reversed_bits(scrambled_upward(reversed_indices_[order & 1], static_cast<std::uint32_t>(order >> 1)));
  }

  std::uint64_t key_;
  std::array<std::uint32_t, 2> reversed_indices_;
};

/// Owen-scrambled Sobol' numbers: the first 2ᵐ samples of a pixel, and every 2ᵐ after them, are spread as evenly as can
/// be, for all m at once.
///
/// Of 2ᵐ samples, each of 2ᵐ equal intervals holds one number; of numbers drawn as a pair, each rectangle 2⁻ᵏ wide and
/// 2ᵏ⁻ᵐ high holds one, for every k. The error of smooth integrands falls nearly with the power −3/2 of the samples. So
/// it should be a power of two; other numbers of samples are good, too.
///
/// Dimensions never run out: they are padded, which means that each takes the samples in a random order of its own. Two
/// dimensions together are thus no better than random; only numbers drawn as a pair are spread as one. Pixels are
/// independent. After 2³² samples the sequence repeats.
///
/// Requires: sample ≥ 0.
/// Cost:     about four times that of Independent: of a simple scene's rendering, a tenth.
/// Threads:  shareable; each stream belongs to one.
/// Source:   Owen, "Scrambled Net Variance for Integrals of Smooth Functions", Annals of Statistics 25(4), 1997;
/// Burley,
///           "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020 (padded by shuffling; here in pairs).
struct Sobol {
  std::uint64_t seed = 0;

  [[nodiscard]] constexpr SobolSampler stream(const Vec2i& pixel, int sample) const noexcept {
    const std::uint64_t x = static_cast<std::uint32_t>(pixel.x);
    const std::uint64_t y = static_cast<std::uint32_t>(pixel.y);
    return {mix(seed, x << 32 | y), static_cast<std::uint32_t>(sample)};
  }

  [[nodiscard]] friend bool operator==(const Sobol&, const Sobol&) noexcept = default;
};

static_assert(SampleSequence<Sobol>);

}  // namespace glint
