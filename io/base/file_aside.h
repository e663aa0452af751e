// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A file that appears under its name only when it is complete and on the disk.
#pragma once

#include <string>
#include <string_view>

#include "io/base/output_target.h"

namespace sunload {

/// Reserves a name beside `path` (`<path>.part-<place>-<process>-<random>`, same
/// folder, so that renaming is atomic; random because the processes of several
/// machines may share a folder; `place` tells where the process number counts:
/// on this machine since it was started, in this container). Unless published,
/// the file aside is removed.
///
/// Links stay: the file that they lead to is the one that is replaced. What is no file (a device, a
/// pipe, an open descriptor such as /dev/stdout) stays as well: the file aside lies in a folder of
/// its own among the temporary files then, and its bytes are written into what is there. What a
/// killed process has left there, the next one removes.
class FileAside {
 public:
  /// Throws MachineError where `path` is a folder.
  explicit FileAside(std::string path);
  ~FileAside();
  FileAside(const FileAside&) = delete;
  FileAside& operator=(const FileAside&) = delete;

  const std::string& path() const { return path_; }
  const std::string& aside() const { return aside_; }
  /// The disk may begin with what is written so far, so that `publish` waits less: a hint.
  void start_flushing() const;
  /// Flushes the finished file to the disk, renames it to `path`, and flushes
  /// the folder; or writes it into what `path` is. Throws MachineError.
  void publish();
  /// The same without flushing, for what is checked when read and may be lost with the power.
  void publish_unflushed();

 private:
  /// Removes the file aside, and the folder of its own where it has one.
  void remove_aside() const;

  std::string path_;
  OutputTarget target_;
  std::string aside_;
  enum class State { writing, published } state_ = State::writing;
};

/// From now on SIGTERM, SIGINT and SIGHUP (unless ignored) end the process as before, but remove
/// the files that it is writing aside first. For commands that do not stop at a point of their own.
void remove_files_aside_on_signals();

/// Removes what killed processes left aside in a folder (not in those below it).
///
/// Other processes, also of other machines, may be writing there. A file aside
/// is left over where its place is this one and its process is gone, or where
/// nobody has written to it for a day (its place cannot be looked into: another
/// machine, or this one before it was started anew). All others stay.
void remove_left_aside(const std::string& folder);

/// Writes a whole file aside and publishes it. Throws MachineError.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace sunload
