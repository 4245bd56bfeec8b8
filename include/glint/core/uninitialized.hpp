// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace glint {

/// Leaves the elements of `resize(n)` without values, whatever their initializers say: the threads that write them
/// later are then also the first to touch their memory. Allocated memory holds plain data by the rules of the language.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

  template <typename U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  UninitializedAllocator() = default;
  template <typename U>
  UninitializedAllocator(const UninitializedAllocator<U>& /*other*/) noexcept {}

  template <typename U>
  void construct(U* /*at*/) noexcept {}
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) noexcept {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A vector of plain data that `resize` does not clear.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace glint
