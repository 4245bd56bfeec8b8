// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace glint {

/// What went wrong with a file: which one, where in it, what was found and what was expected.
/// The message is one line: `cornell.obj:12: face refers to vertex 99, but the file has 8 vertices`.
class IoError : public std::runtime_error {
 public:
  /// The file as a whole.
  IoError(const std::filesystem::path& path, std::string_view problem)
      : runtime_error(path.string().append(": ").append(problem)), path_(path) {}

  /// A place in a file: a line, counted from 1, or a JSON pointer.
  IoError(const std::filesystem::path& path, std::size_t line, std::string_view problem)
      : IoError(path, std::to_string(line), problem) {}
  IoError(const std::filesystem::path& path, std::string_view place, std::string_view problem)
      : runtime_error(path.string().append(":").append(place).append(": ").append(problem)),
        path_(path),
        place_(place) {}

  /// The file, as the caller named it.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// A line number or a JSON pointer; empty where the error is about the file as a whole.
  [[nodiscard]] const std::string& place() const noexcept { return place_; }

 private:
  std::filesystem::path path_;
  std::string place_;
};

}  // namespace glint
