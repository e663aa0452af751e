// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the control groups of a process leave it: of version 2 and, where a controller is still in
/// a hierarchy of its own (RHEL 7 and 8), of version 1.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sunload {

class ControlGroups {
 public:
  /// `of_process`: a file like /proc/self/cgroup; `mounts`: where hierarchies are mounted.
  explicit ControlGroups(const std::filesystem::path& of_process = "/proc/self/cgroup",
                         const std::filesystem::path& mounts = "/sys/fs/cgroup");

  /// Until the tightest limit [bytes]; infinite where there is none. What files keep in memory is
  /// not counted as taken: the system gives it back first.
  double memory_left_bytes() const;
  /// Quota of time, in processors; infinite where there is none.
  double processors() const;

 private:
  /// A group and those around it, the process' own first.
  using Folders = std::vector<std::filesystem::path>;
  Folders memory_v2_, memory_v1_, cpu_v2_, cpu_v1_;
};

}  // namespace sunload
