// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One traces, the others wait, and nobody waits for the dead.
#include "io/base/waiting_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "geo/base/check.h"
#include "tests/support/program.h"

namespace sunload::test {
namespace {

using namespace std::chrono_literals;

/// A child process that takes the lock, says so, and lives until it is killed or told to go on.
class Holder {
 public:
  explicit Holder(const std::string& path) {
    int told[2], tell[2];
    if (::pipe(told) != 0 || ::pipe(tell) != 0) throw std::runtime_error("pipe failed");
    process_ = ::fork();
    if (process_ == 0) {
      {
        const WaitingLock lock(path, {});
        const char held = lock.is_held() ? 'y' : 'n';
        char go_on = 0;
        if (::write(told[1], &held, 1) != 1 || ::read(tell[0], &go_on, 1) != 1) ::_exit(1);
      }
      ::_exit(0);
    }
    char held = 0;
    if (::read(told[0], &held, 1) != 1) throw std::runtime_error("no word from the child");
    EXPECT_EQ(held, 'y');
    tell_ = tell[1];
  }
  void kill() {
    end([&] { ::kill(process_, SIGKILL); });
  }
  void go_on() {
    end([&] { EXPECT_EQ(::write(tell_, "x", 1), 1); });
  }
  ~Holder() { kill(); }

 private:
  template <class How>
  void end(const How& how) {
    if (process_ < 0) return;
    how();
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }
  pid_t process_ = -1;
  int tell_ = -1;
};

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
    Holder holder(folder / "x.lock");
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
  const Holder holder(folder / "x.lock");
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
