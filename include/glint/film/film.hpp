// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glint/color/image.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/film/filter.hpp>
#include <glint/film/splats.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The pixels begin.x ≤ x < end.x, begin.y ≤ y < end.y.
struct PixelRect {
  Vec2i begin{0};
  Vec2i end{0};

  [[nodiscard]] friend bool operator==(const PixelRect&, const PixelRect&) noexcept = default;
};

/// Gathers samples into an image. A sample at raster position s (x right, y down, pixel (i, j) covers [i, i + 1) ×
/// [j, j + 1)) adds w · L and w = filter(s − center) to each pixel whose center is within the filter's radius; the
/// pixel is Σ w L / Σ w, and black where Σ w = 0.
///
/// A sample's footprint is half-open, −radius ≤ s − center < radius: filters that end at zero do not notice, and a box
/// gives a sample on the border between pixels to the pixel that contains it rather than to both.
///
/// The film is made of blocks of 16 × 16 pixels, each with sums of its own that reach over its border as far as the
/// filter does. Whoever renders a block writes to it alone, and `develop` adds up overlapping sums in a fixed order. So
/// the image has the same bits for any number of threads and any order of blocks, without locks, atomics, or a copy of
/// the film for every thread.
///
/// Sums are kept in double: after 10⁶ samples a pixel is still right to the last digit of its floats. The product of
/// two floats is exact in double, so contraction to fused multiply-adds changes nothing.
///
/// Requires: size ≥ 0. A radius above 8 counts as 8, a negative one as 0.
/// Cost:     32 bytes a pixel, times (1 + margin / 8)² where margin = ⌈radius − ½⌉: once for the default box, 1.6 times
///           for radius 2.
/// Threads:  blocks of different index may be written at once; everything else needs the film to itself.
template <Filter F = BoxFilter>
class Film {
  /// Of the samples around one pixel.
  struct Sums {
    double r = 0;
    double g = 0;
    double b = 0;
    double weight = 0;

    void add(double w, const Rgb& value) noexcept {
      r += w * static_cast<double>(value.r);
      g += w * static_cast<double>(value.g);
      b += w * static_cast<double>(value.b);
      weight += w;
    }
    void add(const Sums& other) noexcept {
      r += other.r;
      g += other.g;
      b += other.b;
      weight += other.weight;
    }
    [[nodiscard]] Rgb mean() const noexcept {
      if (weight == 0) return 0;
      return {static_cast<float>(r / weight), static_cast<float>(g / weight), static_cast<float>(b / weight)};
    }
  };

  struct Range {
    int first = 0;
    int last = 0;
  };

 public:
  static constexpr int block_size = 16;  ///< the edge of a block in pixels
  static constexpr float max_radius = 8;

  /// Where the samples of one block's pixels go. Valid while the film lives and is not moved.
  class Block {
   public:
    /// Its part of the image.
    [[nodiscard]] const PixelRect& pixels() const noexcept { return pixels_; }

    /// Adds a sample. False, and nothing added, where the value is not finite.
    ///
    /// Requires: the position is in this block's pixels. One that rounding has put on the far border counts with the
    ///           last pixel.
    bool add(const Vec2<float>& raster_position, const Rgb& value) noexcept {
      if (!is_finite(value)) return false;
      const Vec2<float> at = local(raster_position);
      if constexpr (requires { film_->filter_.visit([](const auto&) {}); }) {
        film_->filter_.visit([&](const auto& filter) { splat(filter, at, value); });
      } else {
        splat(film_->filter_, at, value);
      }
      return true;
    }

   private:
    friend Film;
    Block(Film& film, const PixelRect& pixels, Sums* first) noexcept
        : film_(&film),
          pixels_(pixels),
          origin_(pixels.begin),
          last_(Vec2<float>(pixels.end - pixels.begin) * one_minus_epsilon<float>),
          first_(first) {}

