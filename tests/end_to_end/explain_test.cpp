// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// sunload explain: rows that add up to the result, or a part of it, who changes what, which
/// surface is worth painting, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "io/picture/render_scene.h"
#include "io/result/reader.h"
#include "tests/support/png.h"
#include "tests/support/program.h"
#include "tests/support/result_change.h"
#include "tests/support/square_folder.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using nlohmann::json;

json explained(const WorkFolder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), "explain");
  words.emplace_back("--json");
  const Ran ran = program(folder, words);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return ran.code == 0 ? json::parse(ran.out) : json();
}

json row_of(const json& explanation, const std::string& kind, const std::string& name = {}) {
  for (const auto& row : explanation["rows"])
    if (row["row"] == kind && row["name"] == name) return row;
  ADD_FAILURE() << kind << " " << name;
  return {};
}

constexpr const char* load = "total_kwh_m2";

void expect_adds_up(const json& explanation) {
  double sum = 0;
  for (const auto& row : explanation["rows"]) {
    const std::string kind = row["row"];
    if (kind == "open" || kind == "object") sum += row[load].get<double>();
  }
  EXPECT_NEAR(sum, row_of(explanation, "sum")[load].get<double>(), 1e-9 * std::abs(sum));
  const json rest = row_of(explanation, "remainder");
  const double se = rest["se_kwh_m2"];
  EXPECT_GT(se, 0);
  // Series and pilots are float.
  const double rounding = float_rounding * row_of(explanation, "result")[load].get<double>();
  EXPECT_LE(std::abs(rest[load].get<double>()), accepted_t(16) * se + rounding)
      << explanation.dump(1);
}

std::string coarse_square() { return square_study("totals", "", "5"); }

const std::string explained_variants =
    "sensors: {points: [{position_m: [0, -5, 1.5], normal: [0, 1, 0]}]}\n"
    "variants:\n"
    "  - {name: base, scene: {materials: {glass: {diffuse: 0.3, mirror: 0}}}}\n"
    "  - {name: glazed}\n";

/// In January the square is white.
TEST(Explain, FollowsLightInTheSeasonThatIsChosen) {
  std::string study = coarse_square();
  const auto put = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(study.find(from), std::string::npos) << from;
    study.replace(study.find(from), from.size(), to);
  };
  put("days: [2026-03-21]", "days: [2026-01-21, 2026-06-21]");
  put("paving: {diffuse: 0.3}",
      "paving: {diffuse: 0.3, seasons: {snow: white}}\n    white: {diffuse: 0.8}");
  put("totals: [season, ", "totals: [month, ");
  const SquareFolder square(study + "seasons: {snow: [12, 1, 2]}\n");
  const Ran ran = square.run("results");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string result = square.result("results", "baseline");
  const json january = explained(square.folder, {result, "--object", "house", "--month", "1"}),
             june = explained(square.folder, {result, "--object", "house", "--month", "6"});
  expect_adds_up(january);
  expect_adds_up(june);
  // As a square that is always white gives: its intervals have the same bits.
  put("paving: {diffuse: 0.3, seasons: {snow: white}}", "paving: {diffuse: 0.8}");
  const SquareFolder white(study);
  const Ran ran_white = white.run("results");
  ASSERT_EQ(ran_white.code, 0) << ran_white.err;
  EXPECT_EQ(explained(white.folder, {white.result("results", "baseline"), "--object", "house",
                                     "--month", "1"})["rows"],
            january["rows"]);
  EXPECT_EQ(explained(square.folder, {result, "--object", "house", "--season", "snow"})["rows"],
            january["rows"]);
  const Ran all = program(square.folder, {"explain", result, "--object", "house"});
  EXPECT_EQ(all.code, 2);
  EXPECT_NE(all.err.find("--season, --month, --day"), std::string::npos) << all.err;
}

