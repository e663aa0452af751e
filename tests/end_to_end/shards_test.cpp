// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One process, shards, ranks of MPI: the same bits; and who finishes what.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <regex>
#include <sstream>
#include <thread>

#include "io/base/waiting_lock.h"
#include "io/result/reader.h"
#include "tests/support/child_process.h"
#include "tests/support/program.h"
#include "tests/support/result_change.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

using namespace std::chrono_literals;
constexpr const char* result = "results/street/baseline.h5";

/// The result of one process that nobody disturbed.
const std::string& without_shards() {
  static const WorkFolder folder;
  static const std::string path = [] {
    folder.write("street.yaml", street_study());
    const Ran ran = program(folder, {"run", "street.yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(sums_problem(folder / result), "");
    return folder / result;
  }();
  return path;
}

void expect_same_result(const WorkFolder& folder) {
  EXPECT_EQ(different_data(folder / result, without_shards()), std::vector<std::string>{});
}

std::vector<std::string> files(const WorkFolder& folder, const std::string& end) {
  std::vector<std::string> found;
  for (const auto& name : folder.content("results"))
    if (name.ends_with(end)) found.push_back(name);
  return found;
}

Ran shard(const WorkFolder& folder, int index, int count) {
  return program(folder, {"run", "street.yaml", "--resume", "--shard",
                          std::to_string(index) + "/" + std::to_string(count)});
}

TEST(Shards, OneAfterAnotherGiveTheSameBits) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  const Ran first = shard(folder, 0, 3);
  EXPECT_EQ(first.code, 0) << first.err;
  // Batch u belongs to shard u mod 3: 1, 2, 4 and 5 are the others'.
  EXPECT_NE(first.err.find("4 of 6 batches are still owed by other shards: 1 2 4 5"),
            std::string::npos)
      << first.err;
  EXPECT_EQ(files(folder, ".h5"), std::vector<std::string>{});
  EXPECT_EQ(files(folder, "/prepared").size(), 1u);

  const Ran early = program(folder, {"merge", "street.yaml"});
  EXPECT_EQ(early.code, 75) << early.err;
  EXPECT_NE(early.err.find("1 2 4 5"), std::string::npos) << early.err;

  const Ran last = shard(folder, 2, 3);
  EXPECT_EQ(last.code, 0) << last.err;
  // The lines are read, not traced again.
  EXPECT_EQ(last.err.find(" lines "), std::string::npos) << last.err;
  const Ran middle = shard(folder, 1, 3);
  EXPECT_EQ(middle.code, 0) << middle.err;
  EXPECT_NE(middle.err.find("wrote"), std::string::npos) << middle.err;
  expect_same_result(folder);
  EXPECT_EQ(folder.content("results"), (std::vector<std::string>{"street/", "street/baseline.h5"}));

  // All is there: nothing more to do, for shards and for merge.
  EXPECT_EQ(shard(folder, 0, 3).code, 0);
  EXPECT_EQ(program(folder, {"merge", "street.yaml"}).code, 0);
}

/// Bytes of files of the results folder.
double bytes_of_files(const WorkFolder& folder, const std::string& end) {
  double bytes = 0;
  for (const auto& name : files(folder, end))
    bytes += static_cast<double>(std::filesystem::file_size(folder / ("results/" + name)));
  return bytes;
}

/// What `check` says of the disk, by what lies there at the end of the merge.
double told_by_peak(const std::string& study) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("study.yaml", study);
  const std::string checked = program(folder, {"check", "study.yaml", "--json"}).out;
  std::smatch told;
  EXPECT_TRUE(std::regex_search(checked, told, std::regex("\"disk_bytes\": (\\d+)"))) << checked;
  const auto run = [&](const char* shard) {
    return program(folder, {"run", "study.yaml", "--keep-batches", "--shard", shard});
  };
  EXPECT_EQ(run("0/2").code, 0);
  const double prepared = bytes_of_files(folder, "/prepared");
  EXPECT_GT(prepared, 0);
  EXPECT_EQ(run("1/2").code, 0);
  const double others = bytes_of_files(folder, ".batch") + bytes_of_files(folder, ".h5");
  return std::stod(told[1]) / (prepared + others);
}

