// SPDX-License-Identifier: MIT
#pragma once

/// Reads the command line, does what it says, and returns the exit status.
int run_command_line(int argc, char** argv);
