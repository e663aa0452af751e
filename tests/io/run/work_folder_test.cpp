// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a variant's files lie, what state they are in, and what may be removed.
#include "io/run/work_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "geo/base/check.h"
#include "tests/support/program.h"

namespace sunload::test {
namespace {

const std::string hash(64, 'a'), other_hash(64, 'b');
constexpr std::size_t batches = 3;

/// `results` below the test's own folder, with a variant of three batches.
struct Results {
  WorkFolder folder;
  sunload::WorkFolder work = of("glazed", hash);

  sunload::WorkFolder of(const std::string& variant, const std::string& content_hash) const {
    Study study;
    study.name = "street";
    study.variant = variant;
    return {folder / "results", study, content_hash, batches};
  }
  void write_batch(std::size_t number, const std::string& content_hash = hash) const {
    BatchWriter writer({.content_hash = content_hash,
                        .variant = "glazed",
                        .isa = "avx2",
                        .batch = number,
                        .first_interval = number,
                        .interval_count = 1});
    const double value = 1;
    writer.add({"power", MergeRule::append, ArrayType::float64, {1}}, &value);
    work.make();
    writer.write(work.batch(number));
  }
  std::vector<std::string> content() const { return folder.content("results"); }
};

TEST(WorkFolder, PathsAreThoseOfTheContract) {
  const Results results;
  const std::string place = results.folder / "results/street";
  EXPECT_EQ(results.work.result(), place + "/glazed.h5");
  EXPECT_EQ(results.work.path(), place + "/.work/glazed-" + hash);
  EXPECT_EQ(results.work.batch(0), results.work.path() + "/000000.batch");
  EXPECT_EQ(results.work.batch(1234567), results.work.path() + "/1234567.batch");
  EXPECT_EQ(results.work.prepared(), results.work.path() + "/prepared");
  EXPECT_EQ(results.work.prepared_lock(), results.work.path() + "/prepared.lock");
  EXPECT_EQ(results.work.partial(), results.work.path() + "/partial.h5");
  EXPECT_EQ(results.work.merge_lock(), place + "/.work/glazed.lock");
  const auto other = results.work.with_hash(other_hash);
  EXPECT_EQ(other.path(), place + "/.work/glazed-" + other_hash);
  EXPECT_EQ(other.result(), results.work.result());
  EXPECT_EQ(other.merge_lock(), results.work.merge_lock());
}

TEST(WorkFolder, LookingMakesNothing) {
  const Results results;
  EXPECT_FALSE(results.work.is_there());
  EXPECT_FALSE(results.work.state());
  EXPECT_EQ(results.work.batches_not_there(), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(results.work.missing_batches().numbers, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(results.work.bytes_there(), 0);
  results.work.remove_finished_work();
  remove_left_over(results.folder / "results", "street");
  EXPECT_EQ(results.folder.content(), std::vector<std::string>{});
}

TEST(WorkFolder, DamagedBatchesAreThereButMissing) {
  const Results results;
  results.write_batch(0);
  results.write_batch(1, other_hash);
  EXPECT_EQ(results.work.batches_not_there(), std::vector<std::size_t>{2});
  const MissingBatches missing = results.work.missing_batches();
  EXPECT_EQ(missing.numbers, (std::vector<std::size_t>{1, 2}));
  ASSERT_EQ(missing.reasons.size(), 1u);
  EXPECT_NE(missing.reasons[0].find("000001.batch"), std::string::npos) << missing.reasons[0];
  EXPECT_TRUE(results.work.check(0).valid);
  EXPECT_EQ(results.work.bytes_there(),
            static_cast<double>(std::filesystem::file_size(results.work.batch(0)) +
                                std::filesystem::file_size(results.work.batch(1))));
}

TEST(WorkFolder, AResultThatCannotBeReadIsNamed) {
  const Results results;
  results.folder.write("results/street/glazed.h5", "no HDF5");
  try {
    results.work.state();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("glazed.h5"), std::string::npos) << error.what();
  }
}

TEST(WorkFolder, RemovesItsOwnFilesAlone) {
  const Results results;
  results.write_batch(0);
  results.folder.write("results/street/.work/glazed-" + hash + "/notes.txt", "of the user");
  const auto another = results.of("dull", hash);
  another.make();
  results.work.remove_work();
  results.work.remove_empty_folders();
  EXPECT_TRUE(std::filesystem::exists(results.work.path() + "/notes.txt"));
  EXPECT_FALSE(std::filesystem::exists(results.work.batch(0)));
  EXPECT_TRUE(another.is_there());
  std::filesystem::remove(results.work.path() + "/notes.txt");
  results.work.remove_work();
  another.remove_empty_folders();
  EXPECT_EQ(results.content(), std::vector<std::string>{});
}

TEST(WorkFolder, FinishedWorkStaysWhereItIsWanted) {
  const Results results;
  results.write_batch(0);
  results.work.keep_work();
  results.work.remove_finished_work();
  EXPECT_EQ(results.work.batches_not_there().size(), 2u);
  std::filesystem::remove(results.work.path() + "/kept");
  results.work.remove_finished_work();
  EXPECT_EQ(results.content(), std::vector<std::string>{});
}

TEST(WorkFolder, LeftOversAreRemovedAndWorkIsNot) {
  const Results results;
  results.write_batch(0);
  results.folder.write("results/street/.work/glazed-" + hash + "/prepared.lock", "");
  results.of("glazed", other_hash).make();  // empty: its process was killed
  remove_left_over(results.folder / "results", "street");
  const std::string work = "street/.work/glazed-" + hash + "/";
  EXPECT_EQ(results.content(),
            (std::vector<std::string>{"street/", "street/.work/", work, work + "000000.batch"}));
}

}  // namespace
}  // namespace sunload::test
