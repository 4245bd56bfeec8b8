// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glint/color/rgb.hpp>
#include <glint/core/config.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Sums of light that anybody may add to any pixel at any time.
///
/// Sums are integers, for whose addition the order is of no meaning: the same bits for any number of threads. Each is
/// two words, one counting units of 2⁻¹² and the other what is left in units of 2⁻⁴⁸, so that no scale need be chosen.
///
/// Cost:    48 bytes a pixel; six atomic additions a splat.
/// Threads: add() may be called at once; everything else needs the splats to itself.
class Splats {
 public:
  static constexpr float limit = 0x1p36F;  ///< of one value

  Splats() = default;
  /// Requires: size ≥ 0.
  explicit Splats(Vec2i size)
      : size_(size), words_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * words_a_pixel) {}

  /// Adds to a pixel. False, and nothing added, where a value is not finite or beyond the limit.
  ///
  /// Requires: the pixel is in the image; fewer than 2²⁷ splats a pixel.
  bool add(const Vec2i& pixel, const Rgb& value) noexcept {
    GLINT_ASSERT(pixel.x >= 0 && pixel.y >= 0 && pixel.x < size_.x && pixel.y < size_.y);
    const std::array<float, 3> channels{value.r, value.g, value.b};
    for (const float channel : channels) {
      if (!(std::abs(channel) < limit)) return false;
    }
    std::int64_t* word = &words_[first_word(pixel)];
    for (const float channel : channels) {
      const double units = std::trunc(static_cast<double>(channel) * coarse);
      const double rest = static_cast<double>(channel) - units / coarse;  // exact: both are short sums of powers of two
      add(*word++, units);
      add(*word++, std::nearbyint(rest * fine));
    }
    return true;
  }

  [[nodiscard]] bool empty() const noexcept { return words_.empty(); }

  /// What was added to a pixel, times a factor.
  [[nodiscard]] Rgb sum(const Vec2i& pixel, double factor) const noexcept {
    const std::int64_t* word = &words_[first_word(pixel)];
    const auto channel = [&](std::size_t i) {
      const double value = static_cast<double>(word[2 * i]) / coarse + static_cast<double>(word[2 * i + 1]) / fine;
      return static_cast<float>(value * factor);
    };
    return {channel(0), channel(1), channel(2)};
  }

 private:
  static constexpr std::size_t words_a_pixel = 6;
  static constexpr double coarse = 0x1p12;
  static constexpr double fine = 0x1p48;

  static void add(std::int64_t& word, double units) noexcept {
    if (units != 0) std::atomic_ref(word).fetch_add(static_cast<std::int64_t>(units), std::memory_order_relaxed);
  }
  [[nodiscard]] std::size_t first_word(const Vec2i& pixel) const noexcept {
    return (static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(pixel.x)) *
           words_a_pixel;
  }

  Vec2i size_{0};
  std::vector<std::int64_t> words_;
};

}  // namespace glint
