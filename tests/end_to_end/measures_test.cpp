// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures of a study: values and verdicts on the command line, other measures, variants.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/result/measure_table.h"
#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

const std::string measures =
    "measures:\n"
    "  exposure: {rule: en_17037, least_elevation_deg: 13, of: {object: house}}\n"
    "  czech: {rule: csn_73_4301, of: {object: house}}\n"
    "  sunny: {rule: sun_hours, date: 2026-12-21, least_elevation_deg: 5}\n"
    "  sky: {rule: bre_209_vsc, of: {surface: wall}}\n"
    "  glints: {rule: glint_hours, above_w_m2: 50, most_h: 1, of: {surface: ground}}\n"
    "sensors: {points: [{position_m: [0, -9, 1], normal: [0, 0, 1]}]}\n";
// A tower in the south of the house, 2 m from it.
const std::string tower =
    "o tower\nusemtl plaster\n"
    "v -9 -2 0.01\nv 9 -2 0.01\nv 9 1 0.01\nv -9 1 0.01\nv -9 -2 30\nv 9 -2 30\nv 9 1 30\nv -9 1 "
    "30\n"
    "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\nf 4 3 2 1\n";
const std::string measured_variants =
    "variants:\n  - {name: base}\n  - {name: towered, scene: {files: [square.obj, tower.obj]}}\n";

void write(const WorkFolder& folder, const std::string& more) {
  folder.write("square.obj", square_obj);
  folder.write("tower.obj", tower);
  folder.write("square.yaml", square_study() + more);
}

constexpr const char* base_result = "results/square/base.h5";

MeasureRow row_of(const ResultReader& result, const std::string& measure,
                  const std::string& facade) {
  for (const MeasureRow& row : measure_table(result, {{facade}, {}, {}}))
    if (row.measure == measure) return row;
  ADD_FAILURE() << measure << " of " << facade;
  return {};
}

