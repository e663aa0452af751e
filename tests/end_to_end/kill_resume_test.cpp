// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Killed at any moment: nothing finished is lost, nothing half-written is read,
/// and the result is that of a run that nobody disturbed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <regex>
#include <thread>

#include "io/batch/file.h"
#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

constexpr int batches = 6;

/// Mirrors, a lamp and a two-sided sheet: all that a batch can carry.
void write_study(const WorkFolder& folder) {
  folder.write("square.obj", square_obj);
  folder.write("square.yaml", square_study("totals", "", "1"));
}

/// The result that all others must equal.
struct Undisturbed {
  WorkFolder folder;
  std::string result;
  Undisturbed() {
    write_study(folder);
    const Ran ran = program(folder, {"run", "square.yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    result = folder / "results/square/baseline.h5";
    EXPECT_EQ(ledger_problem(result), "");
    EXPECT_EQ(sums_problem(result), "");
  }
};

const Undisturbed& undisturbed() {
  static const Undisturbed once;
  return once;
}

/// Names below results/, while another process may be renaming them.
std::vector<std::string> names_now(const WorkFolder& folder) {
  for (;;) {
    try {
      return folder.content("results");
    } catch (const std::filesystem::filesystem_error&) {
      continue;
    }
  }
}

bool ends_with(const std::string& text, const std::string& end) { return text.ends_with(end); }

/// What a killed run leaves: whole files under their names, or names that say
/// that they are not whole.
void expect_only_whole_files(const WorkFolder& folder) {
  for (const auto& name : folder.content("results")) {
    const std::string path = folder / ("results/" + name);
    if (name.ends_with('/') || name.find(".part-") != std::string::npos) continue;
    if (ends_with(name, ".batch")) {
      std::smatch words;
      ASSERT_TRUE(std::regex_search(name, words, std::regex("baseline-([0-9a-f]{64})/([0-9]{6})")))
          << name;
      const auto check = check_batch(path, words[1], std::stoul(words[2]));
      EXPECT_TRUE(check.valid) << check.reason;
    } else if (ends_with(name, ".h5")) {
      EXPECT_NO_THROW(ResultReader{path}) << name;
    }
  }
}

int finished_batches(const WorkFolder& folder) {
  int count = 0;
  for (const auto& name : names_now(folder)) count += ends_with(name, ".batch") ? 1 : 0;
  return count;
}

/// After a finished run there is the result, and nothing else.
void expect_result_alone(const WorkFolder& folder) {
  EXPECT_EQ(different_data(folder / "results/square/baseline.h5", undisturbed().result),
            std::vector<std::string>{});
  for (const auto& name : folder.content("results"))
    EXPECT_FALSE(ends_with(name, ".batch") || name.find(".part-") != std::string::npos) << name;
}

using Pause = std::chrono::duration<double>;

/// Runs and sends a signal a `pause` after so many batches are there.
Ran run_until(const WorkFolder& folder, int batch_count, Pause pause, int signal) {
  Process process(program_words({"run", "square.yaml", "--resume"}), folder.path());
  while (process.is_running() && finished_batches(folder) < batch_count)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(pause);
  process.send(signal);
  return process.wait();
}

TEST(KillResume, TenRunsKilledAtAnyMoment) {
  constexpr unsigned rounds = 10;
  int killed = 0;
  for (unsigned seed = 1; seed <= rounds; ++seed) {
    const WorkFolder folder;
    write_study(folder);
    std::mt19937 random(seed);
    // A batch takes some 20 ms of a quiet machine, all before the first one some 100 ms.
    std::uniform_real_distribution<double> within_a_batch(0, 0.03), before_the_first(0, 0.15);
    int there = 0;
    while (there < batches) {
      const Pause pause(there == 0 ? before_the_first(random) : within_a_batch(random));
      const Ran ran = run_until(folder, there, pause, SIGKILL);
      expect_only_whole_files(folder);
      if (ran.code == 0) break;
      ASSERT_EQ(ran.signal, SIGKILL) << ran.err;
      ++killed;
      // The next one gets one batch further at the least.
      there = finished_batches(folder) + 1 + static_cast<int>(random() % 3);
    }
    const Ran ran = program(folder, {"run", "square.yaml", "--resume"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    expect_result_alone(folder);
  }
  std::printf("%d kills in %u rounds\n", killed, rounds);
  EXPECT_GE(killed, static_cast<int>(rounds));
}

TEST(KillResume, LinesAreNotTracedAgain) {
  int seen = 0;
  constexpr int attempts = 10;
  for (int attempt = 0; attempt < attempts && seen == 0; ++attempt) {
    const WorkFolder folder;
    write_study(folder);
    // Where it was faster than the signal there is nothing to see.
    if (run_until(folder, 1, Pause(0), SIGKILL).signal != SIGKILL || finished_batches(folder) == 0)
      continue;
    ++seen;
    const Ran resumed = program(folder, {"run", "square.yaml", "--resume"});
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(resumed.err.find(" lines "), std::string::npos) << resumed.err;
    expect_result_alone(folder);
  }
  EXPECT_EQ(seen, 1);
}

TEST(KillResume, KilledWhileAFileIsBeingWritten) {
  int seen = 0;
  constexpr int wanted = 2, attempts = 10;
  for (int attempt = 0; attempt < attempts && seen < wanted; ++attempt) {
    const WorkFolder folder;
    write_study(folder);
    const auto is_writing = [&] {
      const auto names = names_now(folder);
      return std::any_of(names.begin(), names.end(),
                         [](const auto& name) { return name.find(".part-") != std::string::npos; });
    };
    Process process(program_words({"run", "square.yaml"}), folder.path());
    while (process.is_running() && !is_writing()) {
    }
    process.send(SIGKILL);
    process.wait();
    expect_only_whole_files(folder);
    seen += is_writing() ? 1 : 0;
    const Ran resumed = program(folder, {"run", "square.yaml", "--resume"});
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    expect_result_alone(folder);
  }
  std::printf("%d half-written files were left, and removed by the next run\n", seen);
}

TEST(KillResume, AskedToStopItSaysHowToGoOn) {
  for (const auto& [signal, name] : {std::pair{SIGTERM, "SIGTERM"},
                                     {SIGINT, "SIGINT"},
                                     {SIGUSR1, "SIGUSR1"},
                                     {SIGHUP, "SIGHUP"}}) {
    const WorkFolder folder;
    write_study(folder);
    const Ran ran = run_until(folder, 2, Pause(0), signal);
    EXPECT_EQ(ran.code, 75) << ran.err;
    EXPECT_NE(ran.err.find("--resume"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find(name), std::string::npos) << ran.err;
    expect_only_whole_files(folder);
    EXPECT_GE(finished_batches(folder), 2);
    const Ran resumed = program(folder, {"run", "square.yaml", "--resume"});
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    expect_result_alone(folder);
  }
}

TEST(KillResume, OutOfTimeItEndsWith75) {
  const WorkFolder folder;
  write_study(folder);
  const Ran ran = program(folder, {"run", "square.yaml", "--time-limit", "0.001"});  // 60 ms
  EXPECT_EQ(ran.code, 75) << ran.err;
  EXPECT_NE(ran.err.find("--resume"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("time limit"), std::string::npos) << ran.err;
  expect_only_whole_files(folder);
}

}  // namespace
}  // namespace sunload::test
