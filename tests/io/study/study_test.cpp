// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Studies: every rule of their keys, the schema, variants, and the canonical text.
#include "io/study/study.h"
#include "io/study/words.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/paths.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::WorkFolder;
using Strings = std::vector<std::string>;

StudyFile read_text(const std::string& yaml) {
  static const WorkFolder folder;
  return read_study(folder.write("study.yaml", yaml));
}

/// Problems without the folder's name; a study that is right has none.
Strings problems_of(const std::string& yaml) {
  try {
    read_text(yaml);
  } catch (const InputError& error) {
    Strings problems = error.problems();
    for (auto& problem : problems) {
      const auto name = problem.find("study.yaml:");
      if (name != problem.npos) problem.erase(0, name);
    }
    return problems;
  }
  return {};
}

bool has(const Strings& problems, const std::string& part) {
  return std::any_of(problems.begin(), problems.end(),
                     [&](const std::string& text) { return text.find(part) != text.npos; });
}

std::string joined(const Strings& problems) {
  std::string text;
  for (const auto& problem : problems) text += problem + "\n";
  return text;
}

/// A study from its lines; what a test is about replaces or joins the sections.
std::string with(const std::map<std::string, std::string>& sections) {
  std::map<std::string, std::string> all{
      {"format", "sunload-study-1"},
      {"name", "test"},
      {"site", "{latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague}"},
      {"period", "{days: [2026-03-21]}"},
      {"scene", "{builtin: {name: street}}"}};
  for (const auto& [key, value] : sections) all[key] = value;
  std::string text;
  for (const auto& [key, value] : all) {
    if (!value.empty()) text += key + ": " + value + "\n";
  }
  return text;
}

void expect_problem(const std::map<std::string, std::string>& sections, const std::string& part) {
  const auto problems = problems_of(with(sections));
  EXPECT_TRUE(has(problems, part)) << "wanted: " << part << "\ngot:\n" << joined(problems);
}

void expect_right(const std::map<std::string, std::string>& sections) {
  const auto problems = problems_of(with(sections));
  EXPECT_TRUE(problems.empty()) << joined(problems);
}

TEST(Study, FillsInDefaults) {
  const auto file = read_text(with({}));
  ASSERT_EQ(file.variants.size(), 1u);
  const Study& study = file.variants[0];
  EXPECT_EQ(file.name, "test");
  EXPECT_EQ(study.name, "test");
  EXPECT_EQ(study.variant, "baseline");
  EXPECT_EQ(study.site.latitude_deg, 50);
  EXPECT_FALSE(study.site.north_deg);
  EXPECT_EQ(std::get<DaysPeriod>(study.period.kind).days.size(), 1u);
  EXPECT_FALSE(study.solver.batch_suns);
  EXPECT_EQ(study.output.series.size(), 6u);
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_EQ(file.yaml, with({}));
}

/// Section `scene` with one material.
std::string scene_of(const std::string& material) {
  return "{builtin: {name: street}, materials: {a: {" + material + "}}}";
}

/// The section `scene` of the built-in street with these steps.
std::map<std::string, std::string> steps(const std::string& list) {
  return {{"scene", "{builtin: {name: street}, edit: [" + list + "]}"}};
}

TEST(StudyEdit, ReadsSteps) {
  const Study study =
      read_text(with(steps("{object: house_1, raise: {storeys: 2, storey_m: 3.2}}, "
                           "{near: {position_m: [1, 2]}, remove: true}, "
                           "{add: {box: {position_m: [0, 0], size_m: [4, 2, 3], turn_deg: 90}}}, "
                           "{add: {tree: {position_m: [1, 2, 3], height_m: 8, crown_m: 5}}}")))
          .variants.front();
  ASSERT_EQ(study.scene.edit.size(), 4u);
  EXPECT_EQ(study.scene.edit[0].objects.object, "house_1");
  EXPECT_EQ(std::get<RaiseEdit>(study.scene.edit[0].action).by_m, 6.4);
  EXPECT_EQ(study.scene.edit[1].objects.near->v, 2);
  const auto& box = std::get<AddPrismEdit>(study.scene.edit[2].action);
  EXPECT_FALSE(box.base_m);
  EXPECT_EQ(box.height_m, 3);
  EXPECT_NEAR(box.areas.areas[0][0][0].u, -1, 1e-12);  // a cosine of 90 degrees
  EXPECT_EQ(std::get<AddTreesEdit>(study.scene.edit[3].action).base_m, 3);
}

TEST(StudySelections, AreResolvedWhereTheyAreNamed) {
  auto keys = with(steps("{selection: ends, remove: true}"));
  const Study study =
      read_text(keys +
                "selections: {ends: {object: 'house_?'}, south: {surface: wall, "
                "azimuth_deg: [135, 225], height_m: [0, 4], near: {position_m: [1, 2], "
                "within_m: 30}, polygon: [[0, 0], [9, 0], [0, 9]]}}\n")
          .variants.front();
  ASSERT_EQ(study.selections.size(), 2u);
  EXPECT_EQ(study.scene.edit[0].selection->of.object, "house_?");
  const SelectionStudy& south = study.selections[1].of;
  EXPECT_EQ(south.azimuth_deg, (std::array{135.0, 225.0}));
  EXPECT_EQ(south.height_m, (std::array{0.0, 4.0}));
  EXPECT_EQ(south.within_m, 30);
  EXPECT_EQ(south.polygon.areas[0][0].size(), 3u);
}

TEST(StudySelections, RefuseAreasThatCrossThemselves) {
  const std::string bow = "polygon: [[0, 0], [9, 9], [9, 0], [0, 9]]";
  const std::string said = "polygon: crosses itself near [4.5, 4.5]";
  expect_problem({{"selections", "{s: {" + bow + "}}"}}, said);
  expect_problem(steps("{" + bow + ", remove: true}"), said);
  expect_problem(steps("{add: {footprint: {height_m: 3, " + bow + "}}}"), said);
}

TEST(StudyVariants, TakeMaterialsAwayThatTheStudyDoesNotDefine) {
  const StudyFile file =
      read_text(with({}) +
                "variants:\n  - {name: a, scene: {materials: {plaster: ~, brick: "
                "{diffuse: 0.3}}}}\n");
  ASSERT_EQ(file.variants[0].scene.materials.size(), 1u);
  EXPECT_EQ(file.variants[0].scene.materials[0].name, "brick");
}

TEST(StudyEdit, VariantsAppendSteps) {
  const StudyFile file = read_text(with(steps("{object: a, remove: true}")) +
                                   "variants:\n  - {name: a}\n  - {name: b, scene: {edit: "
                                   "[{object: b, move_m: [1, 0, 0]}]}}\n");
  ASSERT_EQ(file.variants[0].scene.edit.size(), 1u);
  ASSERT_EQ(file.variants[1].scene.edit.size(), 2u);
  EXPECT_EQ(std::get<MoveEdit>(file.variants[1].scene.edit[1].action).by, (Vec3{1, 0, 0}));
}

TEST(StudyEdit, RefusesWhatIsNoStep) {
  expect_problem(steps("{object: a}"), "a step does nothing (one of remove, raise, move_m,");
  expect_problem(steps("{object: a, remove: true, move_m: [1, 2, 3]}"), "does several things");
  expect_problem(steps("{remove: true}"), "a step chooses no objects");
  expect_problem(steps("{object: a, remove: yes}"), "'yes' is not known (must be one of true)");
  expect_problem(steps("{object: a, raise: {storeys: 2}}"), "raise.storey_m is missing");
  expect_problem(steps("{object: a, raise: {}}"), "write by_m, or storeys and storey_m");
  expect_problem(steps("{object: a, move_m: [1, 2]}"), "must be three numbers along x, y and z");
  expect_problem(steps("{object: a, add: {box: {position_m: [0, 0], size_m: [1, 1, 1]}}}"),
                 "stands beside a choice of objects");
  expect_problem(steps("{add: {box: {position_m: [0, 0], size_m: [1, 0, 1]}}}"), "not above 0");
  expect_problem(steps("{add: {}}"), "add does nothing (one of box, footprint, tree, trees, file)");
  expect_problem(steps("{add: {tree: {position_m: [0, 0], height_m: 3, crown_m: 2, trunk_m: 3}}}"),
                 "is not below height_m");
  expect_problem(steps("{add: {tree: {position_m: [0, 0], height_m: 3, crown_m: 2, every_m: 3}}}"),
                 "stands alone");
  expect_problem(steps("{polygon: [[0, 0], [1, 1]], remove: true}"), "three corners or more");
  expect_problem(steps("{polygon: [[0, 0], [1, x], [0, 1]], remove: true}"), "two numbers, [x, y]");
  expect_problem(steps("{polygon: no.json, remove: true}"), "'no.json' is not there");
  expect_problem(steps("{object: a, replace: {file: no.obj}}"), "scene.edit[1].replace.file");
}

