// SPDX-License-Identifier: MIT
// Catch2 version 2 wants its main compiled somewhere; version 3 brings it in a library.
#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#else
#include <catch2/catch_session.hpp>

int main(int argc, char** argv) {
  return Catch::Session().run(argc, argv);
}
#endif

#include <filesystem>

#include <support/shared.hpp>

std::filesystem::path glint::testing::source_directory() {
  return GLINT_SOURCE_DIR;
}
