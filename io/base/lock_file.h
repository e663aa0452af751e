// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A file with a POSIX lock on the whole of it: network file systems carry it between machines, and
/// it ends with the process that holds it.
#pragma once

#include <string>

namespace sunload {

class LockFile {
 public:
  /// Opens the file, made if missing, its folder too; `error` tells where that fails. Throws
  /// MachineError where the folder cannot be made.
  explicit LockFile(std::string path);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  /// Whether `lock` gives up at once where another process has the lock, or waits for it.
  enum class Way { at_once, waiting };
  /// What came of an attempt to lock.
  enum class Outcome {
    locked,
    held,      ///< by another process
    no_locks,  ///< the file system has none
    failed
  };
  /// Where it was another's for a while, its name may be of a later file by then: `is_named`.
  Outcome lock(Way way);
  /// Whether the file still has the name that it was opened by: its last holder may have removed
  /// it, and the lock of a file without a name is worth nothing.
  bool is_named() const;
  /// Number of the last error of the system; 0: none.
  int error() const { return error_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int file_ = -1;
  int error_ = 0;
};

}  // namespace sunload
