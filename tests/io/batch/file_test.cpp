// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/batch/file.h"

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <random>

#include "geo/base/check.h"
#include "tests/io/result/result_example.h"

namespace sunload::test {
namespace {

TEST(BatchFile, RoundTrip) {
  const WorkFolder folder;
  const Example example;
  const std::string path = folder / "000001.batch";
  example.write_batch(path, 1, {"irradiance", "irradiance_sky"});
  const BatchReader reader(path);
  EXPECT_EQ(reader.header().content_hash, "hash");
  EXPECT_EQ(reader.header().batch, 1u);
  EXPECT_EQ(reader.header().first_interval, 64u);
  EXPECT_EQ(reader.header().interval_count, 20u);
  EXPECT_EQ(reader.floats("irradiance_sky"), example.series(64, 20, example.patches));
  EXPECT_EQ(reader.floats("facade_irradiance"), example.series(64, 20, example.facades));
  EXPECT_EQ(reader.chunk_count("irradiance"), 2u);
  EXPECT_EQ(reader.chunk_count("power_sun"), 0u);
  EXPECT_EQ(reader.doubles("power_sun").at(19), example.power(83));
  EXPECT_EQ(reader.spec("sum_load").rule, MergeRule::sum);
  EXPECT_EQ(reader.doubles("sum_load").size(), example.realizations * example.patches);
  EXPECT_TRUE(reader.has("power_absorbed"));
  EXPECT_FALSE(reader.has("absent"));
  EXPECT_THROW(reader.doubles("absent"), InputError);
  EXPECT_EQ(folder.content().size(), 1u);
}

TEST(BatchFile, EqualContentsAreEqualBytes) {
  const WorkFolder folder;
  const Example example;
  example.write_batch(folder / "a", 0);
  example.write_batch(folder / "b", 0);
  EXPECT_EQ(bytes_of(folder / "a"), bytes_of(folder / "b"));
}

TEST(BatchFile, CheckTellsWhatIsWrong) {
  const WorkFolder folder;
  Example example;
  example.patches = 100;
  const std::string path = folder / "0.batch";
  EXPECT_FALSE(check_batch(path, "hash", 0).exists);
  example.write_batch(path, 0);
  EXPECT_TRUE(check_batch(path, "hash", 0).valid);
  const BatchCheck other_hash = check_batch(path, "other", 0),
                   other_batch = check_batch(path, "hash", 1);
  EXPECT_TRUE(other_hash.exists);
  EXPECT_FALSE(other_hash.valid);
  EXPECT_NE(other_hash.reason.find("hash"), std::string::npos);
  EXPECT_FALSE(other_batch.valid);
  std::ofstream(path) << "something else, but long enough to hold a prologue";
  EXPECT_NE(check_batch(path, "hash", 0).reason.find("something else"), std::string::npos);
}

TEST(BatchFile, SeriesLeftOutAreTold) {
  const WorkFolder folder;
  const std::string path = folder / "0.batch";
  BatchHeader header{"hash", "v", "avx2", 0, 0, 1, 64, 4};
  header.left_out = {"irradiance_sky", "irradiance_direct"};
  BatchWriter(header).write(path);
  EXPECT_TRUE(check_batch(path, "hash", 0, {"irradiance_direct", "irradiance_sky"}).valid);
  const BatchCheck lacking = check_batch(path, "hash", 0, {"irradiance_direct"});
  EXPECT_FALSE(lacking.valid);
  EXPECT_NE(lacking.reason.find("irradiance_sky"), std::string::npos) << lacking.reason;
}

TEST(BatchFile, EveryCutAndEveryFlippedByteIsNoticed) {
  const WorkFolder folder;
  Example example;
  example.patches = 40;
  example.intervals = 5;
  example.realizations = 1;
  const std::string path = folder / "0.batch";
  example.write_batch(path, 0);
  const std::string whole = bytes_of(path);
  const auto valid = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return check_batch(path, "hash", 0).valid;
  };
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    EXPECT_FALSE(valid(whole.substr(0, length))) << length;
  }
  EXPECT_FALSE(valid(whole + '\0'));
  std::size_t unnoticed = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    if (valid(damaged)) ++unnoticed;
  }
  // Only the zeros between blocks (less than 64 each) and the spare word mean nothing.
  EXPECT_LT(unnoticed, 64u * 6 + 4);
  EXPECT_TRUE(valid(whole));
}

TEST(BatchFile, UnwritableIsTheMachinesAndLeavesNothing) {
  const WorkFolder folder;
  const Example example;
  EXPECT_THROW(example.write_batch("/no/such/folder/0.batch", 0), MachineError);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{10'000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  try {
    example.write_batch(folder / "0.batch", 0);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const MachineError& error) {
    EXPECT_EQ(std::string(error.what()),
              "cannot write " + (folder / "0.batch") + ": File too large");
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(folder.content().size(), 0u);
}

TEST(BatchFile, BrokenPromisesAreOurBugs) {
  BatchWriter writer({"hash", "v", "avx2", 0, 0, 2, 64, 4});
  const std::vector<double> values(2, 1.0);
  writer.add({"a", MergeRule::append, ArrayType::float64, {2}}, values.data());
  EXPECT_THROW(writer.add({"a", MergeRule::append, ArrayType::float64, {2}}, values.data()),
               std::logic_error);
  EXPECT_THROW(writer.add({"b", MergeRule::append, ArrayType::float64, {1}}, values.data()),
               std::logic_error);
  EXPECT_THROW(writer.add({"c", MergeRule::sum, ArrayType::float32, {2}}, values.data()),
               std::logic_error);
}

}  // namespace
}  // namespace sunload::test
