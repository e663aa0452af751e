// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light at night: from a study with luminaires to lux in the result.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geo/base/units.h"
#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// 100 cd down, 200 cd to the side of plane C 90, nothing upward.
constexpr const char* lamp_ies =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 5 1 2 0 0 0\n1 1 40\n0 90\n0 90 180 270 360\n"
    "100 100\n100 200\n100 100\n100 0\n100 100\n";

/// A yard of 20 m, and sensors on it that look up; absolute coordinates far from 0.
std::string night_study(const std::string& luminaires, const std::string& more = "") {
  return "format: sunload-study-1\nname: night\n"
         "site: {latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague}\n"
         "period: {instants: [\"2026-12-21T22:00\"]}\n"
         "light: {quantity: illuminance}\n"
         "scene:\n  files: [yard.obj]\n"
         "  materials: {paving: {diffuse: 0.25}, panel: {diffuse: 0}}\n"
         "  luminaires: [" +
         luminaires +
         "]\n"
         "mesh: {oracle: none, max_edge_m: 2}\n"
         "sensors: {points: [{position_m: [5000, 0, 1], normal: [0, 0, 1]},\n"
         "  {position_m: [5000, 3, 1], normal: [0, 0, 1]},\n"
         "  {position_m: [5000, -3, 1], normal: [0, 0, 1]}]}\n" +
         more;
}

/// `panel`: 2 m x 2 m that looks down from 3 m, an edge over the first sensor.
void write_yard(const WorkFolder& folder, bool panel = false) {
  folder.write("yard.obj",
               std::string("o yard\nusemtl paving\nv 4990 -10 0\nv 5010 -10 0\nv 5010 10 0\n"
                           "v 4990 10 0\nf 1 2 3 4\n") +
                   (panel ? "o panel\nusemtl panel\nv 5000 -1 3\nv 5000 1 3\nv 5002 1 3\n"
                            "v 5002 -1 3\nf 5 6 7 8\n"
                          : ""));
  folder.write("lamp.ies", lamp_ies);
}

/// Illuminance by lamps of each sensor.
std::vector<double> on_sensors(const std::string& path) {
  return ResultReader(path).doubles("sensor_illuminance_lamps");
}

TEST(Night, LuminairesLightByTheirPhotometry) {
  const WorkFolder folder;
  write_yard(folder);
  folder.write("night.yaml",
               night_study("{position_m: [5000, 0, 5], file: lamp.ies}",
                           "variants:\n"
                           "  - {name: north}\n"
                           "  - {name: turned, scene: {luminaires: [{position_m: [5000, 0, 5], "
                           "file: lamp.ies, turn_deg: 180}]}}\n"
                           "  - {name: even, scene: {luminaires: [{position_m: [5000, 0, 5], "
                           "intensity_cd: 160}]}}\n"
                           "  - {name: dimmed, scene: {luminaires: [{position_m: [5000, 0, 5], "
                           "intensity_cd: 80}]}}\n"));
  const Ran checked = program(folder, {"check", "night.yaml"});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_NE(checked.out.find("luminaires 1 send"), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find("1 intervals (1 with light)"), std::string::npos) << checked.out;
  const Ran ran = program(folder, {"run", "night.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  // 4 m below, and 3 m beside that: r = 5 m, cos = 0.8, γ = 36.87 degrees.
  const double beside = 0.8 / 25, share = std::atan(0.75) / (pi / 2);
  const double street = 100 + share * 100, house = 100 - share * 100;
  const auto expect = [&](const char* variant, std::array<double, 3> truth) {
    const auto seen = on_sensors(folder / ("results/night/" + std::string(variant) + ".h5"));
    ASSERT_EQ(seen.size(), 3u);
    for (std::size_t s = 0; s < 3; ++s)
      EXPECT_NEAR(seen[s], truth[s], 1e-4 * truth[s]) << variant << s;
  };
  expect("north", {100.0 / 16, street * beside, house * beside});
  expect("turned", {100.0 / 16, house * beside, street * beside});
  expect("even", {10, 160 * beside, 160 * beside});
  // Linear, with the same samples: half the light is half of everything.
  const ResultReader even(folder / "results/night/even.h5"),
      dimmed(folder / "results/night/dimmed.h5");
  const auto of_even = even.doubles("light_load"), of_dimmed = dimmed.doubles("light_load");
  ASSERT_EQ(of_even.size(), of_dimmed.size());
  for (std::size_t i = 0; i < of_even.size(); ++i)
    EXPECT_NEAR(of_dimmed[i], of_even[i] / 2, 1e-5 * of_even[i]) << i;
  EXPECT_EQ(even.units("illuminance_lamps"), "lx");
}

// A panel of M lm/m² is seen with M times its form factor.
TEST(Night, SurfacesEmitLumens) {
  const WorkFolder folder;
  write_yard(folder, true);
  std::string study = night_study("");
  study.replace(study.find("panel: {diffuse: 0}"), 19, "panel: {diffuse: 0, emission_lm_m2: 1000}");
  study.replace(study.find("  luminaires: []\n"), 17, "");
  folder.write("night.yaml", study + "solver: {lines_per_patch: 4096}\n");
  const Ran ran = program(folder, {"run", "night.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const double seen = on_sensors(folder / "results/night/baseline.h5")[0];
  // A rectangle [0, 2] × [-1, 1], parallel, 2 m away, a corner at the middle of an edge: twice that
  // of 2 × 1 (Howell, catalogue of configuration factors, B-3).
  const double A = 1, B = 0.5, a = std::sqrt(1 + A * A), b = std::sqrt(1 + B * B);
  const double factor = (A / a * std::atan(B / a) + B / b * std::atan(A / b)) / (2 * pi);
  EXPECT_NEAR(seen, 2 * 1000 * factor, 0.02 * 2 * 1000 * factor);
}

TEST(Night, WattsAndLumensAreNotMixed) {
  const WorkFolder folder;
  write_yard(folder);
  const auto refused = [&](std::string study) {
    folder.write("night.yaml", study);
    const Ran ran = program(folder, {"check", "night.yaml"});
    EXPECT_EQ(ran.code, 2) << ran.err;
    return ran.err;
  };
  std::string watts = night_study("{position_m: [5000, 0, 5], intensity_cd: 10}");
  watts.replace(watts.find("illuminance"), 11, "irradiance");
  EXPECT_NE(refused(watts).find("scene.luminaires need light.quantity: illuminance"),
            std::string::npos);
  std::string panel = night_study("{position_m: [5000, 0, 5], intensity_cd: 10}");
  panel.replace(panel.find("panel: {diffuse: 0}"), 19, "panel: {emission_w_m2: 5}");
  EXPECT_NE(refused(panel).find("write emission_lm_m2"), std::string::npos);
  const std::string all = refused(night_study(
      "{position_m: [5000, 0, 5]}, {position_m: [5000, 0, 5], file: lamp.ies, beam_deg: "
      "20}, {position_m: [5000, 0, 5], flux_lm: 5, to_m: [5010, 0, 5]}, {position_m: "
      "[1, 2], flux_lm: 3}"));
  for (const char* said : {"has no file, intensity_cd or flux_lm", "beam_deg: stands beside file",
                           "to_m: stands alone", "must be three numbers"})
    EXPECT_NE(all.find(said), std::string::npos) << said << "\n" << all;
  folder.write("lamp.ies", "no photometry\n");
  EXPECT_NE(
      refused(night_study("{position_m: [5000, 0, 5], file: lamp.ies}")).find("is no IES file"),
      std::string::npos);
}

}  // namespace
}  // namespace sunload::test
