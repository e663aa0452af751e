// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensors as users meet them: studies, result files, shards, hours of sun of the references.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/reference.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

const std::string three_sensors =
    "sensors:\n"
    "  points:\n"
    "    - {position_m: [0, -5, 1.5], normal: [0, -1, 0]}\n"
    "    - {position_m: [-12, -12, 0], normal: [0, 0, 1]}\n"
    "    - {position_m: [0, 6, 3], normal: [0, 0, 2]}\n";

struct SensedSquare : SquareFolder {
  explicit SensedSquare(const std::string& more = three_sensors,
                        const std::string& errors = "totals")
      : SquareFolder(square_study(errors) + more) {}
  void write(const std::string& more, const std::string& errors = "totals") const {
    write_study(square_study(errors) + more);
  }
};

double sum(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

TEST(SensorStudy, ResultHasWhatPatchesHave) {
  const SensedSquare square(three_sensors, "instants");
  const Ran ran = square.run("a");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const ResultReader result(square.result("a"));
  EXPECT_EQ(result.shape("sensor_position"), (std::vector<std::size_t>{3, 3}));
  EXPECT_EQ(result.doubles("sensor_position")[1], -5);
  EXPECT_EQ(result.doubles("sensor_normal")[8], 1);  // of unit length
  EXPECT_EQ(result.shape("sensor_irradiance"), (std::vector<std::size_t>{12, 3}));
  EXPECT_EQ(result.shape("sensor_light_load_realization"), (std::vector<std::size_t>{16, 3}));
  for (const char* part : {"_direct", "_sky", "_mirror", "_lamps", "_reflected", "_se"})
    EXPECT_EQ(result.shape(std::string("sensor_irradiance") + part),
              (std::vector<std::size_t>{12, 3}))
        << part;
  // light_load = Σ irradiance · hour = Σ of its parts.
  const auto load = result.doubles("sensor_light_load");
  for (std::size_t s = 0; s < 2; ++s) {
    double energy = 0, parts = 0;
    for (std::size_t k = 0; k < 12; ++k) energy += result.row("sensor_irradiance", k)[s] / 1000;
    for (const char* part : {"_direct", "_sky", "_mirror", "_lamps", "_reflected"})
      parts += result.doubles(std::string("sensor_light_load") + part)[s];
    EXPECT_NEAR(load[s], energy, 1e-5 * load[s]);
    EXPECT_NEAR(load[s], parts, 1e-5 * load[s]);
    EXPECT_GT(result.doubles("sensor_light_load_se")[s], 0);
  }
  EXPECT_GT(load[1], 0.9 * sum(result.doubles("ghi")) / 1000);
  EXPECT_EQ(load[2], 0);
  // The one in the house is told about; the others are not.
  EXPECT_NE(ran.err.find("1 of 3 sensors see mostly backs of surfaces"), std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("sensor 2 at (0, 6, 3)"), std::string::npos) << ran.err;
  const Ran info = program(square.folder, {"info", square.result("a")});
  EXPECT_NE(info.out.find("sensors      3: light load"), std::string::npos) << info.out;
  const Ran check = program(square.folder, {"check", "square.yaml"});
  EXPECT_NE(check.out.find("3 points"), std::string::npos) << check.out;
}

// They look along the ground on which they stand; their twins a millimetre above it see the same.
TEST(SensorStudy, OnTheGroundSeeWhatIsJustAboveItSees) {
  const SensedSquare square(
      "sensors: {points: [{position_m: [-12, -12, 0], normal: [0, -1, 0]}, "
      "{position_m: [-12, -12, 0.001], normal: [0, -1, 0]}, "
      "{position_m: [-12, -12, 0], normal: [0, -1, -0.0001]}]}\n");
  ASSERT_EQ(square.run("a").code, 0);
  const ResultReader result(square.result("a"));
  EXPECT_EQ(result.doubles("sensor_position")[2], 0);
  const auto sun = result.doubles("sensor_sun_hours"),
             direct = result.doubles("sensor_light_load_direct"),
             sky = result.doubles("sensor_light_load_sky");
  const auto se = result.doubles("sensor_light_load_sky_se");
  EXPECT_GT(sun[1], 5);
  EXPECT_GT(sky[1], 0);
  for (const std::size_t s : {0u, 2u}) {
    EXPECT_NEAR(sun[s], sun[1], 0.01);
    // The third is turned by a ten-thousandth.
    EXPECT_NEAR(direct[s], direct[1], 3e-4 * direct[1]);
    EXPECT_NEAR(sky[s], sky[1], 4 * std::hypot(se[s], se[1]) + 3e-4 * sky[1]);
  }
}

TEST(SensorStudy, TablesAndGeoPackageHaveThem) {
  const SensedSquare square;
  ASSERT_EQ(square.run("a").code, 0);
  const std::string path = square.result("a");
  const Ran csv = program(square.folder, {"info", path, "--sensor", "0", "--sensor", "1", "--csv"});
  ASSERT_EQ(csv.code, 0) << csv.err;
  const ResultReader result(path);
  const auto load = result.doubles("sensor_light_load"),
             se = result.doubles("sensor_light_load_se");
  EXPECT_NE(csv.out.find(fmt::format("\n0,180,,{:.9g},{:.9g},,,", load[0], se[0])),
            std::string::npos)
      << csv.out;
  EXPECT_NE(csv.out.find(",0,-5,1.5\n1,,,"), std::string::npos) << csv.out;
  EXPECT_EQ(program(square.folder, {"info", path, "--sensor", "7"}).code, 2);
  ASSERT_EQ(program(square.folder, {"export", path, "--to", "gpkg", "-o", "a.gpkg"}).code, 0);
  const Ran rows =
      python(square.folder,
             "import sqlite3; print(sqlite3.connect('a.gpkg').execute('SELECT sensor, "
             "sunload_light_load_kwh_m2, sunload_azimuth_deg FROM sensors').fetchall())");
  EXPECT_EQ(rows.out.find("[('0', "), 0u) << rows.out << rows.err;
  EXPECT_NE(rows.out.find(", 180.0), ('1', "), std::string::npos) << rows.out;
  EXPECT_NE(rows.out.find(", None)]"), std::string::npos) << rows.out;
}

TEST(SensorStudy, ChangesNoPatchAndHasTheSameBitsByShardsThreadsAndFile) {
  const SensedSquare square("");
  ASSERT_EQ(square.run("without").code, 0);
  square.write(three_sensors);
  ASSERT_EQ(square.run("one", {"--threads", "1"}).code, 0);
  ASSERT_EQ(square.run("three", {"--threads", "3"}).code, 0);
  for (const char* shard : {"1/3", "2/3", "0/3"})
    ASSERT_EQ(square.run("shards", {"--shard", shard}).code, 0) << shard;
  square.folder.write("grid.pts", "0 -5 1.5 0 -1 0\n-12 -12 0 0 0 1\n0 6 3 0 0 2\n");
  square.write("sensors: {file: grid.pts}\n");
  ASSERT_EQ(square.run("file").code, 0);
  const auto added = different_data(square.result("without"), square.result("one"));
  EXPECT_FALSE(added.empty());
  for (const auto& name : added)
    EXPECT_TRUE(name.starts_with("sensor") || name == "study_yaml") << name;
  using Strings = std::vector<std::string>;
  EXPECT_EQ(different_data(square.result("one"), square.result("three")), Strings{});
  EXPECT_EQ(different_data(square.result("one"), square.result("shards")), Strings{});
  EXPECT_EQ(different_data(square.result("one"), square.result("file")), Strings{"study_yaml"});
  // The twin: a sensor moved by a millimetre is another one.
  square.folder.write("grid.pts", "0 -5.001 1.5 0 -1 0\n-12 -12 0 0 0 1\n0 6 3 0 0 2\n");
  ASSERT_EQ(square.run("moved").code, 0);
  const auto moved = different_data(square.result("file"), square.result("moved"));
  EXPECT_NE(std::find(moved.begin(), moved.end(), "sensor_light_load"), moved.end());
}

TEST(SensorStudy, MistakesAreToldWithTheirPlace) {
  const SensedSquare square;
  const auto refused = [&](const std::string& sensors, const std::string& text) {
    square.write(sensors);
    const Ran ran = program(square.folder, {"check", "square.yaml"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find(text), std::string::npos) << sensors << ran.err;
  };
  refused("sensors: {points: [{position_m: [0, 0], normal: [0, 0, 1]}]}\n",
          "square.yaml:17:33: sensors.points[1].position_m: must be three numbers, x, y and z");
  refused("sensors: {points: [{position_m: [0, 0, 1], normal: [0, 0, 0]}]}\n", "has no length");
  refused("sensors: {points: [{position_m: [0, 0, 1]}]}\n", "normal is missing");
  refused("sensors: {}\n", "sensors has neither points nor file");
  refused("sensors: {file: a.csv, points: [{position_m: [0, 0, 1], normal: [0, 0, 1]}]}\n",
          "sensors has points and file");
  refused("sensors: {file: a.csv}\n", "a.csv");
  square.folder.write("a.csv", "x,y,z,nx,ny,nz\n1,2,3,0,0,1\n1,2,3,0,0\n");
  refused("sensors: {file: a.csv}\n", "a.csv:3: the row has 5 fields, not 6");
  refused("variants: [{name: a, sensors: {file: b.csv}}]\n", "a variant cannot change this");
  // Far away: most likely relative to another origin.
  square.write("sensors: {points: [{position_m: [5000, 0, 1], normal: [0, 0, 1]}]}\n");
  const Ran ran = program(square.folder, {"check", "square.yaml"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("1 of 1 sensors stand farther from the scene than it is wide"),
            std::string::npos)
      << ran.out;
}

// ---- hours of sun ------------------------------------------------------------------------

/// Upright wall along the points, facing left of the way.
std::string wall(int first, double x0, double y0, double x1, double y1, double height) {
  return fmt::format("v {0} {1} 0\nv {2} {3} 0\nv {2} {3} {4}\nv {0} {1} {4}\nf {5} {6} {7} {8}\n",
                     x0, y0, x1, y1, height, first, first + 1, first + 2, first + 3);
}

/// Walls of a case around its observer at the origin.
std::string walls(const nlohmann::json& c) {
  const auto& p = c["parameters"];
  const std::string kind = c["kind"];
  const double H = number(p["H"]);
  constexpr double far = 2000;  // stands for infinitely long
  if (kind == "south_wall_at_distance") {
    const double d = number(p["distance"]);
    return wall(1, far, -d, -far, -d, H);
  }
  const double W = number(p["W"]) / 2;
  if (kind == "ew_street_centre")
    return wall(1, far, -W, -far, -W, H) + wall(5, -far, W, far, W, H);
  if (kind == "ns_street_centre")
    return wall(1, -W, -far, -W, far, H) + wall(5, W, far, W, -far, H);
  const double D = number(p["D"]) / 2;
  return wall(1, -W, -D, W, -D, H) + wall(5, W, -D, W, D, H) + wall(9, W, D, -W, D, H) +
         wall(13, -W, D, -W, -D, H);
}

/// Seconds from 1970 to the beginning of a date, as YYYY-MM-DD, in UTC.
double seconds_of(const std::string& date) {
  using namespace std::chrono;
  const sys_days day = year{std::stoi(date.substr(0, 4))} /
                       month{static_cast<unsigned>(std::stoi(date.substr(5, 2)))} /
                       std::chrono::day{static_cast<unsigned>(std::stoi(date.substr(8, 2)))};
  return static_cast<double>(duration_cast<seconds>(day.time_since_epoch()).count());
}

/// Stretches of sun on a sensor [h UTC of the date], from the intervals in which it has light.
std::vector<std::pair<double, double>> stretches(const ResultReader& result, std::size_t sensor,
                                                 const std::string& date) {
  const auto bounds = result.doubles("time_bounds"), light = result.doubles("sensor_irradiance");
  const std::size_t sensors = result.shape("sensor_irradiance")[1];
  const auto hour = [&](double seconds) { return (seconds - seconds_of(date)) / 3600; };
  std::vector<std::pair<double, double>> lit;
  bool was_lit = false;
  for (std::size_t k = 0; k < bounds.size() / 2; ++k) {
    const bool is_lit = light[k * sensors + sensor] > 0;
    if (is_lit && !was_lit) lit.emplace_back(hour(bounds[2 * k]), 0);
    if (is_lit) lit.back().second = hour(bounds[2 * k + 1]);
    was_lit = is_lit;
  }
  return lit;
}

/// Largest difference of their ends [h]; infinite where they are not as many.
double largest_difference(const std::vector<std::pair<double, double>>& found,
                          const nlohmann::json& intervals) {
  if (found.size() != intervals.size()) return INFINITY;
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    largest = std::max({largest, std::abs(found[i].first - number(intervals[i][0])),
                        std::abs(found[i].second - number(intervals[i][1]))});
  return largest;
}

TEST(SensorSunHours, OfCourtyardsStreetsAndWalls) {
  constexpr double step_min = 1, hour_min = 60;
  for (const auto& c : reference_cases("06_direct_sun/sun_hours.json")) {
    const std::string id = c["id"];
    const WorkFolder folder;
    // Two-sided sheets stand for buildings, whichever way they face.
    folder.write("walls.obj", "o walls\nusemtl wall\n" + walls(c));
    const std::string date = c["date"];
    const double begin_h = std::round(number(c["window_start_utc_h"]));
    const int offset = static_cast<int>(begin_h);  // the day of that offset is the window's
    folder.write(
        "study.yaml",
        fmt::format(
            "format: sunload-study-1\nname: study\n"
            "site: {{latitude_deg: {}, longitude_deg: {}, timezone: \"{}{:02}:00\"}}\n"
            "period: {{days: [{}], step_min: {}}}\nsun: {{refraction: none}}\n"
            "light: {{source: fixed, dni_w_m2: 1000, dhi_w_m2: 0}}\n"
            "scene: {{files: [walls.obj], materials: {{wall: {{diffuse: 0, sides: two}}}}}}\n"
            "sensors: {{points: [{{position_m: [0, 0, 0], normal: [0, 0, 1]}},"
            " {{position_m: [3, 3, 0], normal: [0, 0, 1]}}]}}\n"
            "solver: {{lines_per_patch: 2, direct_samples: 2, realizations: 2}}\n",
            number(c["lat_deg"]), number(c["lon_deg_east"]), offset > 0 ? "-" : "+",
            std::abs(offset), date, step_min));
    const Ran ran = program(folder, {"run", "study.yaml"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const ResultReader result(folder / "results/study/baseline.h5");
    const double hours = result.doubles("sensor_sun_hours")[0], truth = number(c["sun_hours"]);
    // An interval is lit or not: half a step at each end of each stretch of sun.
    const double most = static_cast<double>(c["intervals_utc_h"].size()) * step_min / hour_min;
    std::cout << id << ": " << hours << " h, truth " << truth << " h, limit " << most << "\n";
    EXPECT_NEAR(hours, truth, most + 1e-3) << id;
    constexpr double most_at_an_end = 2 * step_min / hour_min;
    const double at_ends = largest_difference(stretches(result, 0, date), c["intervals_utc_h"]);
    std::cout << "  ends differ by at most " << at_ends * 60 << " min\n";
    EXPECT_LE(at_ends, most_at_an_end) << id;
    // Planted fault: an observer who stands 4 m aside.
    if (truth > 0) {
      EXPECT_GT(largest_difference(stretches(result, 1, date), c["intervals_utc_h"]),
                most_at_an_end);
      EXPECT_GT(std::abs(result.doubles("sensor_sun_hours")[1] - truth), most + 1e-3) << id;
    }
  }
}

}  // namespace
}  // namespace sunload::test
