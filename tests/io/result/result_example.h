// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A small invented result, and programs that read it.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "io/batch/file.h"
#include "io/result/writer.h"
#include "tests/support/work_folder.h"

namespace sunload::test {

struct Output {
  int status = -1;
  std::string text;  ///< stdout and stderr
};

inline Output run_program(const std::string& command) {
  Output output;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> part{};
  while (const std::size_t got = std::fread(part.data(), 1, part.size(), pipe)) {
    output.text.append(part.data(), got);
  }
  const int status = ::pclose(pipe);
  output.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

/// The running test is skipped where `command` does not run.
#define SUNLOAD_NEEDS_PROGRAM(name, command)             \
  if (::sunload::test::run_program(command).status != 0) \
  GTEST_SKIP() << "NOT RUN: " << (name) << " is not installed"

struct Example {
  std::size_t patches = 5000, intervals = 84, facades = 3, materials = 2, realizations = 4;
  std::size_t chunk_intervals = 64;
  int compression = 4;

  std::size_t batches() const { return (intervals + chunk_intervals - 1) / chunk_intervals; }

  /// Zeros and smooth values, as light is.
  float irradiance(std::size_t t, std::size_t patch) const {
    return patch % 3 == 0 ? 0.0F : static_cast<float>(t) + static_cast<float>(patch) / 8192.0F;
  }
  double power(std::size_t t) const { return 1000.0 + static_cast<double>(t); }

  ResultGeometry geometry() const {
    ResultGeometry g;
    const auto id = [](std::size_t i) { return static_cast<std::int32_t>(i); };
    for (std::size_t i = 0; i < patches + 2; ++i)
      g.vertices.push_back({double(i), double(i % 2), 0});
    for (std::size_t i = 0; i < patches; ++i) {
      g.patch_vertices.push_back({id(i), id(i + 1), id(i + 2)});
      g.patch_area.push_back(1);
      g.patch_centroid.push_back({double(i) + 1, 1.0 / 3, 0});
      g.patch_normal.push_back({0, 0, 1});
      g.patch_object.push_back(0);
      g.patch_facade.push_back(facades > 0 ? id(i % facades) : -1);
      g.patch_material.push_back(materials > 0 ? id(i % materials) : -1);
      g.patch_surface.push_back(static_cast<std::uint8_t>(i % surface_names.size()));
      g.patch_side.push_back(0);
      g.patch_input_triangle.push_back(0);
    }
    g.input_triangle_vertices = {{0, 1, 2}};
    g.object_name = {"Škola č. 3"};
    for (std::size_t i = 0; i < facades; ++i) {
      g.facade_name.push_back("house/south_" + std::to_string(i + 1));
      g.facade_area.push_back(2);
      g.facade_azimuth_deg.push_back(180);
    }
    for (std::size_t i = 0; i < materials; ++i) g.material_name.push_back("m" + std::to_string(i));
    g.origin = {1e6, 2e6, 300};
    return g;
  }

  ResultTimes times() const {
    constexpr double start = 1774051200, step = 900;  // 2026-03-21T00:00Z, a quarter of an hour
    ResultTimes t;
    for (std::size_t i = 0; i < intervals; ++i) {
      const double begin = start + step * static_cast<double>(i);
      t.time.push_back(begin + step / 2);
      t.bounds.push_back({begin, begin + step});
      t.sun_azimuth_deg.push_back(100);
      t.sun_elevation_deg.push_back(30);
      t.sun_direction.push_back({0, 0, 1});
      t.dni.push_back(800);
      t.dhi.push_back(100);
      t.ghi.push_back(500);
    }
    return t;
  }

  ResultWriter::Options options() const {
    ResultWriter::Options options;
    options.chunk_intervals = chunk_intervals;
    options.compression = compression;
    options.realizations = realizations;
    return options;
  }

  std::vector<float> series(std::size_t first, std::size_t count, std::size_t columns) const {
    std::vector<float> values;
    for (std::size_t t = 0; t < count; ++t) {
      for (std::size_t i = 0; i < columns; ++i) values.push_back(irradiance(first + t, i));
    }
    return values;
  }

  void write_batch(const std::string& path, std::size_t batch,
                   const std::vector<std::string>& names = {"irradiance"}) const {
    BatchHeader header{"hash", "baseline",      "avx2",     batch, batch * chunk_intervals,
                       0,      chunk_intervals, compression};
    header.interval_count = std::min(chunk_intervals, intervals - header.first_interval);
    const std::size_t n = header.interval_count;
    BatchWriter writer(header);
    const auto values = series(header.first_interval, n, patches);
    for (const auto& name : names) {
      writer.add({name, MergeRule::append, ArrayType::float32, {n, patches}}, values.data());
    }
    const auto by_facade = series(header.first_interval, n, facades);
    writer.add({"facade_irradiance", MergeRule::append, ArrayType::float32, {n, facades}},
               by_facade.data());
    std::vector<double> powers;
    for (std::size_t t = 0; t < n; ++t) powers.push_back(power(header.first_interval + t));
    for (const char* name : {"power_sun", "power_absorbed"}) {
      writer.add({name, MergeRule::append, ArrayType::float64, {n}}, powers.data());
    }
    const std::vector<double> sums(realizations * patches, static_cast<double>(batch) + 1);
    writer.add({"sum_load", MergeRule::sum, ArrayType::float64, {realizations, patches}},
               sums.data());
    writer.write(path);
  }

  void write_totals(ResultWriter& writer) const {
    const std::vector<double> per_patch(patches, 1.5);
    for (const char* name : {"light_load", "light_load_direct", "light_load_se", "sun_hours",
                             "irradiance_max", "sky_view_factor", "power_load"}) {
      writer.write({name, per_patch});
    }
    writer.write({"light_load_realization", std::vector<double>(realizations * patches, 1.5)});
    writer.write({"facade_light_load", std::vector<double>(facades, 1.5)});
    writer.write({"power_sun_se", {0.25}});
  }

  /// The whole way: batches in `folder`, then the result.
  void write_result(const WorkFolder& folder, const std::string& path,
                    const std::vector<std::string>& names = {"irradiance"}) const {
    ResultWriter writer(path, geometry(), times(), options());
    for (std::size_t b = 0; b < batches(); ++b) {
      const std::string batch = folder / (std::to_string(b) + ".batch");
      write_batch(batch, b, names);
      writer.append(BatchReader(batch));
    }
    write_totals(writer);
    writer.finish(
        {{{"title", "Test"}, {"pairing_id", "p"}}, {{"runtime_lines_s", 1.5}}, {{"seed", 7}}},
        "name: Škola\n");
  }
};

}  // namespace sunload::test
