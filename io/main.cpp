// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs a command; what it throws becomes a message and an exit code (docs/developer/design.md,
/// Commands and exit codes).

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/base/file_aside.h"
#include "io/command/command_line.h"
#include "io/run/progress.h"

namespace sunload {
namespace {

/// Listings count as written only once they have left the program.
int finished_output(int code) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) != 0 || !std::cout) throw_cannot_write("to standard output", errno);
  return code;
}

int guarded(int argc, char** argv) {
  try {
    return finished_output(run_command(argc, argv));
  } catch (const InputError& error) {
    for (const auto& problem : error.problems()) fmt::print(stderr, "{}\n", problem);
    return exit_code::wrong_input;
  } catch (const MachineError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exit_code::machine_limit;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "out of memory; use a larger mesh.max_edge_m or fewer lines_per_patch\n");
    return exit_code::machine_limit;
  } catch (const Interrupted& error) {
    const std::string signal = stop_signal();
    fmt::print(stderr, "{} ({}); finished batches are kept, go on with: sunload run … --resume\n",
               error.what(), signal.empty() ? "time limit" : signal);
    return exit_code::unfinished;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bug in sunload: {}\n", error.what());
    return exit_code::bug;
  }
}

}  // namespace
}  // namespace sunload

int main(int argc, char** argv) {
  // A file that grows beyond `ulimit -f` is an error of writing, not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
  return sunload::guarded(argc, argv);
}
