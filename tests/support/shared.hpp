// SPDX-License-Identifier: MIT
#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include <support/catch.hpp>

namespace glint::testing {

/// The root of the source tree, which main.cpp is told: the tests' own units are compiled alike wherever it is.
[[nodiscard]] std::filesystem::path source_directory();

/// Where a file of the shared reference data is: under the directory named by the environment variable GLINT_SHARED,
/// else under `shared` beside the source tree. Warns and is empty where there is none: the caller skips its test.
[[nodiscard]] inline std::optional<std::filesystem::path> shared_path(const std::string& name) {
  const char* const chosen = std::getenv("GLINT_SHARED");
  const std::filesystem::path root =
      chosen != nullptr ? std::filesystem::path(chosen) : source_directory() / ".." / "shared";
  if (std::error_code error; std::filesystem::exists(root / name, error)) return root / name;
  WARN("skipped: no reference data " << (root / name).string());
  return std::nullopt;
}

/// The content of a file of the shared reference data.
[[nodiscard]] inline std::optional<std::string> shared_file(const std::string& name) {
  const auto path = shared_path(name);
  if (!path) return std::nullopt;
  std::ostringstream text;
  text << std::ifstream(*path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace glint::testing
