// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What is said in every style of progress, and what in none.
#include "io/run/progress.h"

#include <gtest/gtest.h>

namespace sunload::test {
namespace {

/// What a variant's work writes to stderr.
std::string said(ProgressStyle style) {
  testing::internal::CaptureStderr();
  {
    Progress progress(style);
    progress.begin_variant("glazed", 4);
    progress.advance(Stage::lines, 0.5);
    progress.warn("glazed: warning: the sun is cold");
    progress.say("glazed: wrote it");
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, NoneSilencesAllButWarnings) {
  EXPECT_EQ(said(ProgressStyle::none), "glazed: warning: the sun is cold\n");
}

TEST(Progress, OtherStylesTellBoth) {
  for (const auto style : {ProgressStyle::lines, ProgressStyle::bar, ProgressStyle::json}) {
    const std::string text = said(style);
    EXPECT_NE(text.find("the sun is cold"), std::string::npos) << text;
    EXPECT_NE(text.find("wrote it"), std::string::npos) << text;
  }
  EXPECT_NE(said(ProgressStyle::json).find(R"({"message":"glazed: warning: the sun is cold"})"),
            std::string::npos);
}

}  // namespace
}  // namespace sunload::test
