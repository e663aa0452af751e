// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Folders of tests: of one process and one test each, so that neither another checkout nor another
/// test of this one meets them, and removed at the end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sunload::test {

/// A folder of the running test, empty at the beginning and removed at the end.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  /// All that lies below, relative and sorted; folders end with a slash.
  std::vector<std::string> content(const std::string& below = "") const;

 private:
  std::filesystem::path path_;
};

/// One for all helpers of the running test; removed when another test asks for its own, or at the
/// end of the process.
const WorkFolder& folder_of_test();

/// A whole file; empty where there is none.
std::string bytes_of(const std::filesystem::path& path);

}  // namespace sunload::test
