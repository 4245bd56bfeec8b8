// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>

#include <glint/core/config.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/sampler/sobol.hpp>

namespace glint {

namespace detail {

/// Puts a zero before each bit.
[[nodiscard]] constexpr std::uint64_t spread_bits(std::uint32_t bits) noexcept {
  std::uint64_t x = bits;
  x = (x | x << 16) & 0x0000FFFF0000FFFFU;
  x = (x | x << 8) & 0x00FF00FF00FF00FFU;
  x = (x | x << 4) & 0x0F0F0F0F0F0F0F0FU;
  x = (x | x << 2) & 0x3333333333333333U;
  return (x | x << 1) & 0x5555555555555555U;
}

}  // namespace detail

/// Owen-scrambled Sobol' numbers whose error is blue noise on the screen: what one pixel gets too much of, its
/// neighbors get too little of. Seen from afar, or blurred, an image has far less noise than one by Sobol, while each
/// pixel alone is as good.
///
/// One sequence serves all pixels, which take their samples from it along a Morton curve. So a block of 2ᵏ × 2ᵏ pixels
/// has a block of the sequence, which is spread as evenly as a single pixel's. In each dimension the curve turns at
/// random, its first turn sideways or down.
///
/// The film's size does not matter. With N samples a pixel, N a power of two, tiles of 2ᵏ × 2ᵏ pixels use up the 2³²
/// points, 4ᵏ ≤ 2³² / N: 65536 pixels wide at one sample, 8192 at 64, 2048 at 1024. Each tile has its own scrambling,
/// as if it were another image.
///
/// Sample N begins a fresh pattern, so any number of samples may be taken, best a multiple of N; where
/// samples_per_pixel is no power of two, N is the next. Dimensions never run out: see Sobol.
///
/// Requires: 1 ≤ samples_per_pixel ≤ 2³⁰, sample ≥ 0.
/// Cost:     that of Sobol, and somewhat more to begin a stream.
/// Threads:  shareable; each stream belongs to one.
/// Source:   Ahmed, Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering
///           of Pixels", ACM Transactions on Graphics 39(6), 2020. Where they put four quarters in a random order, we
///           put two halves, and their two halves: it is done for all levels at once by one hash, and is as blue.
struct ZSobol {
  int samples_per_pixel = 16;
  std::uint64_t seed = 0;

  [[nodiscard]] constexpr SobolSampler stream(const Vec2i& pixel, int sample) const noexcept {
    GLINT_ASSERT(samples_per_pixel >= 1 && samples_per_pixel <= 1 << 30 && sample >= 0);
    const auto number = static_cast<std::uint32_t>(sample);
    const int bits = static_cast<int>(std::bit_width(static_cast<std::uint32_t>(samples_per_pixel) - 1));
    const std::uint32_t within = number & ((1U << bits) - 1);
    const std::uint64_t columns = detail::spread_bits(static_cast<std::uint32_t>(pixel.x));
    const std::uint64_t rows = detail::spread_bits(static_cast<std::uint32_t>(pixel.y));
    const std::uint64_t down_first = columns | rows << 1;
    const std::uint64_t sideways_first = rows | columns << 1;
    const int tile_bits = (32 - bits) / 2 * 2;
    const std::uint64_t key = mix(mix(seed, number >> bits), down_first >> tile_bits);
    return {key, static_cast<std::uint32_t>(down_first << bits) | within,
            static_cast<std::uint32_t>(sideways_first << bits) | within};
  }

  [[nodiscard]] friend bool operator==(const ZSobol&, const ZSobol&) noexcept = default;
};

static_assert(SampleSequence<ZSobol>);

}  // namespace glint
