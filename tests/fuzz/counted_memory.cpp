// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/counted_memory.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

void* allocated(std::size_t bytes) {
  return bytes <= sunload::fuzz::most_bytes ? std::malloc(std::max<std::size_t>(bytes, 1))
                                            : nullptr;
}

}  // namespace

void* operator new(std::size_t bytes) {
  void* memory = allocated(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

// Libraries ask for it, too, and give it back to the same `delete`.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocated(bytes); }

void operator delete(void* memory) noexcept { std::free(memory); }

void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
