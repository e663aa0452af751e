// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The second command in a row: what a result is of, and what it lacks, when a study is run again.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/result_check.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

using Strings = std::vector<std::string>;

const std::string front_selection = "selections:\n  front: {facade: 'house/south*'}\n";

/// With what `output` says besides.
std::string study_that_stores(const std::string& output) {
  std::string text = square_study();
  return text.insert(text.rfind('}'), ", " + output);
}

TEST(SecondRun, OfAStudyWithSelectionsKnowsItsResult) {
  const SquareFolder square(square_study() + front_selection);
  ASSERT_EQ(square.run("o").code, 0);
  const Ran again = square.run("o", {"--resume"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("finished already"), std::string::npos) << again.err;
  const Ran refused = square.run("o");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("of this very study"), std::string::npos) << refused.err;
  EXPECT_EQ(program(square.folder, {"merge", "square.yaml", "--output", "o"}).code, 0);
}

TEST(SecondRun, OfAStudyWithOtherSelectionsIsRefused) {
  const SquareFolder square(square_study() + front_selection);
  ASSERT_EQ(square.run("o").code, 0);
  square.write_study(square_study());
  const Ran refused = square.run("o", {"--resume"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("its measures or selections differ"), std::string::npos)
      << refused.err;
}

TEST(SecondRun, OfShardsWithSelectionsGoesOnAfterTheFirstVariantIsMerged) {
  const SquareFolder square(square_study("totals", ", year: each") + front_selection +
                            "variants:\n  - {name: a}\n  - {name: b, solver: {seed: 2}}\n");
  ASSERT_EQ(square.run("whole").code, 0);
  for (const char* shard : {"0/2", "1/2"}) {
    const Ran ran = square.run("shards", {"--shard", shard});
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  const Ran merged = program(square.folder, {"merge", "square.yaml", "--output", "shards"});
  EXPECT_EQ(merged.code, 0) << merged.err;
  for (const char* variant : {"a", "b"})
    EXPECT_EQ(different_data(square.result("whole", variant), square.result("shards", variant)),
              Strings{});
}

TEST(SecondRun, OfAStudyThatStoresMoreSeriesSaysThatTheResultLacksThem) {
  const SquareFolder square(study_that_stores("series: [total]"));
  ASSERT_EQ(square.run("o").code, 0);
  square.write_study(square_study());
  for (const Strings& more : {Strings{}, {"--resume"}}) {
    const Ran refused = square.run("o", more);
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("it lacks series that the study stores"), std::string::npos)
        << refused.err;
  }
  ASSERT_EQ(square.run("o", {"--overwrite"}).code, 0);
  // Fewer are there, too.
  square.write_study(study_that_stores("series: none"));
  EXPECT_EQ(square.run("o", {"--resume"}).code, 0);
}

TEST(SecondRun, AfterAStopIsTheCommandThatItNames) {
  const SquareFolder square;
  ASSERT_EQ(square.run("o").code, 0);
  const Ran stopped = square.run("o", {"--overwrite", "--time-limit", "0.001"});
  EXPECT_EQ(stopped.code, 75) << stopped.err;
  EXPECT_NE(stopped.err.find("--overwrite"), std::string::npos) << stopped.err;
  EXPECT_EQ(stopped.err.find("--resume"), std::string::npos) << stopped.err;
}

TEST(SecondRun, ComputesADamagedResultOnceItIsRemoved) {
  const SquareFolder square;
  ASSERT_EQ(square.run("whole").code, 0);
  ASSERT_EQ(square.run("o").code, 0);
  square.folder.write("o/square/baseline.h5", "");
  const Ran refused = square.run("o", {"--resume"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("remove it, and run its study with --resume"), std::string::npos)
      << refused.err;
  std::filesystem::remove(square.result("o"));
  EXPECT_EQ(square.run("o", {"--resume"}).code, 0);
  EXPECT_EQ(different_data(square.result("whole"), square.result("o")), Strings{});
}

}  // namespace
}  // namespace sunload::test
