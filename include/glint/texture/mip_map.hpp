// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <glint/color/image.hpp>
#include <glint/color/rgb.hpp>
#include <glint/core/config.hpp>
#include <glint/math/vec.hpp>

namespace glint {

namespace detail {

/// Pixels along one line of an image: number i is at first + i · step.
struct PixelLine {
  std::size_t first = 0;
  std::size_t step = 1;
  int count = 0;

  [[nodiscard]] std::size_t at(int i) const noexcept { return first + static_cast<std::size_t>(i) * step; }
};

/// Half as many pixels, rounded up, each the mean of what it covers: pixel i of m covers [i n, (i + 1) n) of n pixels
/// that are m wide, so that all shares are whole numbers and nothing is lost.
inline void halve(const Image& from, const PixelLine& n, Image& to, const PixelLine& m) {
  const auto width = static_cast<std::int64_t>(m.count);
  for (int i = 0; i < m.count; ++i) {
    const std::int64_t begin = static_cast<std::int64_t>(i) * n.count;
    const std::int64_t end = begin + n.count;
    std::array<double, 3> sum{};
    for (std::int64_t j = begin / width; j * width < end; ++j) {
      const auto share = static_cast<double>(std::min(end, (j + 1) * width) - std::max(begin, j * width));
      const Rgb& pixel = from.pixels()[n.at(static_cast<int>(j))];
      sum[0] += share * static_cast<double>(pixel.r);
      sum[1] += share * static_cast<double>(pixel.g);
      sum[2] += share * static_cast<double>(pixel.b);
    }
    const double all = n.count;
    to.pixels()[m.at(i)] = {static_cast<float>(sum[0] / all), static_cast<float>(sum[1] / all),
                            static_cast<float>(sum[2] / all)};
  }
}

[[nodiscard]] inline Image halved_across(const Image& image) {
  Image result(Vec2i{(image.width() + 1) / 2, image.height()});
  for (int y = 0; y < image.height(); ++y) {
    const auto row = static_cast<std::size_t>(y);
    halve(image, {row * static_cast<std::size_t>(image.width()), 1, image.width()}, result,
          {row * static_cast<std::size_t>(result.width()), 1, result.width()});
  }
  return result;
}

[[nodiscard]] inline Image halved_down(const Image& image) {
  Image result(Vec2i{image.width(), (image.height() + 1) / 2});
  const auto row = static_cast<std::size_t>(image.width());
  for (int x = 0; x < image.width(); ++x) {
    const auto column = static_cast<std::size_t>(x);
    halve(image, {column, row, image.height()}, result, {column, row, result.height()});
  }
  return result;
}

}  // namespace detail

/// An image and ever coarser ones down to a single pixel, each half as wide and high as the one before, rounded up.
/// Copies share the finest image.
///
/// Ensures: every level has the mean of the image, up to rounding; where sizes are powers of two, every pixel is the
///          mean of what it covers.
/// Errors:  without an image, or with an empty one, there are no levels.
/// Cost:    a third more memory.
/// Source:  Williams, "Pyramidal Parametrics", SIGGRAPH 1983.
class MipMap {
 public:
  MipMap() = default;
  explicit MipMap(std::shared_ptr<const Image> finest) {
    if (finest == nullptr || finest->empty()) return;
    finest_ = std::move(finest);
    for (const Image* last = finest_.get(); last->width() > 1 || last->height() > 1; last = &coarser_.back()) {
      coarser_.push_back(detail::halved_down(detail::halved_across(*last)));
    }
  }
  explicit MipMap(Image finest) : MipMap(std::make_shared<const Image>(std::move(finest))) {}

  [[nodiscard]] bool empty() const noexcept { return finest_ == nullptr; }
  [[nodiscard]] int level_count() const noexcept { return empty() ? 0 : static_cast<int>(coarser_.size()) + 1; }

  /// The image itself; null where there are no levels.
  [[nodiscard]] const std::shared_ptr<const Image>& finest() const noexcept { return finest_; }

  /// Level 0 is the image itself. Requires: 0 ≤ i < level_count().
  [[nodiscard]] const Image& level(int i) const noexcept {
    GLINT_ASSERT(i >= 0 && i < level_count());
    return i == 0 ? *finest_ : coarser_[static_cast<std::size_t>(i - 1)];
  }

 private:
  std::shared_ptr<const Image> finest_;
  std::vector<Image> coarser_;
};

}  // namespace glint
