#include "io/merge_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "io/file_aside.h"

namespace sunload {

MergeLock::MergeLock(const std::string& path) {
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) throw_cannot_write(path, errno);
  // A POSIX lock: network file systems carry it between machines, and it ends
  // with the process that holds it.
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  held_ = fcntl(file_, F_SETLK, &whole) == 0;
  if (!held_ && errno != EACCES && errno != EAGAIN) throw_cannot_write(path, errno);
}

MergeLock::~MergeLock() { close(file_); }

}  // namespace sunload
