// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glint/core/config.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/sampler/concepts.hpp>

namespace glint {

/// Where a random permutation of {0, …, count − 1}, chosen by the key, sends an index: nothing is stored.
///
/// A bijection of the next power of two is walked along until it falls below count; then all are turned by a random
/// step, so that every index goes to every place equally often. Pairs of indices go to pairs of places nearly so: each
/// round about halves the departure, six leave some percent.
///
/// Requires: index < count.
/// Cost:     fewer than two walks on average.
/// Source:   Kensler, "Correlated Multi-Jittered Sampling", Pixar 13-01, 2013, section 3 (the idea; the bijection is
///           ours).
[[nodiscard]] constexpr std::uint32_t permuted(std::uint32_t index, std::uint32_t count, std::uint64_t key) noexcept {
  GLINT_ASSERT(index < count);
  constexpr int rounds = 6;
  const std::uint32_t mask = std::bit_ceil(count) - 1;
  const int half = (std::bit_width(mask) + 1) / 2;
  do {
    std::uint64_t bits = key;
    for (int round = 0; round < rounds; ++round) {
      index = (index * (static_cast<std::uint32_t>(bits) | 1) + static_cast<std::uint32_t>(bits >> 32)) & mask;
      index ^= index >> half;
      bits = std::rotr(bits, 5);
    }
  } while (index >= count);
  const auto turn = static_cast<std::uint32_t>((key >> 32) * count >> 32);
  return index >= count - turn ? index - (count - turn) : index + turn;
}

/// The numbers of one path of a Stratified sequence.
class StratifiedSampler {
 public:
  /// Requires: samples_per_pixel ≥ 1, sample ≥ 0.
  StratifiedSampler(std::uint64_t seed, int samples_per_pixel, const Vec2i& pixel, int sample) noexcept
      : count_(static_cast<std::uint32_t>(samples_per_pixel)),
        columns_(static_cast<std::uint32_t>(std::sqrt(static_cast<float>(samples_per_pixel)))),
        rows_((count_ + columns_ - 1) / columns_),
        index_(static_cast<std::uint32_t>(sample) % count_) {
    GLINT_ASSERT(samples_per_pixel >= 1 && sample >= 0);
    const std::uint64_t pattern = static_cast<std::uint32_t>(sample) / count_;
    const auto x = static_cast<std::uint32_t>(pixel.x);
    const auto y = static_cast<std::uint32_t>(pixel.y);
    key_ = mix(mix(seed, std::uint64_t{x} << 32 | y), pattern);
  }

  [[nodiscard]] float next_1d() noexcept {
    const std::uint64_t key = next_key();
    const std::uint32_t stratum = permuted(index_, count_, key);
    const auto jitter = to_unit_float<float>(mix(key, stratum));
    return within(stratum, jitter, count_);
  }

  [[nodiscard]] Vec2<float> next_2d() noexcept {
    const std::uint64_t key = next_key();
    const std::uint32_t stratum = permuted(index_, count_, key);
    const std::uint64_t jitter = mix(key, stratum);
    const std::uint32_t row = stratum / columns_;
    const std::uint32_t column = permuted(stratum - row * columns_, columns_, mix(key + 1));
    const std::uint32_t shift = permuted(row, rows_, mix(key + 2));
    const auto jitter_x = to_unit_float<float>(static_cast<std::uint32_t>(jitter));
    const auto jitter_y = to_unit_float<float>(jitter);
    return {within(column * rows_ + shift, jitter_x, columns_ * rows_), within(stratum, jitter_y, count_)};
  }

 private:
  /// A point of one of `count` intervals of [0, 1). Held off the upper end, beyond which rounding would carry it.
  [[nodiscard]] static float within(std::uint32_t interval, float jitter, std::uint32_t count) noexcept {
    constexpr float held_off = 1 - 2 * std::numeric_limits<float>::epsilon();
    const auto lower = static_cast<float>(interval);
    return std::min(lower + jitter, (lower + 1) * held_off) / static_cast<float>(count);
  }

  [[nodiscard]] std::uint64_t next_key() noexcept { return mix(key_ + 0x9E3779B97F4A7C15U * ++dimension_); }

  std::uint64_t key_ = 0;
  std::uint64_t dimension_ = 0;
  std::uint32_t count_;
  std::uint32_t columns_;
  std::uint32_t rows_;
  std::uint32_t index_;
};

/// Correlated multi-jittered numbers: the samples of a pixel spread evenly in each number, and in each pair.
///
/// With N samples a pixel, in every 1D dimension and in both coordinates of every 2D dimension each of N equal
/// intervals holds one sample (for the first coordinate and an N that is no product of two nearly equal numbers: at
/// most one in each of slightly more intervals); in 2D besides, each cell of a nearly square grid. Sample N begins a
/// fresh pattern, so any number of samples may be taken, best a multiple of N.
///
/// Dimensions never run out: they are padded, which means that each has its own random order of strata, by hashing. Two
/// dimensions together are thus no better than random; only numbers drawn as a pair are stratified as one.
///
/// Requires: 1 ≤ samples_per_pixel ≤ 2²⁰.
/// Threads:  shareable; each stream belongs to one.
/// Source:   Kensler, "Correlated Multi-Jittered Sampling", Pixar 13-01, 2013, sections 2 and 3.
struct Stratified {
  int samples_per_pixel = 16;
  std::uint64_t seed = 0;

  [[nodiscard]] StratifiedSampler stream(const Vec2i& pixel, int sample) const noexcept {
    return {seed, samples_per_pixel, pixel, sample};
  }

  [[nodiscard]] friend bool operator==(const Stratified&, const Stratified&) noexcept = default;
};

static_assert(SampleSequence<Stratified>);

}  // namespace glint