TEST(Explain, AddsUpAndNamesWhoChangesWhat) {
  const SquareFolder square(coarse_square() + explained_variants);
  const Ran ran = square.run("results");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string base = square.result("results", "base"),
                    glazed = square.result("results", "glazed");
  expect_adds_up(explained(square.folder, {glazed, "--sensor", "0"}));
  const json before = explained(square.folder, {base, "--object", "square"});
  const json after = explained(square.folder, {glazed, "--object", "square"});
  expect_adds_up(before);
  expect_adds_up(after);
  const json change = explained(square.folder, {glazed, "--object", "square", "--against", base});
  EXPECT_EQ(change["against"], "base");
  const json house = row_of(change, "object", "house");
  EXPECT_NEAR(house[load].get<double>(),
              row_of(after, "object", "house")[load].get<double>() -
                  row_of(before, "object", "house")[load].get<double>(),
              1e-12);
  // Same lines, same shadows: what it takes did not change at all.
  EXPECT_EQ(house["sun_kwh_m2"].get<double>(), 0);
  EXPECT_EQ(house["sky_kwh_m2"].get<double>(), 0);
  EXPECT_GT(house["mirrors_kwh_m2"].get<double>(), 0);
  EXPECT_LT(house["se_kwh_m2"].get<double>(),
            row_of(after, "object", "house")["se_kwh_m2"].get<double>());
  double shares = 0;
  for (const auto& row : change["rows"])
    if (row["row"] == "object") shares += row["share_percent"].get<double>();
  EXPECT_NEAR(shares, 100, 1e-6);
  // Hours of the day have stored parts; their lamps and suns are theirs.
  const json morning = explained(square.folder, {glazed, "--object", "square", "--hours", "6-12"});
  expect_adds_up(morning);
  EXPECT_EQ(morning["part"], "hours 6-12");
  const json afternoon =
      explained(square.folder, {glazed, "--object", "square", "--hours", "12-18"});
  for (const char* kind : {"open", "sum"})
    EXPECT_NEAR(
        row_of(morning, kind)[load].get<double>() + row_of(afternoon, kind)[load].get<double>(),
        row_of(after, kind)[load].get<double>(),
        float_rounding * row_of(after, kind)[load].get<double>());
  const Ran csv = program(square.folder, {"explain", glazed, "--object", "house", "--csv"});
  EXPECT_EQ(csv.out.substr(0, csv.out.find('\n')),
            "row,name,sun_kwh_m2,sky_kwh_m2,far_ground_kwh_m2,reflects_kwh_m2,mirrors_kwh_m2,"
            "shines_kwh_m2,total_kwh_m2,se_kwh_m2,share_percent");
}

double paint_change(const json& painting, const std::string& material, const json& object) {
  for (const auto& row : painting["rows"])
    if (row["material"] == material && row["object"] == object)
      return row["change_kwh_m2"].get<double>();
  ADD_FAILURE() << material;
  return 0;
}

TEST(Explain, SaysWhichSurfaceIsWorthPainting) {
  // The same lines, with walls that reflect a little more; no lamp, whose points are other lines.
  constexpr double step = 0.02;
  const auto walls = [&](const std::string& name, double diffuse) {
    return "  - {name: " + name +
           ", scene: {materials: {lamp: {emission_w_m2: 0}, plaster: {diffuse: " +
           std::to_string(diffuse) + "}}}}\n";
  };
  const SquareFolder square(square_study("totals", ", bounces: 20, unshot: 0", "5") +
                            "variants:\n" + walls("base", 0.6) + walls("darker", 0.6 - step) +
                            walls("brighter", 0.6 + step));
  const Ran ran = square.run("results");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto result = [&](const std::string& variant) { return square.result("results", variant); };
  const json painting = explained(square.folder, {result("base"), "--object", "square", "--paint"});
  const json change = explained(
      square.folder, {result("brighter"), "--object", "square", "--against", result("darker")});
  const double truth = 0.1 * row_of(change, "result")[load].get<double>() / (2 * step);
  const double adjoint = paint_change(painting, "plaster", nullptr);
  constexpr double asked = 0.02;  // of the derivative, by common random numbers
  EXPECT_NEAR(adjoint, truth, asked * truth);
  EXPECT_EQ(adjoint, paint_change(painting, "plaster", "house"));
  EXPECT_GT(paint_change(painting, "paving", "square"), 0);
  const Ran refused = program(square.folder, {"explain", result("base"), "--object", "square",
                                              "--paint", "--against", result("darker")});
  EXPECT_EQ(refused.code, 2) << refused.err;
  const Ran csv =
      program(square.folder, {"explain", result("base"), "--object", "square", "--paint", "--csv"});
  EXPECT_EQ(csv.out.substr(0, csv.out.find('\n')),
            "row,material,object,area_m2,reflectance,change_kwh_m2,se_kwh_m2,per_100_m2_kwh_m2");
}

