// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials that change with the seasons: every interval has the light of a study whose materials
/// are always those of its season.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/result/radiance.h"
#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// Eight hours of a day in winter, of one in spring, of one in summer; batches end within days.
/// In winter snow lies and the awning is rolled up, in spring its cloth is thin.
const std::string three_season_days =
    "period: {days: [2026-01-20, 2026-03-21, 2026-06-21], from: \"08:00\", to: \"16:00\", "
    "step_min: 60}\n"
    "solver: {lines_per_patch: 64, realizations: 16, batch_suns: 5}\n"
    "output: {folder: results, totals: [month, hour_of_day]}\n";

std::string study(const std::string& name, const std::string& materials,
                  const std::string& seasons = "", const std::string& more = "") {
  return "format: sunload-study-1\nname: " + name +
         "\nsite: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
         "light: {source: clear_sky}\n" +
         seasons +
         "scene:\n  files: [square.obj]\n  materials:\n"
         "    plaster: {diffuse: 0.6}\n    glass: {diffuse: 0.05, mirror: 0.85}\n"
         "    lamp: {diffuse: 0.1}\n" +
         materials +
         "mesh: {oracle: none, max_edge_m: 3}\n"
         "sensors: {points: [{position_m: [-5, -4, 1], normal: [0, 0, 1]}]}\n" +
         (more.empty() ? three_season_days : more);
}

const std::string usual =
    "    paving: {diffuse: 0.3}\n    canvas: {diffuse: 0.5, transmittance: 0.1, sides: two}\n";
const std::string in_winter =
    "    paving: {diffuse: 0.8}\n    canvas: {diffuse: 0, transmittance: 1, sides: two}\n";
const std::string in_spring =
    "    paving: {diffuse: 0.3}\n    canvas: {diffuse: 0.2, transmittance: 0.4, sides: two}\n";
const std::string of_seasons =
    "    paving: {diffuse: 0.3, seasons: {winter: snow}}\n"
    "    snow: {diffuse: 0.8}\n"
    "    canvas: {diffuse: 0.5, transmittance: 0.1, sides: two, "
    "seasons: {thin: gauze, winter: air}}\n"
    "    gauze: {diffuse: 0.2, transmittance: 0.4, sides: two}\n"
    "    air: {diffuse: 0, transmittance: 1, sides: two}\n";
/// Winter, the last one, rules where both hold.
const std::string seasons = "seasons: {thin: [1, 3], winter: [11-15, 03-15]}\n";

constexpr std::size_t hours_of_a_day = 8;

