// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A team of threads for parallel loops. A thread without work looks for a loop for some 30 µs,
/// then sleeps until one begins.
///
/// Since idle threads sleep, processes that share cores (more ranks or shards than cores) do not
/// take time from each other by waiting. The thread sanitizer understands the synchronisation. A
/// process that was forked has no other threads of the team: its calling thread does all the work.
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

  /// The only one of this process. It is never destroyed, as its threads end with the process.
  static Crew& of_process();

  /// Calls work() on up to `team` threads, the calling one among them, and returns when all calls
  /// have returned. The other threads join when they are free, perhaps never: one call of work()
  /// must be able to do everything, and a call that finds nothing left must do nothing. work() must
  /// not throw. May be called from any thread; loops begun by several threads run side by side.
  void run(int team, const std::function<void()>& work);

 private:
  /// A call of `run`; on its stack.
  struct Loop {
    const std::function<void()>& work;
    int places;  ///< threads that may still join; changed, as `busy` is, under `guard_`
    std::atomic<int> busy{0};  ///< threads that joined and are not done
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
