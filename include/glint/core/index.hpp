// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <limits>

namespace glint {

/// The index that names nothing: the largest value of an unsigned type.
template <std::unsigned_integral I>
inline constexpr I none = std::numeric_limits<I>::max();

}  // namespace glint
