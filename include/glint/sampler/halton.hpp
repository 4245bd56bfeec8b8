// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include <glint/math/low_discrepancy.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/sampler/concepts.hpp>

namespace glint {

/// The numbers of one path of a Halton sequence.
class HaltonSampler {
 public:
  /// One base a dimension; then they begin anew.
  static constexpr std::array bases{PrimeBase(2),  PrimeBase(3),  PrimeBase(5),  PrimeBase(7),
                                    PrimeBase(11), PrimeBase(13), PrimeBase(17), PrimeBase(19)};

  /// Requires: sample ≥ 0.
  constexpr HaltonSampler(std::uint64_t seed, const Vec2i& pixel, int sample) noexcept
      : index_(static_cast<std::uint32_t>(sample) % PrimeBase::index_end), shuffled_(index_) {
    const std::uint64_t x = static_cast<std::uint32_t>(pixel.x);
    const std::uint64_t y = static_cast<std::uint32_t>(pixel.y);
    key_ = mix(mix(seed, x << 32 | y), static_cast<std::uint32_t>(sample) / PrimeBase::index_end);
  }

  [[nodiscard]] constexpr float next_1d() noexcept {
    if (dimension_ == bases.size()) shuffle();
    const std::uint64_t key = next_key();
    if (dimension_ == 0) {  // base two has many digits, but they can be scrambled at once
      ++dimension_;
      return to_unit_float<float>(reversed_bits(scrambled_upward(shuffled_, static_cast<std::uint32_t>(key))));
    }
    return bases[dimension_++].scrambled_inverse(shuffled_, key);
  }

  /// A pair never straddles two sets of bases: it may skip one.
  [[nodiscard]] constexpr Vec2<float> next_2d() noexcept {
    if (dimension_ + 2 > bases.size()) shuffle();
    const float x = next_1d();
    const float y = next_1d();
    return {x, y};
  }

 private:
  /// Puts the samples in another order, so that bases may serve again. It keeps blocks of 2ᵐ together.
  constexpr void shuffle() noexcept {
    shuffled_ = owen_scrambled(index_ << 16, static_cast<std::uint32_t>(next_key())) >> 16;
    dimension_ = 0;
  }

  [[nodiscard]] constexpr std::uint64_t next_key() noexcept {
    key_ += 0x9E3779B97F4A7C15U;
    return mix(key_);
  }

  std::uint64_t key_ = 0;
  std::size_t dimension_ = 0;
  std::uint32_t index_;
  std::uint32_t shuffled_;
};

/// Halton's numbers: in each dimension the radical inverses of the samples in a base of its own, scrambled by Owen's
/// method.
///
/// Of the first bᵐ samples, and of every bᵐ after them, each of bᵐ equal intervals holds one number in base b. Two
/// dimensions of bases b and c together hold one of any bᵐ cⁿ samples in each rectangle b⁻ᵐ wide and c⁻ⁿ high. No
/// number of samples is better than others, and all dimensions of a set of bases are spread as one: that is what it has
/// over Sobol, which is the better for pairs.
///
/// Dimensions never run out: after the last base they are padded, which means that the bases begin anew with the
/// samples in another random order. Sets are thus no better than random together. Large bases would not help: of 47,
/// say, any 16 samples are but random. Pixels are independent, by hashing. Sample 65536 begins a fresh pattern.
///
/// Requires: sample ≥ 0.
/// Threads:  shareable; each stream belongs to one.
/// Source:   Halton, "On the Efficiency of Certain Quasi-Random Sequences of Points", 1960; Owen, "Randomly Permuted
///           (t,m,s)-Nets and (t,s)-Sequences", 1995; Pharr, Jakob, Humphreys (2023), section 8.6.
struct Halton {
  std::uint64_t seed = 0;

  [[nodiscard]] constexpr HaltonSampler stream(const Vec2i& pixel, int sample) const noexcept {
    return {seed, pixel, sample};
  }

  [[nodiscard]] friend bool operator==(const Halton&, const Halton&) noexcept = default;
};

static_assert(SampleSequence<Halton>);

}  // namespace glint
