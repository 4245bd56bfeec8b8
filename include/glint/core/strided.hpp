// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

#include <glint/core/config.hpp>

namespace glint {

/// A read-only view of values laid out at a fixed distance in somebody else's buffer: the positions within an array of
/// vertices, say. Values are copied out, so the buffer may hold any type, at any alignment.
///
/// Requires: the buffer outlives the view and holds `size` values, `stride` bytes apart.
template <typename V>
  requires std::is_trivially_copyable_v<V>
class Strided {
 public:
  /// No values.
  constexpr Strided() noexcept = default;
  Strided(const void* first, std::size_t size, std::size_t stride = sizeof(V)) noexcept
      : first_(static_cast<const std::byte*>(first)), size_(size), stride_(stride) {}
  /// A tightly packed array.
  Strided(std::span<const V> values) noexcept : Strided(values.data(), values.size()) {}
  template <typename R>
    requires std::convertible_to<const R&, std::span<const V>> Strided(const R& values)
  noexcept : Strided(std::span<const V>(values)) {}

  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
  /// Units: bytes.
  [[nodiscard]] constexpr std::size_t stride() const noexcept { return stride_; }

  /// Requires: i < size().
  [[nodiscard]] V operator[](std::size_t i) const noexcept {
    V value;
    std::memcpy(&value, at(i), sizeof(V));
    return value;
  }
  /// Where that value is. Requires: i < size().
  [[nodiscard]] const std::byte* at(std::size_t i) const noexcept {
    GLINT_ASSERT(i < size_);
    return first_ + i * stride_;
  }

 private:
  const std::byte* first_ = nullptr;
  std::size_t size_ = 0;
  std::size_t stride_ = sizeof(V);
};

/// One member of each element of an array: `strided_member(vertices, &Vertex::position)`.
template <typename Struct, typename V>
[[nodiscard]] Strided<V> strided_member(std::span<const Struct> array, V Struct::*member) noexcept {
  return array.empty() ? Strided<V>() : Strided<V>(&(array.front().*member), array.size(), sizeof(Struct));
}

}  // namespace glint
