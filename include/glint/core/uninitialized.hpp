// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include <glint/core/config.hpp>

namespace glint {

/// Leaves the elements of `resize(n)` without values, whatever their initializers say: the threads that write them
/// later are then also the first to touch their memory. Allocated memory holds plain data by the rules of the language.
///
/// Large arrays begin on a large page, and ask for such.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  static constexpr std::size_t large_page = std::size_t{1} << 21;

  UninitializedAllocator() = default;
  template <typename U>
  UninitializedAllocator(const UninitializedAllocator<U>& /*other*/) noexcept {}

  [[nodiscard]] T* allocate(std::size_t n) {
    if (!is_large(n)) return std::allocator<T>::allocate(n);
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    void* const memory = ::operator new (n * sizeof(T), std::align_val_t{large_page});
    GLINT_LARGE_PAGES(memory, n * sizeof(T));
    return static_cast<T*>(memory);
  }
  void deallocate(T* at, std::size_t n) noexcept {
    if (!is_large(n)) return std::allocator<T>::deallocate(at, n);
    ::operator delete (at, std::align_val_t{large_page});
  }

  template <typename U>
  void construct(U* /*at*/) noexcept {}
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) noexcept {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }

 private:
  [[nodiscard]] static constexpr bool is_large(std::size_t n) noexcept { return n >= 2 * large_page / sizeof(T); }
};

/// A vector of plain data that `resize` does not clear.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace glint