TEST(StudyMaterials, KindsExcludeEachOther) {
  for (const char* right :
       {"refractive_index: 1.52",
        "diffuse: 0.1, refractive_index: 1.52, panes: 3, thickness_m: 0.006",
        "refractive_index: 1.52, absorption_per_m: 30",
        "refractive_index: 0.05, extinction_coefficient: 4",
        "diffuse: 0.2, mirror: 0.1, glossy: 0.4, glossy_exponent: 30, transmittance: 0.3",
        "diffuse: 0.2, transmittance: 0.8, sides: two", "normal_transmittance: 0.88, sides: two",
        "normal_transmittance: 0.9823", "diffuse: 0.02, mirror: 0.08, normal_transmittance: 0.884"})
    expect_right({{"scene", scene_of(right)}});
  const std::pair<const char*, const char*> wrong[] = {
      {"refractive_index: 0.9", "0.9 is not above 1"},
      {"refractive_index: 1.5, mirror: 0.1", "a.mirror: cannot stand with refractive_index"},
      {"refractive_index: 1.5, transmittance: 0.1", "a.transmittance: cannot stand with"},
      {"refractive_index: 1.5, glossy: 0.1, glossy_exponent: 2", "a.glossy: cannot stand with"},
      {"extinction_coefficient: 3", "stands without refractive_index"},
      {"refractive_index: 1.5, extinction_coefficient: 3, panes: 2", "a.panes: cannot stand with"},
      {"refractive_index: 1.5, normal_transmittance: 0.8",
       "a.refractive_index: cannot stand with normal_transmittance"},
      {"normal_transmittance: 0.8, panes: 2", "a.panes: cannot stand with normal_transmittance"},
      {"normal_transmittance: 0.8, thickness_m: 0.01", "a.thickness_m: cannot stand with"},
      {"normal_transmittance: 0.8, extinction_coefficient: 3",
       "a.extinction_coefficient: cannot stand with"},
      {"normal_transmittance: 0.5, transmittance: 0.2",
       "a.transmittance: cannot stand with normal_transmittance"},
      {"normal_transmittance: 0.5, glossy: 0.2, glossy_exponent: 9", "a.glossy: cannot stand with"},
      {"normal_transmittance: 0", "a.normal_transmittance"},
      {"normal_transmittance: 0.9824", "a.normal_transmittance: 0.9824 is above 0.9823 ("},
      {"normal_transmittance: 1.1", "a.normal_transmittance"},
      {"normal_transmittance: 0.885, mirror: 0.08, diffuse: 0.02", "0.885 is above 0.884 ("},
      {"normal_transmittance: 0.3, mirror: 1", "0.3 is above 0 ("},
      {"glossy: 0.3", "stands without glossy_exponent"},
      {"diffuse: 0.5, transmittance: 0.6", "diffuse + transmittance = 1.1 is above 1"},
      {"diffuse: 0.4, mirror: 0.3, glossy: 0.2, glossy_exponent: 3, transmittance: 0.2",
       "diffuse + mirror + glossy + transmittance = 1."}};
  for (const auto& [material, part] : wrong) expect_problem({{"scene", scene_of(material)}}, part);
  for (const char* unused : {"panes: 2", "glossy_exponent: 30", "absorption_per_m: 3"})
    EXPECT_EQ(read_text(with({{"scene", scene_of(unused)}})).warnings.size(), 1u) << unused;
}

TEST(Study, ReadsEverySection) {
  const Study study = read_text(R"(
format: sunload-study-1
name: all
site: {crs: "EPSG:28992", elevation_m: 3, timezone: Europe/Amsterdam, north_deg: -1.5}
period: {start: 2026-06-21T00:00, end: 2026-06-22T00:00, step_min: 15}
sun: {refraction: bennett, disk: point, ut1_utc: zero}
light: {source: clear_sky, model: bird, linke_turbidity: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12],
        sky: cie_general, sky_type: 5, far_ground_albedo: 0.3, quantity: irradiance}
scene:
  builtin: {name: canyon, height: 20}
  repair: all
  materials: {glass: {diffuse: 0.05, mirror: 0.95, emission_w_m2: 10, sides: two}, red: {diffuse: 0.3}}
  assign: [{object: "a*", surface: wall, was: x, type: Building, material: glass}]
  ground: {margin_m: 10, material: red}
mesh: {max_edge_m: 0.5, min_area_m2: 0.1}
solver: {transport: gather, bounces: 3, unshot: 0.01, year: each, lines_per_patch: 128, direct_samples: 32,
         realizations: 16, mirror_depth: 2, batch_suns: 32, isa: avx2, seed: 7, power_per_sample_w: auto}
output: {folder: out, series: [total, sky], standard_error: instants, compression: 9,
         significant_bits: 10}
)")
                          .variants[0];
  EXPECT_EQ(study.site.crs, "EPSG:28992");
  EXPECT_EQ(study.site.north_deg, -1.5);
  const auto& period = std::get<RangePeriod>(study.period.kind);
  EXPECT_EQ(period.end.civil.day, 22);
  EXPECT_EQ(period.step_min, 15);
  EXPECT_EQ(study.sun.refraction, Refraction::bennett);
  EXPECT_EQ(study.sun.ut1_utc, Ut1::zero);
  EXPECT_EQ(study.light.model, ClearSkyModel::bird);
  EXPECT_EQ(study.light.linke_turbidity.monthly[11], 12);
  EXPECT_EQ(study.light.sky, SkyModel::cie_general);
  EXPECT_EQ(study.light.sky_type, 5);
  EXPECT_EQ(study.scene.builtin->parameters.at("height"), "20");
  EXPECT_EQ(study.scene.repair, Repair::all);
  ASSERT_EQ(study.scene.materials.size(), 2u);
  EXPECT_EQ(study.scene.materials[0].sides, Sides::two);
  EXPECT_FALSE(study.scene.materials[1].mirror);
  EXPECT_EQ(study.scene.assign[0].kind, "Building");
  EXPECT_EQ(study.scene.assign[0].material_was, "x");
  EXPECT_EQ(study.scene.ground->margin_m, 10);
  EXPECT_EQ(study.mesh.max_edge_m, 0.5);
  EXPECT_EQ(study.solver.realizations, 16);
  EXPECT_EQ(study.solver.isa, "avx2");
  EXPECT_EQ(study.output.series, (Strings{"total", "sky"}));
  EXPECT_EQ(study.output.standard_error, StandardErrors::instants);
  EXPECT_EQ(study.output.significant_bits, 10);
}

TEST(Study, ReadsSignificantBits) {
  const auto bits = [](const std::string& value) {
    return read_text(with({{"output", "{significant_bits: " + value + "}"}}))
        .variants[0]
        .output.significant_bits;
  };
  EXPECT_EQ(bits("auto"), std::nullopt);
  EXPECT_EQ(bits("off"), float_mantissa_bits);
  EXPECT_EQ(bits("1"), 1);
  for (const char* wrong : {"0", "24", "many", "2.5", "[9]"})
    expect_problem({{"output", std::string("{significant_bits: ") + wrong + "}"}},
                   "significant_bits");
}

TEST(Study, ReadsStepsOfSeries) {
  const auto step = [](const std::string& value) {
    return word_of(read_text(with({{"output", "{series_step: " + value + "}"}}))
                       .variants[0]
                       .output.series_step);
  };
  for (const char* word : {"interval", "day", "month", "5 min", "60 min", "720 min"})
    EXPECT_EQ(step(word), word);
  for (const char* wrong : {"60", "hour", "0 min", "-5 min", "1.5 min", "060 min", "60 minutes",
                            "7 min", "1440 min", "99999 min", "[day]"})
    expect_problem({{"output", std::string("{series_step: ") + wrong + "}"}}, "series_step");
  expect_problem({{"output", "{series_step: 7 min}"}}, "does not divide a day");
  expect_problem({{"output", "{series_step: 2000 min}"}}, "write day, month");
  expect_problem({{"output", "{series_step: day, standard_error: instants}"}},
                 "cannot go with standard_error: instants");
}

TEST(Study, ReadsPartsOfThePeriod) {
  const auto totals = [](const std::string& value) {
    return read_text(with({{"output", "{totals: " + value + "}"}})).variants[0].output.totals;
  };
  EXPECT_FALSE(totals("auto"));
  EXPECT_TRUE(totals("none")->empty());
  EXPECT_EQ(totals("[hour_of_day, month]"),
            (std::vector<PartKind>{PartKind::month, PartKind::hour_of_day}));
  for (const char* wrong : {"[week]", "[day, day]", "daily", "[]"})
    EXPECT_FALSE(problems_of(with({{"output", std::string("{totals: ") + wrong + "}"}})).empty())
        << wrong;
}

TEST(Study, ReadsTheShootingTransport) {
  const auto solver = [](const std::string& keys) {
    return read_text(with({{"solver", "{" + keys + "}"}}));
  };
  const Study study =
      solver("transport: shoot, jacobi: regular, power_per_sample_w: 0.25").variants[0];
  EXPECT_EQ(study.solver.transport, Transport::shoot);
  EXPECT_EQ(study.solver.jacobi, Jacobi::regular);
  EXPECT_EQ(study.solver.power_per_sample_w, 0.25);
  const auto by_default = solver("power_per_sample_w: auto, transport: shoot");
  EXPECT_EQ(by_default.variants[0].solver.jacobi, Jacobi::incremental);
  EXPECT_FALSE(by_default.variants[0].solver.power_per_sample_w);
  EXPECT_TRUE(by_default.warnings.empty());
  // Gathering has no samples of power.
  EXPECT_EQ(solver("jacobi: regular, power_per_sample_w: 2").warnings.size(), 2u);
  for (const char* wrong : {"power_per_sample_w: 0", "power_per_sample_w: -1",
                            "power_per_sample_w: some", "jacobi: gauss", "transport: throw"})
    EXPECT_FALSE(problems_of(with({{"solver", std::string("{") + wrong + "}"}})).empty()) << wrong;
}

TEST(Study, ReadsHowManyIntervalsABatchHas) {
  const auto batch = [](const std::string& keys) {
    return read_text(with({{"solver", "{" + keys + "}"}})).variants[0].solver.batch_suns;
  };
  EXPECT_EQ(batch("batch_suns: 3"), 3);
  EXPECT_FALSE(batch("batch_suns: auto"));
  EXPECT_FALSE(batch("bounces: 1"));
}

TEST(Study, ReadsTheSunsOfAnInterval) {
  const auto suns = [](const std::string& keys) {
    return read_text(with({{"solver", "{" + keys + "}"}}))
        .variants[0]
        .solver.sun_samples_per_interval;
  };
  EXPECT_EQ(suns("bounces: 1"), 1);
  EXPECT_EQ(suns("sun_samples_per_interval: 3"), 3);
  EXPECT_FALSE(suns("sun_samples_per_interval: auto"));
  for (const char* wrong : {"0", "-1", "2.5", "257", "some"})
    EXPECT_FALSE(
        problems_of(with({{"solver", std::string("{sun_samples_per_interval: ") + wrong + "}"}}))
            .empty())
        << wrong;
}

