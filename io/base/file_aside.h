// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A file that appears under its name only when it is complete and on the disk.
#pragma once

#include <string>
#include <string_view>

namespace sunload {

/// Reserves a name beside `path` (`<path>.part-<place>-<process>-<random>`, same
/// folder, so that renaming is atomic; random because the processes of several
/// machines may share a folder; `place` tells where the process number counts:
/// on this machine since it was started, in this container). Unless published,
/// the file aside is removed.
class FileAside {
 public:
  explicit FileAside(std::string path);
  ~FileAside();
  FileAside(const FileAside&) = delete;
  FileAside& operator=(const FileAside&) = delete;

  const std::string& path() const { return path_; }
  const std::string& aside() const { return aside_; }
  /// The disk may begin with what is written so far, so that `publish` waits less: a hint.
  void start_flushing() const;
  /// Flushes the finished file to the disk, renames it to `path`, and flushes
  /// the folder. Throws MachineError.
  void publish();
  /// The same without flushing, for what is checked when read and may be lost with the power.
  void publish_unflushed();

 private:
  std::string path_, aside_;
  enum class State { writing, published } state_ = State::writing;
};

/// Removes what killed processes left aside in a folder (not in those below it).
///
/// Other processes, also of other machines, may be writing there. A file aside
/// is left over where its place is this one and its process is gone, or where
/// nobody has written to it for a day (its place cannot be looked into: another
/// machine, or this one before it was started anew). All others stay.
void remove_left_aside(const std::string& folder);

/// MachineError "cannot write `path`: <text of the error number>".
[[noreturn]] void throw_cannot_write(const std::string& path, int error_number);

/// Writes a whole file aside and publishes it. Throws MachineError.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace sunload
