// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/work_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>

namespace sunload::test {

namespace fs = std::filesystem;

namespace {

/// Suite and case, in letters that a path may have.
std::string name_of(const testing::TestInfo* test) {
  if (test == nullptr) return "suite";
  std::string name = std::string(test->test_suite_name()) + "_" + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

const testing::TestInfo* running_test() {
  return testing::UnitTest::GetInstance()->current_test_info();
}

}  // namespace

WorkFolder::WorkFolder() {
  static int count = 0;
  path_ = fs::path(testing::TempDir()) /
          fmt::format("sunload_{}_{}_{}", ::getpid(), name_of(running_test()), count++);
  fs::remove_all(path_);
  fs::create_directories(path_);
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string WorkFolder::write(const std::string& name, const std::string& text) const {
  const fs::path path = path_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

std::string WorkFolder::read(const std::string& name) const { return bytes_of(path_ / name); }

std::vector<std::string> WorkFolder::content(const std::string& below) const {
  std::vector<std::string> names;
  const fs::path root = path_ / below;
  if (!fs::exists(root)) return names;
  // A program at work may remove what is listed: nothing here looks at a file twice or throws.
  std::error_code gone;
  fs::recursive_directory_iterator entry(root, gone);
  for (; entry != fs::recursive_directory_iterator(); entry.increment(gone))
    names.push_back(entry->path().lexically_relative(root).string() +
                    (entry->is_directory(gone) ? "/" : ""));
  std::sort(names.begin(), names.end());
  return names;
}

const WorkFolder& folder_of_test() {
  static std::unique_ptr<WorkFolder> folder;
  static const testing::TestInfo* owner = nullptr;
  if (!folder || owner != running_test()) {
    owner = running_test();
    folder = std::make_unique<WorkFolder>();
  }
  return *folder;
}

std::string bytes_of(const fs::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace sunload::test
