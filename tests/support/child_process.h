// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A forked process that holds something until it is told to go on, or killed.
#pragma once

#include <sys/types.h>

#include <functional>

namespace sunload::test {

class ChildProcess {
 public:
  /// Tells the parent whether all is as it should be, and returns when the parent says so.
  using Hold = std::function<void(bool is_well)>;

  /// Runs `work` in a child, which must call `hold` once; returns when it has. The child ends with
  /// `work`, without leaving the parent's scopes.
  explicit ChildProcess(const std::function<void(const Hold& hold)>& work);
  ~ChildProcess() { kill(); }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// What `hold` was told.
  bool is_well() const { return is_well_; }
  /// SIGKILL: nothing is cleaned up. Waits for its end, as go_on() does.
  void kill();
  /// Sends that signal, and waits for its end.
  void end_by(int signal);
  void go_on();

 private:
  void wait();
  pid_t process_ = -1;
  int tell_ = -1;
  bool is_well_ = false;
};

}  // namespace sunload::test
