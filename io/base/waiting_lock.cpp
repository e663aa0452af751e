// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/waiting_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "geo/base/check.h"
#include "io/base/machine.h"

namespace sunload {

namespace {

constexpr std::chrono::milliseconds between_looks{100};

/// A POSIX lock on the whole file; the number of the error, or 0.
int locked(int file, int command) {
  // Network file systems carry it between machines; it ends with its process.
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(file, command, &whole) == 0 ? 0 : errno;
}

int opened(const std::string& path) {
  // A process that finds the folder empty removes it, perhaps just now.
  constexpr int attempts = 10;
  int file = -1;
  for (int attempt = 0; file < 0 && attempt < attempts; ++attempt) {
    make_writable_folder(std::filesystem::path(path).parent_path());
    file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0 && errno != ENOENT) break;
  }
  return file;
}

}  // namespace

struct WaitingLock::LockFile {
  int file = -1;
  std::mutex guard;
  std::condition_variable changed;
  std::optional<int> outcome;  ///< of the waiting thread: 0 or the number of an error
  ~LockFile() {
    if (file >= 0) close(file);
  }
};

WaitingLock::WaitingLock(const std::string& path, const Rules& rules)
    : path_(path), file_(std::make_shared<LockFile>()) {
  file_->file = opened(path);
  int error = file_->file < 0 ? errno : locked(file_->file, F_SETLK);
  if (error == EACCES || error == EAGAIN) {
    if (file_->file >= 0) {
      if (rules.waiting) rules.waiting();
      wait(rules);
      error = *file_->outcome;
    }
  }
  held_ = error == 0;
  if (!held_) problem_ = std::strerror(error);
}

WaitingLock::~WaitingLock() {
  if (held_) unlink(path_.c_str());
}

/// The system's wait cannot be left at will: a thread of its own does it, and keeps the file
/// open. Looks at the clock and at signals cost nothing on the file system.
void WaitingLock::wait(const Rules& rules) {
  sigset_t all, before;
  sigfillset(&all);
  // Signals are for the thread that looks at them.
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([lock = file_] {
    const int outcome = locked(lock->file, F_SETLKW);
    const std::lock_guard guard(lock->guard);
    lock->outcome = outcome;
    lock->changed.notify_one();
  }).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  std::unique_lock guard(file_->guard);
  while (!file_->changed.wait_for(guard, between_looks, [&] { return file_->outcome.has_value(); }))
    if (rules.is_cancelled && rules.is_cancelled()) throw Interrupted("stopped on request");
}

}  // namespace sunload
