// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/threads.h"

#include <omp.h>

#include <exception>
#include <mutex>

#include "geo/base/check.h"

namespace sunload {

namespace {
int chosen_threads = 0;  // 0: what the runtime finds from affinity and OMP_NUM_THREADS
std::function<bool()> cancellation;
}  // namespace

int thread_count() { return chosen_threads > 0 ? chosen_threads : omp_get_num_procs(); }

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
// One chunk needs no team: waking and joining it costs more than most small loops.
#pragma omp parallel for schedule(dynamic, 1) num_threads(thread_count()) if (chunks > 1)
  for (long long c = 0; c < chunks; ++c) {
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
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace sunload
