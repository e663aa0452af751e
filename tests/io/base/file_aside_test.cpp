// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/file_aside.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "tests/support/child_process.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

namespace fs = std::filesystem;
using test::ChildProcess;
using test::WorkFolder;
using Names = std::vector<std::string>;

/// A process that writes aside; killed, it cannot clean up.
ChildProcess writing_process(const std::string& path) {
  return ChildProcess([&](const ChildProcess::Hold& hold) {
    const FileAside file(path);
    std::ofstream(file.aside()) << "half of it";
    hold(true);
  });
}

TEST(FileAside, AppearsWhenPublishedAndIsRemovedOtherwise) {
  const WorkFolder folder;
  {
    FileAside file(folder / "kept");
    std::ofstream(file.aside()) << "whole";
    EXPECT_FALSE(fs::exists(folder / "kept"));
    file.publish();
    const FileAside given_up(folder / "lost");
    std::ofstream(given_up.aside()) << "half";
    EXPECT_EQ(folder.content().size(), 2u);
  }
  EXPECT_EQ(folder.content(), Names{"kept"});
  EXPECT_EQ(folder.read("kept"), "whole");
}

TEST(FileAside, WhatTheDeadLeftIsRemovedAndWhatTheLivingWriteStays) {
  const WorkFolder folder;
  ChildProcess dead = writing_process(folder / "a.batch");
  ChildProcess living = writing_process(folder / "b.batch");
  dead.kill();
  folder.write("b.batch.part-of-the-name", "");
  folder.write("c.part-1", "");
  ASSERT_EQ(folder.content().size(), 4u);
  remove_left_aside(folder.path());
  const auto content = folder.content();
  EXPECT_EQ(content.size(), 3u);
  EXPECT_TRUE(std::none_of(content.begin(), content.end(),
                           [](const auto& name) { return name.starts_with("a.batch"); }));
  living.kill();
  remove_left_aside(folder.path());
  EXPECT_EQ(folder.content(), (Names{"b.batch.part-of-the-name", "c.part-1"}));
}

TEST(FileAside, IsRemovedByASignalThatEndsTheProcess) {
  const WorkFolder folder;
  ChildProcess writing([&](const ChildProcess::Hold& hold) {
    remove_files_aside_on_signals();
    const FileAside first(folder / "a.csv"), second(folder / "b.csv");
    std::ofstream(first.aside()) << "half of it";
    std::ofstream(second.aside()) << "half of it";
    hold(true);
  });
  ASSERT_EQ(folder.content().size(), 2u);
  writing.end_by(SIGTERM);
  EXPECT_EQ(folder.content(), Names{});
}

TEST(FileAside, OfOtherMachinesOnlyWhatNobodyTouchedForADay) {
  const WorkFolder folder;
  const std::string fresh = "a.batch.part-0123456789ab-1-7", old = "b.batch.part-0123456789ab-1-7";
  folder.write(fresh, "");
  folder.write(old, "");
  fs::last_write_time(folder / old, fs::file_time_type::clock::now() - std::chrono::hours(25));
  remove_left_aside(folder.path());
  EXPECT_EQ(folder.content(), Names{fresh});
}

/// TMPDIR, put back in the end.
class TemporaryFiles {
 public:
  explicit TemporaryFiles(const std::string& folder) {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFiles() { before_ ? setenv("TMPDIR", before_->c_str(), 1) : unsetenv("TMPDIR"); }
  TemporaryFiles(const TemporaryFiles&) = delete;
  TemporaryFiles& operator=(const TemporaryFiles&) = delete;

 private:
  std::optional<std::string> before_;
};

TEST(FileAside, FoldersOfTheDeadAmongTemporaryFilesAreRemoved) {
  const WorkFolder folder;
  const TemporaryFiles there(folder.path());
  ChildProcess dead = writing_process("/dev/null"), living = writing_process("/dev/null");
  ASSERT_EQ(folder.content().size(), 4u);  // a folder of each, with a file
  folder.write("notes.part-0123456789ab-1-7", "a file, of another program");
  dead.kill();
  { const FileAside next("/dev/null"); }
  EXPECT_EQ(folder.content().size(), 3u);  // of the living, and the notes
  living.kill();
  { const FileAside next("/dev/null"); }
  EXPECT_EQ(folder.content(), Names{"notes.part-0123456789ab-1-7"});
}

TEST(FileAside, NoFolderNothingToRemove) {
  const WorkFolder folder;
  EXPECT_NO_THROW(remove_left_aside(folder / "none"));
}

}  // namespace
}  // namespace sunload