// The largest of files is the prepared one here, with mirrors' fates and places on gloss.
TEST(Shards, TheDiskHasRoomForThePreparedFileToo) {
  const std::string lamps = square_study();
  const auto without = [](std::string text, const std::string& part, const std::string& by) {
    return text.replace(text.find(part), part.size(), by);
  };
  const std::string mirror = without(lamps, ", emission_w_m2: 200", ""),
                    gloss = without(mirror, "mirror: 0.85", "glossy: 0.5, glossy_exponent: 30");
  const std::string diffuse = without(mirror, ", mirror: 0.85", "");
  const std::string many = without(mirror, "lines_per_patch: 64", "lines_per_patch: 1024");
  const std::string matrix =
      without(without(diffuse, "max_edge_m: 1.5", "max_edge_m: 4"), "batch_suns: 2",
              "batch_suns: 2, transport: matrix");  // takes no more than 2000 patches
  for (const std::string& study : {lamps, mirror, gloss, diffuse, many, matrix}) {
    const double ratio = told_by_peak(study);
    EXPECT_GT(ratio, 1) << study;
    EXPECT_LT(ratio, 1.25) << study;
  }
}

// What is merged before the end says so wherever it is read.
TEST(Shards, APartialResultSaysWhatIsMissing) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  EXPECT_EQ(shard(folder, 0, 3).code, 0);
  EXPECT_EQ(program(folder, {"merge", "street.yaml", "--partial"}).code, 0);
  const auto partial = files(folder, "partial.h5");
  ASSERT_EQ(partial.size(), 1u);
  const std::string file = "results/" + partial.front();
  for (const auto& more : {std::vector<std::string>{}, {"--paint"}, {"--map", "map.h5"}}) {
    std::vector<std::string> words{"explain", file, "--object", "house_1"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran explained = program(folder, words);
    EXPECT_EQ(explained.code, 2);
    EXPECT_NE(explained.err.find("is incomplete"), std::string::npos) << explained.err;
  }
  // The brightest hour may be one that lacks.
  const std::string info = program(folder, {"info", file}).out;
  const auto brightest = info.find("irradiance");
  ASSERT_NE(brightest, std::string::npos) << info;
  EXPECT_EQ(info.substr(brightest, info.find('\n', brightest) - brightest).find("nan"),
            std::string::npos)
      << info;
  for (const auto& words : {std::vector<std::string>{"info", file},
                            {"export", file, "--to", "csv"},
                            {"compare", file, file}}) {
    const Ran ran = program(folder, words);
    EXPECT_NE(ran.err.find("4 of 6 batches are missing"), std::string::npos)
        << words.front() << ": " << ran.err;
  }
}

// Who comes later reads what is solved, as it reads the lines: it casts no ray for it.
TEST(Shards, SkiesAndSunsOfALongPeriodAreSolvedOnce) {
  for (const char* year : {", year: modes", ", year: each", ", year: modes, bands: rgb"}) {
    const SquareFolder square(square_in_five_minutes(year));
    ASSERT_EQ(square.run("one").code, 0);
    for (const char* shard : {"0/3", "2/3", "1/3"}) {
      const Ran ran = square.run("shards", {"--shard", shard});
      ASSERT_EQ(ran.code, 0) << ran.err;
    }
    const ResultReader one(square.result("one")), shards(square.result("shards"));
    EXPECT_EQ(different_data(square.result("one"), square.result("shards")),
              std::vector<std::string>{});
    EXPECT_EQ(shards.number_attribute("direct_rays"), one.number_attribute("direct_rays"));
    EXPECT_EQ(shards.number_attribute("mirror_rays"), one.number_attribute("mirror_rays"));
    const bool is_of_few = std::string(year).find("modes") != std::string::npos;
    EXPECT_EQ(one.number_attribute("year_skies") > 0, is_of_few);
    EXPECT_EQ(shards.number_attribute("year_skies") > 0, is_of_few);
  }
}

