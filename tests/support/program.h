// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The program as its users meet it: a process with files, output and an exit code.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/work_folder.h"

namespace sunload::test {

/// Limits of a process, as of `ulimit`.
struct Limits {
  std::optional<std::uint64_t> file_bytes;    ///< -f
  std::optional<std::uint64_t> memory_bytes;  ///< -v
};

/// What a process left behind.
struct Ran {
  int code = -1;  ///< exit code; -1 where a signal ended it
  int signal = 0;
  std::string out, err;
  std::vector<std::string> lines() const;  ///< of err
  double seconds = 0;
};

/// A running process; its standard output and error go to files.
class Process {
 public:
  /// Starts `arguments[0]` (an absolute path) in `folder`.
  Process(const std::vector<std::string>& arguments, const std::string& folder,
          const Limits& limits = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal) const;
  bool is_running();
  /// What it has written to its standard error until now.
  std::string err_so_far() const;
  /// Waits for the end.
  Ran wait();

 private:
  bool collect(int options);
  pid_t process_ = -1;
  std::string out_, err_;
  std::optional<int> status_;
  double start_ = 0;
};

/// `sunload arguments…` in `folder`, to its end.
Ran program(const WorkFolder& folder, std::vector<std::string> arguments,
            const Limits& limits = {});
/// The same without waiting.
std::vector<std::string> program_words(std::vector<std::string> arguments);

/// /usr/bin/python3 with the packages of the set-up; `code` gets `arguments` in sys.argv.
Ran python(const WorkFolder& folder, const std::string& code,
           std::vector<std::string> arguments = {});

}  // namespace sunload::test
