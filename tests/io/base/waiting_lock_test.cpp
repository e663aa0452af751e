// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One traces, the others wait, and nobody waits for the dead.
#include "io/base/waiting_lock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "geo/base/check.h"
#include "tests/support/child_process.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

using namespace std::chrono_literals;

/// A child process that takes the lock, says so, and lives until it is killed or told to go on.
ChildProcess holder_of(const std::string& path) {
  return ChildProcess([&](const ChildProcess::Hold& hold) {
    const WaitingLock lock(path, {});
    hold(lock.is_held());
  });
}

TEST(WaitingLock, IsTakenAtOnceWhereNobodyHasItAndItsFileGoesWithIt) {
  const WorkFolder folder;
  bool waited = false;
  {
    const WaitingLock lock(folder / "work/x.lock",
                           {.is_cancelled = {}, .waiting = [&] { waited = true; }});
    EXPECT_TRUE(lock.is_held());
    EXPECT_EQ(lock.problem(), "");
    EXPECT_TRUE(std::filesystem::exists(folder / "work/x.lock"));
  }
  EXPECT_FALSE(waited);
  EXPECT_EQ(folder.content(), std::vector<std::string>{"work/"});
}

TEST(WaitingLock, WaitsForItsHolderAliveOrKilled) {
  for (const bool is_killed : {false, true}) {
    const WorkFolder folder;
    ChildProcess holder = holder_of(folder / "x.lock");
    ASSERT_TRUE(holder.is_well());
    std::thread ending;
    const auto end_holder = [&] {
      // Not before the wait has begun.
      ending = std::thread([&] {
        std::this_thread::sleep_for(200ms);
        is_killed ? holder.kill() : holder.go_on();
      });
    };
    {
      const WaitingLock lock(folder / "x.lock", {.is_cancelled = {}, .waiting = end_holder});
      EXPECT_TRUE(lock.is_held()) << lock.problem();
    }
    ASSERT_TRUE(ending.joinable()) << "it did not wait";
    ending.join();
  }
}

TEST(WaitingLock, AWaitCanBeLeft) {
  const WorkFolder folder;
  const ChildProcess holder = holder_of(folder / "x.lock");
  int asked = 0;
  EXPECT_THROW(WaitingLock(folder / "x.lock", {.is_cancelled = [&] { return ++asked > 2; }}),
               Interrupted);
  EXPECT_TRUE(std::filesystem::exists(folder / "x.lock")) << "it is the holder's";
}

TEST(WaitingLock, WithoutLocksItSaysWhy) {
  const WorkFolder folder;
  std::filesystem::create_directory(folder / "x.lock");
  const WaitingLock lock(folder / "x.lock", {});
  EXPECT_FALSE(lock.is_held());
  EXPECT_NE(lock.problem().find("directory"), std::string::npos) << lock.problem();
}

}  // namespace
}  // namespace sunload::test