TEST(Study, FilesHaveUnitsAndPlacesOfTheirOwn) {
  const WorkFolder folder;
  folder.write("a.obj", "v 0 0 0\n");
  const auto read = [&](const std::string& files) {
    return read_study(folder.write("s.yaml", with({{"scene", "{files: [" + files + "]}"}})));
  };
  const auto files =
      read(
          "a.obj, {file: a.obj, up: y, unit_m: 0.001, position_m: [1, 2, 3], turn_deg: 30, "
          "material: brick}, {file: a.obj, position: \"50 14\", height_m: 200}")
          .variants[0]
          .scene.files;
  ASSERT_EQ(files.size(), 3u);
  EXPECT_FALSE(files[0].is_placed());
  EXPECT_EQ(files[1].up, 'y');
  EXPECT_EQ(files[1].unit_m, 0.001);
  EXPECT_EQ(files[1].position, (Vec3{1, 2, 3}));
  EXPECT_EQ(files[1].turn_deg, 30);
  EXPECT_EQ(files[1].material, "brick");
  EXPECT_EQ(files[2].earth_position->latitude_deg, 50);
  EXPECT_EQ(files[2].earth_position->longitude_deg, 14);
  EXPECT_EQ(files[2].earth_position->height_m, 200);
  const auto wrong = [&](const std::string& list, const std::string& part) {
    try {
      read(list);
      ADD_FAILURE() << list;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  wrong("a.obj, a.obj", "'a.obj' is written twice in the same place");
  wrong("{up: y}", "scene.files[1].file is missing");
  wrong("{file: a.obj, position_m: [1, 2]}", "must be three numbers");
  wrong("{file: a.obj, position_m: [1, 2, 3], position: \"50 14\"}", "remove one");
  wrong("{file: a.obj, position: here}", "scene.files[1].position");
  wrong("{file: a.obj, canopy: a.obj}", "canopy: stands without terrain");
  wrong("{file: a.obj, terrain: b.tif}", "scene.files[1].terrain: 'b.tif' is not there");
  wrong("{file: a.obj, trun_deg: 3}", "did you mean 'turn_deg'");
  EXPECT_EQ(read("{file: a.obj, height_m: 3, least_height_m: 3, trunk_share: 0}").warnings.size(),
            3u);
}

TEST(Study, ResolvesPathsFromTheStudysFolder) {
  const WorkFolder folder;
  folder.write("models/a.obj", "v 0 0 0\n");
  const auto text = with({{"scene", "{files: [../models/a.obj], up: y, unit_m: 0.001}"}});
  const Study study = read_study(folder.write("studies/s.yaml", text)).variants[0];
  ASSERT_EQ(study.scene.files.size(), 1u);
  EXPECT_EQ(study.scene.files[0].path, folder.path() + "/models/a.obj");
  EXPECT_EQ(study.scene.up, 'y');
  expect_problem({{"scene", "{files: [../models/b.obj]}"}},
                 "study.yaml:4:17: scene.files: '../models/b.obj' is not there");
  EXPECT_THROW(read_study(folder.path() + "/nothing.yaml"), InputError);
  EXPECT_THROW(read_study(folder.path()), InputError);
}

TEST(Study, ReportsAllProblemsAtOnceFromTopToBottom) {
  // Where, which key, and what helps; the rest of a sentence may change.
  struct Expected {
    const char *place, *key, *hint;
  };
  constexpr std::array expected{
      Expected{"study.yaml:2:7:", "name: 'a b'", "letters"},
      Expected{"study.yaml:3:7:", "site.latitude_deg", "missing"},
      Expected{"study.yaml:3:7:", "site.timezone", "timezone: Europe/Prague"},
      Expected{"study.yaml:3:8:", "'latitude'", "'latitude_deg'"},
      Expected{"study.yaml:3:36:", "site.longitude_deg", "from -180 up to 180 degrees"},
      Expected{"study.yaml:5:25:", "scene.builtin.name", "'street'"},
      Expected{"study.yaml:6:20:", "mesh.max_edge_m", "from 1e-06"}};
  const auto problems = problems_of(
      "format: sunload-study-1\nname: a b\nsite: {latitude: 5, longitude_deg: 200}\n"
      "period: {days: [2026-03-21]}\nscene: {builtin: {name: stret}}\n"
      "mesh: {max_edge_m: 0}\n");
  ASSERT_EQ(problems.size(), expected.size()) << joined(problems);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& said = problems[i];
    EXPECT_TRUE(said.starts_with(expected[i].place)) << said;
    EXPECT_LT(said.find(expected[i].key), said.rfind(expected[i].hint)) << said;
    EXPECT_NE(said.rfind(expected[i].hint), said.npos) << said;
  }
}

TEST(Study, ChecksTheSite) {
  expect_problem({{"site", "{latitude_deg: 113, longitude_deg: 49, timezone: UTC}"}},
                 "are latitude and longitude swapped?");
  expect_problem({{"site", "{latitude_deg: 50, timezone: UTC}"}}, "site.longitude_deg is missing");
  expect_problem({{"site", "{timezone: UTC}"}}, "site has no position");
  expect_problem({{"site", "{latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prag}"}},
                 "study.yaml:5:55: site.timezone: ");
  expect_problem({{"site", "{latitude_deg: 50, longitude_deg: 14}"}}, "site.timezone is missing");
  expect_right({{"site", "{latitude_deg: 50, longitude_deg: 14}"},
                {"period", "{instants: [2026-03-21T12:00Z, 2026-03-21T15:00+01:00]}"}});
}

TEST(Study, ReadsPositionsAsPeopleWriteThem) {
  const auto site = [](const std::string& position) {
    return read_text(with({{"site", "{position: " + position + ", timezone: UTC}"}}))
        .variants[0]
        .site;
  };
  const auto dms = site("\"49d44'51\\\"N 13d22'39\\\"E\"");
  EXPECT_NEAR(*dms.latitude_deg, 49.7475, 1e-12);
  EXPECT_NEAR(*dms.longitude_deg, 13.3775, 1e-12);
}

TEST(Study, ChecksPositions) {
  expect_problem({{"site", "{position: 33x, timezone: UTC}"}},
                 "study.yaml:5:18: site.position: '33x' is no position on Earth");
  expect_problem(
      {{"site", "{position: 50 14, latitude_deg: 50, longitude_deg: 14, timezone: UTC}"}},
      "site.position: stands beside latitude_deg and longitude_deg");
}

TEST(Study, KnowsDaysByName) {
  const auto days = [](const std::string& site, const std::string& list) {
    const auto file = read_text(with({{"site", site}, {"period", "{days: [" + list + "]}"}}));
    std::string text;
    for (const auto& day : std::get<DaysPeriod>(file.variants[0].period.kind).days)
      text += fmt::format("{}-{}-{} ", day.year, day.month, day.day);
    return text;
  };
  const std::string prague = "{latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague}";
  const std::string cape = "{latitude_deg: -34, longitude_deg: 18, timezone: Africa/Johannesburg}";
  EXPECT_EQ(days(prague,
                 "march_equinox 2026, 2026-05-01, summer_solstice 2026, "
                 "september_equinox 2026, winter_solstice 2026"),
            "2026-3-20 2026-5-1 2026-6-21 2026-9-23 2026-12-21 ");
  EXPECT_EQ(days(cape, "winter_solstice 2026, summer_solstice 2026"), "2026-6-21 2026-12-21 ");
}

TEST(Study, ChecksDaysByName) {
  expect_problem({{"period", "{days: [june_solstice]}"}},
                 "study.yaml:3:17: period.days: 'june_solstice' has no year");
  expect_problem({{"period", "{days: [midsummer 2026]}"}}, "names: march_equinox, june_solstice");
  expect_problem({{"period", "{days: [june_solstice 2026, march_equinox 2026]}"}},
                 "march_equinox 2026 is not after the day before it");
  expect_problem(
      {{"site", "{crs: EPSG:28992, timezone: UTC}"}, {"period", "{days: [summer_solstice 2026]}"}},
      "depends on the hemisphere");
}

TEST(Study, TakesNoTildeForAHomeFolder) {
  expect_problem({{"output", "{folder: ~/results}"}}, "begins with ~");
}

TEST(Study, ChecksTheTimes) {
  const auto wrong = [](const std::string& period, const std::string& part) {
    expect_problem({{"period", period}}, part);
  };
  wrong("{step_min: 5}", "period has no times");
  wrong("{days: [2026-03-21], instants: [2026-03-21]}", "period has days and instants at once");
  wrong("{days: [2026-06-21, 2026-03-21]}", "2026-03-21 is not after the day before it");
  wrong("{days: [2026-06-21, 2026-06-21]}", "is not after the day before it");
  wrong("{days: [2026-06-21T12:00]}", "has a time of day");
  wrong("{days: [2026-02-29]}", "is no date of the calendar");
  wrong("{days: [0000-06-21]}", "is no date of the calendar");
  wrong("{days: 2026-06-21}", "write [2026-06-21]");
  wrong("{days: []}", "the list is empty");
  wrong("{days: [2026-06-21], from: '20:00', to: '06:00'}", "is not after `from`");
  wrong("{days: [2026-06-21], from: '6 h'}", "'6 h' is no time of day");
  wrong("{days: [2026-06-21], step_min: 7}", "no whole number of steps of 7 minutes");
  for (const char* length : {"0", "1e-300", "1e-9"}) {
    const std::string too_short = "out of range (must be from 0.001";
    wrong("{days: [2026-06-21], step_min: " + std::string(length) + "}", too_short);
    wrong("{instants: [2026-06-21T12:00], interval_min: " + std::string(length) + "}", too_short);
  }
  wrong("{start: 2026-06-21, end: 2026-07-01, step_min: 0.001}", "14400000 intervals are too many");
  wrong("{days: [2026-06-21], end: 2026-06-22}", "period.end: does not go with `days`");
  wrong("{start: 2026-06-21}", "period.end is missing");
  wrong("{start: 2026-06-21, end: 2026-06-21}", "is not after `start`");
  wrong("{start: 2026-03-28, end: 2026-03-30, step_min: 1440}", "23 or 25 hours");
  wrong("{instants: [2026-06-21T12:00, 2026-06-21T11:00]}", "is not after the one before it");
  wrong("{instants: [2026-06-21T12:00+02:00, 2026-06-21T10:00Z]}", "is not after the one before");
  wrong("{positions: [{azimuth_deg: 90, elevation_deg: 30}]}",
        "positions need light.source: fixed");
  wrong("{year_of: weather}", "year_of: weather needs light.source: weather");
  wrong("{year_of: weather, step_min: 10}", "period.step_min: does not go with `year_of`");
  wrong("{days: [2026-06-21], as_year: 2004}", "period.as_year: does not go with `days`");
  expect_right({{"period", "{days: [2026-06-20, 2026-06-21], from: 05:00, to: '24:00'}"}});
  expect_right({{"period", "{start: 2026-03-28, end: 2026-03-30, step_min: 60}"}});
  expect_right({{"site", ""},
                {"period", "{positions: [{azimuth_deg: 90, elevation_deg: 30}]}"},
                {"light", "{source: fixed, dni_w_m2: 800, dhi_w_m2: 100}"}});
}

TEST(Study, ChecksLightSceneAndSolver) {
  expect_problem({{"light", "{source: fixed, dni_w_m2: 800}"}}, "fixed needs dhi_w_m2");
  expect_problem({{"light", "{source: weather, weather: x.epw}"}},
                 "light.weather: 'x.epw' is not there");
  expect_problem({{"light", "{source: weather}"}}, "light.source: weather needs a file");
  expect_problem({{"light", "{source: weather, weather: x.epw, stamp: begin}"}}, "light.stamp");
  expect_problem({{"light", "{linke_turbidity: [3, 3]}"}}, "has 2 values");
  expect_problem({{"light", "{sky: prez}"}}, "did you mean 'perez'?");
  expect_problem({{"scene", "{up: z}"}}, "scene has neither files nor builtin");
  expect_problem({{"scene", "{builtin: {name: street, house_4: brick}}"}},
                 "did you mean 'house_3'?");
  expect_problem({{"scene", "{builtin: {name: street}, lod: best}"}}, "is no level of detail");
  expect_problem({{"scene", "{builtin: {name: street}, ground: some}"}}, "must be one of none");
  expect_problem({{"scene", "{builtin: {name: street}, assign: [{object: x}]}"}},
                 "scene.assign[1].material is missing");
  expect_problem(
      {{"scene", "{builtin: {name: street}, materials: {a: {diffuse: 0.6, mirror: 0.5}}}"}},
      "diffuse + mirror = 1.1 is above 1");
  expect_right(
      {{"scene", "{builtin: {name: street}, materials: {a: {diffuse: 0.7, mirror: 0.3}}}"}});
  expect_problem({{"solver", "{lines_per_patch: 100}"}}, "write 96 or 104");
  expect_problem({{"solver", "{direct_samples: 4}"}}, "write 8");
  expect_problem({{"solver", "{realizations: 1}"}}, "out of range");
  expect_problem({{"solver", "{accuracy: {light_load_relative: 0}}"}}, "out of range");
  expect_problem({{"solver", "{accuracy: {}}"}}, "light_load_relative is missing");
  expect_problem({{"solver", "{accuracy: {light_load_relative: 0.01}, max_lines_per_patch: 128}"}},
                 "is below the least counts");
  expect_problem({{"solver", "{bands: rgb, transport: shoot}"}}, "cannot go with transport: shoot");
  expect_problem({{"output", "{series: [total, totl]}"}}, "'totl' is not known");
  expect_problem({{"output", "{series: all}"}}, "none");
  expect_problem({{"output", "{series: [sky, sky]}"}}, "is written twice");
  expect_problem({{"sensors", "{points: []}"}}, "the list is empty");
  expect_problem({{"light", "{sky: perez, sky_scale: absolute}"}}, "cannot go with sky: perez");
  expect_problem({{"light", "{sky: uniform, sky_scale: absolute}"}},
                 "needs zenith_luminance_cd_m2");
  expect_problem({{"light", "{sky: cie_clear, sky_scale: absolute, source: weather}"}},
                 "cannot go with source: weather");
  expect_problem({{"light", "{sky: cie_clear, source: fixed, dni_w_m2: 1}"}},
                 "fixed needs dhi_w_m2");
  expect_right({{"light", "{sky: cie_clear, sky_scale: absolute, source: fixed, dni_w_m2: 1}"}});
  expect_right({{"light", "{sky: uniform, sky_scale: absolute, zenith_luminance_cd_m2: 3000}"}});
  expect_problem({{"solver", "{bands: rgb, transport: matrix}"}},
                 "cannot go with transport: matrix");
  expect_problem({{"solver", "{year: modes, transport: matrix}"}}, "modes cannot go with");
  expect_problem({{"solver", "{accuracy: {light_load_relative: 0.1}, transport: matrix}"}},
                 "cannot go with transport: matrix");
  expect_problem({{"format", "sunload-study-9"}}, "must be one of sunload-study-1");
  expect_problem({{"period", ""}}, "period is missing");
  expect_problem({{"name", ".hidden"}}, "cannot be a name");
}

TEST(Study, WarnsOfValuesWithoutEffect) {
  const auto warnings = read_text(with({{"light", "{turbidity: 4, dni_w_m2: 3}"}})).warnings;
  EXPECT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(has(warnings, "light.turbidity: is not used")) << joined(warnings);
  // Bird takes its aerosols from it.
  const auto bird = read_text(with({{"light", "{model: bird, linke_turbidity: 3}"}})).warnings;
  EXPECT_FALSE(has(bird, "light.linke_turbidity")) << joined(bird);
  const auto plain = read_text(with({{"light", "{model: haurwitz, linke_turbidity: 3}"}})).warnings;
  EXPECT_TRUE(
      has(plain, "light.linke_turbidity: is not used (it belongs to model: ineichen or bird"))
      << joined(plain);
  EXPECT_TRUE(has(
      read_text(with({{"period", "{instants: [2026-06-21T12:00, 2026-06-21T12:10]}"}})).warnings,
      "intervals overlap"));
}

TEST(Study, MergesVariants) {
  const auto file = read_text(with(
      {{"scene", "{builtin: {name: street, house_3: brick}, assign: [{material: a}]}"},
       {"light", "{sky: cie_general, sky_type: 3}"},
       {"variants",
        "[{name: baseline}, {name: glazed, scene: {builtin: {house_3: glazed}, assign: [{material: "
        "b}]}, light: {sky: uniform, sky_type: ~}, solver: {bounces: 2}}]"}}));
  ASSERT_EQ(file.variants.size(), 2u);
  const Study &base = file.variants[0], &glazed = file.variants[1];
  EXPECT_EQ(base.variant, "baseline");
  EXPECT_EQ(glazed.variant, "glazed");
  EXPECT_EQ(glazed.scene.builtin->name, "street");
  EXPECT_EQ(base.scene.builtin->parameters.at("house_3"), "brick");
  EXPECT_EQ(glazed.scene.builtin->parameters.at("house_3"), "glazed");
  EXPECT_EQ(base.scene.assign.size(), 1u);
  ASSERT_EQ(glazed.scene.assign.size(), 2u);
  EXPECT_EQ(glazed.scene.assign[1].material, "b");
  EXPECT_EQ(glazed.light.sky, SkyModel::uniform);
  EXPECT_EQ(base.solver.bounces, 5);
  EXPECT_EQ(glazed.solver.bounces, 2);
  EXPECT_EQ(glazed.site.latitude_deg, 50);
  EXPECT_TRUE(file.warnings.empty()) << joined(file.warnings);
}

TEST(Study, ChecksVariants) {
  const auto wrong = [](const std::string& variants, const std::string& part) {
    expect_problem({{"variants", variants}}, part);
  };
  wrong("[{name: A}, {name: a}]", "'a' is used twice (case makes no difference)");
  wrong("[{name: x/y}]", "'x/y' cannot be a name");
  wrong("[{scene: {}}]", "variants[1].name is missing");
  wrong("[]", "the list is empty");
  wrong("[{name: a, sun: {}}]", "a variant cannot change this");
  wrong("[{name: a, matrix: {}}]", "a variant cannot change this (a matrix makes variants)");
  wrong("[{name: a, site: {elevation_m: 3}}]", "a variant cannot change site.elevation_m");
  wrong("[{name: a, solver: {batch_suns: 3}}]", "a variant cannot change solver.batch_suns");
  wrong("[{name: a, solver: {isa: avx2}}]", "a variant cannot change solver.isa");
  wrong("[{name: a, secne: {}}]", "did you mean 'scene'?");
  // Each problem once, and at the variant's own line.
  EXPECT_EQ(problems_of(with({{"mesh", "{max_edge_m: -1}"}}) +
                        "variants:\n  - {name: a}\n  - {name: b, mesh: {min_area_m2: -1}}\n"),
            (Strings{"study.yaml:2:20: mesh.max_edge_m: -1 is out of range (must be from 1e-06 up "
                     "to 1000000000 metres)",
                     "study.yaml:9:35: mesh.min_area_m2: -1 is out of range (must be from 0 up to "
                     "1000000 square metres)"}));
}

// --- measures -----------------------------------------------------------------------------

std::map<std::string, std::string> measured(const std::string& measures) {
  return {{"measures", measures}};
}

TEST(StudyMeasures, AreReadWithTheDefaultsOfTheirRule) {
  const auto file = read_text(
      with(measured("{b: {rule: csn_73_4301}, a: {rule: en_17037, date: 2026-02-10, "
                    "least_elevation_deg: 13, of: {facade: 'house_1/*', surface: wall}}}")));
  const auto& measures = file.variants[0].measures;
  ASSERT_EQ(measures.size(), 2u);
  EXPECT_EQ(measures[0].name, "b");
  EXPECT_EQ(measures[0].number("least_elevation_deg"), 5);
  EXPECT_EQ(measures[0].number("least_plan_angle_deg"), 25);
  EXPECT_EQ(measures[0].number("area_percent"), 50);
  EXPECT_FALSE(measures[0].date);
  EXPECT_EQ(measures[1].of.facade, "house_1/*");
  EXPECT_EQ(measures[1].date->day, 10);
  EXPECT_EQ(measures[1].number("least_elevation_deg"), 13);
}

TEST(StudyMeasures, RefuseWhatTheirRuleDoesNotKnow) {
  const auto expect = [](const std::string& measures, const std::string& part) {
    expect_problem(measured(measures), part);
  };
  expect("{a: {}}", "measures.a.rule is missing");
  expect("{a: {rule: csn}}", "'csn'");
  expect("{a: {rule: en_17037}}", "measures.a.least_elevation_deg is missing");
  expect("{a: {rule: sun_hours}}", "measures.a.date is missing");
  expect("{a: {rule: bre_209_vsc, least_h: 2}}", "rule bre_209_vsc has no such limit");
  expect("{a: {rule: bre_209_vsc, date: 2026-03-01}}", "rule bre_209_vsc has no such limit");
  expect("{a: {rule: csn_73_4301, count: longest}}", "rule csn_73_4301 has no such limit");
  expect("{a: {rule: csn_73_4301, date: \"2026-03-01T12:00\"}}", "has a time of day");
  expect("{a: {rule: csn_73_4301, date: 2026-02-30}}", "measures.a.date");
  expect("{a: {rule: en_17037, least_elevation_deg: 13, date: 2026-06-21}}",
         "wants a day from 1 February to 21 March");
  expect("{a-b: {rule: csn_73_4301}}", "'a-b' cannot be the name of a measure");
  expect("{a_end: {rule: csn_73_4301}}", "'a_end' cannot be the name of a measure");
  expect("{a: {rule: bre_209_probable_sun}}", "needs light.source: weather");
  expect("{a: {rule: light_hours}}", "measure a needs above_w_m2");
  expect_problem(
      {{"measures", "{a: {rule: roof_potential}}"}, {"light", "{quantity: illuminance}"}},
      "measure a needs light.quantity: irradiance");
  expect("{a: {rule: light_hours, above_lx: 100}}", "measure a needs above_w_m2");
  expect_problem(
      {{"measures", "{a: {rule: glint_hours, above_w_m2: 100}}"}, {"output", "{series: [total]}"}},
      "measure a watches the series mirror");
  expect_problem({{"measures", "{a: {rule: csn_73_4301}}"},
                  {"period", "{positions: [{azimuth_deg: 180, elevation_deg: 30}]}"},
                  {"light", "{source: fixed, dni_w_m2: 800, dhi_w_m2: 100}"}},
                 "measure a needs a period with dates");
}

TEST(StudyMeasures, AreNoPartOfTheCanonicalText) {
  const auto text_of = [](const std::string& measures) {
    return read_text(with(measured(measures))).variants[0];
  };
  const Study none = text_of(""), one = text_of("{a: {rule: csn_73_4301}}");
  EXPECT_EQ(canonical_text(none), canonical_text(one));
  EXPECT_EQ(measures_text(none), "");
  const std::string least = measures_text(one);
  for (const char* other :
       {"{b: {rule: csn_73_4301}}", "{a: {rule: bre_209_garden}}",
        "{a: {rule: csn_73_4301, date: 2026-03-02}}", "{a: {rule: csn_73_4301, least_h: 2}}",
        "{a: {rule: csn_73_4301, area_percent: 60}}",
        "{a: {rule: csn_73_4301, of: {surface: wall}}}",
        "{a: {rule: csn_73_4301, of: {object: x}}}", "{a: {rule: csn_73_4301, of: {facade: x}}}"})
    EXPECT_NE(measures_text(text_of(other)), least) << other;
  EXPECT_EQ(measures_text(text_of("{a: {rule: csn_73_4301, least_h: 1.5}}")), least);
}

Strings names_of(const StudyFile& file) {
  Strings names;
  for (const Study& study : file.variants) names.push_back(study.variant);
  return names;
}

TEST(StudyMatrix, MakesAVariantOfEveryCombination) {
  const StudyFile file =
      read_text(with({{"scene",
                       "{builtin: {name: street}, materials: {m: {diffuse: 0.2}}, edit: "
                       "[{object: a, raise: {storeys: 0, storey_m: 3}}]}"},
                      {"matrix",
                       "{'scene.edit[1].raise.storeys': [0, 2], "
                       "scene.materials.m.diffuse: [0.1, 0.5], site.north_deg: [10]}"}}));
  EXPECT_EQ(names_of(file),
            (Strings{"storeys-0_diffuse-0.1_north_deg-10", "storeys-0_diffuse-0.5_north_deg-10",
                     "storeys-2_diffuse-0.1_north_deg-10", "storeys-2_diffuse-0.5_north_deg-10"}));
  const Study& last = file.variants.back();
  EXPECT_EQ(std::get<RaiseEdit>(last.scene.edit[0].action).by_m, 6);
  EXPECT_EQ(last.scene.materials[0].diffuse, 0.5);
  EXPECT_EQ(last.site.north_deg, 10);
  const SceneStudy scene = scene_of_text(file.yaml, last.variant);  // as a result keeps it
  EXPECT_EQ(std::get<RaiseEdit>(scene.edit[0].action).by_m, 6);
}

TEST(StudyMatrix, GoesOverVariantsAndNamesValues) {
  const StudyFile file = read_text(
      with({{"matrix",
             "{scene: {as_is: {}, no_shed: {edit: [{object: shed, remove: true}]}}, "
             "period: {spring: {}, summer: {days: [2026-06-21]}}}"},
            {"variants", "[{name: a}, {name: b, scene: {edit: [{object: b, remove: true}]}}]"}}));
  EXPECT_EQ(names_of(file),
            (Strings{"a_as_is_spring", "a_as_is_summer", "a_no_shed_spring", "a_no_shed_summer",
                     "b_as_is_spring", "b_as_is_summer", "b_no_shed_spring", "b_no_shed_summer"}));
  ASSERT_EQ(file.variants.back().scene.edit.size(), 2u);  // appended, as those of variants
  EXPECT_EQ(file.variants.back().scene.edit[1].objects.object, "shed");
  EXPECT_EQ(std::get<DaysPeriod>(file.variants.back().period.kind).days[0].month, 6);
}

TEST(StudyMatrix, RefusesWhatMakesNoVariants) {
  const auto wrong = [](const std::string& matrix, const std::string& part) {
    expect_problem({{"matrix", matrix}}, part);
  };
  wrong("[1]", "must be a map of keys and their values");
  wrong("{solver.bounces: 3}", "must be a list of values, or a map of named ones");
  wrong("{solver.bounces: []}", "matrix.solver.bounces: has no values");
  wrong("{solver.bounces: [[1]]}", "a value of a list must be a single one");
  wrong("{solver.bounces: [1, x]}", "solver.bounces: 'x' is no number");
  wrong("{solver.bounces: [1, 1]}", "makes 'bounces-1' twice");
  wrong("{solver.bouncs: [1]}", "did you mean 'bounces'?");
  wrong("{solver..a: [1]}", "'solver..a' is no key of a study");
  wrong("{'scene.edit[1].remove': [true]}", "scene.edit[1] is not there (the list has 0 items)");
  wrong("{solver.batch_suns: [1, 2]}", "a variant cannot change solver.batch_suns");
  wrong("{site.latitude_deg: [1, 2]}", "a variant cannot change site.latitude_deg");
  wrong("{output.folder: [a]}", "a variant cannot change output.folder");
  wrong("{name: [a]}", "a variant cannot change name");
  const std::string part =
      "matrix: makes more than 3000 variants (each of them is a run of its own)";
  std::string many = "1", named = "{name: v1}";
  for (int k = 2; k <= 60; ++k) {
    many += ", " + std::to_string(k);
    named += ", {name: v" + std::to_string(k) + "}";
  }
  wrong("{solver.seed: [" + many + "], solver.bounces: [" + many + "]}", part);
  expect_problem({{"matrix", "{solver.seed: [" + many + "]}"}, {"variants", "[" + named + "]"}},
                 part);
}

// --- the schema ---------------------------------------------------------------------------

json read_schema() {
  std::ifstream file(test::source_folder() + "/configs/study.schema.json");
  return json::parse(file);
}

/// Calls `visit(path, schema)` for every key, `scene.materials.*.diffuse`.
void walk(const json& schema, const std::string& path,
          const std::function<void(const std::string&, const json&)>& visit) {
  const std::string dot = path.empty() ? "" : path + ".";
  const json properties = schema.value("properties", json::object());
  for (const auto& [key, value] : properties.items()) {
    visit(dot + key, value);
    walk(value, dot + key, visit);
  }
  if (schema.contains("items")) walk(schema["items"], path + "[]", visit);
  const auto others = schema.find("additionalProperties");
  if (others != schema.end() && others->is_object()) {
    if (!others->contains("properties")) visit(dot + "*", *others);
    walk(*others, dot + "*", visit);
  }
  for (const auto& choice : schema.value("anyOf", json::array())) walk(choice, path, visit);
}

TEST(StudySchema, ListsTheKeysThatTheReaderKnows) {
  std::set<std::string> in_schema;
  walk(read_schema(), "", [&](const std::string& path, const json& schema) {
    in_schema.insert(path);
    const bool told = schema.contains("description") || schema.contains("const");
    EXPECT_TRUE(told) << path << " has no description";
  });
  const Strings known = study_keys();
  EXPECT_EQ(Strings(in_schema.begin(), in_schema.end()), known);
}

/// A step of scene.edit in which the key can stand, and has an effect.
json step_around(const std::string& path) {
  const std::string file = test::source_folder() + "/LICENSE";
  const json corners = {{0, 0}, {1, 0}, {0, 1}};
  json step = {{"object", "a*"}};
  const auto is_in = [&](const std::string& key) {
    return path.starts_with("scene.edit[]." + key);
  };
  if (is_in("turn")) {
    step["turn"] = {{"by_deg", 10}};
  } else if (is_in("replace")) {
    step["replace"] = {{"file", file}};
  } else if (is_in("add.box") || is_in("add.name") || is_in("add.material")) {
    step = {{"add", {{"box", {{"position_m", {0, 0}}, {"size_m", {1, 1, 1}}}}}}};
  } else if (is_in("add.footprint")) {
    step = {{"add", {{"footprint", {{"polygon", corners}, {"height_m", 9}}}}}};
  } else if (is_in("add.trees")) {
    step = {{"add", {{"trees", {{"file", file}}}}}};
  } else if (is_in("add.tree")) {
    step = {{"add", {{"tree", {{"position_m", {0, 0}}, {"height_m", 160}, {"crown_m", 1}}}}}};
    step["add"]["tree"]["height_m"] = 150;
    if (is_in("add.tree.every_m")) step["add"]["tree"]["to_m"] = {50, 0};
    if (is_in("add.tree.to_m")) step["add"]["tree"]["every_m"] = 5;
  } else if (is_in("add.file")) {
    step = {{"add", {{"file", {{"file", file}}}}}};
  } else if (is_in("raise.storey")) {
    step["raise"] = {{"storeys", 1}, {"storey_m", 2}};
  } else if (is_in("raise.from_m")) {
    step["raise"] = {{"by_m", 1}};
  } else if (!is_in("remove") && !is_in("move_m") && !is_in("raise")) {
    step["remove"] = true;
  }
  if (is_in("near.within_m")) step["near"] = {{"position_m", {0, 0}}};
  return step;
}

/// A luminaire with what a key of it needs beside it.
json luminaire_around(const std::string& path) {
  json luminaire = {{"position_m", {0, 0, 5}}, {"intensity_cd", 100}};
  if (path.ends_with(".to_m")) luminaire["every_m"] = 5;
  if (path.ends_with(".every_m")) luminaire["to_m"] = {50, 0, 5};
  if (path.ends_with(".file")) luminaire = {{"position_m", {0, 0, 5}}, {"flux_lm", 1000}};
  if (path.ends_with(".flux_lm"))
    luminaire = {{"position_m", {0, 0, 5}}, {"file", test::source_folder() + "/LICENSE"}};
  return luminaire;
}

/// A study in which the key can stand.
json study_around(const std::string& path) {
  json study = json::parse(R"({"format": "sunload-study-1", "name": "test",
    "site": {"latitude_deg": 50, "longitude_deg": 14, "timezone": "UTC"},
    "period": {"days": ["2026-03-21"]}, "scene": {"builtin": {"name": "street"},
    "materials": {"m": {}}, "assign": [{"material": "m"}], "ground": {"material": "m"}}})");
  const json fixed = {{"source", "fixed"}, {"dni_w_m2", 800}, {"dhi_w_m2", 100}};
  const json sun = {{"azimuth_deg", 90}, {"elevation_deg", 30}};
  if (path == "period.interval_min") {
    study["period"] = {{"instants", {"2026-03-21T12:00"}}};
  } else if (path == "period.as_year" || path == "period.year_of") {
    study["period"] = {{"year_of", "weather"}};
  } else if (path.starts_with("period.positions") || path == "site.timezone") {
    study["period"] = {{"positions", json::array({sun})}};
    study["light"] = fixed;
  }
  if (path == "scene.materials.*.seasons.*" || path == "light.far_ground_seasons.*")
    study["seasons"]["m"] = {"11-01", "04-15"};
  if (path == "scene.ground.height_m") study["scene"]["ground"]["surface"] = "level";
  if (path == "site.timezone") study["site"].erase("timezone");
  if (path.starts_with("scene.edit")) study["scene"]["edit"] = json::array({step_around(path)});
  if (path.starts_with("scene.luminaires") || path.ends_with("emission_lm_m2"))
    study["light"]["quantity"] = "illuminance";
  if (path.starts_with("scene.luminaires"))
    study["scene"]["luminaires"] = json::array({luminaire_around(path)});
  if (path.starts_with("scene.files")) {
    study["scene"].erase("builtin");
    study["scene"]["files"] = json::array({{{"file", test::source_folder() + "/LICENSE"}}});
  }
  return study;
}

