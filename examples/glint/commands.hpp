// SPDX-License-Identifier: MIT
#pragma once
#include <CLI/CLI.hpp>

/// The subcommands of the program. Each adds itself to the command line; what it does when chosen sets `exit_code`.
/// Anything that goes wrong with a file is thrown as glint::IoError, and told by main.
void add_render_command(CLI::App& app, int& exit_code);
void add_compare_command(CLI::App& app, int& exit_code);
void add_info_command(CLI::App& app, int& exit_code);