    /// The position in the block, brought inside whatever it is: no sample can write elsewhere.
    [[nodiscard]] Vec2<float> local(const Vec2<float>& position) const noexcept {
      return {std::min(std::max(0.0F, position.x - origin_.x), last_.x),
              std::min(std::max(0.0F, position.y - origin_.y), last_.y)};
    }

    /// Pixel (x, y) of the block; in the margin where outside [0, 16).
    [[nodiscard]] Sums& sums(int x, int y) const noexcept { return first_[y * film_->stride_ + x]; }

    template <typename G>
    void splat(const G& filter, const Vec2<float>& at, const Rgb& value) noexcept {
      if constexpr (std::same_as<G, BoxFilter>) {
        if (film_->radius_ == 0.5F) return sums(static_cast<int>(at.x), static_cast<int>(at.y)).add(1, value);
      }
      const Range columns = film_->footprint(at.x);
      const Range rows = film_->footprint(at.y);
      if constexpr (SeparableFilter<G>) {
        splat_separable(filter.profile(), columns, rows, at, value);
      } else {
        splat_pixelwise(filter, columns, rows, at, value);
      }
    }

    template <typename G>
    void splat_pixelwise(const G& filter, Range columns, Range rows, const Vec2<float>& at, const Rgb& value) noexcept {
      for (int y = rows.first; y <= rows.last; ++y) {
        for (int x = columns.first; x <= columns.last; ++x) {
          sums(x, y).add(filter.evaluate({from_center(at.x, x), from_center(at.y, y)}), value);
        }
      }
    }

    template <typename Profile>
    void splat_separable(const Profile& profile, Range columns, Range rows, const Vec2<float>& at,
                         const Rgb& value) noexcept {
      std::array<float, widest_footprint> across{};
      for (int x = columns.first; x <= columns.last; ++x) {
        across[static_cast<std::size_t>(x - columns.first)] = profile(from_center(at.x, x));
      }
      for (int y = rows.first; y <= rows.last; ++y) {
        const float down = profile(from_center(at.y, y));
        for (int x = columns.first; x <= columns.last; ++x) {
          sums(x, y).add(down * across[static_cast<std::size_t>(x - columns.first)], value);
        }
      }
    }

    Film* film_;
    PixelRect pixels_;
    Vec2<float> origin_;
    Vec2<float> last_;  ///< the last position within the block's pixels
    Sums* first_;       ///< of pixel (0, 0) of the block
  };

  /// Black.
  explicit Film(Vec2i size, F filter = {})
      : size_(size),
        filter_(std::move(filter)),
        radius_(std::min(std::max(0.0F, filter_radius(filter_)), max_radius)),
        margin_(static_cast<int>(std::ceil(std::max(0.0F, radius_ - 0.5F)))),
        stride_(block_size + 2 * margin_),
        grid_((size + Vec2i(block_size - 1)) / block_size),
        sums_(block_count() * sums_per_block()) {}

  [[nodiscard]] Vec2i size() const noexcept { return size_; }
  [[nodiscard]] const F& filter() const noexcept { return filter_; }

  /// Blocks side by side and below each other; they are numbered row by row from the top.
  [[nodiscard]] Vec2i block_grid() const noexcept { return grid_; }
  [[nodiscard]] std::size_t block_count() const noexcept {
    return static_cast<std::size_t>(grid_.x) * static_cast<std::size_t>(grid_.y);
  }

  /// Requires: index < block_count().
  [[nodiscard]] Block block(std::size_t index) noexcept {
    GLINT_ASSERT(index < block_count());
    const Vec2i at{static_cast<int>(index) % grid_.x, static_cast<int>(index) / grid_.x};
    const Vec2i begin = at * block_size;
    const Vec2i end{std::min(begin.x + block_size, size_.x), std::min(begin.y + block_size, size_.y)};
    return {*this, {begin, end}, &sums_[slot(at, begin)]};
  }

