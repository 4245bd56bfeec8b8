// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <string>
#include <system_error>

#include <glint/io/error.hpp>
#include <glint/io/file.hpp>
#include <glint/io/image.hpp>

/// Throws where the output is the input, by whatever name.
inline void require_other_file(const std::filesystem::path& output, const std::filesystem::path& input) {
  std::error_code none_there;
  if (std::filesystem::equivalent(input, output, none_there)) {
    throw glint::IoError(output, "is an input: name another output");
  }
}

/// Throws where an image cannot be written there. Leaves no trace.
inline void require_writable_image(const std::filesystem::path& output) {
  const std::string extension = glint::detail::lower_case_extension(output);
  if (extension != ".exr" && extension != ".png" && extension != ".hdr") {
    throw glint::IoError(output, "cannot be written as an image: expected .exr, .hdr or .png");
  }
  const glint::FileReplacement trial(output);
}
