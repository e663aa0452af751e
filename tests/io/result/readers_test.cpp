// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The result as others see it: h5py, xarray, netCDF and the tools of HDF5.
#include <chrono>
#include <thread>

#include "tests/io/result/result_example.h"
#include "tests/support/paths.h"

namespace sunload::test {
namespace {

// Debian's own interpreter, for which its packages are installed.
constexpr const char* python = "/usr/bin/python3";

const std::string packages = std::string(python) + " -c 'import h5py, xarray, h5netcdf'";

void expect_python_reads(const std::string& path, const Example& example) {
  const Output output = run_program(
      std::string(python) + " " + test::source_folder() + "/tests/io/result/read_result.py " +
      path + " " + std::to_string(example.intervals) + " " + std::to_string(example.patches));
  EXPECT_EQ(output.status, 0) << output.text;
}

TEST(ResultReaders, PythonReadsSeveralBatchesAndChunks) {
  SUNLOAD_NEEDS_PROGRAM("python3 with h5py, xarray and h5netcdf", packages);
  const WorkFolder folder;
  const Example example;
  example.write_result(folder, folder / "a.h5");
  expect_python_reads(folder / "a.h5", example);
}

TEST(ResultReaders, PythonReadsOneShortBatch) {
  SUNLOAD_NEEDS_PROGRAM("python3 with h5py, xarray and h5netcdf", packages);
  const WorkFolder folder;
  Example example;
  example.patches = 7;
  example.intervals = 5;
  example.write_result(folder, folder / "a.h5");
  expect_python_reads(folder / "a.h5", example);
}

TEST(ResultReaders, PythonReadsWithoutFacadesAndMaterials) {
  SUNLOAD_NEEDS_PROGRAM("python3 with h5py, xarray and h5netcdf", packages);
  const WorkFolder folder;
  Example example;
  example.facades = example.materials = 0;
  example.write_result(folder, folder / "a.h5");
  expect_python_reads(folder / "a.h5", example);
}

TEST(ResultReaders, PythonReadsStoredSeries) {
  SUNLOAD_NEEDS_PROGRAM("python3 with h5py, xarray and h5netcdf", packages);
  const WorkFolder folder;
  Example example;
  example.compression = 0;
  example.write_result(folder, folder / "a.h5");
  expect_python_reads(folder / "a.h5", example);
}

TEST(ResultReaders, NetcdfListsDimensionsAndUnits) {
  SUNLOAD_NEEDS_PROGRAM("ncdump", "command -v ncdump");
  const WorkFolder folder;
  for (const std::size_t facades : {std::size_t{3}, std::size_t{0}}) {
    Example example;
    example.facades = facades;
    const std::string path = folder / (std::to_string(facades) + ".h5");
    example.write_result(folder, path);
    const Output output = run_program("ncdump -h " + path);
    EXPECT_EQ(output.status, 0) << output.text;
    for (const char* line :
         {"time = 84 ;", "patch = 5000 ;", "float irradiance(time, patch) ;",
          "time:units = \"seconds since 1970-01-01T00:00:00Z\"", "irradiance:_FillValue = NaNf ;",
          "int patch_vertices(patch, corner) ;", "string object_name(object) ;",
          "mesh:topology_dimension = 2 ;", "double vertex_position(vertex, xyz) ;"}) {
      EXPECT_NE(output.text.find(line), std::string::npos) << line << "\n" << output.text;
    }
    EXPECT_EQ(run_program("ncdump -v irradiance,patch_surface,light_load " + path).status, 0);
  }
}

TEST(ResultReaders, EqualWritesAreEqual) {
  const WorkFolder folder;
  const Example example;
  example.write_result(folder, folder / "a.h5");
  // HDF5's times of objects count seconds: a later second would show them.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  example.write_result(folder, folder / "b.h5");
  const std::string both = (folder / "a.h5") + " " + (folder / "b.h5");
  EXPECT_EQ(run_program("cmp " + both).status, 0);
}

TEST(ResultReaders, HdfToolSeesAnotherValueAndNoOther) {
  SUNLOAD_NEEDS_PROGRAM("h5diff", "command -v h5diff");
  const WorkFolder folder;
  Example example;
  example.write_result(folder, folder / "a.h5");
  example.write_result(folder, folder / "same.h5");
  EXPECT_EQ(run_program("h5diff " + (folder / "a.h5") + " " + (folder / "same.h5")).status, 0);
  example.patches += 1;
  example.write_result(folder, folder / "b.h5");
  EXPECT_NE(run_program("h5diff " + (folder / "a.h5") + " " + (folder / "b.h5")).status, 0);
}

}  // namespace
}  // namespace sunload::test
