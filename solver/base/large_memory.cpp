// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/large_memory.h"

#include <sys/mman.h>

#include <new>

namespace sunload {

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;
/// Smaller arrays lie in pages of any size.
constexpr std::size_t least_large = 2 * large_page;
constexpr std::align_val_t cache_line{64};

std::align_val_t alignment_of(std::size_t bytes) {
  return bytes < least_large ? cache_line : std::align_val_t{large_page};
}

}  // namespace

void* take_large_memory(std::size_t bytes) {
  void* const memory = ::operator new(bytes, alignment_of(bytes));
#ifdef MADV_HUGEPAGE
  // Whole pages of it; a system that has none says so, and nothing changes.
  if (bytes >= least_large) madvise(memory, bytes / large_page * large_page, MADV_HUGEPAGE);
#endif
  return memory;
}

void leave_large_memory(void* memory, std::size_t bytes) {
  ::operator delete(memory, alignment_of(bytes));
}

}  // namespace sunload
