// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Fixed chunks, ordered sums, exceptions of parallel loops.

#include "solver/base/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "geo/base/check.h"

namespace sunload::test {
namespace {

/// Sets the number of threads and puts the old one back.
class Threads {
 public:
  explicit Threads(int count) : before_(chosen_thread_count()) { set_thread_count(count); }
  ~Threads() { set_thread_count(before_); }

 private:
  int before_;
};

TEST(ParallelChunks, CoverTheRangeOnce) {
  for (const int threads : {1, 2, 3, 7})
    for (const std::size_t count : {0u, 1u, 9u, 10u, 11u, 1000u})
      for (const std::size_t chunk : {1u, 10u, 64u, 5000u}) {
        const Threads set(threads);
        std::vector<std::atomic<int>> visits(count);
        parallel_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
          EXPECT_EQ(begin % chunk, 0u);
          EXPECT_EQ(end, std::min(count, begin + chunk));
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        for (const auto& v : visits) ASSERT_EQ(v, 1);
      }
}

TEST(ParallelChunks, RethrowTheExceptionOfTheFirstChunk) {
  for (const int threads : {1, 2, 7}) {
    const Threads set(threads);
    std::atomic<int> done = 0;
    std::atomic<bool> has_thrown = false;
    try {
      parallel_chunks(100, 1, [&](std::size_t i, std::size_t) {
        ++done;
        if (i == 17) has_thrown = true;
        if (i == 17 || i == 18 || i == 93) throw std::runtime_error(std::to_string(i));
        // A busy machine may let its thread wait before the loop knows.
        while (i > 18 && !has_thrown) std::this_thread::yield();
        if (i > 18) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      });
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "17");
    }
    // All before it, and no more behind it than other threads had begun.
    EXPECT_GE(done, 18);
    EXPECT_LT(done, 100);
  }
}

TEST(ParallelChunks, EndWhereTheyAreCancelled) {
  int asked = 0;
  set_cancellation([&] { return ++asked > 3; });
  const Threads set(1);
  std::atomic<int> done = 0;
  EXPECT_THROW(parallel_chunks(10, 1, [&](std::size_t, std::size_t) { ++done; }), Interrupted);
  EXPECT_EQ(done, 3);
  set_cancellation({});
  parallel_chunks(10, 1, [&](std::size_t, std::size_t) { ++done; });
  EXPECT_EQ(done, 13);
}

/// Threads of a team, also more than processors; each waits until all are there.
TEST(ParallelChunks, GoOnAsManyThreadsAsAreAskedFor) {
  for (const int threads : {1, 2, 5}) {
    const Threads set(threads);
    std::mutex guard;
    std::set<std::thread::id> seen;
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    parallel_chunks(static_cast<std::size_t>(threads), 1, [&](std::size_t, std::size_t) {
      {
        const std::lock_guard lock(guard);
        seen.insert(std::this_thread::get_id());
      }
      for (bool all = false; !all && std::chrono::steady_clock::now() < until;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::lock_guard lock(guard);
        all = seen.size() == static_cast<std::size_t>(threads);
      }
    });
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(threads));
  }
}

/// A loop within a loop runs on the thread that meets it: what it holds, nobody else asks for.
TEST(ParallelChunks, WithinALoopStayOnTheirThread) {
  const Threads set(3);
  std::atomic<int> elsewhere = 0, done = 0;
  parallel_chunks(8, 1, [&](std::size_t, std::size_t) {
    const auto self = std::this_thread::get_id();
    parallel_chunks(100, 1, [&](std::size_t, std::size_t) {
      ++done;
      if (std::this_thread::get_id() != self) ++elsewhere;
    });
  });
  EXPECT_EQ(done, 800);
  EXPECT_EQ(elsewhere, 0);
}

/// Loops of several threads at a time, as files are written beside the work.
TEST(ParallelChunks, OfSeveralThreadsGoOnSideBySide) {
  const Threads set(3);
  std::atomic<int> done = 0;
  const auto loops = [&] {
    for (int loop = 0; loop < 200; ++loop)
      parallel_chunks(50, 1, [&](std::size_t, std::size_t) { ++done; });
  };
  { const std::jthread one(loops), two(loops), three(loops); }
  EXPECT_EQ(done, 3 * 200 * 50);
}

TEST(OrderedSum, HasTheSameBitsForAnyNumberOfThreads) {
  constexpr std::size_t count = 100'003, chunk = 128;
  const auto sum = [&](int threads) {
    const Threads set(threads);
    return ordered_sum(count, chunk, 0.0, [](std::size_t begin, std::size_t end) {
      double part = 0;
      for (std::size_t i = begin; i < end; ++i) part += std::sin(static_cast<double>(i)) * 1e6;
      return part;
    });
  };
  const double one = sum(1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(sum(threads), one) << threads;
  // The order does matter for these numbers: backwards the bits differ.
  double backwards = 0;
  for (std::size_t i = count; i-- > 0;) backwards += std::sin(static_cast<double>(i)) * 1e6;
  EXPECT_NE(backwards, one);
}

TEST(ThreadCount, FollowsTheProcessorsWhereNoneIsChosen) {
  const Threads set(3);
  EXPECT_EQ(thread_count(), 3);
  set_thread_count(0);
  EXPECT_EQ(thread_count(), processors_by_affinity());
  EXPECT_EQ(chosen_thread_count(), 0);
}

}  // namespace
}  // namespace sunload::test
