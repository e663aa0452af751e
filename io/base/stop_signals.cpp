// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/stop_signals.h"

#include <unistd.h>

#include <csignal>

#include "io/base/exit_code.h"

namespace sunload {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

/// After this time without a clean end the process ends where it stands.
constexpr unsigned grace_s = 4;

void remember(int signal) {
  if (caught_signal == 0) alarm(grace_s);
  caught_signal = signal;
}

void end_at_once(int) {
  constexpr char text[] =
      "stopped at once; finished batches are kept, go on with --resume (or with --overwrite where "
      "that was the command)\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof(text) - 1);
  _exit(exit_code::unfinished);
}

bool is_ignored(int signal) {
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

void install_stop_signals() {
  struct sigaction action {};
  action.sa_handler = end_at_once;
  sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = remember;
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) sigaction(signal, &action, nullptr);
  if (!is_ignored(SIGHUP)) sigaction(SIGHUP, &action, nullptr);
}

bool stop_signal_came() { return caught_signal != 0; }

std::string stop_signal() {
  switch (static_cast<int>(caught_signal)) {
    case SIGTERM:
      return "SIGTERM";
    case SIGINT:
      return "SIGINT";
    case SIGUSR1:
      return "SIGUSR1";
    case SIGHUP:
      return "SIGHUP";
    default:
      return {};
  }
}

}  // namespace sunload
