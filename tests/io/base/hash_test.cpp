// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

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

// What is added in pieces, across the borders of what waits to be hashed, is one text.
TEST(Sha256, IsTheSameInPieces) {
  std::string all;
  for (int i = 0; i < 30000; ++i) all += static_cast<char>(i * i % 251);
  for (const std::size_t piece : {1u, 7u, 4095u, 4096u, 4097u, 29999u}) {
    Sha256 hash;
    for (std::size_t at = 0; at < all.size(); at += piece)
      hash.add(all.data() + at, std::min(piece, all.size() - at));
    EXPECT_EQ(hash.hexadecimal(), sha256(all)) << piece;
  }
}

TEST(Digest, TellsListsAndTextsApart) {
  const auto of = [](const auto&... values) {
    Digest digest;
    (digest.add(values), ...);
    return digest.hex();
  };
  const std::string ab = "ab", a = "a", b = "b", c = "c", bc = "bc";
  EXPECT_NE(of(ab, c), of(a, bc));
  EXPECT_NE(of(std::vector{1.0, 2.0}, std::vector{3.0}),
            of(std::vector{1.0}, std::vector{2.0, 3.0}));
  EXPECT_EQ(of(std::vector{1.0, 2.0}), of(std::size_t{2}, 1.0, 2.0));
}

}  // namespace
}  // namespace sunload::test