TEST(Explain, DrawsTheRowsBesidesTheTable) {
  const SquareFolder square(coarse_square());
  ASSERT_EQ(square.run("results").code, 0);
  const std::vector<std::string> words{"explain", square.result("results"), "--object", "square"};
  const Ran table = program(square.folder, words);
  auto with_picture = words;
  with_picture.insert(with_picture.end(), {"-o", "why.png"});
  const Ran drawn = program(square.folder, with_picture);
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_EQ(drawn.out, table.out);
  const Png picture = read_png(square.folder / "why.png");
  EXPECT_GT(picture.width, 500);
  EXPECT_GT(count_of(picture, {0.93, 0.62, 0.10}), 1000u) << "sun";
}

TEST(Explain, TellsWhereTimesDiffer) {
  const SquareFolder square(coarse_square() +
                            "variants:\n  - {name: march}\n  - {name: june, period: {days: "
                            "[2026-06-21]}}\n");
  const Ran ran = square.run("results");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto notes = [&](const char* base) {
    return program(square.folder, {"explain", square.result("results", "june"), "--object",
                                   "square", "--against", square.result("results", base)})
        .out;
  };
  EXPECT_NE(notes("march").find("cover different intervals of time: 2026-03-21"), std::string::npos)
      << notes("march");
  EXPECT_EQ(notes("june").find("different intervals"), std::string::npos);
}