class Seasons : public testing::Test {
 protected:
  Seasons() { folder_.write("square.obj", square_obj); }
  std::string run(const std::string& name, const std::string& materials,
                  const std::string& with = "", const std::string& more = "") const {
    folder_.write(name + ".yaml", study(name, materials, with, more));
    const Ran ran = program(folder_, {"run", name + ".yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return folder_ / ("results/" + name + "/baseline.h5");
  }
  WorkFolder folder_;
};

/// Largest difference of the rows of a day.
double day_difference(const ResultReader& a, const ResultReader& b, const char* series,
                      std::size_t day) {
  double most = 0;
  for (std::size_t k = day * hours_of_a_day; k < (day + 1) * hours_of_a_day; ++k) {
    const auto one = a.row(series, k), other = b.row(series, k);
    EXPECT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) most = std::max(most, std::abs(one[i] - other[i]));
  }
  return most;
}

// What surfaces reflect is told where it stays: then light that leaves them is known at any time.
TEST_F(Seasons, LeaveRadianceKnownWhereReflectancesStay) {
  const std::string only_thinner =
      "    paving: {diffuse: 0.3}\n"
      "    canvas: {diffuse: 0.2, transmittance: 0.1, sides: two, seasons: {thin: gauze}}\n"
      "    gauze: {diffuse: 0.2, transmittance: 0.4, sides: two}\n";
  const ResultReader changing(run("changing", of_seasons, seasons)),
      staying(run("staying", only_thinner, "seasons: {thin: [1, 3]}\n"));
  EXPECT_FALSE(changing.has("diffuse_reflectance"));
  EXPECT_EQ(sums_problem(staying.path()), "");
  ASSERT_TRUE(staying.has("diffuse_reflectance"));
  EXPECT_NO_THROW(radiance_at(staying, 0));
  EXPECT_THROW(radiance_at(changing, 0), InputError);
  const auto mean = mean_radiance(changing), sent = changing.doubles("power_load");
  for (std::size_t i = 0; i < sent.size(); ++i)
    EXPECT_NEAR(mean[i], 1000 * sent[i] / (3 * hours_of_a_day) / pi, 1e-9 * mean[i]);
}

TEST_F(Seasons, GiveEveryIntervalTheLightOfItsMaterials) {
  const std::string all = run("all", of_seasons, seasons);
  EXPECT_EQ(sums_problem(all), "");
  EXPECT_EQ(ledger_problem(all), "");
  const ResultReader mixed(all);
  const ResultReader winter(run("winter", in_winter)), spring(run("spring", in_spring)),
      summer(run("summer", usual));
  // The same suns, the same random numbers: the same bits.
  for (const char* series : {"irradiance", "irradiance_sky", "irradiance_mirror",
                             "sensor_irradiance", "facade_irradiance"}) {
    EXPECT_EQ(day_difference(mixed, winter, series, 0), 0) << series;
    EXPECT_EQ(day_difference(mixed, spring, series, 1), 0) << series;
    EXPECT_EQ(day_difference(mixed, summer, series, 2), 0) << series;
    EXPECT_GT(day_difference(mixed, summer, series, 0), 0) << series;
    EXPECT_GT(day_difference(mixed, winter, series, 1), 0) << series;
  }
  // Months lie in one season each.
  const auto months = mixed.doubles("light_load_by_month"),
             errors = mixed.doubles("light_load_by_month_se");
  const std::size_t n = mixed.doubles("patch_area").size();
  ASSERT_EQ(months.size(), 3 * n);
  std::size_t month = 0;
  for (const ResultReader* one : {&winter, &spring, &summer}) {
    const auto alone = one->doubles("light_load_by_month"),
               alone_errors = one->doubles("light_load_by_month_se");
    for (std::size_t i = month * n; i < (month + 1) * n; ++i) {
      EXPECT_NEAR(months[i], alone[i], 1e-6 * alone[i]) << month;
      EXPECT_NEAR(errors[i], alone_errors[i], 1e-3 * alone_errors[i] + 1e-9) << month;
    }
    ++month;
  }
  // What is seen of the sky is a mean over the time.
  const auto seen = mixed.doubles("sky_view_factor"), w = winter.doubles("sky_view_factor"),
             s = spring.doubles("sky_view_factor"), u = summer.doubles("sky_view_factor");
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(seen[i], (w[i] + s[i] + u[i]) / 3, 1e-6);
}

// Batches that lie wholly where nothing mirrors, or no lamp shines, add nothing to the errors of
// these parts.
TEST_F(Seasons, HaveErrorsOfPartsThatSomeOfThemLack) {
  const std::string dull_in_winter =
      "    paving: {diffuse: 0.3}\n    canvas: {diffuse: 0.5, sides: two, seasons: {winter: "
      "glow}}\n"
      "    glow: {diffuse: 0.5, sides: two, emission_w_m2: 40}\n"
      "    mirror: {diffuse: 0.05, mirror: 0.85}\n";
  const auto by = [&](const std::string& name, const char* batch_suns) {
    std::string text = study(name, dull_in_winter, seasons);
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{"plaster: {diffuse: 0.6}",
                                              "plaster: {diffuse: 0.6, seasons: {winter: mirror}}"},
          {"glass: {diffuse: 0.05, mirror: 0.85}", "glass: {diffuse: 0.1}"},
          {"batch_suns: 5", batch_suns}})
      text.replace(text.find(from), from.size(), to);
    folder_.write(name + ".yaml", text);
    const Ran ran = program(folder_, {"run", name + ".yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ResultReader(folder_ / ("results/" + name + "/baseline.h5"));
  };
  const ResultReader split = by("split", "batch_suns: 5"), whole = by("whole", "batch_suns: 24");
  for (const char* name : {"light_load_mirror_se", "light_load_lamps_se",
                           "sensor_light_load_mirror_se", "sensor_light_load_lamps_se"}) {
    const auto some = split.doubles(name), one = whole.doubles(name);
    const double most = *std::max_element(one.begin(), one.end());
    ASSERT_EQ(some.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(some[i], one[i], 1e-3 * most) << name;
    // Beams to points have no noise.
    EXPECT_EQ(most > 0, std::string_view(name) != "sensor_light_load_mirror_se") << name;
  }
}

TEST_F(Seasons, AreTheSameInShards) {
  const std::string whole = run("whole", of_seasons, seasons);
  const std::string copy = folder_ / "copy.h5";
  std::filesystem::rename(whole, copy);
  for (const char* shard : {"0/2", "1/2"})
    EXPECT_EQ(program(folder_, {"run", "whole.yaml", "--shard", shard}).code, 0);
  EXPECT_TRUE(different_data(whole, copy).empty());
}

TEST_F(Seasons, OfWhichThePeriodSeesOneAreItsMaterials) {
  const std::string always = "seasons: {winter: [01-01, 12-31], thin: [2025-01-01, 2025-02-01]}\n";
  const std::string one = run("one", of_seasons, always), other = run("other", in_winter);
  for (const auto& name : different_data(one, other))
    EXPECT_FALSE(name.starts_with("irradiance") || name.starts_with("light_load")) << name;
}

/// By each season's own few; what that is off by is told, and the test asks no more.
TEST_F(Seasons, HaveAYearOfFewSolutionsToo) {
  const auto three_weeks = [](const std::string& year) {
    return "period: {start: 2026-03-05, end: 2026-03-26, step_min: 60}\n"
           "solver: {lines_per_patch: 16, direct_samples: 4, realizations: 4, year: " +
           year + "}\noutput: {folder: results, series: [total]}\n";
  };
  const ResultReader each(run("each", of_seasons, seasons, three_weeks("each")));
  const ResultReader few(run("few", of_seasons, seasons, three_weeks("modes")));
  const double reduction_w_m2 = few.number_attribute("reduction_error_w_m2");
  EXPECT_GT(reduction_w_m2, 0);
  const auto area = each.doubles("patch_area");
  double squares = 0, all = 0;
  for (std::size_t k = 0; k < each.doubles("time").size(); ++k) {
    const auto a = each.row("irradiance", k), b = few.row("irradiance", k);
    for (std::size_t i = 0; i < area.size(); ++i)
      squares += area[i] * (a[i] - b[i]) * (a[i] - b[i]), all += area[i];
  }
  // The nodes' own samples of the sky about the sun come in besides, as the told error has it not.
  EXPECT_LT(std::sqrt(squares / all), 3 * reduction_w_m2 + 1);
}

/// Nothing is saved by them, and all would be tests.
TEST_F(Seasons, OfFewIntervalsHaveSolutionsOfTheirOwn) {
  const auto with_year = [](const std::string& year) {
    return "period: {days: [2026-01-20, 2026-06-21], from: \"10:00\", to: \"14:00\"}\n"
           "solver: {lines_per_patch: 64, year: " +
           year + "}\noutput: {folder: results}\n";
  };
  EXPECT_EQ(different_data(run("each", of_seasons, seasons, with_year("each")),
                           run("few", of_seasons, seasons, with_year("modes"))),
            std::vector<std::string>{"study_yaml"});
}

/// Beyond the scene, too.
TEST_F(Seasons, ChangeTheFarGround) {
  const auto study_with = [&](const std::string& name, const std::string& light) {
    std::string text = study(name, usual, "seasons: {snow: [12, 1, 2]}\n");
    const std::string plain = "light: {source: clear_sky}";
    return text.replace(text.find(plain), plain.size(),
                        "light: {source: clear_sky, " + light + "}");
  };
  std::vector<std::unique_ptr<ResultReader>> results;
  for (const auto& [name, light] : {std::pair{"snow", "far_ground_seasons: {snow: 0.8}"},
                                    {"white", "far_ground_albedo: 0.8"},
                                    {"grey", "far_ground_albedo: 0.2"}}) {
    folder_.write(std::string(name) + ".yaml", study_with(name, light));
    const Ran ran = program(folder_, {"run", std::string(name) + ".yaml"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err.find("changes nothing") != std::string::npos, name != std::string("snow"));
    results.push_back(std::make_unique<ResultReader>(
        folder_ / ("results/" + std::string(name) + "/baseline.h5")));
  }
  const ResultReader &snow = *results[0], &white = *results[1], &grey = *results[2];
  EXPECT_EQ(day_difference(snow, white, "irradiance", 0), 0);
  EXPECT_EQ(day_difference(snow, grey, "irradiance", 1), 0);
  EXPECT_GT(day_difference(snow, grey, "irradiance", 0), 1);
}

/// A ground that follows the weather file has every day the light of a ground of that reflectance.
TEST_F(Seasons, FollowTheAlbedoOfTheWeather) {
  std::string weather = "time,ghi_w_m2,dhi_w_m2,albedo\n";
  const std::array<std::pair<const char*, const char*>, 3> days{
      {{"2026-01-20", "0.8"}, {"2026-03-21", "0.2"}, {"2026-06-21", "0.2"}}};
  for (const auto& [date, albedo] : days)
    for (int hour = 0; hour < 24; ++hour)
      weather += fmt::format("{}T{:02}:00,{},60,{}\n", date, hour, 60 + 20 * hour, albedo);
  folder_.write("albedo.csv", weather);
  std::vector<std::unique_ptr<ResultReader>> results;
  for (const auto& [name, reflects] :
       {std::pair{"file", "weather"}, {"white", "0.8"}, {"grey", "0.2"}}) {
    std::string text = study(name, fmt::format("    paving: {{diffuse: {}}}\n"
                                               "    canvas: {{diffuse: 0.5, sides: two}}\n",
                                               reflects));
    const std::string plain = "light: {source: clear_sky}";
    text.replace(text.find(plain), plain.size(),
                 fmt::format("light: {{source: weather, weather: albedo.csv, stamp: start, "
                             "far_ground_albedo: {}}}",
                             reflects));
    folder_.write(std::string(name) + ".yaml", text);
    const Ran ran = program(folder_, {"run", std::string(name) + ".yaml"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    results.push_back(std::make_unique<ResultReader>(
        folder_ / ("results/" + std::string(name) + "/baseline.h5")));
  }
  const ResultReader &file = *results[0], &white = *results[1], &grey = *results[2];
  for (const char* series : {"irradiance", "facade_irradiance"}) {
    EXPECT_EQ(day_difference(file, white, series, 0), 0) << series;
    EXPECT_EQ(day_difference(file, grey, series, 1), 0) << series;
    EXPECT_EQ(day_difference(file, grey, series, 2), 0) << series;
    EXPECT_GT(day_difference(file, white, series, 1), 0) << series;
  }
  EXPECT_EQ(sums_problem(file.path()), "");
}

/// A file's lamps share their power by the sides that the file has, in all seasons.
TEST_F(Seasons, LeaveTheLampsOfFilesTheirPower) {
  folder_.write(
      "lamps.wrl",
      "#VRML V2.0 utf8\n"
      "DEF ground Shape { appearance Appearance { material DEF soil Material { diffuseColor "
      ".3 .3 .3 } } geometry IndexedFaceSet { coord Coordinate { point [ -9 -9 0, 9 -9 0, 9 "
      "9 0, -9 9 0 ] } coordIndex [ 0 1 2 3 -1 ] } }\n"
      "DEF one Shape { appearance Appearance { material DEF bulb Material { diffuseColor .1 "
      ".1 .1 emissiveColor 1 1 1 } } geometry IndexedFaceSet { coord Coordinate { point [ 0 "
      "0 3, 0 1 3, 1 1 3, 1 0 3 ] } coordIndex [ 0 1 2 3 -1 ] } }\n"
      "DEF two Shape { appearance Appearance { material USE bulb } geometry IndexedFaceSet "
      "{ coord Coordinate { point [ 5 0 3, 5 3 3, 8 3 3, 8 0 3 ] } coordIndex [ 0 1 2 3 -1 "
      "] } }\n");
  const auto emitted = [&](const std::string& name, const std::string& soil,
                           const std::string& with) {
    std::string text = study(name, "    cloth: {diffuse: 0.4, sides: two}\n" + soil, with);
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{
              "files: [square.obj]",
              "files: [lamps.wrl]\n  up: z\n  emission_scale_w: 1000\n"
              "  assign: [{object: \"two*\", material: cloth}]"},
          {"    plaster: {diffuse: 0.6}\n    glass: {diffuse: 0.05, mirror: 0.85}\n    lamp: "
           "{diffuse: 0.1}\n",
           ""}})
      text.replace(text.find(from), from.size(), to);
    folder_.write(name + ".yaml", text);
    const Ran ran = program(folder_, {"run", name + ".yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ResultReader(folder_ / ("results/" + name + "/baseline.h5")).doubles("power_emitted");
  };
  const auto usual_power = emitted("always", "    soil: {diffuse: 0.3}\n", "");
  const auto seasonal = emitted(
      "sometimes", "    soil: {diffuse: 0.3, seasons: {winter: snow}}\n    snow: {diffuse: 0.8}\n",
      "seasons: {winter: [1]}\n");
  ASSERT_FALSE(usual_power.empty());
  EXPECT_GT(usual_power.front(), 0);
  EXPECT_EQ(seasonal, usual_power);
}

TEST_F(Seasons, ThatChangeNothingAreNone) {
  folder_.write("unused.yaml",
                study("unused", usual + "    nowhere: {diffuse: 0.1, seasons: {winter: canvas}}\n",
                      "seasons: {winter: [1], past: [2001-01-01, 2001-02-01]}\n"));
  const Ran unused = program(folder_, {"check", "unused.yaml"});
  EXPECT_EQ(unused.out.find("\nseasons"), std::string::npos) << unused.out;
  folder_.write("past.yaml", study("past", of_seasons,
                                   "seasons: {winter: [2001-01-01, 2001-02-01], thin: [3]}\n"));
  const Ran past = program(folder_, {"check", "past.yaml"});
  EXPECT_NE((past.out + past.err).find("season 'winter' holds in no interval"), std::string::npos)
      << past.out << past.err;
}

TEST_F(Seasons, ThatAreCalledLikeThoseOfTheCalendarAreTold) {
  const std::string more = "seasons: {thin: [6, 7], winter: [11-15, 03-15]}\n";
  const auto said = [&](const std::string& name, const std::string& totals) {
    std::string days = three_season_days;
    days.replace(days.find("month, hour_of_day"), std::string("month, hour_of_day").size(), totals);
    folder_.write(name + ".yaml", study(name, of_seasons, more, days));
    const Ran ran = program(folder_, {"check", name + ".yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out + ran.err;
  };
  const std::string told = "season 'winter' is called like one of the calendar";
  EXPECT_NE(said("both", "season").find(told), std::string::npos);
  EXPECT_EQ(said("own", "month").find(told), std::string::npos);
}

/// Whether anything of it changes a material or not.
TEST_F(Seasons, OfEveryIntervalAreInTheResult) {
  const std::string more =
      "seasons: {thin: [1, 3], \"deep winter\": [01-15, 02-15], winter: [6]}\n";
  const ResultReader result(run("named",
                                "    paving: {diffuse: 0.3, seasons: {thin: snow}}\n"
                                "    snow: {diffuse: 0.8}\n    canvas: {diffuse: 0.5}\n",
                                more));
  const auto flags = result.integers("study_seasons");
  ASSERT_EQ(flags.size(), 3 * hours_of_a_day);
  constexpr std::array<int, 3> of_days{1 + 2, 1, 4};
  for (std::size_t k = 0; k < flags.size(); ++k)
    EXPECT_EQ(flags[k], of_days[k / hours_of_a_day]) << k;
  EXPECT_EQ(result.text_attribute("study_seasons", "flag_meanings"), "thin deep_winter winter");
  EXPECT_EQ(result.number_attributes("study_seasons", "flag_masks"),
            (std::vector<double>{1, 2, 4}));
  const auto info = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{"info", result.path()};
    all.insert(all.end(), words.begin(), words.end());
    return program(folder_, all);
  };
  EXPECT_NE(info({}).out.find("thin 16 h, deep_winter 8 h, winter 8 h"), std::string::npos)
      << info({}).out;
  // Months are stored, and make up the seasons of the study; its own winter goes first.
  for (const auto& [season, month] : {std::pair{"deep winter", "1"}, {"winter", "6"}})
    EXPECT_EQ(info({"--objects", "--csv", "--season", season}).out,
              info({"--objects", "--csv", "--month", month}).out)
        << season;
  EXPECT_NE(info({"--objects", "--csv", "--season", "autumn"}).err.find("no such time"),
            std::string::npos);
  const Ran wrong = info({"--season", "wintre"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("thin, deep_winter, winter, spring"), std::string::npos) << wrong.err;
}

/// `~` takes all of them away, or one.
TEST_F(Seasons, CanBeTakenAwayByAVariant) {
  const auto with_variants = [&](const std::string& variants) {
    return study("variants", of_seasons, seasons) + "variants:\n" + variants;
  };
  folder_.write("variants.yaml", with_variants("  - {name: all}\n  - {name: none, seasons: ~}\n"
                                               "  - {name: no_winter, seasons: {winter: ~}}\n"));
  const Ran ran = program(folder_, {"run", "variants.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto result = [&](const char* name) {
    return ResultReader(folder_ / ("results/variants/" + std::string(name) + ".h5"));
  };
  const ResultReader all = result("all"), none = result("none"), no_winter = result("no_winter");
  const ResultReader summer(run("summer", usual)), spring(run("spring", in_spring));
  EXPECT_FALSE(none.has("study_seasons"));
  for (std::size_t day = 0; day < 3; ++day)
    EXPECT_EQ(day_difference(none, summer, "irradiance", day), 0) << day;
  EXPECT_EQ(day_difference(no_winter, spring, "irradiance", 0), 0);
  EXPECT_EQ(day_difference(no_winter, all, "irradiance", 1), 0);
  EXPECT_GT(day_difference(no_winter, all, "irradiance", 0), 0);
  for (const auto& [variants, words] :
       {std::pair{"  - {name: a, light: ~}\n", "light has no value"},
        {"  - {name: a, scene: {materials: {paving: {seasons: {wintre: snow}}}}}\n",
         "'wintre' is no season of the study"}}) {
    folder_.write("wrong.yaml", with_variants(variants));
    const Ran wrong = program(folder_, {"check", "wrong.yaml"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_NE(wrong.err.find(words), std::string::npos) << wrong.err;
  }
}

/// What an opaque body covers is cut out with the materials as written: told once, and only where
/// there is something.
TEST_F(Seasons, TellOfWhatTheyWouldUncover) {
  const std::string materials =
      "    paving: {diffuse: 0.3}\n"
      "    canvas: {diffuse: 0.5, sides: two, seasons: {thin: gauze, winter: air}}\n"
      "    gauze: {diffuse: 0.2, transmittance: 0.4, sides: two}\n"
      "    air: {diffuse: 0, transmittance: 1, sides: two}\n";
  const auto warned = [&](const std::string& name, const std::string& box) {
    std::string text = study(name, materials, seasons);
    const std::string files = "  files: [square.obj]\n";
    if (!box.empty())
      text.insert(text.find(files) + files.size(),
                  "  edit:\n    - {add: {name: tent, material: canvas, box: {position_m: [10, -10, "
                  "2], size_m: [4, 4, 3]}}}\n    - {add: {name: table, material: plaster, box: "
                  "{position_m: " +
                      box + ", size_m: [1, 1, 1]}}}\n");
    folder_.write(name + ".yaml", text);
    const Ran ran = program(folder_, {"check", name + ".yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const std::string words = "triangles let light pass in season ";
    const auto first = ran.out.find(words);
    if (first == std::string::npos) return std::string();
    EXPECT_EQ(ran.out.find(words, first + 1), std::string::npos) << ran.out;
    return ran.out.substr(first, ran.out.find('\n', first) - first);
  };
  EXPECT_EQ(warned("awning", ""), "");
  EXPECT_EQ(warned("beside", "[5, -10, 0]"), "");
  EXPECT_NE(warned("within", "[10, -10, 3]").find("'thin, winter', 'thin'"), std::string::npos);
}

TEST_F(Seasons, AreToldByCheckAndNotExplained) {
  folder_.write("told.yaml", study("told", of_seasons, seasons));
  const Ran check = program(folder_, {"check", "told.yaml"});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_NE(check.out.find("thin, winter 8 h, thin 8 h, else 8 h"), std::string::npos) << check.out;
  const Ran listed = program(folder_, {"check", "told.yaml", "--json"});
  EXPECT_EQ(
      nlohmann::json::parse(listed.out).at("variants").at(0).at("seasons"),
      nlohmann::json::parse("[{\"name\": \"thin, winter\", \"hours\": 8}, {\"name\": \"thin\", "
                            "\"hours\": 8}, {\"name\": \"else\", \"hours\": 8}]"));
  ASSERT_EQ(program(folder_, {"run", "told.yaml"}).code, 0);
  const Ran factors = program(
      folder_, {"export", "results/told/baseline.h5", "--to", "form-factors", "--of", "object"});
  EXPECT_EQ(factors.code, 0) << factors.err;  // geometry alone
  const Ran explain = program(folder_, {"explain", "results/told/baseline.h5", "--sensor", "0"});
  EXPECT_EQ(explain.code, 2);
  EXPECT_NE(explain.err.find("its materials change with the seasons"), std::string::npos)
      << explain.err;
}

TEST_F(Seasons, ThatMakeNoSenseAreRefused) {
  const auto refusal = [&](const std::string& materials, const std::string& of) {
    folder_.write("wrong.yaml", study("wrong", materials, of));
    const Ran ran = program(folder_, {"check", "wrong.yaml"});
    EXPECT_EQ(ran.code, 2) << ran.out;
    return ran.err;
  };
  for (const auto& [of, words] :
       {std::pair{"seasons: {winter: [11-15]}\n", "neither two dates"},
        {"seasons: {winter: [13]}\n", "a month that is none"},
        {"seasons: {winter: [11-31, 12-02]}\n", "'11-31' is no date of a season"},
        {"seasons: {winter: [11-15, 11-15]}\n", "ends where it begins"},
        {"seasons: {winter: [11-15, 2026-11-20]}\n", "one without"},
        {"seasons: {wintre: [11-15, 12-15]}\n", "did you mean 'wintre'"}}) {
    const std::string err = refusal(of_seasons, of);
    EXPECT_NE(err.find(words), std::string::npos) << of << err;
  }
  const std::string winter = "seasons: {winter: [1, 2]}\n";
  EXPECT_NE(
      refusal("    paving: {diffuse: 0.3, seasons: {winter: slush}}\n    canvas: {diffuse: 0.5}\n",
              winter)
          .find("material 'slush' is not known"),
      std::string::npos);
  EXPECT_NE(refusal("    paving: {diffuse: 0.3, sides: two, seasons: {winter: snow}}\n"
                    "    snow: {diffuse: 0.8, sides: one}\n    canvas: {diffuse: 0.5}\n",
                    winter)
                .find("sides"),
            std::string::npos);
}

}  // namespace
}  // namespace sunload::test
