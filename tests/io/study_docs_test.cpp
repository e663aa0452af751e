/// The page about the study file says what the schema says.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

TEST(StudyDocs, PageIsWrittenFromTheSchema) {
  const std::string command = "/usr/bin/python3 " SUNLOAD_SOURCE_DIR "/scripts/study-docs --check";
  EXPECT_EQ(std::system(command.c_str()), 0);
}
