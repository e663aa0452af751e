// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Folders that others remove while they are made.
#include "io/base/machine.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

/// As shards that leave no empty folders do.
TEST(WritableFolder, IsMadeThoughAnotherRemovesItMeanwhile) {
  const WorkFolder folder;
  const std::string path = folder / "study/.work/variant";
  std::atomic<bool> is_done = false;
  std::jthread remover([&] {
    while (!is_done) {
      std::error_code not_there;
      std::filesystem::remove(path, not_there);
      std::filesystem::remove(folder / "study/.work", not_there);
      std::this_thread::yield();
    }
  });
  constexpr int times = 3000;
  for (int time = 0; time < times; ++time) EXPECT_NO_THROW(make_writable_folder(path)) << time;
  is_done = true;
}

}  // namespace
}  // namespace sunload::test
