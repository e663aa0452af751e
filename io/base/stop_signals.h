// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Signals that ask a process to stop: it ends by itself, with what is finished kept.
#pragma once

#include <string>

namespace sunload {

/// SIGTERM, SIGINT, SIGUSR1 and SIGHUP are remembered from now on, and 4 s after the first of them
/// the process ends with exit code 75 if it has not done so by itself. A SIGHUP that was ignored
/// (nohup) stays so. May be called before anything else of the program has been set up.
void install_stop_signals();

/// Whether one has come.
bool stop_signal_came();

/// Name of the last one that came, or nothing.
std::string stop_signal();

}  // namespace sunload