TEST(Shards, ByHandForAnyNumberOfVariants) {
  // Variants of one batch: each shard finishes some, and finds those of the others.
  const auto study = [](const std::string& plaster) {
    auto text = std::regex_replace(square_study(), std::regex("batch_suns: 2"), "batch_suns: 12");
    text = std::regex_replace(text, std::regex("plaster: \\{diffuse: 0.6\\}"),
                              "plaster: {diffuse: " + plaster + "}");
    text += "variants:\n";
    for (const char* name : {"a", "b", "c", "d"}) text += std::string("  - {name: ") + name + "}\n";
    return text;
  };
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("square.yaml", study("0.6"));
  const auto run = [&](const std::string& shard) {
    return program(folder, {"run", "square.yaml", "--shard", shard});
  };
  for (const char* shard : {"0/3", "1/3", "2/3"}) {
    const Ran ran = run(shard);
    EXPECT_EQ(ran.code, 0) << shard << "\n" << ran.err;
  }
  EXPECT_EQ(files(folder, ".h5").size(), 4u);
  // Once more there is nothing to do; without --shard it is refused as ever.
  EXPECT_EQ(run("1/3").code, 0);
  EXPECT_EQ(program(folder, {"run", "square.yaml"}).code, 2);
  // Results of another study are no shard's.
  folder.write("square.yaml", study("0.5"));
  const Ran other = run("1/3");
  EXPECT_EQ(other.code, 2) << other.err;
  EXPECT_NE(other.err.find("is the result of another state of the study"), std::string::npos)
      << other.err;
  for (const auto& name : files(folder, ".h5"))
    ChangedResult(folder / ("results/" + name))
        .set({.dataset = "", .attribute = "numerics_version", .shape = {}}, 1);
  const Ran older = run("1/3");
  EXPECT_EQ(older.code, 2) << older.err;
  EXPECT_NE(older.err.find("is the result of another version of the program"), std::string::npos)
      << older.err;
}

TEST(Shards, AtTheSameTimeGiveTheSameBits) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  std::vector<std::unique_ptr<Process>> processes;
  for (int index = 0; index < 3; ++index)
    processes.push_back(
        std::make_unique<Process>(program_words({"run", "street.yaml", "--threads", "1", "--shard",
                                                 std::to_string(index) + "/3"}),
                                  folder.path()));
  int traced = 0;
  for (auto& process : processes) {
    const Ran ran = process->wait();
    EXPECT_EQ(ran.code, 0) << ran.err;
    traced += ran.err.find(" lines ") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(traced, 1) << "one traces, the others wait for its file";
  // Two that end in the same moment may each leave the merge to the other's lock.
  const Ran merged = program(folder, {"merge", "street.yaml"});
  EXPECT_EQ(merged.code, 0) << merged.err;
  expect_same_result(folder);
}

/// Lives with the lock of a prepared file until it is killed.
ChildProcess tracer_with(const std::string& lock_path) {
  return ChildProcess([&](const ChildProcess::Hold& hold) {
    const WaitingLock lock(lock_path, {});
    hold(lock.is_held());
  });
}

void until_it_waits(Process& process) {
  while (process.is_running() && process.err_so_far().find("waiting for it") == std::string::npos)
    std::this_thread::sleep_for(1ms);
}

TEST(Shards, WaitingForLinesEndsWithTimeSignalsAndTheTracer) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  EXPECT_EQ(shard(folder, 0, 3).code, 0);
  const std::string prepared = folder / ("results/" + files(folder, "/prepared").front());
  std::filesystem::remove(prepared);
  ChildProcess tracer = tracer_with(prepared + ".lock");
  ASSERT_TRUE(tracer.is_well());
  const Ran limited =
      program(folder, {"run", "street.yaml", "--shard", "1/3", "--time-limit", "0.01"});
  EXPECT_EQ(limited.code, 75) << limited.err;
  EXPECT_NE(limited.err.find("waiting"), std::string::npos) << limited.err;
  for (const int signal : {SIGUSR1, SIGTERM}) {
    Process process(program_words({"run", "street.yaml", "--shard", "1/3"}), folder.path());
    until_it_waits(process);
    const auto sent = std::chrono::steady_clock::now();
    process.send(signal);
    const Ran ran = process.wait();
    EXPECT_EQ(ran.code, 75) << ran.err;
    EXPECT_LT(std::chrono::steady_clock::now() - sent, 5s);
  }
  // The tracer dies without lines: one of those who wait traces them.
  Process one(program_words({"run", "street.yaml", "--shard", "1/3"}), folder.path());
  Process two(program_words({"run", "street.yaml", "--shard", "2/3"}), folder.path());
  for (Process* process : {&one, &two}) until_it_waits(*process);
  tracer.kill();
  for (Process* process : {&one, &two}) {
    const Ran ran = process->wait();
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  EXPECT_EQ(program(folder, {"merge", "street.yaml"}).code, 0);
  expect_same_result(folder);
  EXPECT_EQ(folder.content("results"), (std::vector<std::string>{"street/", "street/baseline.h5"}));
}

