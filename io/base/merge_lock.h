// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One merge at a time: a lock that the system lets go when its holder dies.
#pragma once

#include <string>

namespace sunload {

class MergeLock {
 public:
  /// Tries to take the lock file `path` (made if missing, its folder too; removed by its
  /// holder at the end); does not wait. Throws MachineError.
  explicit MergeLock(const std::string& path);
  ~MergeLock();
  MergeLock(const MergeLock&) = delete;
  MergeLock& operator=(const MergeLock&) = delete;
  bool is_held() const { return held_; }

 private:
  std::string path_;
  int file_ = -1;
  bool held_ = false;
};

}  // namespace sunload
