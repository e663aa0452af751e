// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/hash.h"

#include <gtest/gtest.h>

#include <fstream>

#include "geo/base/check.h"
#include "tests/io/result/result_example.h"

namespace sunload::test {
namespace {

// FIPS 180-2, appendix B.1 and B.3, and the empty message.
constexpr const char* of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* of_million_a =
    "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
constexpr const char* of_nothing =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

TEST(Hash, PublishedValues) {
  EXPECT_EQ(sha256("abc"), of_abc);
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')), of_million_a);
  EXPECT_EQ(sha256(""), of_nothing);
}

TEST(Hash, OfFilesShorterAndLongerThanOneRead) {
  const WorkFolder folder;
  std::ofstream(folder / "abc") << "abc";
  std::ofstream(folder / "empty") << "";
  const std::string large(3'000'000, 'b');
  std::ofstream(folder / "large") << large;
  EXPECT_EQ(sha256_of_file(folder / "abc"), of_abc);
  EXPECT_EQ(sha256_of_file(folder / "empty"), of_nothing);
  EXPECT_EQ(sha256_of_file(folder / "large"), sha256(large));
}

TEST(Hash, UnreadableFilesAreTheUsers) {
  const WorkFolder folder;
  EXPECT_THROW(sha256_of_file(folder / "absent"), InputError);
  EXPECT_THROW(sha256_of_file(folder / "."), InputError);
}

}  // namespace
}  // namespace sunload::test