// Also where exactly half of a wall, one of two triangles, is enough.
TEST(Measures, VerdictsAgreeWithWhatIsReached) {
  const WorkFolder folder;
  std::string more = "measures:\n";
  for (int p = 1; p < 40; ++p)
    more += fmt::format(
        "  sky_{}: {{rule: bre_209_vsc, least_percent: {}, of: {{surface: wall}}}}\n", p, p);
  folder.write("square.obj", square_obj);
  folder.write("tower.obj", tower);
  folder.write("square.yaml", square_study("totals", "", "1000") + more + measured_variants);
  const Ran ran = program(folder, {"run", "square.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  int halves = 0, judged = 0;
  for (const char* path : {base_result, "results/square/towered.h5"})
    for (const MeasureRow& row : measure_table(ResultReader(folder / path), {})) {
      if (row.level.empty()) continue;
      ++judged;
      if (std::abs(row.passing_percent - 50) < 1e-6) ++halves;
      EXPECT_EQ(row.level == "fail", row.margin < 0)
          << row.measure << " of " << row.name << ": " << row.passing_percent << " %";
    }
  EXPECT_GT(judged, 100);
  EXPECT_GT(halves, 5);
}

// One of two equal slopes is half of a roof, whatever rounding of its ridge to millimetres says.
TEST(Measures, HalfOfARoofIsHalfOfIt) {
  const WorkFolder folder;
  folder.write(
      "square.obj",
      "o house\nusemtl plaster\n"
      "v -4 -5 0\nv 4 -5 0\nv 4 5 0\nv -4 5 0\nv -4 -5 3\nv 4 -5 3\nv 4 5 3\nv -4 5 3\n"
      "v 0.001 -5 6\nv 0.001 5 6\n"
      "f 4 3 2 1\nf 1 2 6 9 5\nf 2 3 7 6\nf 3 4 8 10 7\nf 4 1 5 8\nf 6 7 10 9\nf 8 5 9 10\n"
      "o tower\nusemtl plaster\n"
      "v -9 -9 0\nv -5 -9 0\nv -5 9 0\nv -9 9 0\nv -9 -9 30\nv -5 -9 30\nv -5 9 30\nv -9 9 "
      "30\n"
      "f 11 12 16 15\nf 12 13 17 16\nf 13 14 18 17\nf 14 11 15 18\nf 15 16 17 18\n"
      "f 14 13 12 11\n");
  std::string more = "measures:\n";
  for (int p = 1; p < 100; ++p)
    more += fmt::format(
        "  sky_{}: {{rule: bre_209_vsc, least_percent: {}, of: {{object: house, surface: "
        "roof}}}}\n",
        p, p);
  folder.write("square.yaml", square_study("totals", "", "1000") + more);
  const Ran ran = program(folder, {"run", "square.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  int halves = 0;
  for (const MeasureRow& row :
       measure_table(ResultReader(folder / "results/square/baseline.h5"), {{}, {"house"}, {}})) {
    if (std::abs(row.passing_percent - 50) > 0.05) continue;
    ++halves;
    EXPECT_LT(row.passing_percent, 50);
    EXPECT_EQ(row.level, "pass") << row.measure << ": " << row.passing_percent << " %";
    EXPECT_GE(row.margin, 0) << row.measure;
  }
  EXPECT_GT(halves, 5);
}

TEST(Measures, HaveVerdictsAndTellWhoLoses) {
  const WorkFolder folder;
  write(folder, measures + measured_variants);
  const Ran ran = program(folder, {"run", "square.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const ResultReader result(folder / base_result);
  EXPECT_EQ(result.text_attribute("measures"), "exposure czech sunny sky glints");
  // Open to the south at the equinox.
  const MeasureRow south = row_of(result, "exposure", "house/south_1");
  EXPECT_EQ(south.level, "high");
  EXPECT_DOUBLE_EQ(south.margin, south.reached - 1.5);
  EXPECT_EQ(south.passing_percent, 100);
  EXPECT_EQ(row_of(result, "exposure", "house/north_1").level, "fail");
  EXPECT_EQ(row_of(result, "exposure", "house/north_1").margin, -1.5);
  const std::string dataset = "measure_czech";
  EXPECT_EQ(result.units(dataset), "h");
  EXPECT_NE(measure_words(result, "sunny")
                .definition.find("; here with least_elevation_deg 5, date 2026-12-21"),
            std::string::npos);
  for (const char* attribute : {"definition", "source", "rule", "parameters", "level_words"})
    EXPECT_FALSE(result.text_attribute(dataset, attribute).empty()) << attribute;
  const auto parameters = nlohmann::json::parse(result.text_attribute(dataset, "parameters"));
  EXPECT_EQ(parameters["date"], nlohmann::json({2026, 3, 1}));
  EXPECT_EQ(sums_problem(folder / base_result), "");

  const Ran table = program(folder, {"info", base_result, "--measures", "--csv"});
  EXPECT_EQ(table.out.rfind("measure,group,name,area_m2,mean,reached,units,level,margin,"
                            "passing_percent,spans\n",
                            0),
            0u);
  // In the open: from 5° to 5° in one span.
  const auto sensor = table.out.find("sunny,sensor,0,");
  ASSERT_NE(sensor, std::string::npos) << table.out;
  const std::string line = table.out.substr(sensor, table.out.find('\n', sensor) - sensor);
  EXPECT_NE(line.find(",2026-12-21T07:"), std::string::npos) << line;
  EXPECT_EQ(std::count(line.begin(), line.end(), '/'), 1) << line;
  const auto json =
      nlohmann::json::parse(program(folder, {"info", base_result, "--measures", "--json"}).out);
  EXPECT_EQ(json["measures"][0]["levels"].size(), 3u);
  const Ran screen = program(folder, {"info", base_result});
  EXPECT_NE(screen.out.find("exposure: mean"), std::string::npos) << screen.out;

  const Ran compared = program(folder, {"compare", base_result, "results/square/towered.h5"});
  EXPECT_NE(compared.out.find("facade house/south_1: high → fail"), std::string::npos)
      << compared.out;
  // Of what a measure has values for: nothing of this model is a ground.
  for (const char* counts :
       {"exposure: pass in the base → in the variant: 1 → 0 of 1 object, 3 → 2 "
        "of 4 facades, 1 → 1 of 1 sensor\n",
        "glints: pass in the base → in the variant: 1 → 1 of 1 sensor\n"})
    EXPECT_NE(compared.out.find(counts), std::string::npos) << counts << compared.out;
  for (const char* quantity : {"measure_exposure", "measure_sky"}) {
    const Ran drawn = program(folder, {"render", base_result, "-o", "a.png", "--size", "320x320",
                                       "--quantity", quantity});
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    const Ran exported = program(
        folder, {"export", base_result, "--to", "csv", "-o", "a.csv", "--quantity", quantity});
    EXPECT_EQ(exported.code, 0) << exported.err;
  }
  EXPECT_EQ(program(folder, {"view", base_result, "-o", "a.html"}).code, 0);
  const Ran part = program(folder, {"info", base_result, "--measures", "--hours", "8-12"});
  EXPECT_EQ(part.code, 2);
  EXPECT_NE(part.err.find("no measures of a part of the period"), std::string::npos) << part.err;
}

TEST(Measures, OthersMakeAnotherResultOfTheSameBatches) {
  const WorkFolder folder, whole;
  write(folder, measures);
  EXPECT_EQ(program(folder, {"run", "square.yaml", "--resume", "--shard", "0/2"}).code, 0);
  // What another shard was told meanwhile.
  const std::string other =
      "measures: {sky: {rule: bre_209_vsc}}\n" + measures.substr(measures.find("sensors:"));
  write(folder, other);
  const Ran second =
      program(folder, {"run", "square.yaml", "--resume", "--shard", "1/2", "--keep-batches"});
  EXPECT_EQ(second.code, 0) << second.err;
  write(whole, other);
  EXPECT_EQ(program(whole, {"run", "square.yaml", "--threads", "1"}).code, 0);
  const char* result = "results/square/baseline.h5";
  EXPECT_EQ(different_data(folder / result, whole / result), std::vector<std::string>{});

  write(folder, measures);
  const Ran refused = program(folder, {"run", "square.yaml", "--resume"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("its measures or selections differ"), std::string::npos)
      << refused.err;
  EXPECT_EQ(program(folder, {"run", "square.yaml", "--overwrite"}).code, 0);
  EXPECT_EQ(measure_names(ResultReader(folder / result)).size(), 5u);
}

/// Four hours about a box on a plane, before what is measured there.
std::string box_study(const std::string& name) {
  return "format: sunload-study-1\nname: " + name +
         "\nsite: {latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague}\n"
         "period: {days: [2026-03-21], from: \"10:00\", to: \"14:00\", step_min: 60}\n"
         "scene: {builtin: {name: box_on_plane}}\n"
         "mesh: {oracle: none, max_edge_m: 10}\nsolver: {lines_per_patch: 16}\n";
}

/// The sun shines in every hour with light: no overcast sky.
TEST(Measures, SayWhereTheyHaveNoValue) {
  const WorkFolder folder;
  const auto study = [](const char* light) {
    return box_study("bright") +
           "measures: {df: {rule: daylight_factor}, sky: {rule: bre_209_vsc}}\n" +
           std::string(light);
  };
  folder.write("bright.yaml", study(""));
  const char* result = "results/bright/baseline.h5";
  const Ran run = program(folder, {"run", "bright.yaml"}),
            check = program(folder, {"check", "bright.yaml"});
  ASSERT_EQ(run.code, 0) << run.err;
  for (const std::string& said : {run.err, check.out})
    EXPECT_NE(said.find("measure df has no value (it is taken over intervals with light but"),
              std::string::npos)
        << said;
  const std::string table = program(folder, {"info", result, "--measures"}).out;
  EXPECT_NE(table.find("df: light as a share"), std::string::npos) << table;
  EXPECT_NE(table.find("  no value\n"), std::string::npos) << table;
  EXPECT_NE(program(folder, {"info", result}).out.find("df: no value"), std::string::npos);
  folder.write("bright.yaml",
               study("light: {source: fixed, dni_w_m2: 0, dhi_w_m2: 200, sky: cie_overcast}\n"));
  const Ran overcast = program(folder, {"check", "bright.yaml"});
  EXPECT_EQ(overcast.out.find("has no value"), std::string::npos) << overcast.out;
}

/// In the open it is 100 % by its definition, in whatever unit light is told and its strength
/// given.
TEST(Measures, DaylightFactorIsWholeInTheOpen) {
  const WorkFolder folder;
  for (const char* quantity : {"irradiance", "illuminance"})
    for (const char* strength :
         {"dhi_w_m2: 200", "sky_scale: absolute, zenith_luminance_cd_m2: 9000"}) {
      folder.write(
          "open.yaml",
          box_study("open") +
              "sensors: {points: [{position_m: [0, 0, 500], normal: [0, 0, 1]}]}\n"
              "measures: {df: {rule: daylight_factor}, of_sky: {rule: daylight_factor, light: "
              "sky}}\n" +
              fmt::format(
                  "light: {{source: fixed, dni_w_m2: 0, {}, sky: cie_overcast, quantity: {}}}\n",
                  strength, quantity));
      const Ran ran = program(folder, {"run", "open.yaml", "--overwrite"});
      ASSERT_EQ(ran.code, 0) << ran.err;
      const ResultReader result(folder / "results/open/baseline.h5");
      // Single precision, and what lines of the horizon see of the ground.
      EXPECT_NEAR(result.doubles("sensor_measure_df").at(0), 100, 1)
          << quantity << ", " << strength;
      EXPECT_NEAR(result.doubles("sensor_measure_of_sky").at(0), 100, 1)
          << quantity << ", " << strength;
      EXPECT_EQ(ran.err.find("counts the light of lamps"), std::string::npos) << ran.err;
    }
}

TEST(Measures, OfDaylightWarnOfLamps) {
  const WorkFolder folder;
  const std::string overcast =
      "light: {source: fixed, dni_w_m2: 0, dhi_w_m2: 200, sky: cie_overcast}\n";
  std::string study = box_study("lit");
  const std::string scene = "scene: {builtin: {name: box_on_plane}";
  study.insert(study.find(scene) + scene.size(),
               ", materials: {glowing: {diffuse: 0.5, emission_w_m2: 50}}, assign: [{object: box, "
               "material: glowing}]");
  folder.write("lit.yaml", study + overcast +
                               "measures: {all: {rule: daylight_factor}, of_sky: {rule: "
                               "daylight_factor, light: sky}}\n");
  const Ran ran = program(folder, {"check", "lit.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("measure all counts the light of lamps"), std::string::npos) << ran.out;
  EXPECT_EQ(ran.out.find("measure of_sky counts"), std::string::npos) << ran.out;
}

TEST(Measures, OfAYearNeedOne) {
  const WorkFolder folder;
  write(folder, "measures: {a: {rule: roof_potential, of: {surface: roof}}}\n");
  const Ran ran = program(folder, {"check", "square.yaml"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("measure a needs a whole year"), std::string::npos) << ran.err;
  std::string two_years = folder.read("square.yaml");
  const auto period = two_years.find("period: {");
  two_years.replace(period, two_years.find('}', period) + 1 - period,
                    "period: {start: 2026-01-01, end: 2028-01-01, step_min: 60}");
  folder.write("square.yaml", two_years);
  const Ran longer = program(folder, {"check", "square.yaml"});
  EXPECT_EQ(longer.code, 2);
  EXPECT_NE(longer.err.find("the period has 730 days"), std::string::npos) << longer.err;
}

TEST(Measures, OfOtherSensorsOfOneNumberAreNotCompared) {
  const WorkFolder folder;
  const std::string up = "{position_m: [0, -9, 1], normal: [0, 0, 1]}",
                    down = "{position_m: [-12, -12, 0.5], normal: [0, 0, -1]}";
  const auto result_of = [&](const std::string& name, const std::string& sensors) {
    folder.write("square.obj", square_obj);
    folder.write("square.yaml", square_study() +
                                    "measures: {sun: {rule: sun_hours, date: "
                                    "2026-03-21, least_h: 3}}\nsensors: {points: [" +
                                    sensors + "]}\n");
    const Ran ran = program(folder, {"run", "square.yaml", "--output", name});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return name + "/square/baseline.h5";
  };
  const std::string a = result_of("a", up + ", " + down), b = result_of("b", down + ", " + up);
  const Ran others = program(folder, {"compare", a, b});
  for (const char* part : {"0 → 0 of 0 sensors\n", "sensor 0: only in the base, pass (",
                           "sensor 0: only in the variant, fail ("})
    EXPECT_NE(others.out.find(part), std::string::npos) << part << others.out;
  const Ran same = program(folder, {"compare", a, a});
  EXPECT_NE(same.out.find("1 → 1 of 2 sensors\n"), std::string::npos) << same.out;
}

/// As with selections: a variant may remove what is measured.
TEST(Measures, OfWhatAVariantRemovesAreTakenInTheOthers) {
  const WorkFolder folder;
  const auto study = [](const char* object) {
    return box_study("gone") +
           "measures: {sky: {rule: bre_209_vsc, of: {object: " + std::string(object) +
           "}}, south: {rule: en_17037, least_elevation_deg: 13, of: {facade: 'box/south*'}}}\n"
           "variants: [{name: base}, {name: bare, scene: {edit: [{object: box, remove: true}]}}]\n";
  };
  folder.write("gone.yaml", study("box"));
  const std::string lacks = "measure sky: no object of variant bare matches 'box'";
  const Ran check = program(folder, {"check", "gone.yaml"}),
            run = program(folder, {"run", "gone.yaml"}),
            alone = program(folder, {"check", "gone.yaml", "--variant", "bare"});
  for (const Ran* ran : {&check, &run, &alone}) {
    EXPECT_EQ(ran->code, 0) << ran->err;
    EXPECT_NE((ran->out + ran->err).find(lacks), std::string::npos) << ran->out << ran->err;
    EXPECT_NE((ran->out + ran->err).find("no facade of variant bare matches 'box/south*'"),
              std::string::npos);
  }
  EXPECT_EQ(check.out.find("of variant base matches"), std::string::npos) << check.out;
  const std::string with = "results/gone/base.h5", without = "results/gone/bare.h5";
  EXPECT_TRUE(has_values(ResultReader(folder / with), "sky"));
  EXPECT_FALSE(has_values(ResultReader(folder / without), "sky"));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"compare", with, without},
        {"compare", with, without, "--quantity", "measure_sky"},
        {"export", without, "--to", "csv", "-o", "bare.csv"},
        {"info", without, "--measures"}}) {
    const Ran ran = program(folder, words);
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  folder.write("gone.yaml", study("bux"));
  for (const char* command : {"check", "run"}) {
    const Ran slip = program(folder, {command, "gone.yaml"});
    EXPECT_EQ(slip.code, 2);
    EXPECT_NE(slip.err.find("measure sky: no object matches 'bux' (in any variant of the study); "
                            "did you mean box?"),
              std::string::npos)
        << slip.err;
  }
}

TEST(Measures, ThatChooseNothingAreRefusedAtOnce) {
  const WorkFolder folder;
  write(folder,
        "measures: {a: {rule: csn_73_4301, of: {facade: 'hause/*'}}, b: {rule: csn_73_4301, "
        "of: {object: squares}}}\n");
  const Ran ran = program(folder, {"check", "square.yaml"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("measure a: no facade matches 'hause/*'"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("measure b: no object matches 'squares'"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("did you mean square?"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace sunload::test
