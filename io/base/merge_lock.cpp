// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/merge_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "io/base/file_aside.h"
#include "io/base/machine.h"

namespace sunload {

namespace {

/// True where `path` is still the file that was opened, not a later one of that name.
bool is_file_of(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

MergeLock::MergeLock(const std::string& path) : path_(path) {
  // A process that has merged removes the folder when it is empty, perhaps just now.
  constexpr int attempts = 10;
  for (int attempt = 0; file_ < 0 && attempt < attempts; ++attempt) {
    make_writable_folder(std::filesystem::path(path).parent_path());
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0 && errno != ENOENT) break;
  }
  if (file_ < 0) throw_cannot_write(path, errno);
  // A POSIX lock: network file systems carry it between machines, and it ends
  // with the process that holds it.
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  const bool is_locked = fcntl(file_, F_SETLK, &whole) == 0;
  if (!is_locked && errno != EACCES && errno != EAGAIN) {
    const int error = errno;
    close(file_);
    throw_cannot_write(path, error);
  }
  // The holder before us may have removed the file that we opened: it merged just now.
  held_ = is_locked && is_file_of(file_, path);
}

MergeLock::~MergeLock() {
  if (held_) unlink(path_.c_str());
  close(file_);
}

}  // namespace sunload
