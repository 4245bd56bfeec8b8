// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

#include <glint/core/config.hpp>

namespace glint {

/// Has all of an object brought to the caches, for it will be read soon. The bytes that it owns elsewhere are not.
template <typename T>
GLINT_ALWAYS_INLINE void prefetch(const T& object) noexcept {
  constexpr std::size_t cache_line = 64;
  const auto* const at = reinterpret_cast<const std::byte*>(&object);
  for (std::size_t i = 0; i < sizeof(T); i += cache_line) GLINT_PREFETCH(at + i);
}

}  // namespace glint