json& place_in(json& study, const std::string& path) {
  json* place = &study;
  std::stringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');) {
    const bool list = part.ends_with("[]");
    if (list) part.resize(part.size() - 2);
    place = &(*place)[part == "*" ? "m" : part];
    if (list) place = &(*place)[0];
  }
  return *place;
}

Strings problems_with(const std::string& path, const json& value) {
  json study = study_around(path);
  place_in(study, path) = value;
  return problems_of(study.dump());
}

// JSON is YAML: the schema's own limits, words and defaults are tried on the reader.
TEST(StudySchema, HasTheRangesAndWordsOfTheReader) {
  int limits = 0, words = 0;
  walk(read_schema(), "", [&](const std::string& path, const json& schema) {
    const auto refused = [&](const json& value) {
      return has(problems_with(path, value), "is out of range");
    };
    const bool is_integer = schema.contains("type") && schema["type"] == "integer";
    const bool is_number = schema.contains("type") && schema["type"] == "number";
    const auto beyond = [&](const json& bound, int way) -> json {
      if (is_integer) return bound.get<std::int64_t>() + way;
      return std::nextafter(bound.get<double>(), way * std::numeric_limits<double>::max());
    };
    if (schema.contains("minimum")) {
      ++limits;
      EXPECT_FALSE(refused(schema["minimum"])) << path;
      EXPECT_TRUE(refused(beyond(schema["minimum"], -1))) << path;
    }
    if (schema.contains("exclusiveMinimum")) {
      ++limits;
      EXPECT_TRUE(refused(schema["exclusiveMinimum"])) << path;
      EXPECT_FALSE(refused(beyond(schema["exclusiveMinimum"], 1))) << path;
    }
    // Beyond the largest seed there is no number to try.
    if (schema.contains("maximum") && path != "solver.seed") {
      ++limits;
      EXPECT_FALSE(refused(schema["maximum"])) << path;
      EXPECT_TRUE(refused(beyond(schema["maximum"], 1))) << path;
    }
    if (is_number || is_integer) {
      EXPECT_TRUE(has(problems_with(path, "much"), "is no number")) << path;
    }
    std::string list;
    for (const auto& word : schema.value("enum", json::array())) {
      ++words;
      list += (list.empty() ? "" : ", ") + word.get<std::string>();
      const auto problems = problems_with(path, word);
      EXPECT_FALSE(has(problems, "is not known") || has(problems, "supported")) << path << word;
    }
    // The refusal lists all words that the reader knows.
    if (!list.empty()) {
      EXPECT_TRUE(has(problems_with(path, "nonsense"), list + ")")) << path;
    }
  });
  EXPECT_GT(limits, 40);
  EXPECT_GT(words, 25);
}

