// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Pages of `man` and completions of shells, from the options of the commands.
#pragma once

#include <string>
#include <vector>

namespace sunload {

/// An option or a positional argument as its help tells it.
struct OptionWords {
  std::vector<std::string> names;  ///< --output, -o; empty: a positional one
  std::string argument;            ///< what it takes; empty: nothing, a flag
  std::string what;
  /// What else holds: its range, its default, the variable of the environment that it has its value
  /// from where it is not given, what it does not go with.
  std::vector<std::string> rules = {};
  std::vector<std::string> choices = {};  ///< words that completions offer
};
struct CommandWords {
  std::string name, what, examples;
  std::vector<OptionWords> options;
};

/// Writes FOLDER/man1/sunload.1 and a page for each command, and completions for bash, zsh and fish
/// into FOLDER/completion. Throws MachineError.
void write_manual(const std::string& folder, const std::vector<CommandWords>& commands);

}  // namespace sunload
