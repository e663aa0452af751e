// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/child_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace sunload::test {

ChildProcess::ChildProcess(const std::function<void(const Hold&)>& work) {
  int told[2], tell[2];
  if (::pipe(told) != 0 || ::pipe(tell) != 0) throw std::runtime_error("pipe failed");
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error("fork failed");
  if (process_ == 0) {
    ::close(told[0]);
    ::close(tell[1]);
    work([&](bool is_well) {
      const char word = is_well ? 'y' : 'n';
      char go_on = 0;
      if (::write(told[1], &word, 1) != 1 || ::read(tell[0], &go_on, 1) != 1) ::_exit(1);
    });
    ::_exit(0);
  }
  ::close(told[1]);
  ::close(tell[0]);
  tell_ = tell[1];
  char word = 0;
  const bool has_told = ::read(told[0], &word, 1) == 1;
  ::close(told[0]);
  if (!has_told) {
    kill();
    throw std::runtime_error("no word from the child");
  }
  is_well_ = word == 'y';
}

void ChildProcess::kill() { end_by(SIGKILL); }

void ChildProcess::end_by(int signal) {
  if (process_ < 0) return;
  ::kill(process_, signal);
  wait();
}

void ChildProcess::go_on() {
  if (process_ < 0) return;
  if (::write(tell_, "x", 1) != 1) throw std::runtime_error("the child is gone");
  wait();
}

void ChildProcess::wait() {
  ::close(tell_);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

}  // namespace sunload::test