TEST(Shards, TheWholeRunTwiceAtTheSameTime) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  Process one(program_words({"run", "street.yaml"}), folder.path());
  Process two(program_words({"run", "street.yaml"}), folder.path());
  for (Process* process : {&one, &two}) {
    const Ran ran = process->wait();
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  EXPECT_EQ(program(folder, {"run", "street.yaml", "--resume"}).code, 0);
  expect_same_result(folder);
}

TEST(Shards, AShardThatIsKilledGoesOn) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  Process killed(program_words({"run", "street.yaml", "--shard", "0/3"}), folder.path());
  while (killed.is_running() && files(folder, ".batch").empty()) std::this_thread::sleep_for(1ms);
  killed.send(SIGKILL);
  killed.wait();
  for (const int index : {1, 2, 0}) EXPECT_EQ(shard(folder, index, 3).code, 0);
  expect_same_result(folder);
}

TEST(Shards, ADamagedPreparedFileIsMadeAgain) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  EXPECT_EQ(shard(folder, 0, 3).code, 0);
  const std::string prepared = folder / ("results/" + files(folder, "/prepared").front());
  std::filesystem::resize_file(prepared, std::filesystem::file_size(prepared) / 2);
  const Ran second = shard(folder, 1, 3);
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_NE(second.err.find(" lines "), std::string::npos) << second.err;
  std::filesystem::remove(prepared);
  EXPECT_EQ(shard(folder, 2, 3).code, 0);
  expect_same_result(folder);
}

/// mpirun, or empty where it is not installed.
constexpr const char* no_mpirun = "NOT RUN: no mpirun (package openmpi-bin)";
constexpr const char* no_mpi = "NOT RUN: this build has no MPI (package libopenmpi-dev)";

std::string mpirun() {
  for (const char* path : {"/usr/bin/mpirun", "/usr/local/bin/mpirun"})
    if (::access(path, X_OK) == 0) return path;
  return {};
}

std::vector<std::string> rank_words(int ranks, std::vector<std::string> arguments) {
  std::vector<std::string> words{mpirun(), "--oversubscribe", "-n", std::to_string(ranks)};
  if (::geteuid() == 0) words.insert(words.begin() + 1, "--allow-run-as-root");
#ifdef __SANITIZE_ADDRESS__
  // Libraries of MPI are gone before leaks are looked for, and none could be told to be theirs.
  words.insert(words.begin() + 1, {"-x", "LSAN_OPTIONS=detect_leaks=0"});
#endif
  const auto program = program_words(std::move(arguments));
  words.insert(words.end(), program.begin(), program.end());
  return words;
}

/// False where it waits for what never comes.
bool ends_within_a_minute(Process& process) {
  const auto begin = std::chrono::steady_clock::now();
  while (process.is_running() && std::chrono::steady_clock::now() - begin < 60s)
    std::this_thread::sleep_for(10ms);
  return !process.is_running();
}

TEST(Shards, RanksOfMpiGiveTheSameBits) {
  if (mpirun().empty()) GTEST_SKIP() << no_mpirun;
  for (const int ranks : {2, 3}) {
    const WorkFolder folder;
    folder.write("street.yaml", street_study());
    Process process(rank_words(ranks, {"run", "street.yaml", "--threads", "1"}), folder.path());
    const Ran ran = process.wait();
    if (ran.err.find("this build has no MPI") != std::string::npos) GTEST_SKIP() << no_mpi;
    EXPECT_EQ(ran.code, 0) << ran.err;
    expect_same_result(folder);
    EXPECT_EQ(folder.content("results"),
              (std::vector<std::string>{"street/", "street/baseline.h5"}));
  }
}

