// SPDX-License-Identifier: MIT
#pragma once
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <system_error>

#include <glint/bvh/tree.hpp>
#include <glint/io/file.hpp>
#include <glint/io/tree_file.hpp>

namespace glint {

/// The bytes of a file, without a copy where the system (POSIX) can map it into memory; read where it cannot.
///
/// Requires: nobody changes the file meanwhile. Replacing it, as replace_file does, is no change.
/// Errors:   IoError, as read_file.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) map(path, std::filesystem::file_size(path, ignored));
    if (!mapping_) content_ = read_file(path);
  }

  [[nodiscard]] bool is_mapped() const noexcept { return mapping_ != nullptr; }
  /// Aligned for numbers of every kind, unless there are fewer than 16.
  [[nodiscard]] std::span<const std::byte> bytes() const noexcept {
    if (!mapping_) return std::as_bytes(std::span(content_));
    return {static_cast<const std::byte*>(mapping_.get()), size_};
  }

 private:
  struct Unmap {
    std::size_t size;

    void operator()(void* address) const noexcept { ::munmap(address, size); }
  };

  void map(const std::filesystem::path& path, std::size_t size) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    ::close(file);
    if (address == MAP_FAILED) return;
    mapping_ = std::unique_ptr<void, Unmap>(address, Unmap{size});
    size_ = size;
  }

  std::unique_ptr<void, Unmap> mapping_{nullptr, {}};
  std::size_t size_ = 0;
  std::string content_;
};

/// A tree in a file, used where it is: its arrays are the file's bytes.
///
/// Requires, Ensures, Errors: as MappedFile and read_tree.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
class MappedTree {
 public:
  MappedTree(const std::filesystem::path& path, const TreeOrigin& origin) : file_(path) {
    const detail::TreeFileHeader header = detail::checked_header<T, I>(path, file_.bytes(), origin);
    const std::span<const std::byte> content = file_.bytes().subspan(sizeof(header));
    const std::size_t node_bytes = header.nodes * sizeof(BinaryNode<T, I>);
    view_.nodes = values<BinaryNode<T, I>>(content.first(node_bytes));
    view_.order = values<I>(content.subspan(node_bytes));
    view_.depth = int(header.depth);
    view_.left_out = header.left_out;
    detail::TreeFileCheck<T, I>(path, view_, origin.primitives).run();
  }

  /// Valid as long as this, or what it was moved into.
  [[nodiscard]] const TreeView<T, I>& view() const noexcept { return view_; }

 private:
  template <typename V>
  [[nodiscard]] static std::span<const V> values(std::span<const std::byte> bytes) noexcept {
    const void* const at = bytes.data();
    return {static_cast<const V*>(at), bytes.size() / sizeof(V)};
  }

  MappedFile file_;
  TreeView<T, I> view_;
};

}  // namespace glint
