// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs a command; what it throws becomes a message and an exit code (docs/developer/design.md,
/// Commands and exit codes).

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <new>
#include <string_view>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/base/file_aside.h"
#include "io/base/machine.h"
#include "io/base/standard_streams.h"
#include "io/base/stop_signals.h"
#include "io/command/run_command.h"

namespace sunload {
namespace {

/// Work that goes on where it was stopped; other commands end by the signal.
bool stops_cleanly(int argc, char** argv) {
  return argc > 1 && (std::strcmp(argv[1], "run") == 0 || std::strcmp(argv[1], "merge") == 0);
}

/// What must be so before any library opens a file or takes its time. Some hundred of them are
/// set up before `main` begins, which takes a good part of a second on a busy machine.
void begin(int argc, char** argv, char**) {
  open_closed_streams();
  if (stops_cleanly(argc, argv)) {
    install_stop_signals();
  } else {
    remove_files_aside_on_signals();
  }
}

#ifdef __GLIBC__
/// Called before the constructors of libraries, with the words of the command line.
[[gnu::used, gnu::section(".preinit_array")]] void (*const before_libraries)(int, char**,
                                                                             char**) = begin;
#endif

/// Listings count as written only once they have left the program.
int finished_output(int code) {
  finish_listing();
  return code;
}

int guarded(int argc, char** argv) {
  try {
    return finished_output(run_command(argc, argv));
  } catch (const InputError& error) {
    for (const auto& problem : error.problems()) tell(problem);
    return exit_code::wrong_input;
  } catch (const MachineError& error) {
    tell(error.what());
    return exit_code::machine_limit;
  } catch (const std::bad_alloc&) {
    tell("out of memory; use a larger mesh.max_edge_m or fewer lines_per_patch");
    return exit_code::machine_limit;
  } catch (const Interrupted& error) {
    const std::string signal = stop_signal();
    const bool overwrites =
        std::find(argv, argv + argc, std::string_view("--overwrite")) != argv + argc;
    tell(fmt::format("{} ({}); finished batches are kept, go on with: sunload run … --{}",
                     error.what(), signal.empty() ? "time limit" : signal,
                     overwrites ? "overwrite" : "resume"));
    return exit_code::unfinished;
  } catch (const std::exception& error) {
    tell(fmt::format("bug in sunload: {}", error.what()));
    return exit_code::bug;
  }
}

}  // namespace
}  // namespace sunload

int main(int argc, char** argv) {
  sunload::begin(argc, argv, nullptr);
  // A file that grows beyond `ulimit -f` is an error of writing, not the end of the process; so is
  // a reader of our messages who goes away.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  sunload::keep_memory_to_end_with();
  sunload::open_listing();
  return sunload::guarded(argc, argv);
}
