// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#include <glint/color/rgb.hpp>
#include <glint/core/config.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A raster of linear colors. Row 0 is the top row, as in image files.
class Image {
 public:
  Image() = default;
  /// Black, or filled. Requires: width and height ≥ 0.
  explicit Image(Vec2i size, Rgb fill = {})
      : size_(size), pixels_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), fill) {}

  [[nodiscard]] Vec2i size() const noexcept { return size_; }
  [[nodiscard]] int width() const noexcept { return size_.x; }
  [[nodiscard]] int height() const noexcept { return size_.y; }
  [[nodiscard]] bool empty() const noexcept { return pixels_.empty(); }

  /// Requires: 0 ≤ x < width, 0 ≤ y < height.
  [[nodiscard]] const Rgb& operator()(int x, int y) const noexcept { return pixels_[index(x, y)]; }
  [[nodiscard]] Rgb& operator()(int x, int y) noexcept { return pixels_[index(x, y)]; }

  /// All pixels, row by row from the top.
  [[nodiscard]] const std::vector<Rgb>& pixels() const noexcept { return pixels_; }
  [[nodiscard]] std::vector<Rgb>& pixels() noexcept { return pixels_; }

  [[nodiscard]] friend bool operator==(const Image&, const Image&) = default;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const noexcept {
    GLINT_ASSERT(x >= 0 && x < size_.x && y >= 0 && y < size_.y);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(x);
  }

  Vec2i size_{0};
  std::vector<Rgb> pixels_;
};

}  // namespace glint
