// SPDX-License-Identifier: MIT
#pragma once

namespace glint {

/// The version of these headers (semantic versioning). CMakeLists.txt reads it from here.
struct Version {
  int major = 0;
  int minor = 1;
  int patch = 0;

  [[nodiscard]] friend constexpr bool operator==(const Version&, const Version&) noexcept = default;
};

inline constexpr Version version{};

}  // namespace glint
