// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Scratch that is purged and quota scripts remove batches while a run works: a run that ends well
/// has its results all the same.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

namespace fs = std::filesystem;

/// Batches that are there now; others may come and go meanwhile.
std::vector<fs::path> batches_now(const SquareFolder& square) {
  std::vector<fs::path> found;
  std::error_code gone;
  const fs::path work = square.folder / "results/square/.work";
  for (fs::recursive_directory_iterator at(work, gone), end; !gone && at != end; at.increment(gone))
    if (at->path().extension() == ".batch") found.push_back(at->path());
  return found;
}

/// Files that are being written now.
std::vector<fs::path> parts_now(const SquareFolder& square) {
  std::vector<fs::path> found;
  std::error_code gone;
  const fs::path results = square.folder / "results";
  for (fs::recursive_directory_iterator at(results, gone), end; !gone && at != end;
       at.increment(gone))
    if (at->path().string().find(".part-") != std::string::npos) found.push_back(at->path());
  return found;
}

/// A run beside which `remove` is called again and again until it says that it is done.
Ran run_beside(const SquareFolder& square,
               const std::function<bool(const std::vector<fs::path>&)>& remove) {
  Process process(program_words({"run", "square.yaml"}), square.folder.path());
  bool is_done = false;
  while (process.is_running()) {
    if (!is_done) is_done = remove(batches_now(square));
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  return process.wait();
}

std::string without_vanishing() {
  static const SquareFolder square;
  static const int code = square.run("results").code;
  EXPECT_EQ(code, 0);
  return square.result("results");
}

void expect_result(const SquareFolder& square, const Ran& ran) {
  ASSERT_EQ(ran.code, 0) << ran.err;
  ASSERT_TRUE(fs::exists(square.result("results"))) << ran.err;
  EXPECT_EQ(different_data(square.result("results"), without_vanishing()),
            std::vector<std::string>{});
}

bool is_removed(const fs::path& path) {
  std::error_code gone;
  return fs::remove(path, gone);
}

TEST(Vanishing, OneBatchIsComputedAgain) {
  const SquareFolder square;
  const Ran ran = run_beside(
      square, [](const auto& batches) { return !batches.empty() && is_removed(batches[0]); });
  expect_result(square, ran);
  EXPECT_NE(ran.err.find("1 of 6 batches were there and are gone"), std::string::npos) << ran.err;
}

TEST(Vanishing, ADamagedBatchIsComputedAgain) {
  const SquareFolder square;
  const Ran ran = run_beside(square, [](const auto& batches) {
    if (batches.empty()) return false;
    std::error_code gone;
    fs::resize_file(batches[0], fs::file_size(batches[0], gone) / 2, gone);
    return !gone;
  });
  expect_result(square, ran);
}

/// What removes a whole folder takes the file that is written first and its folder later.
TEST(Vanishing, WhatIsBeingWrittenIsWrittenAgain) {
  const SquareFolder square;
  const Ran ran = run_beside(square, [&](const auto& batches) {
    bool is_done = false;
    for (const auto& part : parts_now(square)) is_done |= batches.size() > 1 && is_removed(part);
    return is_done;
  });
  expect_result(square, ran);
}

TEST(Vanishing, TheWholeFolderIsComputedAgain) {
  const SquareFolder square;
  const Ran ran = run_beside(square, [&](const auto& batches) {
    std::error_code gone;
    return batches.size() > 2 && fs::remove_all(square.folder / "results", gone) > 0;
  });
  expect_result(square, ran);
}

TEST(Vanishing, WhatVanishesAgainAndAgainIsListed) {
  const SquareFolder square;
  const Ran ran = run_beside(square, [](const auto& batches) {
    for (const auto& batch : batches) is_removed(batch);
    return false;
  });
  EXPECT_EQ(ran.code, 75) << ran.err;
  EXPECT_NE(ran.err.find("baseline.h5 is not there; run the study again with --resume"),
            std::string::npos)
      << ran.err;
  EXPECT_FALSE(fs::exists(square.result("results")));
}

TEST(Vanishing, OfAShardItsOwnBatches) {
  const SquareFolder square;
  ASSERT_EQ(square.run("results", {"--shard", "1/2"}).code, 0);
  Process process(program_words({"run", "square.yaml", "--shard", "0/2"}), square.folder.path());
  bool is_done = false;
  while (process.is_running()) {
    for (const auto& batch : batches_now(square))
      if (!is_done && batch.stem() == "000000") is_done = is_removed(batch);
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  expect_result(square, process.wait());
}

}  // namespace
}  // namespace sunload::test
