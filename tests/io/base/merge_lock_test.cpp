// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One merge at a time, and none that waits for the dead.
#include "io/base/merge_lock.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "geo/base/check.h"
#include "tests/support/child_process.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

/// A child process that takes the lock, says so, and lives until it is killed.
ChildProcess holder(const std::string& path) {
  return ChildProcess([&](const ChildProcess::Hold& hold) {
    const MergeLock lock(path);
    hold(lock.is_held());
  });
}

TEST(MergeLock, OneHolderAtATime) {
  const WorkFolder folder;
  ChildProcess first = holder(folder / "lock");
  EXPECT_TRUE(first.is_well());
  EXPECT_FALSE(MergeLock(folder / "lock").is_held());
  EXPECT_FALSE(holder(folder / "lock").is_well());
  EXPECT_TRUE(MergeLock(folder / "another").is_held());
}

TEST(MergeLock, EndsWithItsHolderHoweverItDies) {
  const WorkFolder folder;
  ChildProcess first = holder(folder / "lock");
  ASSERT_TRUE(first.is_well());
  first.kill();
  EXPECT_TRUE(MergeLock(folder / "lock").is_held());
}

TEST(MergeLock, IsLetGoAtTheEndOfItsScope) {
  const WorkFolder folder;
  { EXPECT_TRUE(MergeLock(folder / "lock").is_held()); }
  EXPECT_TRUE(holder(folder / "lock").is_well());
}

TEST(MergeLock, LeavesNoFile) {
  const WorkFolder folder;
  {
    const MergeLock lock(folder / "made/lock");
    EXPECT_EQ(folder.content(), (std::vector<std::string>{"made/", "made/lock"}));
  }
  EXPECT_EQ(folder.content(), std::vector<std::string>{"made/"});
}

TEST(MergeLock, OfAFileThatWasRemovedMeanwhileIsWorthNothing) {
  const WorkFolder folder;
  const ChildProcess first = holder(folder / "lock");
  std::filesystem::remove(folder / "lock");
  // The next one is of a new file, and is the one that counts.
  EXPECT_TRUE(MergeLock(folder / "lock").is_held());
}

TEST(MergeLock, NoFolderIsAnErrorOfTheMachine) {
  const WorkFolder folder;
  folder.write("file", "");
  EXPECT_THROW(MergeLock(folder / "file/lock"), MachineError);
}

}  // namespace
}  // namespace sunload::test
