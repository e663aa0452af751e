// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What is written replaces files, and nothing else.
#include "io/base/output_target.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "geo/base/check.h"
#include "io/base/file_aside.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

namespace fs = std::filesystem;
using test::WorkFolder;
using Names = std::vector<std::string>;

TEST(OutputTarget, LinksStayAndTheFileAtTheirEndIsReplaced) {
  const WorkFolder folder;
  folder.write("kept.csv", "before");
  fs::create_directory(folder / "far");
  folder.write("far/away.csv", "before");
  fs::create_symlink("far/away.csv", folder / "second");
  fs::create_symlink(folder / "second", folder / "first");
  fs::create_symlink("far/new.csv", folder / "to_nothing");
  write_file(folder / "first", "now");
  write_file(folder / "to_nothing", "now");
  EXPECT_TRUE(fs::is_symlink(folder / "first") && fs::is_symlink(folder / "second"));
  EXPECT_TRUE(fs::is_symlink(folder / "to_nothing"));
  EXPECT_EQ(folder.read("far/away.csv"), "now");
  EXPECT_EQ(folder.read("far/new.csv"), "now");
  EXPECT_EQ(folder.read("kept.csv"), "before");
  EXPECT_EQ(folder.content("far"), (Names{"away.csv", "new.csv"}));
}

TEST(OutputTarget, APipeIsWrittenInto) {
  const WorkFolder folder;
  const std::string pipe = folder / "pipe", text(300'000, 'x');  // more than a pipe holds
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] {
    std::ifstream stream(pipe, std::ios::binary);
    got.assign(std::istreambuf_iterator<char>(stream), {});
  });
  write_file(pipe, text);
  reader.join();
  EXPECT_EQ(got, text);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(folder.content(), Names{"pipe"});
}

TEST(OutputTarget, ADeviceStaysWhatItIs) {
  // A link of our own, so that a fault does not hit the device itself.
  const WorkFolder folder;
  fs::create_symlink("/dev/full", folder / "full");
  EXPECT_EQ(output_target(folder / "full").kind, OutputTarget::Kind::special);
  EXPECT_THROW(write_file(folder / "full", "text"), MachineError);
  EXPECT_TRUE(fs::is_symlink(folder / "full") && fs::is_character_file("/dev/full"));
  EXPECT_NO_THROW(write_file("/dev/null", "text"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputTarget, AnOpenDescriptorIsWrittenOnWhereItStands) {
  const WorkFolder folder;
  folder.write("log", "before\n");
  const int file = ::open((folder / "log").c_str(), O_WRONLY | O_APPEND);
  ASSERT_GE(file, 0);
  const std::string number = std::to_string(file);
  fs::create_symlink("/proc/self/fd/" + number, folder / "link");
  for (const std::string& name : {"/dev/fd/" + number, "/proc/self/fd/" + number, folder / "link"})
    write_file(name, name + "\n");
  ::close(file);
  EXPECT_EQ(folder.read("log"), "before\n/dev/fd/" + number + "\n/proc/self/fd/" + number + "\n" +
                                    (folder / "link") + "\n");
}

TEST(OutputTarget, FoldersAndCirclesAreRefused) {
  const WorkFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_THROW(output_target(folder / "a"), MachineError);
  EXPECT_THROW(output_target(folder.path()), MachineError);
}

TEST(OutputTarget, WhatIsReadIsNotWrittenByAnyName) {
  const WorkFolder folder;
  const std::string read = folder.write("read.h5", ""), other = folder.write("other.h5", "");
  fs::create_symlink("read.h5", folder / "link.h5");
  fs::create_hard_link(read, folder / "same.h5");
  for (const std::string& name :
       {read, folder / "link.h5", folder / "same.h5", folder / "./read.h5"})
    EXPECT_NE(test::refusal_of([&] { expect_not_read(name, {"", other, read}); }), "") << name;
  for (const std::string& name : {folder / "new.h5", std::string(), std::string("/dev/null")})
    EXPECT_NO_THROW(expect_not_read(name, {"", other, read})) << name;
}

}  // namespace
}  // namespace sunload