  /// Where light goes that paths bring to pixels of their own choosing. Made when first asked for.
  [[nodiscard]] Splats& splats() {
    if (splats_.empty()) splats_ = Splats(size_);
    return splats_;
  }

  /// Says how many paths brought splats, those that brought none included. A pixel gets the mean over as many paths as
  /// there are pixels: what one path for each of them brings. Splats go to one pixel each, whatever the filter.
  void count_splatting_paths(std::uint64_t paths) noexcept { splatting_paths_ += paths; }

  /// The image of all samples and splats so far.
  template <Executor E = Serial>
  [[nodiscard]] Image develop(const E& executor = {}) const {
    Image image(size_);
    executor.parallel_for(static_cast<std::size_t>(size_.y), block_size, [&](std::size_t begin, std::size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
        for (int x = 0; x < size_.x; ++x) image(x, y) = value({x, y});
      }
    });
    return image;
  }

  /// Forgets all samples and splats.
  void clear() noexcept {
    std::fill(sums_.begin(), sums_.end(), Sums{});
    splats_ = {};
    splatting_paths_ = 0;
  }

 private:
  static constexpr std::size_t widest_footprint = 2 * static_cast<std::size_t>(max_radius) + 1;

  [[nodiscard]] static float from_center(float position, int pixel) noexcept {
    return position - (static_cast<float>(pixel) + 0.5F);
  }

  /// The pixels along one axis with −radius ≤ position − center < radius, within block and margin.
  [[nodiscard]] Range footprint(float position) const noexcept {
    const auto floor = [](float v) {
      const int truncated = static_cast<int>(v);
      return truncated - (v < static_cast<float>(truncated) ? 1 : 0);
    };
    return {std::max(floor(position - radius_ - 0.5F) + 1, -margin_),
            std::min(floor(position + radius_ - 0.5F), block_size - 1 + margin_)};
  }

  [[nodiscard]] std::size_t sums_per_block() const noexcept {
    return static_cast<std::size_t>(stride_) * static_cast<std::size_t>(stride_);
  }

  /// Where the block at a place of the grid keeps the sums of a pixel of its own or its margin.
  [[nodiscard]] std::size_t slot(const Vec2i& at, const Vec2i& pixel) const noexcept {
    const Vec2i local = pixel - at * block_size + Vec2i(margin_);
    return (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(grid_.x) + static_cast<std::size_t>(at.x)) *
               sums_per_block() +
           static_cast<std::size_t>(local.y * stride_ + local.x);
  }

  /// What a pixel shows.
  [[nodiscard]] Rgb value(const Vec2i& pixel) const noexcept {
    const Rgb mean = total(pixel).mean();
    if (splatting_paths_ == 0 || splats_.empty()) return mean;
    const double pixels = static_cast<double>(size_.x) * static_cast<double>(size_.y);
    return mean + splats_.sum(pixel, pixels / static_cast<double>(splatting_paths_));
  }

  /// A pixel's sums over all blocks that reach it, in the order of the grid.
  [[nodiscard]] Sums total(const Vec2i& pixel) const noexcept {
    const Vec2i first{std::max(pixel.x - margin_, 0) / block_size, std::max(pixel.y - margin_, 0) / block_size};
    const Vec2i last{std::min((pixel.x + margin_) / block_size, grid_.x - 1),
                     std::min((pixel.y + margin_) / block_size, grid_.y - 1)};
    Sums all;
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) all.add(sums_[slot({x, y}, pixel)]);
    }
    return all;
  }

  Vec2i size_{0};
  F filter_;
  float radius_ = 0;  ///< the filter's, in [0, max_radius]
  int margin_ = 0;    ///< pixels by which a block's sums reach over its border
  int stride_ = 0;    ///< sums in a row of a block
  Vec2i grid_{0};
  std::vector<Sums> sums_;
  Splats splats_;
  std::uint64_t splatting_paths_ = 0;
};

}  // namespace glint
