// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Arrays of any size come and go, and lie where vector code expects them.
#include "solver/base/large_memory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/base/large_filled.h"

namespace sunload::test {
namespace {

template <class Real>
using Numbers = std::vector<Real, LargeMemory<Real>>;

TEST(LargeMemory, BeginsAtACacheLineWhateverItsSize) {
  // Below and above the size from which pages are large ones, whole pages and not.
  for (const std::size_t count : {1u, 1000u, 1'048'575u, 1'048'576u, 1'048'577u, 5'000'000u}) {
    Numbers<float> numbers(count, 1.0f);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % 64, 0u) << count;
    EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0.0), static_cast<double>(count));
  }
}

/// Memory comes with what was in it before.
TEST(LargeMemory, IsFilledWhateverWasThere) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 20 | 5}) {
    const auto ones = large_filled(count, 1.0f);
    EXPECT_EQ(std::accumulate(ones.begin(), ones.end(), 0.0), static_cast<double>(count));
  }
  const auto zeros = large_zeros<float>(std::size_t{1} << 20 | 5);
  EXPECT_EQ(std::count(zeros.begin(), zeros.end(), 0.0f), std::ssize(zeros));
}

TEST(LargeMemory, IsThatOfVectorsThatGrowAndMove) {
  Numbers<double> numbers;
  for (int k = 0; k < 1'500'000; ++k) numbers.push_back(k);  // from small pages into large ones
  Numbers<double> copy = numbers, moved = std::move(numbers);
  EXPECT_EQ(copy, moved);
  EXPECT_EQ(moved.back(), 1'499'999.0);
  copy.resize(10);
  copy.shrink_to_fit();
  EXPECT_EQ(copy.back(), 9.0);
}

#if !defined(__SANITIZE_ADDRESS__)  // where what is left is watched, nothing is kept
constexpr std::size_t bytes = std::size_t{5} << 20, half = bytes / 2;

TEST(LargeMemory, IsKeptForWhoAsksForAsMuchNext) {
  return_large_memory();
  void* const first = take_large_memory(bytes);
  void* const second = take_large_memory(bytes);
  leave_large_memory(first, bytes);
  leave_large_memory(second, bytes);
  void* const again[] = {take_large_memory(bytes), take_large_memory(bytes)};
  EXPECT_TRUE((again[0] == first && again[1] == second) ||
              (again[0] == second && again[1] == first));
  for (void* const memory : again) leave_large_memory(memory, bytes);
  return_large_memory();
}

/// Pages that the process has in memory.
std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void* touched(std::size_t size) {
  void* const memory = take_large_memory(size);
  std::memset(memory, 1, size);
  return memory;
}

TEST(LargeMemory, IsNeverMoreThanWasInUseAtATime) {
  return_large_memory();
  const std::size_t before = resident_bytes();
  // One after another, each of another size: those before are given back.
  for (std::size_t size = bytes; size < bytes + 8 * 4096; size += 4096)
    leave_large_memory(touched(size), size);
  EXPECT_LT(resident_bytes(), before + 2 * bytes);
  // Two at a time, then one of half: there is room for it beside one of them.
  void* const first = touched(bytes);
  void* const second = touched(bytes);
  leave_large_memory(first, bytes);
  leave_large_memory(second, bytes);
  leave_large_memory(touched(half), half);
  EXPECT_LT(resident_bytes(), before + 3 * bytes);
  return_large_memory();
  EXPECT_LT(resident_bytes(), before + bytes);
}

#if !defined(__SANITIZE_THREAD__)  // which needs address space of its own
/// The process may take so much more address space, no longer than this lives.
class AddressSpace {
 public:
  explicit AddressSpace(std::size_t more) {
    std::ifstream statm("/proc/self/statm");
    std::size_t all = 0;
    statm >> all;
    getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur = all * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + more;
    setrlimit(RLIMIT_AS, &limit);
  }
  AddressSpace(const AddressSpace&) = delete;
  ~AddressSpace() { setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_{};
};

void* of_the_system(std::size_t size) {
  return mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
}

// Other memory has grown meanwhile: what is kept aside is in the way of what is wanted.
TEST(LargeMemory, IsGivenBackWhereTheSystemRefusesMore) {
  return_large_memory();
  // So large that allocators ask the system for each, whatever came before.
  constexpr std::size_t unit = std::size_t{256} << 20, more = unit / 2;
  void* const first = take_large_memory(unit);
  void* const second = take_large_memory(unit);
  const AddressSpace limited(more);
  leave_large_memory(first, unit);
  leave_large_memory(second, unit);
  void* const in_use = take_large_memory(more + unit / 8);  // in the room of one of them
  void* const other = of_the_system(unit * 3 / 4);
  ASSERT_NE(other, MAP_FAILED);
  EXPECT_EQ(of_the_system(unit / 4), MAP_FAILED);
  void* const wanted = take_large_memory(unit / 4);
  EXPECT_NE(wanted, nullptr);
  EXPECT_THROW(take_large_memory(2 * unit), std::bad_alloc);
  munmap(other, unit * 3 / 4);
  leave_large_memory(in_use, more + unit / 8);
  leave_large_memory(wanted, unit / 4);
  return_large_memory();
}
#endif
#endif

}  // namespace
}  // namespace sunload::test
