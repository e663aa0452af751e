#include "io/file_aside.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>

#include "geo/check.h"

namespace sunload {
namespace {

/// fsync of a file or folder; the number of the error, or 0.
int flushed_to_disk(const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  return error;
}

}  // namespace

void throw_cannot_write(const std::string& path, int error_number) {
  throw MachineError("cannot write " + path + ": " + std::strerror(error_number));
}

FileAside::FileAside(std::string path)
    : path_(std::move(path)),
      aside_(path_ + ".part-" + std::to_string(::getpid()) + "-" +
             std::to_string(std::random_device{}())) {}

FileAside::~FileAside() {
  if (state_ == State::writing) ::unlink(aside_.c_str());
}

void FileAside::publish() {
  if (const int error = flushed_to_disk(aside_, O_RDONLY)) throw_cannot_write(path_, error);
  if (std::rename(aside_.c_str(), path_.c_str()) != 0) throw_cannot_write(path_, errno);
  state_ = State::published;
  const auto folder = std::filesystem::path(path_).parent_path();
  const int error = flushed_to_disk(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
  // Some network file systems cannot flush folders and say so: nothing more can be done there.
  if (error != 0 && error != EINVAL && error != ENOTSUP) throw_cannot_write(path_, error);
}

}  // namespace sunload
