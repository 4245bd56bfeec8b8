// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include <glint/core/config.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/sampler/concepts.hpp>

namespace glint {

/// The numbers of one path, all independent.
class IndependentSampler {
 public:
  constexpr IndependentSampler(std::uint64_t seed, const Vec2i& pixel, int sample) noexcept
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        counter_{static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y),
                 static_cast<std::uint32_t>(sample), 0} {}

  [[nodiscard]] GLINT_ALWAYS_INLINE constexpr float next_1d() noexcept {
    if (used_ > 3) refill();
    return to_unit_float<float>(block_[used_++]);
  }

  /// A pair never straddles two blocks: it may skip a number.
  [[nodiscard]] GLINT_ALWAYS_INLINE constexpr Vec2<float> next_2d() noexcept {
    if (used_ > 2) refill();
    const Vec2<float> pair{to_unit_float<float>(block_[used_]), to_unit_float<float>(block_[used_ + 1])};
    used_ += 2;
    return pair;
  }

 private:
  constexpr void refill() noexcept {
    block_ = philox4x32<7>(counter_, key_);
    ++counter_[3];
    used_ = 0;
  }

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  std::uint32_t used_ = 4;
};

/// Independent uniform numbers: the plainest sequence, the error of which falls with the root of the samples.
///
/// A number is a function of (seed, pixel, sample, dimension) alone: Philox with seven rounds, the fewest that pass
/// BigCrush. Dimensions never run out: 2³⁴ to a path.
///
/// Cost:    a block of four numbers at a time.
/// Threads: shareable; each stream belongs to one.
/// Source:  Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011, table 2.
struct Independent {
  std::uint64_t seed = 0;

  [[nodiscard]] constexpr IndependentSampler stream(const Vec2i& pixel, int sample) const noexcept {
    return {seed, pixel, sample};
  }

  [[nodiscard]] friend bool operator==(const Independent&, const Independent&) noexcept = default;
};

static_assert(SampleSequence<Independent>);

}  // namespace glint