/// Warned of by its file, twice, by its scene and by its mesh.
std::string doubtful_study() {
  std::string text = street_study();
  for (const auto& [is, by] :
       {std::pair("{name: street}", "{name: street}, materials: {idle: {glossy_exponent: 20}}"),
        std::pair("max_edge_m: 4", "max_edge_m: 4, light_threshold_m2: 1"),
        std::pair("lines_per_patch: 64", "lines_per_patch: 16")})
    text.replace(text.find(is), std::string(is).size(), by);
  return text;
}

/// Lines that have the words, in an order of their own: those of ranks come in any.
std::vector<std::string> lines_with(const std::string& words, const std::string& text) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find(words) != std::string::npos) found.push_back(line);
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Shards, RanksSayOnceWhatIsOfTheStudy) {
  if (mpirun().empty()) GTEST_SKIP() << no_mpirun;
  const WorkFolder folder;
  folder.write("street.yaml", doubtful_study());
  const auto warnings =
      lines_with("warning:", program(folder, {"run", "street.yaml", "--output", "by_one"}).err);
  EXPECT_EQ(warnings.size(), 4u);
  Process process(rank_words(3, {"run", "street.yaml", "--output", "by_ranks"}), folder.path());
  const Ran ran = process.wait();
  if (ran.err.find("this build has no MPI") != std::string::npos) GTEST_SKIP() << no_mpi;
  EXPECT_EQ(lines_with("warning:", ran.err), warnings);
}

// They are commands of their own, perhaps on other machines, and may never meet.
TEST(Shards, EachSaysWhatIsOfTheStudy) {
  const WorkFolder folder;
  folder.write("street.yaml", doubtful_study());
  const auto warnings = lines_with("warning:", shard(folder, 0, 2).err);
  EXPECT_EQ(warnings.size(), 4u);
  EXPECT_EQ(lines_with("warning:", shard(folder, 1, 2).err), warnings);
}

TEST(Shards, RanksSayThemselvesWhatEachFinds) {
  if (mpirun().empty()) GTEST_SKIP() << no_mpirun;
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  EXPECT_EQ(shard(folder, 0, 2).code, 0);
  const auto damaged = files(folder, ".batch");
  EXPECT_EQ(damaged.size(), 3u);
  for (const auto& batch : damaged) {
    const std::string path = folder / ("results/" + batch);
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  }
  Process process(rank_words(3, {"run", "street.yaml", "--threads", "1"}), folder.path());
  const Ran ran = process.wait();
  if (ran.err.find("this build has no MPI") != std::string::npos) GTEST_SKIP() << no_mpi;
  const auto found = lines_with("it is computed again", ran.err);
  ASSERT_EQ(found.size(), damaged.size()) << ran.err;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NE(found[i].find(damaged[i]), std::string::npos) << found[i];
  expect_same_result(folder);
}

// Each process is a shard, and needs no MPI for it.
TEST(Shards, RanksMayHaveShardsOfTheirOwn) {
  if (mpirun().empty()) GTEST_SKIP() << no_mpirun;
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  Process process(rank_words(3, {"run", "street.yaml", "--threads", "1", "--shard", "auto"}),
                  folder.path());
  const Ran ran = process.wait();
  EXPECT_EQ(ran.code, 0) << ran.err;
  // Those who end in one moment leave the merge to each other.
  EXPECT_EQ(program(folder, {"merge", "street.yaml"}).code, 0);
  expect_same_result(folder);
}

TEST(Shards, OneShardForAllRanksIsRefused) {
  if (mpirun().empty()) GTEST_SKIP() << no_mpirun;
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  Process process(rank_words(2, {"run", "street.yaml", "--shard", "0/2"}), folder.path());
  const Ran ran = process.wait();
  EXPECT_EQ(ran.code, 2) << ran.err;
  EXPECT_NE(ran.err.find("--shard auto"), std::string::npos) << ran.err;
}

