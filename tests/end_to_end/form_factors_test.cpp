// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// sunload export --to form-factors: of a result and of its study the same, and refusals.
#include <gtest/gtest.h>

#include "tests/support/program.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

constexpr const char* to = "form-factors";

TEST(FormFactorsExport, OfAResultAreThoseOfItsStudy) {
  const SquareFolder square(square_study("totals", "", "5") +
                            "variants:\n  - {name: base}\n  - {name: other}\n");
  ASSERT_EQ(square.run("results").code, 0);
  const std::string result = square.result("results", "other");
  for (const std::string of : {"patch", "object", "facade", "surface"}) {
    const Ran of_result =
        program(square.folder, {"export", result, "--to", to, "--of", of, "-o", "r.csv"});
    ASSERT_EQ(of_result.code, 0) << of_result.err;
    const Ran of_study = program(
        square.folder, {"export", "square.yaml", "--variant", "other", "--to", to, "--of", of});
    ASSERT_EQ(of_study.code, 0) << of_study.err;
    EXPECT_EQ(square.folder.read("r.csv"), of_study.out) << of;
    EXPECT_NE(of_study.out.find("elsewhere"), std::string::npos);
    EXPECT_EQ(of_study.err.find("of no facade") != std::string::npos, of == "facade");
  }
  const Ran hdf5 = program(square.folder, {"export", result, "--to", to, "-o", "f.h5"});
  EXPECT_EQ(hdf5.code, 0) << hdf5.err;
  EXPECT_FALSE(square.folder.read("f.h5").empty());
}

TEST(FormFactorsExport, RefusesWhatItWouldNotHeed) {
  const SquareFolder square(square_study("totals", "", "5"));
  const auto refused = [&](std::vector<std::string> words, const std::string& says) {
    words.insert(words.begin(), {"export", "square.yaml", "--to"});
    const Ran ran = program(square.folder, words);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
  };
  refused({to, "--month", "3"}, "--to form-factors takes");
  refused({to, "--quantity", "light_load"}, "--to form-factors takes");
  refused({to, "--of", "sensor"}, "patch, facade, object or surface");
  refused({to, "-o", "f.vtk"}, ".h5 or .csv");
  refused({to, "--variant", "none"}, "none");
  refused({to, "-o", "square.yaml"}, "square.yaml");
  refused({"csv", "--variant", "baseline"}, "are of form factors");
}

}  // namespace
}  // namespace sunload::test