TEST(Explain, TellsWhereThePlaceDiffers) {
  const WorkFolder folder;
  const std::string study =
      "format: sunload-study-1\nname: place\n"
      "site: {latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague, north_deg: 0}\n"
      "period: {days: [2026-03-21], from: \"10:00\", to: \"14:00\", step_min: 60}\n"
      "scene:\n  builtin: {name: box_on_plane}\n  edit:\n    - {object: box, remove: true}\n"
      "    - {add: {name: a, material: plaster, box: {position_m: [0, 10, 0], size_m: [8, 8, "
      "8]}}}\n"
      "    - {add: {name: b, material: plaster, box: {position_m: [0, -10, 0], size_m: [8, 8, "
      "8]}}}\n"
      "  materials: {plaster: {diffuse: 0.5}}\n"
      "selections: {south: {object: '*', surface: wall, azimuth_deg: [135, 225]}}\n"
      "mesh: {oracle: none, max_edge_m: 8}\nsolver: {lines_per_patch: 16, realizations: 4}\n"
      "sensors: {points: [{position_m: [0, 0, 1], normal: [0, 0, 1]}]}\n"
      "variants:\n  - {name: base}\n"
      "  - {name: gone, scene: {edit: [{object: b, remove: true}]}}\n"
      "  - {name: turned, site: {north_deg: 90}}\n";
  folder.write("place.yaml", study);
  std::string moved = study;
  moved.replace(moved.find("[0, 0, 1], normal"), 9, "[0, 1, 1]");
  folder.write("moved.yaml", moved);
  const Ran ran = program(folder, {"run", "place.yaml"}),
            other =
                program(folder, {"run", "moved.yaml", "--variant", "base", "--output", "moved"});
  ASSERT_EQ(other.code, 0) << other.err;
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto notes = [&](const std::string& variant, std::vector<std::string> place,
                         const std::string& results = "results") {
    place.insert(place.begin(),
                 {results + "/place/" + variant + ".h5", "--against", "results/place/base.h5"});
    const json told = explained(folder, place);
    std::string all;
    for (const auto& note : told["notes"]) all += note.get<std::string>() + "\n";
    return all;
  };
  const auto has = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  const std::string gone = notes("gone", {"--selection", "south"});
  EXPECT_TRUE(has(gone, "the place differs: 128 m² in base and 64 m² in gone, of which 64 m²"))
      << gone;
  const std::string wall = notes("turned", {"--facade", "a/south_1"});
  EXPECT_TRUE(has(wall, "64 m² in base and 64 m² in turned, of which 0 m²")) << wall;
  EXPECT_TRUE(has(wall, "turned against each other")) << wall;
  const std::string object = notes("turned", {"--object", "a"});
  EXPECT_FALSE(has(object, "the place differs")) << object;
  const std::string sensor = notes("base", {"--sensor", "0"}, "moved");
  EXPECT_TRUE(has(sensor, "its sensors stand elsewhere")) << sensor;
  for (const auto& same : {notes("gone", {"--object", "a"}), notes("gone", {"--sensor", "0"})}) {
    EXPECT_TRUE(has(same, "paired realizations")) << same;
    EXPECT_FALSE(has(same, "differs")) << same;
  }
}

/// Sum over the patches of an object, or of all: value × area.
double sum_over(const ResultReader& map, const std::string& dataset,
                const std::string& object = {}) {
  const auto values = map.doubles(dataset), area = map.doubles("patch_area");
  const auto names = map.strings("object_name");
  const auto of = map.integers("patch_object");
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (object.empty() || names[static_cast<std::size_t>(of[i])] == object)
      sum += values[i] * area[i];
  return sum;
}

TEST(Explain, MapsWhichPatchesGiveAndTake) {
  const SquareFolder square(coarse_square() + explained_variants);
  ASSERT_EQ(square.run("results").code, 0);
  const std::string result = square.result("results", "glazed"), map = square.folder / "map.h5";
  for (const std::vector<std::string>& place :
       {std::vector<std::string>{"--object", "square"}, {"--sensor", "0"}, {"--object", "house"}}) {
    std::vector<std::string> words{result, "--map", map};
    words.insert(words.end(), place.begin(), place.end());
    const json table = explained(square.folder, words);
    const ResultReader file(map, {}, Opens::derived_too);
    const double rounding = 1e-9 * row_of(table, "result")[load].get<double>();
    for (const auto& row : table["rows"]) {
      if (row["row"] != "object" && row["row"] != "sum") continue;
      const std::string object = row["row"] == "sum" ? "" : row["name"];
      const auto expect_sum = [&](const std::string& dataset, const std::string& column) {
        EXPECT_NEAR(sum_over(file, dataset, object), row[column].get<double>(), rounding)
            << place.back() << " " << dataset << " of " << object;
      };
      expect_sum("light_given_reflected", "reflects_kwh_m2");
      expect_sum("light_given_mirror", "mirrors_kwh_m2");
      expect_sum("light_given_lamps", "shines_kwh_m2");
      // What adds up has the open in it; the house takes by its floor, which has no patches.
      if (object.empty() || object == "house") continue;
      EXPECT_NEAR(sum_over(file, "light_given", object) - sum_over(file, "light_taken", object),
                  row[load].get<double>(), rounding)
          << object;
    }
    double weight = 0;
    for (const double of_patch : file.doubles("place_weight")) weight += of_patch;
    EXPECT_NEAR(weight, place.front() == "--sensor" ? 0 : 1, 1e-12);
    EXPECT_GT(sum_over(file, "light_given_reflected"), 1e4 * rounding) << "there is some";
  }
}

