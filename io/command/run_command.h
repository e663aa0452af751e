// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The command line of sunload with all its commands.
#pragma once

namespace sunload {

/// Runs the command that is asked for and returns its exit code (io/base/exit_code.h). Throws
/// InputError for a line that is not understood, and what the command throws.
int run_command(int argc, char** argv);

}  // namespace sunload
