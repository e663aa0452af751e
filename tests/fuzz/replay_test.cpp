// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every input that once broke a reader, and every seed of the fuzzers, read with the ordinary
// build: nothing but InputError may come of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <vector>

#include "tests/fuzz/counted_memory.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/paths.h"
#include "tests/support/work_folder.h"

namespace sunload::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(test::source_folder()) / "tests" / "fuzz";

std::vector<fs::path> files_of(const fs::path& place) {
  std::vector<fs::path> files;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(place, absent)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class Replay : public testing::TestWithParam<std::string> {};

TEST_P(Replay, InputsAreReadOrRefused) {
  const auto& target = targets().at(GetParam());
  const auto seeds = files_of(folder / "corpus" / GetParam());
  EXPECT_FALSE(seeds.empty()) << "the fuzzer " << GetParam() << " has nothing to begin with";
  auto inputs = files_of(folder / "regressions" / GetParam());
  inputs.insert(inputs.end(), seeds.begin(), seeds.end());
  for (const auto& input : inputs) {
    SCOPED_TRACE(input.string());
    EXPECT_NO_THROW(run(target, test::bytes_of(input)));
  }
}

TEST_P(Replay, HalfFilesAreReadOrRefused) {
  const auto& target = targets().at(GetParam());
  for (const auto& seed : files_of(folder / "corpus" / GetParam())) {
    SCOPED_TRACE(seed.string());
    const auto bytes = test::bytes_of(seed);
    EXPECT_NO_THROW(run(target, std::string_view(bytes).substr(0, bytes.size() / 2)));
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, target] : targets()) all.push_back(name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Replay, testing::ValuesIn(names()),
                         [](const auto& name) { return name.param; });

// The twin: an exception that is no InputError, and a request beyond all reason, are noticed.
TEST(ReplayTwin, FaultsAreNoticed) {
  EXPECT_ANY_THROW(run([](std::string_view) { throw std::logic_error("planted"); }, {}));
  EXPECT_THROW(run([](std::string_view) { std::vector<char>(most_bytes + 1); }, {}),
               std::bad_alloc);
}

}  // namespace
}  // namespace sunload::fuzz
