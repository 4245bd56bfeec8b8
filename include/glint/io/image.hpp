// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <filesystem>
#include <string>

#include <glint/color/image.hpp>
#include <glint/io/error.hpp>
#include <glint/io/image_exr.hpp>
#include <glint/io/image_ldr.hpp>

namespace glint {

namespace detail {

/// The extension in lower case, with its dot.
[[nodiscard]] inline std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace detail

/// Reads an image by its extension: .exr as read_exr does; .png, .jpg, .jpeg, .bmp, .tga and .hdr as read_ldr does.
/// The encoding is that of 8-bit and 16-bit images; OpenEXR and HDR are linear.
///
/// Errors:   IoError, also for another extension.
[[nodiscard]] inline Image read_image(const std::filesystem::path& path, Encoding encoding = Encoding::Srgb) {
  const std::string extension = detail::lower_case_extension(path);
  if (extension == ".exr") return read_exr(path);
  for (const char* const known : {".png", ".jpg", ".jpeg", ".bmp", ".tga", ".hdr"}) {
    if (extension == known) return read_ldr(path, encoding);
  }
  throw IoError(path, "cannot be read as an image: expected .exr, .hdr, .png, .jpg, .jpeg, .bmp or .tga");
}

/// Writes an image by its extension: .exr in 32-bit float, .hdr, or .png in 8-bit sRGB.
///
/// Errors:   IoError, also for another extension.
inline void write_image(const Image& image, const std::filesystem::path& path) {
  const std::string extension = detail::lower_case_extension(path);
  if (extension == ".exr") return write_exr(image, path);
  if (extension == ".hdr") return write_hdr(image, path);
  if (extension == ".png") return write_png(image, path);
  throw IoError(path, "cannot be written as an image: expected .exr, .hdr or .png");
}

}  // namespace glint
