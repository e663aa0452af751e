// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/waiting_lock.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>

#include "geo/base/check.h"
#include "io/base/lock_file.h"

namespace sunload {

namespace {

constexpr std::chrono::milliseconds between_looks{100};

/// Threads that are started meanwhile get no signals: these are for the thread that looks at them.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

struct WaitingLock::Wait {
  explicit Wait(const std::string& path) : file(path) {}
  LockFile file;
  std::mutex guard;
  std::condition_variable changed;
  std::optional<LockFile::Outcome> outcome;  ///< of the waiting thread
};

WaitingLock::WaitingLock(const std::string& path, const Rules& rules) {
  bool has_told = false;
  do {
    wait_ = std::make_shared<Wait>(path);
    auto outcome = wait_->file.lock(LockFile::Way::at_once);
    if (outcome == LockFile::Outcome::held) {
      if (rules.waiting && !has_told) rules.waiting();
      has_told = true;
      outcome = waited(rules);
    }
    is_held_ = outcome == LockFile::Outcome::locked;
    // Its holder before has removed it: what counts is the next file of that name.
  } while (is_held_ && !wait_->file.is_named());
  if (!is_held_) problem_ = std::strerror(wait_->file.error());
}

WaitingLock::~WaitingLock() {
  if (is_held_) unlink(wait_->file.path().c_str());
}

/// The system's wait cannot be left at will: a thread of its own does it, and keeps the file
/// open. Looks at the clock and at signals cost nothing on the file system.
LockFile::Outcome WaitingLock::waited(const Rules& rules) {
  {
    const SignalsBlocked signals_blocked;
    std::thread([wait = wait_] {
      const auto outcome = wait->file.lock(LockFile::Way::waiting);
      const std::lock_guard guard(wait->guard);
      wait->outcome = outcome;
      wait->changed.notify_one();
    }).detach();
  }
  std::unique_lock guard(wait_->guard);
  while (!wait_->changed.wait_for(guard, between_looks, [&] { return wait_->outcome.has_value(); }))
    if (rules.is_cancelled && rules.is_cancelled()) throw Interrupted("stopped on request");
  return *wait_->outcome;
}

}  // namespace sunload
