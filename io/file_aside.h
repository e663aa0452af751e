/// A file that appears under its name only when it is complete and on the disk.
#pragma once

#include <string>

namespace sunload {

/// Reserves a name beside `path` (`<path>.part-<process>-<random>`, same
/// folder, so that renaming is atomic; random because the processes of several
/// machines may share a folder). Unless published, the file aside is removed.
class FileAside {
 public:
  explicit FileAside(std::string path);
  ~FileAside();
  FileAside(const FileAside&) = delete;
  FileAside& operator=(const FileAside&) = delete;

  const std::string& path() const { return path_; }
  const std::string& aside() const { return aside_; }
  /// Flushes the finished file to the disk, renames it to `path`, and flushes
  /// the folder. Throws MachineError.
  void publish();

 private:
  std::string path_, aside_;
  enum class State { writing, published } state_ = State::writing;
};

/// MachineError "cannot write `path`: <text of the error number>".
[[noreturn]] void throw_cannot_write(const std::string& path, int error_number);

}  // namespace sunload
