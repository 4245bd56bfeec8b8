// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include <glint/io/error.hpp>

namespace glint {

/// The largest image a reader accepts, in pixels: 16384 x 16384, 3 GiB once read. A few damaged bytes in a header must
/// not claim the machine's memory.
inline constexpr std::int64_t max_image_pixels = std::int64_t{1} << 28;

/// Refuses a size before anything is allocated for it.
///
/// Errors:   IoError where a side is below 1 or the area above max_image_pixels.
inline void require_readable_size(const std::filesystem::path& path, std::int64_t width, std::int64_t height) {
  if (width >= 1 && height >= 1 && width <= max_image_pixels / height) return;
  throw IoError(path, "the header claims " + std::to_string(width) + " x " + std::to_string(height) +
                          " pixels, expected 1 to " + std::to_string(max_image_pixels) + " in all");
}

}  // namespace glint
