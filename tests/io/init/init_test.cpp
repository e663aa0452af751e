// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The study that `init` writes: it is read, says what is a guess, and replaces nothing.
#include "io/init/init.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <sstream>

#include "io/init/measure_text.h"
#include "io/init/proposals.h"
#include "io/init/study_text.h"
#include "io/measure/rules.h"
#include "io/plan/planner.h"
#include "io/study/material_table.h"
#include "io/study/study.h"
#include "tests/support/paths.h"
#include "tests/support/refusal_of.h"
#include "tests/support/small_weather.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

using test::refusal_of;
using test::WorkFolder;

constexpr const char* box =
    "mtllib no.mtl\no house\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 3\nv 4 0 3\nv 4 4 3\nv 0 4 "
    "3\n"
    "usemtl Facade_Brick_02\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nusemtl "
    "nothing\n"
    "f 5 6 7 8\n";

/// What is written to the standard output meanwhile.
class Listing {
 public:
  Listing() : before_(std::cout.rdbuf(text_.rdbuf())) {}
  ~Listing() { std::cout.rdbuf(before_); }
  Listing(const Listing&) = delete;
  Listing& operator=(const Listing&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

/// The study that init writes, read again; its text.
std::pair<Study, std::string> begun(const WorkFolder& folder, const InitRules& rules) {
  const Listing listing;
  init_study(rules, folder / "study.yaml");
  EXPECT_NE(listing.text().find("sunload check"), std::string::npos);
  const StudyFile file = read_study(folder / "study.yaml");
  EXPECT_NO_THROW(Planner().plan(file.variants.front()));
  return {file.variants.front(), folder.read("study.yaml")};
}

TEST(Init, WithoutAPlaceTheSunStandsWhereTheStudyPutsIt) {
  const WorkFolder folder;
  const auto [study, text] = begun(folder, {.model = folder.write("box.obj", box)});
  EXPECT_TRUE(std::holds_alternative<PositionsPeriod>(study.period.kind));
  EXPECT_NE(text.find("<<< Neither file nor weather tells where this stands"), std::string::npos);
}

TEST(Init, APlaceBringsDaysAndAZone) {
  const WorkFolder folder;
  const auto [study, text] =
      begun(folder, {.model = folder.write("box.obj", box), .at = "52.01 4.36"});
  const auto& days = std::get<DaysPeriod>(study.period.kind);
  EXPECT_EQ(days.days.size(), 3u);
  EXPECT_EQ(study.site.timezone, "Europe/Amsterdam");
  EXPECT_NE(text.find("<<< timezone"), std::string::npos);
  EXPECT_NE(text.find("<<< north_deg"), std::string::npos);
}

TEST(Init, PlaceAndNorthOfAProjectionAreTheFilesOwn) {
  const WorkFolder folder;
  const auto [study, text] =
      begun(folder, {.model = test::source_folder() + "/configs/models/town.city.json"});
  EXPECT_FALSE(study.site.latitude_deg);
  EXPECT_FALSE(study.site.north_deg);
  EXPECT_EQ(study.site.timezone, "Europe/Prague");
  EXPECT_NE(text.find("type: \"SolitaryVegetationObject\", material: crown"), std::string::npos);
}

TEST(Init, FeetOfAProjectionAreTheUnit) {
  const WorkFolder folder;
  const auto model = folder.write("new_york.obj",
                                  "v 990000 200000 0\nv 990030 200000 0\nv 990030 200030 0\n"
                                  "v 990000 200000 40\nf 1 2 3\nf 1 2 4\n");
  const auto [study, text] = begun(folder, {.model = model, .crs = "EPSG:2263"});
  EXPECT_EQ(study.site.timezone, "America/New_York");
  ASSERT_TRUE(study.scene.files.front().unit_m);
  EXPECT_NEAR(*study.scene.files.front().unit_m, 1200.0 / 3937, 1e-10);
  EXPECT_NE(text.find("<<< unit_m of the CRS"), std::string::npos) << text;
}

TEST(Init, WeatherBringsItsYearAndItsStation) {
  const WorkFolder folder;
  const auto [study, text] = begun(folder, {.model = folder.write("box.obj", box),
                                            .weather = folder.write("w.epw", test::small_epw())});
  EXPECT_EQ(study.light.source, LightSource::weather);
  EXPECT_TRUE(std::holds_alternative<WeatherPeriod>(study.period.kind));
  EXPECT_NE(text.find("<<< the place is the weather station's"), std::string::npos);
}

/// The mark of guesses is no word that only guesses have.
TEST(Init, AStationOfAnyNameIsTaken) {
  const WorkFolder folder;
  for (const std::string name : {"A<<<", "<<<", "two\"quotes\"", "a: b # c", "{'}"}) {
    std::string weather = test::small_epw();
    weather.replace(weather.find("NOWHERE"), 7, name);
    std::filesystem::remove(folder / "study.yaml");
    const auto [study, text] = begun(
        folder, {.model = folder.write("box.obj", box), .weather = folder.write("w.epw", weather)});
    EXPECT_NE(text.find(name), std::string::npos) << name;
    EXPECT_EQ(study.light.source, LightSource::weather) << name;
  }
}

TEST(Init, MaterialsAreProposedByNamesAndKinds) {
  EXPECT_EQ(proposed_for_name("Facade_Brick_02"), "brick");
  EXPECT_EQ(proposed_for_name("oak window"), "double_glazing");
  EXPECT_FALSE(proposed_for_name("material_7"));
  EXPECT_EQ(proposed_for_kind("WaterBody"), "water");
  EXPECT_FALSE(proposed_for_kind("Building"));
  const WorkFolder folder;
  const auto [study, text] = begun(folder, {.model = folder.write("box.obj", box), .at = "52 4"});
  EXPECT_NE(text.find("was: \"Facade_Brick_02\", material: brick"), std::string::npos) << text;
}

TEST(Init, EveryProposedMaterialIsInTheTable) {
  for (std::size_t s = 0; s < surface_names.size(); ++s)
    EXPECT_TRUE(tabled_material(proposed_for_surface(static_cast<Surface>(s))));
  for (const char* name :
       {"glass", "brick", "concrete", "road", "lawn", "leaf", "tile", "slate", "plaster", "wood",
        "steel", "alumin", "water", "stone", "paving", "gravel", "wall"})
    EXPECT_TRUE(tabled_material(*proposed_for_name(name))) << name;
  for (const char* kind : {"PlantCover", "Road", "Railway", "TransportSquare", "LandUse"})
    EXPECT_TRUE(tabled_material(*proposed_for_kind(kind))) << kind;
}

/// A square of ground with a block on it, whose up is z.
std::string block_on_ground() {
  std::string text = "v 0 0 0\nv 40 0 0\nv 40 40 0\nv 0 40 0\nf 1 2 3 4\n";
  for (const int z : {0, 9})
    text += fmt::format("v 10 10 {0}\nv 20 10 {0}\nv 20 20 {0}\nv 10 20 {0}\n", z);
  return text + "f 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n";
}

/// The same with y up, as some programs write it: (x, y, z) becomes (x, z, -y).
std::string block_on_its_side() {
  std::string text = "v 0 0 0\nv 40 0 0\nv 40 0 -40\nv 0 0 -40\nf 1 2 3 4\n";
  for (const int z : {0, 9})
    text += fmt::format("v 10 {0} -10\nv 20 {0} -10\nv 20 {0} -20\nv 10 {0} -20\n", z);
  return text + "f 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n";
}

TEST(Init, AModelOnItsOwnGroundGetsNoOther) {
  const WorkFolder folder;
  const auto [study, text] =
      begun(folder, {.model = folder.write("block.obj", block_on_ground()), .at = "52 4"});
  EXPECT_NE(text.find("ground: none"), std::string::npos) << text;
  EXPECT_NE(text.find("<<< ground: faces at the model's foot, 100 % of its plan"),
            std::string::npos)
      << text;
  const WorkFolder other;
  const auto [of_box, box_text] =
      begun(other, {.model = other.write("box.obj", box), .at = "52 4"});
  EXPECT_EQ(box_text.find("ground: none\n"), std::string::npos) << "a house stands on none";
}

TEST(Init, WhatHousesAreSunkIntoIsLand) {
  // Two tiles of a slope, a house in each.
  std::string text = "o west\nv -20 -20 0\nv 2 -20 1\nv 2 20 1\nv -20 20 0\nf 1 2 3 4\n";
  text += "o east\nv 2 -20 1\nv 30 -20 3\nv 30 20 3\nv 2 20 1\nf 5 6 7 8\n";
  int first = 9;
  for (const int x : {-10, 10}) {
    text += fmt::format("o house{}\n", x);
    for (const int z : {-1, 8})
      for (const auto& [dx, dy] : {std::pair(0, 0), {5, 0}, {5, 5}, {0, 5}})
        text += fmt::format("v {} {} {}\n", x + dx, dy, z);
    for (const auto& f : {"4 3 2 1", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8", "5 6 7 8"}) {
      std::istringstream corners(f);
      text += "f";
      for (int corner = 0; corners >> corner;) text += fmt::format(" {}", corner + first - 1);
      text += "\n";
    }
    first += 8;
  }
  const WorkFolder folder;
  const auto [study, written] =
      begun(folder, {.model = folder.write("town.obj", text), .at = "52 4"});
  ASSERT_EQ(study.scene.land.size(), 2u) << written;
  EXPECT_NE(written.find("<<< land: houses are sunk into it"), std::string::npos) << written;
  EXPECT_NE(written.find("ground: none"), std::string::npos) << written;
  const WorkFolder other;
  EXPECT_EQ(begun(other, {.model = other.write("block.obj", block_on_ground()), .at = "52 4"})
                .second.find("land:"),
            std::string::npos);
}

TEST(Init, AModelThatLiesOnItsSideIsStoodUp) {
  const WorkFolder folder;
  const auto [study, text] =
      begun(folder, {.model = folder.write("block.obj", block_on_its_side()), .at = "52 4"});
  EXPECT_NE(text.find("      up: y\n"), std::string::npos) << text;
  EXPECT_NE(text.find("<<< up: y"), std::string::npos);
  const WorkFolder capitals;
  const std::string of_capitals =
      begun(capitals, {.model = capitals.write("BLOCK.OBJ", block_on_its_side()), .at = "52 4"})
          .second;
  EXPECT_NE(of_capitals.find("      up: y\n"), std::string::npos) << of_capitals;
  const WorkFolder closed;
  const std::string with_bottom = block_on_its_side() + "f 8 7 6 5\n";
  const std::string of_closed =
      begun(closed, {.model = closed.write("block.obj", with_bottom), .at = "52 4"}).second;
  EXPECT_NE(of_closed.find("      up: y\n"), std::string::npos) << of_closed;
  const WorkFolder other;
  const auto [as_said, told] = begun(
      other, {.model = other.write("block.obj", block_on_its_side()), .at = "52 4", .up = "z"});
  EXPECT_EQ(told.find("up: y"), std::string::npos) << "what is said is not guessed";
}

TEST(Init, WritesOnlyWhereThereIsAFolder) {
  const WorkFolder folder;
  const InitRules rules{.model = folder.write("box.obj", box)};
  try {
    init_study(rules, folder / "none/study.yaml");
    FAIL() << "it has written into no folder";
  } catch (const MachineError& error) {
    EXPECT_NE(std::string(error.what()).find("there is no folder"), std::string::npos);
  }
}

TEST(Init, ReplacesNoFile) {
  const WorkFolder folder;
  folder.write("study.yaml", "mine");
  const InitRules rules{.model = folder.write("box.obj", box)};
  EXPECT_NE(refusal_of([&] { init_study(rules, folder / "study.yaml"); }).find("is there already"),
            std::string::npos);
  EXPECT_EQ(folder.read("study.yaml"), "mine");
  EXPECT_NE(refusal_of([&] { init_study(rules, folder / "study.txt"); }).find(".yaml"),
            std::string::npos);
}

/// What `check` would refuse is filled, and said.
TEST(Init, RowsThatAreMissingAreMadeOfTheirNeighbours) {
  const WorkFolder folder;
  std::string csv =
      "# latitude_deg: 50\n# longitude_deg: 14\n# utc_offset: +01:00\n"
      "time,dni_w_m2,dhi_w_m2\n";
  for (int hour = 1; hour <= 24; ++hour)
    if (hour != 11) csv += fmt::format("2026-06-21T{:02}:00,100,40\n", hour);
  const auto [study, text] = begun(
      folder, {.model = folder.write("box.obj", box), .weather = folder.write("hole.csv", csv)});
  EXPECT_EQ(study.light.missing, Missing::interpolate);
  EXPECT_NE(text.find("1 records lack a value or a row"), std::string::npos) << text;
}

TEST(Init, ValuesThatAreTooLowAreMadeOfTheirNeighbours) {
  const WorkFolder folder;
  std::string csv = "# latitude_deg: 50\n# longitude_deg: 14\ntime,dni_w_m2,dhi_w_m2\n";
  for (int hour = 1; hour <= 24; ++hour)
    csv += fmt::format("2026-06-21T{:02}:00,{},40\n", hour, hour == 11 ? -60 : 100);
  const auto [study, text] = begun(
      folder, {.model = folder.write("box.obj", box), .weather = folder.write("low.csv", csv)});
  EXPECT_EQ(study.light.missing, Missing::interpolate);
  EXPECT_NE(text.find("1 values are too low (line 14, dni: -60 W/m2)"), std::string::npos) << text;
}

/// Of a station in the far east: its noon is near midnight of UTC, which is no zone of its own.
TEST(Init, RowsInUtcHaveTheDaysOfTheirStation) {
  const WorkFolder folder;
  // Noon is at 02:45 UTC: rows are missing in the morning, on both sides of midnight.
  const std::string csv =
      "# latitude_deg: -34.9\n# longitude_deg: 138.6\n# utc_offset: +00:00\n"
      "time,dni_w_m2,dhi_w_m2\n" +
      test::hours_without_midnight(1, 48);
  const auto [study, text] = begun(
      folder, {.model = folder.write("box.obj", box), .weather = folder.write("utc.csv", csv)});
  EXPECT_EQ(study.site.timezone, "Australia/Adelaide");
  EXPECT_EQ(study.light.missing, Missing::interpolate);
  EXPECT_NE(text.find("2 records lack a value or a row"), std::string::npos) << text;
}

/// They lack nothing that does not follow.
TEST(Init, RowsThatHaveTwoOfThreeQuantitiesAreComplete) {
  const WorkFolder folder;
  std::string csv =
      "# latitude_deg: 50\n# longitude_deg: 14\n# utc_offset: +01:00\n"
      "time,dni_w_m2,dhi_w_m2,ghi_w_m2\n";
  for (int hour = 1; hour <= 24; ++hour)
    csv += fmt::format("2026-06-21T{:02}:00,{},40,90\n", hour, hour == 11 ? "100" : "");
  const auto [study, text] = begun(
      folder, {.model = folder.write("box.obj", box), .weather = folder.write("two.csv", csv)});
  EXPECT_EQ(study.light.missing, Missing::refuse);
  EXPECT_EQ(text.find("lack a value"), std::string::npos) << text;
}

/// 0xe9 is é in Latin-1.
TEST(Init, FilesThatAStudyCannotNameAreToldAsSuch) {
  const WorkFolder folder;
  const InitRules rules{.model = folder.write("bad\xe9.obj", box)};
  const std::string message = refusal_of([&] { init_study(rules, folder / "study.yaml"); });
  EXPECT_NE(message.find("its name is not in UTF-8"), std::string::npos) << message;
  EXPECT_NE(message.find("rename"), std::string::npos) << message;
  EXPECT_EQ(folder.content(), (std::vector<std::string>{"bad\xe9.obj"}));
}

/// 0xfc is ü in Latin-1.
TEST(Init, StationsWithNamesInLatin1MakeStudiesInUtf8) {
  const WorkFolder folder;
  std::string epw = test::small_epw();
  epw.replace(epw.find("NOWHERE"), 7, "M\xfcnchen");
  const auto [study, text] = begun(
      folder, {.model = folder.write("box.obj", box), .weather = folder.write("latin.epw", epw)});
  EXPECT_NE(text.find("München"), std::string::npos) << text;
}

TEST(Init, NamesOfStudiesAreThoseThatAStudyMayHave) {
  EXPECT_EQ(study_name("a/Delft Zuid (2).city.json"), "Delft_Zuid__2_");
  EXPECT_EQ(study_name("tower.obj"), "tower");
  EXPECT_EQ(study_name(".obj"), "obj");
  EXPECT_EQ(study_name("..."), "first");
}

TEST(Init, ZonesAreThoseOfTheNearestPlaceWithTheOffset) {
  EXPECT_EQ(guessed_zone(52.0, 4.4)->name, "Europe/Amsterdam");
  EXPECT_EQ(guessed_zone(-33.4, -70.8)->name, "America/Santiago");
  // A station that keeps the time of India is in India, however near Nepal it lies.
  EXPECT_EQ(guessed_zone(27.7, 85.3)->name, "Asia/Kathmandu");
  EXPECT_EQ(guessed_zone(27.7, 85.3, 5.5 * 3600)->name, "Asia/Kolkata");
  // Gothenburg is nearer to Copenhagen; a map of Sweden is of places in Sweden.
  EXPECT_EQ(guessed_zone(57.7, 12.0)->name, "Europe/Copenhagen");
  EXPECT_EQ(guessed_zone(57.7, 12.0, {}, "Sweden - onshore and offshore.")->name,
            "Europe/Stockholm");
  EXPECT_EQ(guessed_zone(50.1, 14.4, {}, "Czechia; Slovakia.")->name, "Europe/Prague");
  // Weather of Santiago for a map of the Netherlands.
  EXPECT_EQ(guessed_zone(51.9, 4.5, -4 * 3600, "Netherlands - onshore.")->name, "Europe/Amsterdam");
}

TEST(Init, RulesOfPlanningAreWrittenReadyToRun) {
  const WorkFolder folder;
  const auto [study, text] = begun(folder, {.model = folder.write("box.obj", box),
                                            .at = "50.09 14.42",
                                            .measures = {"EN17037", "bre-209-garden", "en_17037"}});
  ASSERT_EQ(study.measures.size(), 2u) << "a rule that is named twice is one rule";
  EXPECT_EQ(study.measures[0].rule, "en_17037");
  EXPECT_EQ(study.measures[0].of.facade, "*");
  EXPECT_EQ(study.measures[1].of.surface, "ground");
  EXPECT_NE(text.find("<<< 13 degrees are the Czech Republic's"), std::string::npos);
}

TEST(Init, EveryRuleOfPlanningIsOfferedAndMakesAStudyOfAYear) {
  EXPECT_EQ(offered_rules().size(), measure_rules().size());
  for (const MeasureRule& rule : measure_rules()) {
    const WorkFolder folder;
    const auto [study, text] = begun(folder, {.model = folder.write("box.obj", box),
                                              .weather = folder.write("w.epw", test::small_epw()),
                                              .measures = {rule.word}});
    ASSERT_EQ(study.measures.size(), 1u) << rule.word;
    EXPECT_EQ(study.measures.front().rule, rule.word);
  }
}

TEST(Init, ARuleThatNeedsWhatIsNotThereSaysWhatToAdd) {
  const WorkFolder folder;
  const std::string model = folder.write("box.obj", box);
  const auto refusal = [&](const std::string& rule) {
    return refusal_of(
        [&] { init_study({.model = model, .measures = {rule}}, folder / "study.yaml"); });
  };
  EXPECT_NE(refusal("en_17037").find("--at"), std::string::npos);
  EXPECT_NE(refusal("roof_potential").find("WEATHER"), std::string::npos);
  EXPECT_NE(refusal("en_1").find("write one of: en_17037, csn_73_4301"), std::string::npos);
}

TEST(Init, AnExampleIsCopiedWithItsFiles) {
  const WorkFolder folder;
  const Listing listing;
  init_example("town_day", folder.path());
  EXPECT_EQ(folder.content(),
            (std::vector<std::string>{"models/", "models/town.city.json", "town_day.yaml"}));
  EXPECT_NE(refusal_of([&] { init_example("town_day", folder.path()); }).find("is there already"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { init_example("../town", folder.path()); }).find("write one of"),
            std::string::npos);
}

TEST(Init, PlanDataTellsWhichColumnsItTook) {
  const WorkFolder folder;
  const auto [study, text] = begun(
      folder,
      {.model = folder.write(
           "plan.geojson",
           R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": )"
           R"({"hoehe": 8}, "geometry": {"type": "Polygon", "coordinates": [[[15.001, 49.6535], )"
           R"([15.002, 49.6535], [15.002, 49.654], [15.001, 49.6535]]]}}]})")});
  EXPECT_NE(text.find("<<< heights of footprints from column hoehe"), std::string::npos) << text;
  EXPECT_NE(text.find("EPSG:32633"), std::string::npos);
  EXPECT_TRUE(std::holds_alternative<DaysPeriod>(study.period.kind));
}

TEST(Init, PlanDataOfOtherColumnsIsTold) {
  const WorkFolder folder;
  const std::string plan = folder.write(
      "plan.geojson",
      R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": )"
      R"({"roof elevation": 8}, "geometry": {"type": "Polygon", "coordinates": [[[15.001, 49.6535], )"
      R"([15.002, 49.6535], [15.002, 49.654], [15.001, 49.6535]]]}}]})");
  const auto said = refusal_of([&] { begun(folder, {.model = plan}); });
  EXPECT_NE(said.find("roof elevation"), std::string::npos) << said;
  EXPECT_NE(said.find("sunload init --height"), std::string::npos) << said;
  const auto [study, text] = begun(folder, {.model = plan, .height = "roof elevation"});
  EXPECT_EQ(study.scene.files.front().footprints.height, "roof elevation") << text;
  std::filesystem::remove(folder / "study.yaml");
  const auto by_storeys = begun(folder, {.model = plan, .storeys = "roof elevation"}).first;
  EXPECT_EQ(by_storeys.scene.files.front().footprints.storeys, "roof elevation");
  std::filesystem::remove(folder / "study.yaml");
  const std::string other = folder.write("box.obj", box);
  EXPECT_NE(refusal_of([&] {
              begun(folder, {.model = other, .height = "h"});
            }).find("name columns of plan data"),
            std::string::npos);
}

/// Kashgar keeps the time of Peking, whose table of zones has no place near it.
TEST(Init, AnOffsetIsBetterThanAZoneOfFarAway) {
  const WorkFolder folder;
  const std::string weather =
      test::small_epw({.latitude_deg = 39.5, .longitude_deg = 76, .offset_h = 8});
  const auto [study, text] = begun(
      folder, {.model = folder.write("box.obj", box), .weather = folder.write("w.epw", weather)});
  EXPECT_EQ(study.site.timezone, "+08:00") << text;
}

}  // namespace
}  // namespace sunload
