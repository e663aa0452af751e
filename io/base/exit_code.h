// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Exit codes of the program (docs/developer/design.md, Commands and exit codes).
#pragma once

namespace sunload::exit_code {

inline constexpr int done = 0;
inline constexpr int wrong_input = 2;
inline constexpr int machine_limit = 3;
inline constexpr int bug = 70;
inline constexpr int unfinished = 75;

}  // namespace sunload::exit_code
