// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/reader.h"
#include "io/result/writer.h"

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "geo/base/check.h"
#include "io/result/h5.h"
#include "io/result/schema.h"
#include "tests/io/result/result_example.h"
#include "tests/support/paths.h"
#include "tests/support/small_result.h"

namespace sunload::test {
namespace {

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Files may not grow beyond so many bytes, as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(ResultFile, RoundTrip) {
  const WorkFolder folder;
  const Example example;
  const std::string path = folder / "a.h5";
  example.write_result(folder, path, {"irradiance", "irradiance_direct"});
  const ResultReader reader(path);
  EXPECT_EQ(reader.shape("irradiance"), (std::vector<std::size_t>{84, 5000}));
  const auto all = example.series(0, example.intervals, example.patches);
  EXPECT_EQ(reader.doubles("irradiance_direct"), std::vector<double>(all.begin(), all.end()));
  const auto row = reader.row("irradiance", 70);
  EXPECT_EQ(row[4999], static_cast<double>(example.irradiance(70, 4999)));
  EXPECT_EQ(reader.doubles("power_sun")[83], example.power(83));
  EXPECT_EQ(reader.doubles("power_sun_se"), std::vector<double>{0.25});
  EXPECT_EQ(reader.units("power_sun_se"), "kWh");
  EXPECT_EQ(reader.strings("object_name"), std::vector<std::string>{"Škola č. 3"});
  EXPECT_EQ(reader.integers("patch_facade")[4], 1);
  EXPECT_EQ(reader.integers("patch_surface")[5], 5);
  EXPECT_EQ(reader.text_attribute("title"), "Test");
  EXPECT_EQ(reader.number_attribute("seed"), 7);
  EXPECT_TRUE(std::isnan(reader.number_attribute("absent")));
  EXPECT_FALSE(reader.has("irradiance_sky"));
  EXPECT_EQ(folder.content().size(), 3u) << "two batches and the result";
}

TEST(ResultFile, NamesAreLabelsAndResultsWithoutThemAreRead) {
  const WorkFolder folder;
  Example example;
  example.patches = 10;
  example.intervals = 3;
  example.write_result(folder, folder / "a.h5");
  const ResultReader labelled(folder / "a.h5");
  EXPECT_EQ(labelled.strings("facade"), labelled.strings("facade_name"));
  EXPECT_EQ(labelled.strings("object"), labelled.strings("object_name"));
  // As versions before wrote it: a scale without values.
  const Output changed = run_program(
      "/usr/bin/python3 -c \"import h5py; f = h5py.File('" + folder / "a.h5" +
      std::string("', 'a'); ") +
      "n = len(f['facade']); del f['facade']; f.create_dataset('facade', (n,), 'f4'); "
      "f['facade'].make_scale('This is a netCDF dimension but not a netCDF variable.')\"");
  SUNLOAD_NEEDS_PROGRAM("h5py", "/usr/bin/python3 -c 'import h5py'");
  ASSERT_EQ(changed.status, 0) << changed.text;
  EXPECT_EQ(ResultReader(folder / "a.h5").strings("facade_name").size(), example.facades);
}

TEST(ResultFile, MissingRowsAreNaN) {
  const WorkFolder folder;
  const Example example;
  const std::string batch = folder / "1.batch", path = folder / "partial.h5";
  example.write_batch(batch, 1);
  {
    ResultWriter writer(path, example.geometry(), example.times(), example.options());
    writer.append(BatchReader(batch));
    writer.finish({}, "");
  }
  const ResultReader reader(path);
  EXPECT_TRUE(std::isnan(reader.row("irradiance", 0)[1]));
  EXPECT_TRUE(std::isnan(reader.doubles("power_sun")[63]));
  EXPECT_EQ(reader.row("irradiance", 64)[1], static_cast<double>(example.irradiance(64, 1)));
}

TEST(ResultFile, BatchesOfAnotherCompressionAndPlainFacadesFit) {
  const WorkFolder folder;
  Example plain;
  plain.compression = 0;
  const Example deflated;
  plain.write_batch(folder / "0", 0);
  deflated.write_batch(folder / "1", 1);
  const std::string path = folder / "a.h5";
  {
    ResultWriter writer(path, deflated.geometry(), deflated.times(), deflated.options());
    writer.append(BatchReader(folder / "0"));
    writer.append(BatchReader(folder / "1"));
    writer.finish({}, "");
  }
  const auto all = deflated.series(0, deflated.intervals, deflated.patches);
  EXPECT_EQ(ResultReader(path).doubles("irradiance"), std::vector<double>(all.begin(), all.end()));
}

TEST(ResultFile, WhatIsLeftOutIsNotThere) {
  const WorkFolder folder;
  const Example example;
  auto options = example.options();
  options.left_out = {"irradiance_direct"};
  example.write_batch(folder / "0", 0, {"irradiance", "irradiance_direct"});
  {
    ResultWriter writer(folder / "a.h5", example.geometry(), example.times(), options);
    writer.append(BatchReader(folder / "0"));
    writer.finish({}, "");
  }
  EXPECT_TRUE(ResultReader(folder / "a.h5").has("irradiance"));
  EXPECT_FALSE(ResultReader(folder / "a.h5").has("irradiance_direct"));
}

TEST(ResultFile, RoundedSeriesSayHow) {
  const WorkFolder folder;
  Example example;
  example.intervals = 10;
  const auto values = example.series(0, example.intervals, example.patches);
  BatchWriter batch({"hash", "baseline", "avx2", 0, 0, 10, 64, 4});
  const auto spec = [&](const char* name, int bits) {
    return ArraySpec{name, MergeRule::append, ArrayType::float32, {10, example.patches}, bits};
  };
  batch.add(spec("irradiance", 9), values.data());
  batch.add(spec("irradiance_sky", all_mantissa_bits), values.data());
  batch.write(folder / "0");
  const std::string path = folder / "a.h5";
  {
    ResultWriter writer(path, example.geometry(), example.times(), example.options());
    writer.append(BatchReader(folder / "0"));
    writer.finish({}, "");
  }
  const auto stored = ResultReader(path).doubles("irradiance");
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(stored[i], static_cast<double>(rounded(values[i], 9)));
  const std::string name = "_QuantizeBitRoundNumberOfSignificantBits";
  const h5::File file = h5::File::open(path);
  EXPECT_EQ(file.dataset("irradiance").numbers(name), std::vector<double>{9});
  EXPECT_EQ(file.dataset("irradiance_sky").numbers(name), std::nullopt);
}

TEST(ResultFile, SeriesOfDoublesBecomeChunks) {
  const WorkFolder folder;
  Example example;
  example.intervals = 10;
  BatchWriter batch({"hash", "baseline", "avx2", 0, 0, 10, 64, 4});
  const auto series = example.series(0, 10, example.facades);
  const std::vector<double> values(series.begin(), series.end());
  batch.add({"facade_irradiance", MergeRule::append, ArrayType::float64, {10, 3}}, values.data());
  const std::vector<double> errors(10, 0.5);
  batch.add({"power_sun_se", MergeRule::append, ArrayType::float64, {10}}, errors.data());
  batch.write(folder / "0");
  const std::string path = folder / "a.h5";
  {
    ResultWriter writer(path, example.geometry(), example.times(), example.options());
    writer.append(BatchReader(folder / "0"));
    writer.write({"power_sun_se", {2}});
    writer.finish({}, "");
  }
  const ResultReader reader(path);
  EXPECT_EQ(reader.doubles("facade_irradiance"), values);
  EXPECT_EQ(reader.doubles("power_sun_se"), errors);  // per instant, in W
  EXPECT_EQ(reader.units("power_sun_se"), "W");
}

TEST(ResultFile, BrokenPromisesAreOurBugs) {
  const WorkFolder folder;
  const Example example;
  example.write_batch(folder / "0", 0);
  ResultWriter writer(folder / "a.h5", example.geometry(), example.times(), example.options());
  EXPECT_THROW(writer.write({"no_such", {1}}), std::logic_error);
  EXPECT_THROW(writer.write({"light_load", {1}}), std::logic_error);
  EXPECT_THROW(writer.write({"irradiance", {1}}), std::logic_error);
  writer.append(BatchReader(folder / "0"));
  EXPECT_THROW(writer.append(BatchReader(folder / "0")), std::logic_error);
}

TEST(ResultFile, UnfinishedLeavesNothing) {
  const WorkFolder folder;
  const Example example;
  { ResultWriter writer(folder / "a.h5", example.geometry(), example.times(), example.options()); }
  EXPECT_EQ(folder.content().size(), 0u);
}

TEST(ResultFile, UnwritableFolderIsTheMachines) {
  const Example example;
  try {
    ResultWriter writer("/no/such/folder/a.h5", example.geometry(), example.times(),
                        example.options());
    FAIL() << "nothing was thrown";
  } catch (const MachineError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("/no/such/folder/a.h5"), std::string::npos) << text;
    EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;
  }
}

TEST(ResultFile, FullDiskAtAnyPointIsTheMachinesAndLeavesNothing) {
  const WorkFolder folder;
  const Example example;
  for (std::size_t b = 0; b < example.batches(); ++b) {
    example.write_batch(folder / std::to_string(b), b);
  }
  const auto write = [&] {
    ResultWriter writer(folder / "a.h5", example.geometry(), example.times(), example.options());
    for (std::size_t b = 0; b < example.batches(); ++b) {
      writer.append(BatchReader(folder / std::to_string(b)));
    }
    example.write_totals(writer);
    writer.finish({{{"title", std::string(100'000, 'x')}}, {}, {}}, std::string(100'000, 'y'));
  };
  write();
  const auto size = std::filesystem::file_size(folder / "a.h5");
  std::filesystem::remove(folder / "a.h5");
  constexpr std::size_t steps = 20;
  for (std::size_t i = 0; i < steps; ++i) {
    const SmallDisk disk(size * i / steps);
    try {
      write();
      FAIL() << "nothing was thrown at " << i << " of " << steps;
    } catch (const MachineError& error) {
      EXPECT_NE(std::string(error.what()).find("File too large"), std::string::npos)
          << error.what();
    }
    EXPECT_EQ(folder.content().size(), example.batches());
  }
  write();
  EXPECT_EQ(std::filesystem::file_size(folder / "a.h5"), size);
}

TEST(ResultReader, ForeignFilesAreTheUsers) {
  const WorkFolder folder;
  EXPECT_THROW(ResultReader(folder / "absent.h5"), InputError);
  write_bytes(folder / "text.h5", "not HDF5");
  write_bytes(folder / "empty.h5", "");
  EXPECT_THROW(ResultReader(folder / "text.h5"), InputError);
  EXPECT_THROW(ResultReader(folder / "empty.h5"), InputError);
  EXPECT_THROW(ResultReader(folder / "."), InputError);
  Example example;
  example.patches = 10;
  example.intervals = 3;
  example.write_result(folder, folder / "a.h5");
  const ResultReader reader(folder / "a.h5");
  EXPECT_THROW(reader.doubles("absent"), InputError);
  EXPECT_THROW(reader.row("irradiance", 3), InputError);
  EXPECT_THROW(reader.row("power_sun_se", 0), InputError);
  EXPECT_THROW(reader.strings("irradiance"), InputError);
  EXPECT_THROW(reader.doubles("object_name"), InputError);
}

// HDF5 gives back what it reserved: the end of a small file may lie before its series began.
TEST(ResultReader, TheSmallestResultsAreReadable) {
  const WorkFolder folder;
  for (std::size_t patches = 1; patches <= 12; ++patches) {
    Example example;
    example.patches = patches;
    example.intervals = 1 + patches % 3;
    const auto path = folder / ("small_" + std::to_string(patches) + ".h5");
    example.write_result(folder, path);
    EXPECT_NO_THROW(ResultReader{path}) << patches << " patches";
  }
  SmallResult house;
  house.cells = 1;
  house.houses.resize(1);
  house.realizations = 2;
  EXPECT_NO_THROW(ResultReader{write_small_result(house, "smallest")});
}

/// Reads all there is; InputError is a good end, and so is success (where only a value changed).
bool reads(const std::string& path) {
  try {
    const ResultReader reader(path);
    for (const auto& variable : result_schema()) {
      const std::string name(variable.name);
      if (!reader.has(name)) continue;
      if (variable.type == h5::Type::text) {
        reader.strings(name);
      } else {
        reader.doubles(name);
      }
      reader.units(name);
    }
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TEST(ResultReader, DamagedFilesDoNotCrash) {
  const WorkFolder folder;
  Example example;
  example.patches = 50;
  example.intervals = 10;
  example.write_result(folder, folder / "a.h5");
  const std::string whole = bytes_of(folder / "a.h5");
  ASSERT_TRUE(reads(folder / "a.h5"));
  std::mt19937 random(1);
  constexpr int cuts = 60, flips = 600;
  for (int i = 0; i < cuts; ++i) {
    write_bytes(folder / "cut.h5", whole.substr(0, random() % whole.size()));
    EXPECT_FALSE(reads(folder / "cut.h5"));
  }
  int noticed = 0;
  for (int i = 0; i < flips; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 4; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    write_bytes(folder / "bad.h5", damaged);
    noticed += reads(folder / "bad.h5") ? 0 : 1;
  }
  EXPECT_GT(noticed, flips * 9 / 10) << "only chunks that happen to be plain may change unnoticed";
}

/// Rows of the first table of the format's page.
std::vector<std::array<std::string, 4>> documented() {
  std::ifstream page(test::source_folder() + "/docs/result-file.md");
  std::vector<std::array<std::string, 4>> rows;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| ") || line.starts_with("| name")) continue;
    std::array<std::string, 4> row;
    std::istringstream cells(line.substr(1));
    for (auto& cell : row) {
      std::getline(cells, cell, '|');
      cell = cell.size() > 2 ? cell.substr(1, cell.size() - 2) : "";
    }
    rows.push_back(row);
  }
  return rows;
}

TEST(ResultFile, PageAndSchemaAndFileAgree) {
  constexpr std::array<const char*, 6> type_names{"int8",    "int32",   "int64",
                                                  "float32", "float64", "text"};
  const auto rows = documented();
  ASSERT_EQ(rows.size(), result_schema().size());
  const WorkFolder folder;
  Example example;
  example.patches = 10;
  example.intervals = 3;
  example.write_result(folder, folder / "a.h5");
  const ResultReader reader(folder / "a.h5");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ResultVariable& variable = result_schema()[i];
    EXPECT_EQ(rows[i][0], variable.name);
    EXPECT_EQ(rows[i][1], variable.dims) << variable.name;
    EXPECT_EQ(rows[i][2], type_names[static_cast<std::size_t>(variable.type)]) << variable.name;
    EXPECT_EQ(rows[i][3], variable.units) << variable.name;
    if (!reader.has(rows[i][0])) continue;
    EXPECT_EQ(reader.shape(rows[i][0]).size(), dimension_names(variable).size()) << variable.name;
    EXPECT_EQ(reader.units(rows[i][0]), rows[i][3]);
  }
}

TEST(ResultFile, NothingIsWrittenThatThePageDoesNotName) {
  std::set<std::string> names;
  for (const auto& row : documented()) names.insert(row[0]);
  for (const auto& variable : result_schema()) {
    for (const auto& dim : dimension_names(variable)) names.insert(dim);
  }
  const WorkFolder folder;
  Example example;
  example.patches = 10;
  example.intervals = 3;
  example.write_result(folder, folder / "a.h5");
  for (const auto& name : h5::File::open(folder / "a.h5").names()) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

}  // namespace
}  // namespace sunload::test