TEST(StudySchema, HasTheDefaultsOfTheReader) {
  int defaults = 0;
  walk(read_schema(), "", [&](const std::string& path, const json& schema) {
    if (!schema.contains("default")) return;
    ++defaults;
    json study = study_around(path);
    const Study absent = read_text(study.dump()).variants[0];
    place_in(study, path) = schema["default"];
    const Study written = read_text(study.dump()).variants[0];
    EXPECT_EQ(canonical_text(absent), canonical_text(written)) << path;
    EXPECT_EQ(absent.solver.isa, written.solver.isa);
    EXPECT_EQ(absent.output.folder, written.output.folder);
    EXPECT_EQ(absent.output.series, written.output.series);
    EXPECT_EQ(absent.output.standard_error, written.output.standard_error);
    EXPECT_EQ(absent.output.compression, written.output.compression);
    EXPECT_EQ(absent.output.totals, written.output.totals);
    EXPECT_EQ(absent.output.significant_bits, written.output.significant_bits);
    EXPECT_EQ(word_of(absent.output.series_step), word_of(written.output.series_step));
  });
  EXPECT_GT(defaults, 30);
}

TEST(StudyConfigs, AreRead) {
  int read = 0;
  std::vector<fs::directory_entry> entries;
  for (const char* folder : {"/configs", "/configs/mcrad"})
    for (const auto& entry : fs::directory_iterator(test::source_folder() + folder))
      entries.push_back(entry);
  for (const auto& entry : entries) {
    if (entry.path().extension() != ".yaml") continue;
    // A model that does not come with the project: below.
    if (entry.path().stem() == "delft_day") continue;
    ++read;
    try {
      const auto file = read_study(entry.path().string());
      const bool historic = entry.path().parent_path().stem() == "mcrad";
      EXPECT_EQ(file.name, (historic ? "mcrad_" : "") + entry.path().stem().string());
      EXPECT_TRUE(file.warnings.empty()) << joined(file.warnings);
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GE(read, 10);
}

TEST(StudyConfigs, OfARealModelSayWhereItCanBeHad) {
  const WorkFolder folder;
  const auto study = test::bytes_of(test::source_folder() + "/configs/delft_day.yaml");
  const auto path = folder.write("delft_day.yaml", study);
  try {
    read_study(path);
    ADD_FAILURE() << "the model is not there";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("models/delft_lod1_v20.city.json' is not there"), said.npos) << said;
    EXPECT_NE(said.find("github.com/cityjson/cjio"), said.npos) << said;
    EXPECT_NE(said.find("licence MIT"), said.npos) << said;
  }
  folder.write("models/delft_lod1_v20.city.json", "{}");
  EXPECT_EQ(read_study(path).name, "delft_day");
}

// --- the canonical text -------------------------------------------------------------------

struct Change {
  const char* name;
  std::function<void(Study&)> apply;
};

Study rich_study() {
  Study study =
      read_text(with({{"scene",
                       "{builtin: {name: street}, materials: {a: {}, b: {}}, assign: [{material: "
                       "a}], ground: {}}"}}))
          .variants[0];
  SceneFileStudy file;
  file.path = "x";
  file.position = Vec3{1, 2, 3};
  file.earth_position = {50, 14, 0};
  file.terrain = "y";
  study.scene.files = {file};
  return study;
}

template <class Kind>
Change with_period(const char* name, std::function<void(Kind&)> apply) {
  return {name, [apply](Study& study) { apply(std::get<Kind>(study.period.kind)); }};
}

void expect_seen(const Study& study, const std::vector<Change>& changes) {
  for (const auto& change : changes) {
    Study changed = study;
    change.apply(changed);
    EXPECT_NE(canonical_text(study), canonical_text(changed)) << change.name;
  }
}

TEST(CanonicalText, SeesEveryValueThatCanChangeANumber) {
  expect_seen(
      rich_study(),
      {{"latitude", [](Study& s) { *s.site.latitude_deg += 1e-13; }},
       {"longitude", [](Study& s) { *s.site.longitude_deg += 1e-13; }},
       {"crs", [](Study& s) { s.site.crs = "x"; }},
       {"elevation", [](Study& s) { s.site.elevation_m = 0; }},
       {"timezone", [](Study& s) { s.site.timezone = "UTC"; }},
       {"north", [](Study& s) { s.site.north_deg = 0; }},
       {"refraction", [](Study& s) { s.sun.refraction = Refraction::none; }},
       {"ut1", [](Study& s) { s.sun.ut1_utc = Ut1::zero; }},
       {"disk", [](Study& s) { s.sun.disk = SunDisk::finite; }},
       {"horizon",
        [](Study& s) {
          s.site.horizon = Horizon({{0, 5}});
        }},
       {"source", [](Study& s) { s.light.source = LightSource::fixed; }},
       {"model", [](Study& s) { s.light.model = ClearSkyModel::bird; }},
       {"linke", [](Study& s) { s.light.linke_turbidity.monthly[7] += 1; }},
       {"dni", [](Study& s) { s.light.dni_w_m2 = 1; }},
       {"dhi", [](Study& s) { s.light.dhi_w_m2 = 1; }},
       {"sky", [](Study& s) { s.light.sky = SkyModel::uniform; }},
       {"sky_type", [](Study& s) { s.light.sky_type = 1; }},
       {"turbidity", [](Study& s) { s.light.turbidity = 4; }},
       {"sky scale", [](Study& s) { s.light.sky_scale = SkyScale::absolute; }},
       {"zenith", [](Study& s) { s.light.zenith_luminance_cd_m2 = 1000; }},
       {"bands", [](Study& s) { s.solver.bands = Bands::rgb; }},
       {"far ground", [](Study& s) { s.light.far_ground_albedo = 0; }},
       {"builtin", [](Study& s) { s.scene.builtin->name = "x"; }},
       {"builtin parameter", [](Study& s) { s.scene.builtin->parameters["a"] = "b"; }},
       {"no builtin", [](Study& s) { s.scene.builtin.reset(); }},
       {"up", [](Study& s) { s.scene.up = 'y'; }},
       {"unit", [](Study& s) { s.scene.unit_m = 2; }},
       {"lod", [](Study& s) { s.scene.lod = "1"; }},
       {"repair", [](Study& s) { s.scene.repair = Repair::all; }},
       {"orient", [](Study& s) { s.scene.orient = Orientation::keep; }},
       {"up of a file", [](Study& s) { s.scene.files[0].up = 'y'; }},
       {"unit of a file", [](Study& s) { s.scene.files[0].unit_m = 1; }},
       {"lod of a file", [](Study& s) { s.scene.files[0].lod = "1"; }},
       {"position", [](Study& s) { s.scene.files[0].position->z = 4; }},
       {"no position", [](Study& s) { s.scene.files[0].position.reset(); }},
       {"position on Earth", [](Study& s) { s.scene.files[0].earth_position->height_m = 4; }},
       {"turn", [](Study& s) { s.scene.files[0].turn_deg = 4; }},
       {"material of a file", [](Study& s) { s.scene.files[0].material = "x"; }},
       {"blocks", [](Study& s) { s.scene.files[0].terrain.clear(); }},
       {"canopy", [](Study& s) { s.scene.files[0].canopy = "x"; }},
       {"least height", [](Study& s) { s.scene.files[0].least_height_m = 1; }},
       {"trunk", [](Study& s) { s.scene.files[0].trunk_share = 0; }},
       {"footprints", [](Study& s) { s.scene.files[0].footprints.height = "h"; }},
       {"storey", [](Study& s) { s.scene.files[0].footprints.storey_m = 4; }},
       {"default height", [](Study& s) { s.scene.files[0].footprints.default_height_m = 4; }},
       {"material name", [](Study& s) { s.scene.materials[0].name = "c"; }},
       {"diffuse", [](Study& s) { s.scene.materials[0].diffuse = 0; }},
       {"mirror", [](Study& s) { s.scene.materials[0].mirror = 0; }},
       {"panes", [](Study& s) { s.scene.materials[0].smooth = Panes{1.5}; }},
       {"glossy", [](Study& s) { s.scene.materials[0].glossy = 0.1; }},
       {"exponent", [](Study& s) { s.scene.materials[0].glossy_exponent = 10; }},
       {"transmittance", [](Study& s) { s.scene.materials[0].transmittance = 0.1; }},
       {"emission", [](Study& s) { s.scene.materials[1].emission_w_m2 = 1; }},
       {"sides", [](Study& s) { s.scene.materials[1].sides = Sides::one; }},
       {"fewer materials", [](Study& s) { s.scene.materials.pop_back(); }},
       {"assign object", [](Study& s) { s.scene.assign[0].object = "x"; }},
       {"assign surface", [](Study& s) { s.scene.assign[0].surface = "wall"; }},
       {"assign was", [](Study& s) { s.scene.assign[0].material_was = "x"; }},
       {"assign type", [](Study& s) { s.scene.assign[0].kind = "x"; }},
       {"assign material", [](Study& s) { s.scene.assign[0].material = "b"; }},
       {"no rules", [](Study& s) { s.scene.assign.clear(); }},
       {"ground wanted", [](Study& s) { s.scene.ground->wanted = false; }},
       {"ground surface", [](Study& s) { s.scene.ground->surface = GroundSurface::level; }},
       {"ground height", [](Study& s) { s.scene.ground->height_m = 3; }},
       {"ground margin", [](Study& s) { s.scene.ground->margin_m = 1; }},
       {"ground material", [](Study& s) { s.scene.ground->material = "b"; }},
       {"ground by default", [](Study& s) { s.scene.ground.reset(); }},
       {"max edge", [](Study& s) { s.mesh.max_edge_m = 1; }},
       {"min area", [](Study& s) { s.mesh.min_area_m2 = 1; }},
       {"transport", [](Study& s) { s.solver.transport = Transport::shoot; }},
       {"matrix", [](Study& s) { s.solver.transport = Transport::matrix; }},
       {"jacobi", [](Study& s) { s.solver.jacobi = Jacobi::regular; }},
       {"power per sample", [](Study& s) { s.solver.power_per_sample_w = 0.5; }},
       {"bounces", [](Study& s) { s.solver.bounces = 1; }},
       {"unshot", [](Study& s) { s.solver.unshot = 0; }},
       {"year", [](Study& s) { s.solver.year = Year::each; }},
       {"lines", [](Study& s) { s.solver.lines_per_patch = 8; }},
       {"samples", [](Study& s) { s.solver.direct_samples = 8; }},
       {"suns of an interval", [](Study& s) { s.solver.sun_samples_per_interval = 2; }},
       {"as many suns as it takes", [](Study& s) { s.solver.sun_samples_per_interval.reset(); }},
       {"realizations", [](Study& s) { s.solver.realizations = 4; }},
       {"mirror depth", [](Study& s) { s.solver.mirror_depth = 1; }},
       {"batch suns", [](Study& s) { s.solver.batch_suns = 1; }},
       {"accuracy", [](Study& s) { s.solver.accuracy = AccuracyStudy{0.02}; }},
       {"another accuracy", [](Study& s) { s.solver.accuracy = AccuracyStudy{0.03}; }},
       {"accuracy of instants",
        [](Study& s) {
          s.solver.accuracy = AccuracyStudy{{}, 0.02};
        }},
       {"most lines",
        [](Study& s) {
          s.solver.accuracy = AccuracyStudy{0.02};
          s.solver.max_lines_per_patch = 512;
        }},
       {"seed", [](Study& s) { s.solver.seed = 9007199254740993; }},
       with_period<DaysPeriod>("day", [](DaysPeriod& p) { p.days[0].day = 2; }),
       with_period<DaysPeriod>("from", [](DaysPeriod& p) { p.from_s = 1; }),
       with_period<DaysPeriod>("to", [](DaysPeriod& p) { p.to_s = 1; }),
       with_period<DaysPeriod>("step", [](DaysPeriod& p) { p.step_min = 1; })});
}

TEST(CanonicalText, TellsPanesMetalsAndClearGlassApart) {
  const std::vector<Smooth> kinds{ConstantShares{},
                                  Panes{1.5},
                                  Panes{1.6},
                                  Panes{.refractive_index = 1.5, .thickness_m = 0.01},
                                  Panes{.refractive_index = 1.5, .absorption_per_m = 10},
                                  Panes{.refractive_index = 1.5, .count = 2},
                                  Metal{1.5, 3},
                                  Metal{1.6, 3},
                                  Metal{1.5, 4},
                                  ClearGlass{0.8},
                                  ClearGlass{0.9}};
  std::set<std::string> texts;
  for (const Smooth& kind : kinds) {
    Study study = rich_study();
    study.scene.materials[0].smooth = kind;
    texts.insert(canonical_text(study));
  }
  EXPECT_EQ(texts.size(), kinds.size());
}

/// A study in which the key has an effect.
json study_to_see(const std::string& path) {
  json study = study_around(path);
  const auto starts = [&](const char* with) { return path.starts_with(with); };
  if (starts("period.start") || starts("period.end"))
    study["period"] = {{"start", "2026-03-21"}, {"end", "2026-03-23"}};
  if (path == "period.instants") study["period"] = {{"instants", {"2026-03-21T12:00"}}};
  if (path == "period.as_year")
    study["light"] = {{"source", "weather"}, {"weather", test::source_folder() + "/LICENSE"}};
  if (path == "light.source") study["light"] = {{"dni_w_m2", 800}, {"dhi_w_m2", 100}};
  if (path == "light.sky_scale") study["light"]["sky"] = "preetham";
  if (path == "light.zenith_luminance_cd_m2")
    study["light"] = {{"sky", "preetham"}, {"sky_scale", "absolute"}};
  if (path == "light.colour") study["solver"]["bands"] = "rgb";
  if (path == "site.position" || path == "site.latitude_deg" || path == "site.longitude_deg")
    study["site"] = {{"timezone", "UTC"}, {"position", "49d44'51\"N 13d22'39\"E"}};
  if (path == "site.latitude_deg" || path == "site.longitude_deg")
    study["site"] = {{"timezone", "UTC"}, {"latitude_deg", 49}, {"longitude_deg", 14}};
  if (starts("scene.files")) study["scene"]["files"][0]["position"] = "49d44'51\"N 13d22'39\"E";
  if (path == "scene.files[].position_m") study["scene"]["files"][0].erase("position");
  for (const char* of_rasters : {"canopy", "least_height_m", "trunk_share"})
    if (path == std::string("scene.files[].") + of_rasters)
      study["scene"]["files"][0]["terrain"] = test::source_folder() + "/LICENSE";
  auto& material = study["scene"]["materials"]["m"];
  for (const char* of_an_index :
       {"extinction_coefficient", "thickness_m", "absorption_per_m", ".panes"})
    if (path.ends_with(of_an_index)) material["refractive_index"] = 1.5;
  if (path.ends_with(".glossy")) material["glossy_exponent"] = 10;
  if (path == "mesh.light_threshold_m2") study["mesh"]["oracle"] = "historic";
  if (path == "solver.max_lines_per_patch")
    study["solver"]["accuracy"]["light_load_relative"] = 0.02;
  if (path == "solver.power_per_sample_w") study["solver"]["transport"] = "shoot";
  return study;
}

/// Values that the schema lets stand under a key, some of them.
std::vector<json> values_of(const std::string& path, const json& schema) {
  const std::string file = test::source_folder() + "/LICENSE";
  const json corners = {{0, 0}, {2, 0}, {0, 1}};
  const std::map<std::string, std::vector<json>> texts{
      {"site.position", {"50d00'00\"N 14d00'00\"E"}},
      {"site.crs", {"EPSG:28992", "EPSG:32633"}},
      {"site.timezone", {"UTC", "Europe/Prague"}},
      {"site.horizon", {test::source_folder() + "/tests/fuzz/corpus/horizon/pvgis.csv"}},
      {"period.days", {{"2026-03-22"}}},
      {"period.from", {"06:00", "07:00"}},
      {"period.to", {"17:00", "18:00"}},
      {"period.start", {"2026-03-20"}},
      {"period.end", {"2026-03-24"}},
      {"period.instants", {{"2026-03-21T13:00"}}},
      {"scene.files[].lod", {"1", "2.2"}},
      {"scene.files[].position", {"50d00'00\"N 14d00'00\"E"}},
      {"scene.files[].material", {"m"}},
      {"scene.files[].terrain", {file}},
      {"scene.files[].canopy", {file}},
      {"scene.files[].file", {file, test::source_folder() + "/README.md"}},
      {"scene.parallel_sources", {file}},
      {"scene.luminaires[].file", {file}},
      {"sensors.file", {file}},
      {"scene.builtin.name", {"street", "canyon"}},
      {"scene.materials.*.seasons.*", {"m", "n"}},
      {"seasons.*", {{"11-01", "04-15"}, {1, 2}}},
      {"scene.lod", {"1", "2.2"}},
      {"scene.assign[].object", {"a"}},
      {"scene.assign[].was", {"a"}},
      {"scene.assign[].type", {"a"}},
      {"scene.assign[].material", {"m", "n"}},
      {"scene.ground.material", {"m", "n"}},
      {"scene.land", {{"a"}, {"b"}}},
      {"scene.edit[].object", {"a", "b"}},
      {"scene.files[].footprints.height", {"a"}},
      {"scene.files[].footprints.storeys", {"a"}},
      {"scene.files[].footprints.base", {"a"}},
      {"scene.files[].footprints.name", {"a"}},
      {"scene.files[].footprints.layer", {"a"}},
      {"scene.edit[].add.trees.file", {test::source_folder() + "/README.md"}},
      {"scene.edit[].add.trees.layer", {"a"}},
      {"scene.edit[].add.trees.height", {"a"}},
      {"scene.edit[].add.trees.crown", {"a"}},
      {"scene.edit[].add.trees.name", {"a"}},
      {"scene.edit[].add.trees.leaves", {"a"}},
      {"scene.edit[].add.trees.trunk", {"a"}},
      {"scene.edit[].type", {"a"}},
      {"scene.edit[].polygon", std::vector<json>(1, corners)},
      {"scene.edit[].replace.file", {file, test::source_folder() + "/README.md"}},
      {"scene.edit[].replace.material", {"m"}},
      {"scene.edit[].add.file.file", {file, test::source_folder() + "/README.md"}},
      {"scene.edit[].add.file.material", {"m"}},
      {"scene.edit[].add.name", {"a"}},
      {"scene.edit[].add.material", {"m"}},
      {"scene.edit[].add.footprint.polygon", std::vector<json>(1, corners)},
      {"scene.edit[].add.tree.leaves", {"m"}},
      {"scene.edit[].add.tree.trunk", {"m"}},
      {"name", {"one", "other"}},
      {"variants[].name", {"one", "other"}},
      {"output.folder", {"a", "b"}},
      {"output.series", {{"total"}, {"sky"}}}};
  if (const auto known = texts.find(path); known != texts.end()) return known->second;
  std::vector<json> values = schema.value("enum", std::vector<json>{});
  if (schema.contains("const")) values.push_back(schema["const"]);
  for (const auto& choice : schema.value("anyOf", json::array()))
    for (const json& value : values_of(path, choice)) values.push_back(value);
  const std::string type =
      schema.contains("type") && schema["type"].is_string() ? schema["type"] : "";
  if (type == "number" || type == "integer") values = {0.25, 0.5, 1, 2.5, 3, 16, 64, 1024, 2005};
  if (type == "array" && schema["items"].value("type", "") == "number")
    for (const double value : {1.0, 0.25})
      values.push_back(std::vector<double>(schema.value("minItems", std::size_t{1}), value));
  return values;
}

/// Texts of the studies that differ in nothing but this key; those that are refused left out.
std::set<std::string> texts_by(const std::string& path, const json& schema) {
  std::vector<json> studies{study_to_see(path)};
  for (const json& value : values_of(path, schema)) {
    studies.push_back(study_to_see(path));
    place_in(studies.back(), path) = value;
  }
  std::set<std::string> texts;
  for (const json& study : studies)
    if (problems_of(study.dump()).empty())
      texts.insert(canonical_text(read_text(study.dump()).variants.back()));
  return texts;
}

// Keys are walked through, so that a new one is seen or named here.
TEST(CanonicalText, SeesEveryKeyOfTheSchemaButThese) {
  const std::set<std::string> others{
      // Names and what is shown or stored.
      "name", "variants[].name", "format", "output.folder", "output.series", "output.compression",
      // Hashed apart: bytes of files, points of sensors, the instruction set in force, the standard
      // errors of instants, which are more datasets, and roundings.
      "scene.files[].file", "scene.files[].source", "scene.parallel_sources", "light.weather",
      "sensors.file", "sensors.points[].position_m", "sensors.points[].normal",
      "sensors.points[].tilt_deg", "sensors.points[].azimuth_deg", "solver.isa",
      // Made of finished batches (measures_text).
      "measures.*.rule", "measures.*.of.object", "measures.*.of.facade", "measures.*.of.surface",
      "measures.*.of.selection", "measures.*.date", "measures.*.least_elevation_deg",
      "measures.*.least_angle_deg", "measures.*.least_plan_angle_deg", "measures.*.least_span_min",
      "measures.*.least_dni_w_m2", "measures.*.above_w_m2", "measures.*.above_lx",
      "measures.*.least_h", "measures.*.most_h", "measures.*.least_percent",
      "measures.*.area_percent", "measures.*.count", "measures.*.season", "measures.*.light",
      // So are selections, but for what rules and steps that name one choose (selection_test).
      "selections.*.object", "selections.*.type", "selections.*.facade", "selections.*.surface",
      "selections.*.azimuth_deg", "selections.*.height_m", "selections.*.polygon",
      "selections.*.near.position_m", "selections.*.near.within_m", "selections.*.except",
      "scene.assign[].selection", "scene.edit[].selection", "scene.cut",
      // So are the parts of the period that have totals.
      "output.standard_error", "output.significant_bits", "output.totals", "output.series_step",
      // One word only, beside which no other period can stand; any parameter of built-in scenes.
      "period.year_of", "scene.edit[].remove", "scene.builtin.*",
      // Of files that are edited in, the mesh has the bytes; what a matrix says becomes variants.
      "matrix.*"};
  std::set<std::string> unseen;
  walk(read_schema(), "", [&](const std::string& path, const json& schema) {
    const bool has_keys =
        schema.contains("properties") ||
        schema.value("items", json::object()).contains("properties") ||
        (schema.contains("additionalProperties") && schema["additionalProperties"].is_object()) ||
        path.starts_with("variants[].") || path == "scene.files" || path == "scene.ground";
    if (path == "variants[].name" || !has_keys)
      if (texts_by(path, schema).size() < 2) unseen.insert(path);
  });
  EXPECT_EQ(unseen, others);
}

TEST(CanonicalText, HasWordsForChoices) {
  const json text = json::parse(canonical_text(read_text(with({})).variants[0]));
  EXPECT_EQ(text["mesh"]["oracle"], "default");
  EXPECT_EQ(text["sun"]["disk"], "point");
  EXPECT_EQ(text["solver"]["transport"], "gather");
}

TEST(CanonicalText, SeesEveryKindOfPeriod) {
  Study study = rich_study();
  const std::string days = canonical_text(study);
  study.period.kind = RangePeriod{};
  EXPECT_NE(canonical_text(study), days);
  expect_seen(
      study,
      {with_period<RangePeriod>("start", [](RangePeriod& p) { p.start.civil.second = 1e-3; }),
       with_period<RangePeriod>("end", [](RangePeriod& p) { p.end.civil.minute = 1; }),
       with_period<RangePeriod>("zone", [](RangePeriod& p) { p.end.has_offset = true; }),
       with_period<RangePeriod>("step", [](RangePeriod& p) { p.step_min = 1; })});
  study.period.kind = InstantsPeriod{{ParsedTime{{}, true, true, 0}}, 60};
  expect_seen(study, {with_period<InstantsPeriod>(
                          "offset", [](InstantsPeriod& p) { p.instants[0].offset_s = 3600; }),
                      with_period<InstantsPeriod>("interval",
                                                  [](InstantsPeriod& p) { p.interval_min = 1; })});
  study.period.kind = PositionsPeriod{{SunAt{}}};
  expect_seen(study,
              {with_period<PositionsPeriod>(
                   "azimuth", [](PositionsPeriod& p) { p.positions[0].azimuth_deg = 1; }),
               with_period<PositionsPeriod>(
                   "elevation", [](PositionsPeriod& p) { p.positions[0].elevation_deg = 1; }),
               with_period<PositionsPeriod>(
                   "interval", [](PositionsPeriod& p) { p.positions[0].interval_min = 1; })});
}

TEST(CanonicalText, DoesNotSeeNamesPlacesAndOutput) {
  const Study study = rich_study();
  const Where elsewhere{"other.yaml", 3, 4};
  const std::vector<Change> changes{
      {"name", [](Study& s) { s.name = "x"; }},
      {"variant", [](Study& s) { s.variant = "x"; }},
      {"isa", [](Study& s) { s.solver.isa = "avx2"; }},  // the one in force is hashed apart
      {"files", [](Study& s) { s.scene.files[0].path = "/elsewhere/x"; }},
      {"parallel sources", [](Study& s) { s.scene.parallel_sources = "/elsewhere/x"; }},
      {"output",
       [](Study& s) { s.output = {"x", {"total"}, StandardErrors::instants, 0, {}, {}, {}}; }},
      {"time of day written",
       [](Study& s) {
         s.period.where = {"y", 1, 1};
       }},
      {"places", [&](Study& s) {
         s.site.where = s.period.where = s.scene.where = elsewhere;
         s.scene.files[0].where = s.scene.builtin->where = elsewhere;
         s.scene.materials[0].where = s.scene.assign[0].where = elsewhere;
       }}};
  for (const auto& change : changes) {
    Study changed = study;
    change.apply(changed);
    EXPECT_EQ(canonical_text(study), canonical_text(changed)) << change.name;
  }
}

}  // namespace
}  // namespace sunload