TEST(Explain, ItsMapIsDrawnAndExported) {
  const SquareFolder square(coarse_square());
  ASSERT_EQ(square.run("results").code, 0);
  const std::string result = square.result("results");
  const auto done = [&](std::vector<std::string> words) {
    const Ran ran = program(square.folder, words);
    EXPECT_EQ(ran.code, 0) << words.front() << ": " << ran.err;
    return ran.out;
  };
  const auto refused = [&](std::vector<std::string> words, const std::string& says) {
    const Ran ran = program(square.folder, words);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
  };
  done({"explain", result, "--object", "square", "--map", "map.h5", "--hours", "8-12"});
  done({"render", "map.h5", "-o", "map.png", "--camera", "top", "--size", "600x400"});
  EXPECT_GT(count_of(read_png(square.folder / "map.png"), mark_colour), 1000u) << "the place";
  done({"render", "map.h5", "-o", "taken.png", "--quantity", "light_taken_sky", "--scale", "log"});
  const std::string csv = done({"export", "map.h5", "--to", "csv", "--object", "house"});
  EXPECT_NE(csv.find("light_given_kwh_m4"), std::string::npos);
  for (const char* format : {"vtk", "glb", "gpkg", "ply"})
    done({"export", "map.h5", "--to", format, "-o", std::string("map.") + format});
  refused({"info", "map.h5"}, "is a map of a place, no result");
  refused({"view", "map.h5", "-o", "map.html"}, "render and export show it");
  refused({"export", "map.h5", "--to", "xdmf", "-o", "map.xdmf"}, "of a map of a place");
  refused({"render", "map.h5", "-o", "a.png", "--camera", "sun"}, "of a map of a place");
  refused({"render", "map.h5", "-o", "a.png", "--month", "3"}, "explain --month 3 --map");
  refused({"explain", result, "--object", "square", "--map", "map.png"}, "render draws");
  refused({"explain", result, "--object", "square", "--map", "map.h5", "--paint"}, "--paint");
  refused({"explain", result, "--object", "square", "--map", result}, "baseline.h5");
}

TEST(Explain, RefusesWhatItCannotTell) {
  const SquareFolder square(coarse_square());
  const Ran ran = square.run("results");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string result = square.result("results");
  const auto refusal = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"explain", result});
    const Ran refused = program(square.folder, words);
    EXPECT_EQ(refused.code, 2);
    return refused.err;
  };
  EXPECT_NE(refusal({}).find("no place is named"), std::string::npos);
  EXPECT_NE(refusal({"--object", "hause"}).find("house"), std::string::npos);
  EXPECT_NE(refusal({"--object", "house", "-o", "why.svg"}).find(".png"), std::string::npos);
  EXPECT_NE(refusal({"--object", "house", "-o", "why.png", "--paint"}).find("--paint"),
            std::string::npos);
  EXPECT_NE(refusal({"--object", "house", "--sensor", "0"}).find("sensor"), std::string::npos);
  std::filesystem::create_directory(square.folder / "elsewhere");
  EXPECT_NE(refusal({"--object", "house", "--study-folder", "elsewhere"}).find("square.obj"),
            std::string::npos);
  square.folder.write("square.obj", std::string(square_obj) + "v 0 0 9\n" + "f 1 2 19\n");
  EXPECT_NE(refusal({"--object", "house"}).find("not what it was computed from"),
            std::string::npos);
  ChangedResult(result).set({.dataset = "", .attribute = "numerics_version", .shape = {}}, 1);
  EXPECT_NE(refusal({"--object", "house"}).find("another version of the program"),
            std::string::npos);
}

}  // namespace
}  // namespace sunload::test