// They would wait for each other: one has nothing to do, the other all.
TEST(Shards, RanksThatSeeDifferentResultsEnd) {
  if (mpirun().empty()) GTEST_SKIP() << no_mpirun;
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("square.yaml", square_study());
  ASSERT_EQ(program(folder, {"run", "square.yaml", "--output", "there"}).code, 0);
  auto words = rank_words(1, {"run", "square.yaml", "--resume", "--output", "there"});
  words.insert(words.end(), {":", "-n", "1"});
  for (const auto& word : program_words({"run", "square.yaml", "--output", "not_there"}))
    words.push_back(word);
  Process process(words, folder.path());
  ASSERT_TRUE(ends_within_a_minute(process)) << process.err_so_far();
  const Ran ran = process.wait();
  if (ran.err.find("this build has no MPI") != std::string::npos) GTEST_SKIP() << no_mpi;
  EXPECT_EQ(ran.code, 3) << ran.err;
  EXPECT_NE(ran.err.find("ranks see different results"), std::string::npos) << ran.err;
}

// Each of four would compute everything.
TEST(Shards, ALauncherOfAnotherMpiIsRefused) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  auto words = program_words({"run", "street.yaml"});
  words.insert(words.begin(), {"/usr/bin/env", "PMI_SIZE=4", "PMI_RANK=1"});
  Process process(words, folder.path());
  const Ran ran = process.wait();
  EXPECT_EQ(ran.code, 2) << ran.err;
  EXPECT_NE(ran.err.find("started as one of"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("--shard auto"), std::string::npos) << ran.err;
}

TEST(Shards, RanksThatAreStoppedGoOn) {
  if (mpirun().empty()) GTEST_SKIP() << no_mpirun;
  const WorkFolder folder;
  // Four times the patches, so that mpirun has the time to pass the signal on.
  folder.write("street.yaml",
               std::regex_replace(street_study(), std::regex("max_edge_m: 4"), "max_edge_m: 2"));
  Process process(rank_words(2, {"run", "street.yaml", "--threads", "1"}), folder.path());
  while (process.is_running() && files(folder, ".batch").empty()) std::this_thread::sleep_for(1ms);
  process.send(SIGTERM);
  const Ran ran = process.wait();
  if (ran.err.find("this build has no MPI") != std::string::npos) GTEST_SKIP() << no_mpi;
  EXPECT_NE(ran.code, 0) << ran.err;
  // What was finished is kept: batches, or all of them merged where the ranks were faster.
  EXPECT_GE(files(folder, ".batch").size() + files(folder, ".h5").size(), 1u) << ran.err;
  EXPECT_EQ(program(folder, {"run", "street.yaml", "--resume"}).code, 0);
  EXPECT_EQ(program(folder, {"run", "street.yaml", "--output", "alone"}).code, 0);
  EXPECT_EQ(different_data(folder / result, folder / "alone/street/baseline.h5"),
            std::vector<std::string>{});
}

TEST(Shards, RanksComputeADamagedBatchAgain) {
  if (mpirun().empty()) GTEST_SKIP() << no_mpirun;
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  ASSERT_EQ(program(folder, {"run", "street.yaml", "--keep-batches"}).code, 0);
  std::filesystem::remove(folder / result);
  const std::string batch = folder / ("results/" + files(folder, "000002.batch").front());
  std::filesystem::resize_file(batch, std::filesystem::file_size(batch) / 2);
  // Only one of them finds out: they must not wait for each other.
  Process process(rank_words(2, {"run", "street.yaml", "--threads", "1"}), folder.path());
  ASSERT_TRUE(ends_within_a_minute(process)) << process.err_so_far();
  const Ran ran = process.wait();
  if (ran.err.find("this build has no MPI") != std::string::npos) GTEST_SKIP() << no_mpi;
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.err.find("000002.batch"), std::string::npos) << ran.err;
  expect_same_result(folder);
}

