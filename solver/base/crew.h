// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Threads that wait for parallel loops, and sleep soon where none comes.
///
/// Processes that share processors, more ranks or shards than cores, do not take time from each
/// other by waiting. The thread sanitizer understands it, and so does a process that was forked: it
/// has nobody to help, and does all by itself.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

namespace sunload {

class Crew {
 public:
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// The one of this process; it is never destroyed, as its threads end with the process.
  static Crew& of_process();

  /// Calls work() on up to `team` threads, the calling one among them, and returns when all calls
  /// have returned. Others come as they find time: work() must be complete with one call, and do
  /// nothing where there is nothing left. It must not throw. From any thread; loops of several
  /// threads go on side by side.
  void run(int team, const std::function<void()>& work);

 private:
  /// A call of `run`; on its stack.
  struct Loop {
    const std::function<void()>& work;
    int places;                ///< for those who come yet; under `guard_`, as all changes of `busy`
    std::atomic<int> busy{0};  ///< who came and is not done
  };

  Crew() = default;
  void have_threads(int count);
  [[noreturn]] void help();
  Loop* loop_with_a_place() const;

  std::mutex guard_;
  std::condition_variable loop_came_, loop_left_;
  std::vector<Loop*> loops_;
  std::atomic<unsigned> came_{0};  ///< loops, ever
  int threads_ = 0;
};

}  // namespace sunload
