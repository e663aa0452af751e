// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One merge at a time, and none that waits for the dead.
#include "io/base/merge_lock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "geo/base/check.h"
#include "tests/support/program.h"

namespace sunload::test {
namespace {

/// A child process that takes the lock, says so, and lives until it is killed.
class Holder {
 public:
  explicit Holder(const std::string& path) {
    int told[2];
    if (::pipe(told) != 0) throw std::runtime_error("pipe failed");
    process_ = ::fork();
    if (process_ == 0) {
      const MergeLock lock(path);
      const char held = lock.is_held() ? 'y' : 'n';
      if (::write(told[1], &held, 1) != 1) _exit(1);
      for (;;) ::pause();
    }
    ::close(told[1]);
    char held = 'n';
    is_held_ = ::read(told[0], &held, 1) == 1 && held == 'y';
    ::close(told[0]);
  }
  ~Holder() { die(); }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;
  bool is_held() const { return is_held_; }
  void die() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
  bool is_held_ = false;
};

TEST(MergeLock, OneHolderAtATime) {
  const WorkFolder folder;
  Holder first(folder / "lock");
  EXPECT_TRUE(first.is_held());
  EXPECT_FALSE(MergeLock(folder / "lock").is_held());
  EXPECT_FALSE(Holder(folder / "lock").is_held());
  EXPECT_TRUE(MergeLock(folder / "another").is_held());
}

TEST(MergeLock, EndsWithItsHolderHoweverItDies) {
  const WorkFolder folder;
  Holder first(folder / "lock");
  ASSERT_TRUE(first.is_held());
  first.die();
  EXPECT_TRUE(MergeLock(folder / "lock").is_held());
}

TEST(MergeLock, IsLetGoAtTheEndOfItsScope) {
  const WorkFolder folder;
  { EXPECT_TRUE(MergeLock(folder / "lock").is_held()); }
  EXPECT_TRUE(Holder(folder / "lock").is_held());
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
  const Holder first(folder / "lock");
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
