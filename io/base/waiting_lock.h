// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A lock that processes wait for: one does what all need, the others then find it done.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "io/base/lock_file.h"

namespace sunload {

/// A lock file (made if missing, its folder too; removed by its holder at the end). The system
/// lets it go when its holder dies, on whatever machine, and wakes one of those who wait.
class WaitingLock {
 public:
  /// What happens while another process has the lock.
  struct Rules {
    std::function<bool()> is_cancelled{};  ///< asked every tenth of a second while waiting
    std::function<void()> waiting{};       ///< called once, where another process has the lock
  };
  /// Returns when the lock is held, or at once where the file system has no locks: then
  /// `problem` says so, and nothing is held. Throws Interrupted where the wait is cancelled.
  WaitingLock(const std::string& path, const Rules& rules);
  ~WaitingLock();
  WaitingLock(const WaitingLock&) = delete;
  WaitingLock& operator=(const WaitingLock&) = delete;

  bool is_held() const { return is_held_; }
  /// Why there is no lock; empty where it is held.
  const std::string& problem() const { return problem_; }

 private:
  struct Wait;
  LockFile::Outcome waited(const Rules& rules);

  std::string problem_;
  std::shared_ptr<Wait> wait_;  ///< shared with the thread that waits
  bool is_held_ = false;
};

}  // namespace sunload
