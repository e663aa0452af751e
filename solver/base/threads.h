// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Fixed chunks, ordered reduction, exceptions collected and rethrown: with `crew`, all that knows
/// threads in the solver.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace sunload {

/// Processors that the system lets this process run on.
int processors_by_affinity();
/// Threads that parallel loops use; at start the processors this process may run on.
int thread_count();
/// 1 or more, or 0: always as many as the processors that this process may run on. Results never
/// depend on it.
void set_thread_count(int threads);
/// What it has been set to; 0 at start.
int chosen_thread_count();

/// From now on every parallel loop asks this before each chunk, from any thread,
/// and ends with Interrupted where the answer is true. Empty: never.
void set_cancellation(std::function<bool()> is_cancelled);

/// Calls body(begin, end) for the chunks [0, chunk), [chunk, 2·chunk), … of
/// [0, count), any order, any thread. After an exception no chunk behind it is
/// begun; of several that of the first chunk is rethrown after the loop.
void parallel_chunks(std::size_t count, std::size_t chunk,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls body(i) for every i in [0, count).
template <class Body>
void parallel_for(std::size_t count, Body&& body, std::size_t chunk = 1) {
  parallel_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Sum of body(begin, end) over fixed chunks, added in chunk order: the same
/// bits for any number of threads.
template <class Sum, class Body>
Sum ordered_sum(std::size_t count, std::size_t chunk, Sum zero, Body&& body) {
  std::vector<Sum> parts((count + chunk - 1) / chunk, zero);
  parallel_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    parts[begin / chunk] = body(begin, end);
  });
  Sum total = zero;
  for (const auto& part : parts) total += part;
  return total;
}

}  // namespace sunload
