// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Memory of large arrays, in large pages where the system has some: what is looked for anywhere in
/// them is found sooner, and there are fewer pages to ask for.
#pragma once

#include <cstddef>
#include <memory>

namespace sunload {

/// Aligned to cache lines at the least. Throws std::bad_alloc.
void* take_large_memory(std::size_t bytes);
/// `bytes`: as it was taken.
void leave_large_memory(void* memory, std::size_t bytes);

/// Of vectors of many numbers.
template <class Real>
struct LargeMemory {
  using value_type = Real;
  LargeMemory() = default;
  template <class Other>
  explicit LargeMemory(const LargeMemory<Other>&) {}
  Real* allocate(std::size_t n) { return static_cast<Real*>(take_large_memory(n * sizeof(Real))); }
  void deallocate(Real* memory, std::size_t n) { leave_large_memory(memory, n * sizeof(Real)); }
  template <class Other>
  bool operator==(const LargeMemory<Other>&) const {
    return true;
  }
};

}  // namespace sunload
