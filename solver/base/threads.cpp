// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/threads.h"

#include <sched.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

#include "geo/base/check.h"
#include "solver/base/crew.h"

namespace sunload {

namespace {

int chosen_threads = 0;  // 0: as many as there are processors
std::function<bool()> cancellation;

thread_local bool in_team = false;  // a loop within a loop runs on the thread that meets it

/// Every thread takes the next number that nobody has taken.
template <class Body>
void for_every(long long count, const Body& body) {
  std::atomic<long long> next = 0;
  const auto work = [&] {
    const bool was_in_team = std::exchange(in_team, true);
    for (long long c = next++; c < count; c = next++) body(c);
    in_team = was_in_team;
  };
  // One chunk needs no team: waking and joining it costs more than most small loops.
  if (in_team || count < 2 || thread_count() < 2) return work();
  Crew::of_process().run(static_cast<int>(std::min<long long>(count, thread_count())), work);
}

}  // namespace

int processors_by_affinity() {
  // The system tells only into a set as large as its own, and some have more than cpu_set_t.
  constexpr int most = 1 << 16;
  for (int count = CPU_SETSIZE; count <= most; count *= 2) {
    cpu_set_t* set = CPU_ALLOC(static_cast<std::size_t>(count));
    const std::size_t bytes = CPU_ALLOC_SIZE(static_cast<std::size_t>(count));
    const bool is_told = set && sched_getaffinity(0, bytes, set) == 0;
    const int processors = is_told ? CPU_COUNT_S(bytes, set) : 0;
    CPU_FREE(set);
    if (is_told) return std::max(1, processors);
  }
  return 1;
}

int thread_count() { return chosen_threads > 0 ? chosen_threads : processors_by_affinity(); }

void set_thread_count(int threads) { chosen_threads = std::max(0, threads); }

int chosen_thread_count() { return chosen_threads; }

void set_cancellation(std::function<bool()> is_cancelled) {
  cancellation = std::move(is_cancelled);
}

void parallel_chunks(std::size_t count, std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  const auto chunks = static_cast<long long>((count + chunk - 1) / chunk);
  std::exception_ptr first;
  std::atomic<long long> first_chunk = chunks;
  std::mutex guard;
  for_every(chunks, [&](long long c) {
    if (c > first_chunk) return;  // nobody will see what it makes
    try {
      if (cancellation && cancellation()) throw Interrupted("stopped on request");
      const auto begin = static_cast<std::size_t>(c) * chunk;
      body(begin, std::min(count, begin + chunk));
    } catch (...) {
      const std::lock_guard lock(guard);
      if (c < first_chunk) {
        first_chunk = c;
        first = std::current_exception();
      }
    }
  });
  if (first) std::rethrow_exception(first);
}

}  // namespace sunload
