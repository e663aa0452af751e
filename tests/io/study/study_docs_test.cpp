// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The page about the study file says what the schema says.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/paths.h"

TEST(StudyDocs, PageIsWrittenFromTheSchema) {
  const std::string command =
      "/usr/bin/python3 " + sunload::test::source_folder() + "/scripts/study-docs --check";
  EXPECT_EQ(std::system(command.c_str()), 0);
}