TEST(Shards, ADamagedBatchOfAnotherShardIsNamedAndComputedAgain) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  EXPECT_EQ(shard(folder, 0, 3).code, 0);
  EXPECT_EQ(shard(folder, 1, 3).code, 0);
  const std::string batch = "results/" + files(folder, "000004.batch").front();
  std::string bytes = folder.read(batch);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  folder.write(batch, bytes);
  const Ran last = shard(folder, 2, 3);
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_NE(last.err.find("000004.batch"), std::string::npos) << last.err;
  EXPECT_NE(last.err.find("batches 4 must be computed again"), std::string::npos) << last.err;
  EXPECT_EQ(files(folder, ".h5"), std::vector<std::string>{});
  EXPECT_EQ(shard(folder, 1, 3).code, 0);
  expect_same_result(folder);
}

/// A processor of another kind would compute other bits: what it finds is never lost silently.
TEST(Shards, WorkOfAnotherInstructionSetIsNamed) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  const auto with_isa = [&](const std::string& isa) {
    folder.write("square.yaml", square_study("totals", ", isa: " + isa));
  };
  const auto of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin() + 1, "square.yaml");
    return program(folder, arguments);
  };
  with_isa("sse4.2");
  ASSERT_EQ(of({"run", "--shard", "0/2"}).code, 0);
  with_isa("avx2");
  for (const auto& arguments :
       {std::vector<std::string>{"merge"}, {"merge", "--partial"}, {"run", "--shard", "1/2"}}) {
    const Ran ran = of(arguments);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find("holds batches of this study computed with sse4.2"), std::string::npos)
        << ran.err;
    EXPECT_NE(ran.err.find("write solver: {isa: sse4.2}"), std::string::npos) << ran.err;
  }
  const Ran whole = of({"run", "--resume"});
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_NE(whole.err.find("holds batches computed with sse4.2, and is not used"),
            std::string::npos)
      << whole.err;
  with_isa("sse4.2");
  for (const std::string command : {"run", "merge"}) {
    const Ran ran = of({command});
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find("computed with avx2, this processor would use sse4.2"),
              std::string::npos)
        << ran.err;
  }
  // Other work of a study that was edited between shards.
  folder.write("square.yaml", square_study("totals", ", seed: 7"));
  ASSERT_EQ(of({"run", "--shard", "0/2", "--output", "other"}).code, 0);
  folder.write("square.yaml", square_study("totals", ", seed: 8"));
  const Ran edited = of({"merge", "--output", "other"});
  EXPECT_EQ(edited.code, 75) << edited.err;
  EXPECT_NE(edited.err.find("was it edited meanwhile?"), std::string::npos) << edited.err;
}

TEST(Shards, SignalsEndWith75Within5Seconds) {
  for (const int signal : {SIGUSR1, SIGTERM}) {
    const WorkFolder folder;
    folder.write("street.yaml", street_study());
    Process process(program_words({"run", "street.yaml", "--shard", "1/3"}), folder.path());
    while (process.is_running() && files(folder, ".batch").empty())
      std::this_thread::sleep_for(1ms);
    const auto sent = std::chrono::steady_clock::now();
    process.send(signal);
    const Ran ran = process.wait();
    EXPECT_EQ(ran.code, 75) << ran.err;
    EXPECT_LT(std::chrono::steady_clock::now() - sent, 5s);
    for (const int index : {0, 1, 2}) EXPECT_EQ(shard(folder, index, 3).code, 0);
    expect_same_result(folder);
  }
}

TEST(Shards, TimeLimitsEndWith75) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  const Ran ran =
      program(folder, {"run", "street.yaml", "--shard", "0/3", "--time-limit", "0.002"});
  EXPECT_EQ(ran.code, 75) << ran.err;
  EXPECT_LT(ran.seconds, 5);
  for (const int index : {0, 1, 2}) EXPECT_EQ(shard(folder, index, 3).code, 0);
  expect_same_result(folder);
}

TEST(Shards, WrongOnesAreTheUsers) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  for (const char* text : {"3/3", "1", "auto"}) {
    const Ran ran = program(folder, {"run", "street.yaml", "--shard", text});
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find("--shard"), std::string::npos) << ran.err;
  }
  EXPECT_EQ(folder.content(), std::vector<std::string>{"street.yaml"});
}

}  // namespace
}  // namespace sunload::test
