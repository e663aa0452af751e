// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How fast series become chunks, batch files and a result; processor time, as others may use the
// machine:
//   series_bench RESULT.h5 [FOLDER] [BATCHES]
// Rows of the result's irradiance with light, repeated to 60 000 patches and batches of 64 suns;
// of chunks also rows as they come, with those of the nights.
// FOLDER: where files go (default: none are written). A second on N processors is N seconds of
// processor time.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string>

#include "io/batch/chunk.h"
#include "io/batch/file.h"
#include "io/result/reader.h"
#include "io/result/writer.h"
#include "solver/base/threads.h"

using namespace sunload;

namespace {

constexpr std::size_t patches = 60'000, suns = 64;
constexpr double mega = 1e6;

struct Spent {
  double wall_s = 0, processor_s = 0;
};

template <class Action>
Spent spent(const Action& action) {
  const auto wall = std::chrono::steady_clock::now();
  const auto processor = std::clock();
  action();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(),
          static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC};
}

/// Best of some repetitions by processor time.
template <class Action>
Spent best(const Action& action) {
  constexpr int repetitions = 5;
  Spent least{1e300, 1e300};
  for (int k = 0; k < repetitions; ++k)
    if (const auto one = spent(action); one.processor_s < least.processor_s) least = one;
  return least;
}

void tell(const std::string& what, std::size_t bytes, Spent time, const std::string& more = {}) {
  fmt::print("{:<34} {:8.0f} MB/s of processor time, {:8.0f} MB/s of wall time {}\n", what,
             static_cast<double>(bytes) / mega / time.processor_s,
             static_cast<double>(bytes) / mega / time.wall_s, more);
}

enum class Rows { lit, all };

/// Rows of a quarter of the period on (of a year, of days as long as their nights).
std::vector<float> rows_of(const ResultReader& result, Rows rows) {
  const auto shape = result.shape("irradiance");
  const std::size_t count = std::min(suns, shape[0]);
  const auto all = result.rows("irradiance", std::min(shape[0] / 4, shape[0] - count), count);
  std::vector<std::vector<double>> chosen;
  for (auto row = all.begin(); row != all.end(); row += static_cast<std::ptrdiff_t>(shape[1]))
    if (const auto end = row + static_cast<std::ptrdiff_t>(shape[1]);
        rows == Rows::all || std::any_of(row, end, [](double v) { return v > 0; }))
      chosen.emplace_back(row, end);
  std::vector<float> values(suns * patches);
  for (std::size_t k = 0; k < suns; ++k)
    for (std::size_t p = 0; p < patches; ++p)
      values[k * patches + p] = static_cast<float>(chosen[k % chosen.size()][p % shape[1]]);
  return values;
}

void tell_chunks(const std::vector<float>& values, const std::string& of) {
  const std::size_t bytes = values.size() * sizeof(float);
  for (const int level : {0, 1, 4, 6}) {
    std::size_t size = 0;
    const auto time = best([&] {
      size = 0;
      for (const auto& chunk :
           encoded_chunks(values.data(), suns, patches, {suns, patches_per_chunk}, level))
        size += chunk.size();
    });
    tell(fmt::format("{}, chunks at level {}", of, level), bytes, time,
         fmt::format("({:.2f}:1)", static_cast<double>(bytes) / static_cast<double>(size)));
  }
}

ArraySpec series(std::size_t rows) {
  return {"irradiance", MergeRule::append, ArrayType::float32, {rows, patches}};
}

/// Batches written, merged, and removed, as `run` does it.
void write_year(const std::vector<float>& values, const std::string& folder, std::size_t batches) {
  namespace fs = std::filesystem;
  fs::create_directories(folder);
  const auto path = [&](std::size_t b) { return folder + "/" + std::to_string(b) + ".batch"; };
  const std::size_t bytes = batches * values.size() * sizeof(float);
  const auto writing = spent([&] {
    for (std::size_t b = 0; b < batches; ++b) {
      BatchWriter writer({"hash", "baseline", "avx2", b, b * suns, suns, suns, 4});
      writer.add(series(suns), values.data());
      writer.write(path(b));
    }
  });
  tell(fmt::format("{} batch files", batches), bytes, writing);
  ResultGeometry geometry;
  geometry.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (std::size_t p = 0; p < patches; ++p) {
    geometry.patch_vertices.push_back({0, 1, 2});
    geometry.patch_area.push_back(0.5);
    geometry.patch_centroid.push_back({0.3, 0.3, 0});
    geometry.patch_normal.push_back({0, 0, 1});
  }
  for (auto* list : {&geometry.patch_object, &geometry.patch_facade, &geometry.patch_material,
                     &geometry.patch_input_triangle})
    list->assign(patches, 0);
  geometry.patch_surface.assign(patches, 0);
  geometry.patch_side.assign(patches, 0);
  geometry.input_triangle_vertices = {{0, 1, 2}};
  geometry.object_name = geometry.material_name = {"plate"};
  ResultTimes times;
  for (std::size_t k = 0; k < batches * suns; ++k) {
    const double begin = 3600.0 * static_cast<double>(k);
    times.time.push_back(begin + 1800);
    times.bounds.push_back({begin, begin + 3600});
    times.sun_direction.push_back({0, 0, 1});
    for (auto* list :
         {&times.sun_azimuth_deg, &times.sun_elevation_deg, &times.dni, &times.dhi, &times.ghi})
      list->push_back(1);
  }
  const auto target = folder + "/year.h5";
  fs::remove(target);
  const auto merging = spent([&] {
    ResultWriter writer(target, geometry, times, {});
    for (std::size_t b = 0; b < batches; ++b) writer.append(BatchReader(path(b)));
    writer.finish({}, "");
  });
  tell("merged", bytes, merging,
       fmt::format("({:.0f} MB)", static_cast<double>(fs::file_size(target)) / mega));
  tell("both", bytes, {writing.wall_s + merging.wall_s, writing.processor_s + merging.processor_s});
  for (std::size_t b = 0; b < batches; ++b) fs::remove(path(b));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "series_bench RESULT.h5 [FOLDER] [BATCHES]\n");
    return 2;
  }
  const ResultReader result(argv[1]);
  const auto values = rows_of(result, Rows::lit);
  const std::size_t bytes = values.size() * sizeof(float);
  std::vector<float> copy(values.size());
  tell("memcpy", bytes, best([&] { std::memcpy(copy.data(), values.data(), bytes); }),
       fmt::format("({} threads)", thread_count()));
  tell_chunks(values, "lit");
  tell_chunks(rows_of(result, Rows::all), "days and nights");
  constexpr std::size_t usual_batches = 16;
  if (argc > 2) write_year(values, argv[2], argc > 3 ? std::stoul(argv[3]) : usual_batches);
  return 0;
}
