// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <type_traits>

#include <glint/core/config.hpp>

namespace glint {

/// A stack in place, for up to `Capacity` elements that the user has proven to be enough. Nothing is initialized.
template <typename T, std::size_t Capacity>
class FixedStack {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  FixedStack() noexcept {}  // not defaulted: that would initialize the elements

  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Requires: size() < Capacity.
  void push(const T& value) noexcept {
    GLINT_ASSERT(size_ < Capacity);
    elements_[size_++] = value;
  }
  /// Requires: not empty().
  T pop() noexcept {
    GLINT_ASSERT(size_ > 0);
    return elements_[--size_];
  }
  /// The i-th element from the bottom. Requires: i < size().
  [[nodiscard]] T& operator[](std::size_t i) noexcept { return elements_[i]; }

 private:
  std::size_t size_ = 0;
  union {  // holds the elements without making them
    T elements_[Capacity];
  };
};

}  // namespace glint
