// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

#include <glint/core/config.hpp>

namespace glint {

/// Numbers that threads take, each of them once.
///
/// Threads: any may take; `value` knows what threads took that have been joined.
class Counter {
 public:
  explicit Counter(std::size_t first) noexcept : next_(first) {}

  /// The first of `n` numbers in a row that nobody else gets.
  [[nodiscard]] std::size_t take(std::size_t n) noexcept { return GLINT_FETCH_ADD(next_, n); }

  /// The number to be taken next.
  [[nodiscard]] std::size_t value() const noexcept { return next_; }

 private:
  std::size_t next_;
};

}  // namespace glint
