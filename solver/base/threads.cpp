// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/threads.h"

#ifdef _OPENMP
#include <omp.h>
#else
#include <sched.h>

#include <atomic>
#include <thread>
#endif

#include <exception>
#include <mutex>
#include <utility>

#include "geo/base/check.h"

namespace sunload {

namespace {
int chosen_threads = 0;  // 0: what the runtime finds from affinity and OMP_NUM_THREADS
std::function<bool()> cancellation;

#ifdef _OPENMP
int processors() { return omp_get_num_procs(); }

template <class Body>
void for_every(long long count, const Body& body) {
// One chunk needs no team: waking and joining it costs more than most small loops.
#pragma omp parallel for schedule(dynamic, 1) num_threads(thread_count()) if (count > 1)
  for (long long c = 0; c < count; ++c) body(c);
}
#else
// CMake: SUNLOAD_THREADS=std. The thread sanitizer understands these threads, and not those of
// GCC's OpenMP. A team for every loop: slower, and the same bits.
int processors() {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  return sched_getaffinity(0, sizeof mine, &mine) == 0 ? std::max(1, CPU_COUNT(&mine)) : 1;
}

thread_local bool in_team = false;  // a loop within a loop runs on the thread that meets it

template <class Body>
void for_every(long long count, const Body& body) {
  std::atomic<long long> next = 0;
  const auto work = [&] {
    for (long long c = next++; c < count; c = next++) body(c);
  };
  const long long team = in_team ? 1 : std::min<long long>(count, thread_count());
  std::vector<std::jthread> others;  // joined at the end of this function
  for (long long t = 1; t < team; ++t) {
    others.emplace_back([&work] {
      in_team = true;
      work();
    });
  }
  const bool was_in_team = std::exchange(in_team, true);
  work();
  in_team = was_in_team;
}
#endif
}  // namespace

int thread_count() { return chosen_threads > 0 ? chosen_threads : processors(); }

void set_thread_count(int threads) { chosen_threads = std::max(1, threads); }

void set_cancellation(std::function<bool()> is_cancelled) {
  cancellation = std::move(is_cancelled);
}

void parallel_chunks(std::size_t count, std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  const auto chunks = static_cast<long long>((count + chunk - 1) / chunk);
  std::exception_ptr first;
  long long first_chunk = chunks;
  std::mutex guard;
  for_every(chunks, [&](long long c) {
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
