// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One merge at a time: a lock that the system lets go when its holder dies.
#pragma once

#include <string>

#include "io/base/lock_file.h"

namespace sunload {

class MergeLock {
 public:
  /// Tries to take the lock file `path` (made if missing, its folder too; removed by its
  /// holder at the end); does not wait. Where the file system has no locks it is taken to be held,
  /// and `problem` says so. Throws MachineError.
  explicit MergeLock(const std::string& path);
  ~MergeLock();
  MergeLock(const MergeLock&) = delete;
  MergeLock& operator=(const MergeLock&) = delete;
  bool is_held() const { return is_held_; }
  /// Why others may have it, too; empty where nobody has.
  const std::string& problem() const { return problem_; }

 private:
  LockFile file_;
  std::string problem_;
  bool is_held_ = false;
};

}  // namespace sunload
