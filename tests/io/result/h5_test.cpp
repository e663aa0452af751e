// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/h5.h"

#include <cmath>
#include <limits>

#include "io/batch/chunk.h"
#include "tests/io/result/result_example.h"

namespace sunload::test {
namespace {

TEST(H5, AttributesAndDatasetsRoundTrip) {
  const WorkFolder folder;
  const std::string path = folder / "a.h5";
  {
    h5::File file = h5::File::create(path);
    file.set("text", "ž");
    file.set("number", 1.0 / 3, h5::Type::float64);
    file.set("list", {1, 2, 3}, h5::Type::int8);
    file.set("integer", std::numeric_limits<std::int64_t>::max());
    h5::Dataset data = file.create_dataset(
        "data", {h5::Type::float32, {3, 2}, {}, 0, h5::DatasetSpec::Unwritten::nan});
    const std::vector<double> row{1, 2};
    data.write_rows(1, 1, row.data());
    file.create_dataset("words", {h5::Type::text, {2}, {}, 0})
        .write(std::vector<std::string>{"a", ""});
    file.close();
  }
  const h5::File file = h5::File::open(path);
  EXPECT_EQ(file.text("text"), "ž");
  EXPECT_EQ(file.text("absent"), std::nullopt);
  EXPECT_EQ(file.text("number"), std::nullopt);
  EXPECT_EQ(file.numbers("number"), std::vector<double>{1.0 / 3});
  EXPECT_EQ(file.numbers("list"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(file.numbers("text"), std::nullopt);
  EXPECT_EQ(file.names(), (std::vector<std::string>{"data", "words"}));
  const auto values = file.dataset("data").doubles();
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[3], 2);
  EXPECT_EQ(file.dataset("data").row(1), (std::vector<double>{1, 2}));
  EXPECT_EQ(file.dataset("words").strings(), (std::vector<std::string>{"a", ""}));
  EXPECT_THROW(file.dataset("data").strings(), h5::Error);
  EXPECT_THROW(file.dataset("absent"), h5::Error);
}

TEST(H5, ChunksOfBothCodingsAreReadBack) {
  const WorkFolder folder;
  const std::string path = folder / "a.h5";
  const ChunkShape shape{4, 1000};
  const std::vector<float> values(4 * 1000, 2.5F);
  {
    h5::File file = h5::File::create(path);
    h5::Dataset data = file.create_dataset("data", {h5::Type::float32, {8, 1000}, {4, 1000}, 4});
    data.write_chunk({0, 0}, encoded_chunks(values.data(), 4, 1000, shape, 4)[0],
                     h5::ChunkCoding::deflated);
    data.write_chunk({4, 0}, zlib_deflated(encoded_chunks(values.data(), 4, 1000, shape, 0)[0], 0),
                     h5::ChunkCoding::deflated_unshuffled);
    file.close();
  }
  EXPECT_EQ(h5::File::open(path).dataset("data").doubles(), std::vector<double>(8000, 2.5));
  // A flipped bit among the stored values is seen.
  std::string bytes = folder.read("a.h5");
  const float value = 2.5F;
  const auto at = bytes.rfind(std::string(reinterpret_cast<const char*>(&value), sizeof(value)));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 2] = static_cast<char>(bytes[at + 2] ^ 1);
  folder.write("a.h5", bytes);
  EXPECT_THROW(h5::File::open(path).dataset("data").doubles(), h5::Error);
}

TEST(H5, ErrorsCarryTheReasonAndNothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  try {
    h5::File::create("/no/such/folder/a.h5");
    FAIL() << "nothing was thrown";
  } catch (const h5::Error& error) {
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace sunload::test
