// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Memory of large arrays, in large pages where the system has some: what is looked for anywhere in
/// them is found sooner, and there are fewer pages to ask for.
///
/// The system clears pages before it gives them away, by one thread: blocks of suns, one after
/// another, would wait for that longer than for some of their work. So what is left is kept aside
/// for who asks for as much next; with what is in use it is never more than once was in use.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace sunload {

/// Aligned to cache lines at the least; what it holds is anything. Throws std::bad_alloc.
void* take_large_memory(std::size_t bytes);
/// `bytes`: as it was taken.
void leave_large_memory(void* memory, std::size_t bytes) noexcept;
/// Gives back to the system what is kept aside of arrays of at most that size, and begins anew:
/// before much other memory is wanted.
void return_large_memory(
    std::size_t up_to_bytes = std::numeric_limits<std::size_t>::max()) noexcept;

/// Of vectors of many numbers.
template <class Real>
struct LargeMemory {
  using value_type = Real;
  LargeMemory() = default;
  template <class Other>
  explicit LargeMemory(const LargeMemory<Other>&) {}
  Real* allocate(std::size_t n) { return static_cast<Real*>(take_large_memory(n * sizeof(Real))); }
  void deallocate(Real* memory, std::size_t n) { leave_large_memory(memory, n * sizeof(Real)); }
  /// What nobody gives a value is anything, as the memory is.
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
