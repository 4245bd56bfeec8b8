// SPDX-License-Identifier: MIT
// glint: renders JSON scenes, compares images, and says what is in a file.
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include <glint/version.hpp>

#include "commands.hpp"

namespace {

constexpr int usage_error = 2;

std::string version_line() {
  return "glint " + std::to_string(glint::version.major) + "." + std::to_string(glint::version.minor) + "." +
         std::to_string(glint::version.patch);
}

/// One line, as all errors are.
std::string usage_line(const CLI::App* app, const CLI::Error& error) {
  std::string problem = error.what();
  if (const auto others = app->remaining(); app->get_subcommands().empty() && !others.empty()) {
    problem = "\"" + others.front() + "\" is not a subcommand, expected render, compare or info";
  }
  return "glint: " + problem + "; see glint --help\n";
}

int run(int argc, char** argv) {
  CLI::App app("Renders JSON scenes, compares images, and says what is in a file.", "glint");
  app.set_version_flag("--version", version_line());
  app.require_subcommand(1);
  app.failure_message(usage_line);
  app.footer("Exit status: 0 done, 1 something failed or differs too much, 2 wrong usage, 130 interrupted.");
  int exit_code = 0;
  add_render_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_info_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("glint: out of memory\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "glint: %s\n", error.what());
  }
  return 1;
}
