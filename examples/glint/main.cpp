// SPDX-License-Identifier: MIT
// glint: renders JSON scenes, compares images, and says what is in a file.
#include <cstdio>
#include <exception>
#include <new>

#include "command_line.hpp"

int main(int argc, char** argv) {
  try {
    return run_command_line(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("glint: out of memory\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "glint: %s\n", error.what());
  }
  return 1;
}
