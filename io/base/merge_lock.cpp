// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/merge_lock.h"

#include <unistd.h>

#include <cstring>

#include "io/base/file_aside.h"
#include "io/base/file_writing.h"

namespace sunload {

MergeLock::MergeLock(const std::string& path) : file_(path) {
  const auto outcome = file_.lock(LockFile::Way::at_once);
  if (outcome == LockFile::Outcome::failed) throw_cannot_write(path, file_.error());
  if (outcome == LockFile::Outcome::no_locks) problem_ = std::strerror(file_.error());
  // The holder before us may have removed the file that we opened: it merged just now.
  is_held_ = outcome != LockFile::Outcome::held && file_.is_named();
}

MergeLock::~MergeLock() {
  if (is_held_) unlink(file_.path().c_str());
}

}  // namespace sunload
