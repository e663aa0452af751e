// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/lock_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "io/base/machine.h"

namespace sunload {

LockFile::LockFile(std::string path) : path_(std::move(path)) {
  // A process that finds the folder empty removes it, perhaps just now.
  constexpr int attempts = 10;
  for (int attempt = 0; file_ < 0 && attempt < attempts; ++attempt) {
    make_writable_folder(std::filesystem::path(path_).parent_path());
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    error_ = file_ < 0 ? errno : 0;
    if (file_ < 0 && error_ != ENOENT) break;
  }
}

LockFile::~LockFile() {
  if (file_ >= 0) close(file_);
}

LockFile::Outcome LockFile::lock(Way way) {
  if (file_ < 0) return Outcome::failed;
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  error_ = fcntl(file_, way == Way::waiting ? F_SETLKW : F_SETLK, &whole) == 0 ? 0 : errno;
  switch (error_) {
    case 0:
      return Outcome::locked;
    case EACCES:
    case EAGAIN:
      return Outcome::held;
    case ENOLCK:
    case ENOSYS:
    case EOPNOTSUPP:
      return Outcome::no_locks;
    default:
      return Outcome::failed;
  }
}

bool LockFile::is_named() const {
  struct stat opened {
  }, named{};
  return fstat(file_, &opened) == 0 && stat(path_.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace sunload
