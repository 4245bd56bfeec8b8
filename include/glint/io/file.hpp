// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cerrno>
#include <concepts>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <random>
#include <string>
#include <system_error>

#include <glint/io/error.hpp>

namespace glint {

/// Opens a file for reading, byte by byte as it is.
///
/// Errors:   IoError where there is no such file, it is a directory, or it may not be read.
[[nodiscard]] inline std::ifstream open_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw IoError(path, "is a directory, expected a file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path, "cannot be read: " + std::generic_category().message(errno));
  return file;
}

/// The content of a file.
///
/// Errors:   IoError, as open_file.
[[nodiscard]] inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file = open_file(path);
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  std::string content;
  if (!unknown) content.reserve(static_cast<std::size_t>(size));
  std::array<char, 1U << 16U> block;
  while (file.read(block.data(), std::ssize(block)), file.gcount() > 0) {
    content.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) throw IoError(path, "reading failed");
  return content;
}

/// A file in the making: written beside its target under a name of its own, and moved into its place by commit().
/// Until then the target keeps its former content; without a commit the destructor removes what was written.
///
/// Errors:   IoError where the target cannot be written or is something else than a regular file.
/// Threads:  any number of writers, of this process or others: each has its own file, and the last commit stays.
class FileReplacement {
 public:
  explicit FileReplacement(const std::filesystem::path& path) : path_(path), target_(resolved(path)) {
    errno = EEXIST;
    for (int attempt = 0; attempt < 16 && errno == EEXIST; ++attempt) {
      temporary_ = target_;
      temporary_ += unique_suffix();
      std::FILE* const created = std::fopen(temporary_.string().c_str(), "wbx");  // x: never another writer's file
      if (created == nullptr) continue;
      std::fclose(created);
      stream_.open(temporary_, std::ios::binary | std::ios::trunc);
      return;
    }
    throw IoError(path_, "cannot be written: " + std::generic_category().message(errno));
  }
  FileReplacement(const FileReplacement&) = delete;
  FileReplacement& operator=(const FileReplacement&) = delete;
  ~FileReplacement() {
    if (committed_) return;
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }

  [[nodiscard]] std::ofstream& stream() noexcept { return stream_; }

  /// Puts the file in its place, in one step.
  ///
  /// Errors:   IoError where anything written did not reach the file; the target is as it was.
  void commit() {
    stream_.close();
    if (!stream_) throw IoError(path_, "writing failed: is the disk full?");
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) throw IoError(path_, "cannot be written: " + error.message());
    committed_ = true;
  }

 private:
  /// The file behind a link, so that the link stays one. Devices and directories are not to be replaced.
  [[nodiscard]] static std::filesystem::path resolved(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
      throw IoError(path, std::filesystem::is_directory(status) ? "cannot be written: it is a directory"
                                                                : "cannot be written: it is not a regular file");
    }
    if (!std::filesystem::is_symlink(path, error)) return path;
    const auto target = std::filesystem::weakly_canonical(path, error);
    return error ? path : target;
  }

  [[nodiscard]] static std::string unique_suffix() {
    std::random_device device;
    std::string suffix(".");  // appended to: GCC 12 warns of `"." + std::string()` where users optimize
    suffix.append(std::to_string(device())).append(std::to_string(device())).append(".part");
    return suffix;
  }

  std::filesystem::path path_;
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

/// Writes a file in one step: `write(stream)` fills a file beside it, which then takes its place. Where anything fails,
/// the former file stays as it was and nothing half-written is left.
///
/// Errors:   IoError, or whatever `write` throws.
template <std::invocable<std::ofstream&> Write>
void replace_file(const std::filesystem::path& path, Write&& write) {
  FileReplacement file(path);
  write(file.stream());
  file.commit();
}

}  // namespace glint
