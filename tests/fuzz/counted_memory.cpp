// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/counted_memory.h"

#include <algorithm>
#include <cstdlib>
#include <new>

void* operator new(std::size_t bytes) {
  void* memory =
      bytes <= sunload::fuzz::most_bytes ? std::malloc(std::max<std::size_t>(bytes, 1)) : nullptr;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }

void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
