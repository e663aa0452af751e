// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Memory of large arrays, in large pages where the system has some: random access is faster, and
/// there are fewer pages to ask for.
///
/// The system clears pages, by one thread, before it hands them out: one block of suns after
/// another would wait for that longer than for some of its work. So memory that is left is kept for
/// the next request of the same size. What is kept and what is in use together never exceed the
/// most that was in use at once.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace sunload {

/// Takes memory, aligned to cache lines at the least; its contents are undefined. Throws
/// std::bad_alloc.
void* take_large_memory(std::size_t bytes);
/// `bytes`: as it was taken.
void leave_large_memory(void* memory, std::size_t bytes) noexcept;
/// Gives kept memory of arrays of at most that size back to the system, and begins to count anew;
/// to be called before much other memory is wanted.
void return_large_memory(
    std::size_t up_to_bytes = std::numeric_limits<std::size_t>::max()) noexcept;

/// Allocator of vectors of many numbers.
template <class Real>
struct LargeMemory {
  using value_type = Real;
  LargeMemory() = default;
  template <class Other>
  explicit LargeMemory(const LargeMemory<Other>&) {}
  Real* allocate(std::size_t n) { return static_cast<Real*>(take_large_memory(n * sizeof(Real))); }
  void deallocate(Real* memory, std::size_t n) { leave_large_memory(memory, n * sizeof(Real)); }
  /// Leaves a number without a value uninitialised.
  template <class Other>
  void construct(Other* place) {
    ::new (static_cast<void*>(place)) Other;
  }
  template <class Other>
  bool operator==(const LargeMemory<Other>&) const {
    return true;
  }
};

template <class Real>
using LargeVector = std::vector<Real, LargeMemory<Real>>;

}  // namespace sunload
