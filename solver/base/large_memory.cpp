// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/large_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <new>

namespace sunload {

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;
/// Smaller arrays lie in pages of any size …
constexpr std::size_t least_large = 2 * large_page;
/// … and still smaller ones are not worth keeping: allocators do.
constexpr std::size_t least_kept = std::size_t{1} << 20;
constexpr std::align_val_t cache_line{64};

std::align_val_t alignment_of(std::size_t bytes) {
  return bytes < least_large ? cache_line : std::align_val_t{large_page};
}

void* new_memory(std::size_t bytes) {
  void* const memory = ::operator new(bytes, alignment_of(bytes));
#ifdef MADV_HUGEPAGE
  // Whole pages of it; a system that has none says so, and nothing changes.
  if (bytes >= least_large) madvise(memory, bytes / large_page * large_page, MADV_HUGEPAGE);
#endif
  return memory;
}

void give_back(void* memory, std::size_t bytes) noexcept {
  ::operator delete(memory, alignment_of(bytes));
}

/// Large arrays that nobody uses. With those in use they never are more than were once in use.
class Aside {
 public:
  /// One of that size, or null; then there is room for it.
  void* take(std::size_t bytes) noexcept {
    const std::lock_guard lock(guard_);
    in_use_ += bytes;
    most_in_use_ = std::max(most_in_use_, in_use_);
    for (std::size_t i = count_; i-- > 0;)
      if (arrays_[i].bytes == bytes) return taken(i);
    while (in_use_ + kept_ > most_in_use_) give_back(0);
    return nullptr;
  }
  /// What take() made room for did not come.
  void not_taken(std::size_t bytes) noexcept {
    const std::lock_guard lock(guard_);
    in_use_ -= bytes;
  }
  /// Whether there is a place for it.
  bool keep(void* memory, std::size_t bytes) noexcept {
    const std::lock_guard lock(guard_);
    in_use_ -= bytes;
    if (count_ == arrays_.size()) return false;
    arrays_[count_++] = {memory, bytes};
    kept_ += bytes;
    return true;
  }
  void give_back_up_to(std::size_t bytes) noexcept {
    const std::lock_guard lock(guard_);
    for (std::size_t i = count_; i-- > 0;)
      if (arrays_[i].bytes <= bytes) give_back(i);
    most_in_use_ = in_use_ + kept_;
  }

 private:
  struct Array {
    void* memory;
    std::size_t bytes;
  };

  void* taken(std::size_t i) noexcept {
    const Array array = arrays_[i];
    std::move(arrays_.begin() + i + 1, arrays_.begin() + count_--, arrays_.begin() + i);
    kept_ -= array.bytes;
    return array.memory;
  }
  void give_back(std::size_t i) noexcept {
    const std::size_t bytes = arrays_[i].bytes;
    sunload::give_back(taken(i), bytes);
  }

  std::mutex guard_;
  std::array<Array, 64> arrays_{};  ///< from the oldest on; a block has some dozen
  std::size_t count_ = 0;
  std::size_t in_use_ = 0, most_in_use_ = 0, kept_ = 0;  ///< bytes
};

/// Never destroyed: arrays may be left while the process ends.
Aside& aside() {
  static Aside& of_process = *new Aside;
  return of_process;
}

// GCC defines a macro, Clang has a feature.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SUNLOAD_SANITIZES_ADDRESSES
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define SUNLOAD_SANITIZES_ADDRESSES
#endif

#if defined(SUNLOAD_SANITIZES_ADDRESSES)
constexpr bool keeps_aside = false;  // what is used after it was left is to be seen
#else
constexpr bool keeps_aside = true;
#endif

}  // namespace

void* take_large_memory(std::size_t bytes) {
  if (bytes < least_kept || !keeps_aside) return new_memory(bytes);
  if (void* const kept = aside().take(bytes)) return kept;
  try {
    return new_memory(bytes);
  } catch (const std::bad_alloc&) {
    return_large_memory();  // where that is what lacks
  }
  try {
    return new_memory(bytes);
  } catch (const std::bad_alloc&) {
    aside().not_taken(bytes);
    throw;
  }
}

void leave_large_memory(void* memory, std::size_t bytes) noexcept {
  if (bytes >= least_kept && keeps_aside && aside().keep(memory, bytes)) return;
  give_back(memory, bytes);
}

void return_large_memory(std::size_t up_to_bytes) noexcept { aside().give_back_up_to(up_to_bytes); }

}  // namespace sunload
