// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Listings with fixed headers, exit codes, and what running again does (docs/developer/design.md,
/// Commands and exit codes).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/batch/chunk.h"
#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct CommandedSquare : SquareFolder {
  explicit CommandedSquare(const std::string& more = "") : SquareFolder(square_study() + more) {}
  Ran run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1, "square.yaml");
    return program(folder, arguments);
  }
  std::string result(const std::string& variant = "baseline") const {
    return SquareFolder::result("results", variant);
  }
  /// Path of a batch, from its number.
  std::string batch(int number) const {
    for (const auto& name : folder.content())
      if (name.ends_with(fmt::format("{:06}.batch", number))) return folder / name;
    ADD_FAILURE() << "batch " << number << " is not there";
    return {};
  }
  void change(const std::string& from, const std::string& to) const {
    std::string text = folder.read("square.yaml");
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    folder.write("square.yaml", text.replace(at, from.size(), to));
  }
};

const std::string two_variants =
    "variants:\n"
    "  - {name: mirror}\n"
    "  - {name: dull, scene: {materials: {glass: {diffuse: 0.3, mirror: 0}}}}\n";

/// A run would refine; what is told without it are the least patches, and variants that differ in
/// their materials alone share what is read and computed.
TEST(Commands, CheckWithoutRefinement) {
  const CommandedSquare square(two_variants);
  const auto refining = [&](const std::string& text) {
    auto study = text;
    const std::string none = "oracle: none, ";
    return study.erase(study.find(none), none.size());
  };
  square.write_study(refining(square.folder.read("square.yaml")));
  const auto checked = [&](const Lines& options) {
    Lines words{"check", "--json", "--progress", "none"};
    words.insert(words.end(), options.begin(), options.end());
    const Ran ran = square.run(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return nlohmann::json::parse(ran.out)["variants"];
  };
  const auto refined = checked({}), least = checked({"--no-refine"});
  ASSERT_EQ(least.size(), 2u);
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_EQ(least[v]["hash"], refined[v]["hash"]);
    EXPECT_EQ(least[v]["refined"], false);
    EXPECT_LT(least[v]["patches"], refined[v]["patches"]);
    EXPECT_EQ(least[v]["hash"], checked({"--no-refine", "--variant", least[v]["name"]})[0]["hash"]);
  }
  EXPECT_NE(square.run({"check", "--no-refine"}).out.find("not refined here"), std::string::npos);
}

TEST(Commands, CheckAsJson) {
  const CommandedSquare square(two_variants);
  const Ran ran = square.run({"check", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto json = nlohmann::ordered_json::parse(ran.out);
  Lines keys, keys_of_variant;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (Lines{"study", "folder", "variants", "batch_suns", "units"}));
  EXPECT_EQ(json["study"], "square");
  EXPECT_EQ(json["folder"], "results");
  const Ran elsewhere = square.run({"check", "--json", "--output", "there"});
  EXPECT_EQ(nlohmann::json::parse(elsewhere.out)["folder"], "there");
  ASSERT_EQ(json["variants"].size(), 2u);
  for (const auto& variant : json["variants"]) {
    keys_of_variant.clear();
    for (const auto& [key, value] : variant.items()) keys_of_variant.push_back(key);
    EXPECT_EQ(keys_of_variant,
              (Lines{"name", "hash", "patches", "intervals", "lit", "batches", "lines",
                     "memory_bytes", "disk_bytes", "seconds", "seasons"}));
    EXPECT_TRUE(variant["seasons"].empty());
    EXPECT_EQ(variant["intervals"], 12);
    EXPECT_EQ(variant["batches"], 6);
    EXPECT_EQ(variant["hash"].get<std::string>().size(), 64u);
    EXPECT_EQ(variant["lines"], 64 * variant["patches"].get<int>());
  }
  EXPECT_EQ(json["batch_suns"], 2);
  EXPECT_EQ(json["units"], 12);
  EXPECT_NE(json["variants"][0]["hash"], json["variants"][1]["hash"]);
  EXPECT_EQ(square.folder.content(), (Lines{"square.obj", "square.yaml"}));
}

TEST(Commands, SunAsCsv) {
  const CommandedSquare square;
  square.change("from: \"06:00\", to: \"18:00\", ", "");
  const Ran ran = square.run({"sun"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Lines lines = lines_of(ran.out);
  ASSERT_EQ(lines.size(), 25u);  // a day in hours, the night included
  EXPECT_EQ(lines[0], "time,azimuth_deg,elevation_deg,dni_w_m2,dhi_w_m2,ghi_w_m2");
  double before = -1e9, highest = -90;
  int below = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(std::count(lines[i].begin(), lines[i].end(), ','), 5) << lines[i];
    EXPECT_EQ(lines[i].substr(10, 1), "T");
    EXPECT_EQ(lines[i].substr(lines[i].find(',') - 1, 1), "Z");
    std::istringstream rest(lines[i].substr(lines[i].find(',') + 1));
    double azimuth = 0, elevation = 0;
    char comma = 0;
    rest >> azimuth >> comma >> elevation;
    below += elevation < 0 ? 1 : 0;
    highest = std::max(highest, elevation);
    before = azimuth;
  }
  EXPECT_GT(before, 180);
  EXPECT_GE(below, 10);
  EXPECT_NEAR(highest, 90 - 49.7475, 1);  // noon of an equinox
}

TEST(Commands, CompareAsCsvInfoAndPictures) {
  const CommandedSquare square(two_variants);
  ASSERT_EQ(square.run({"run"}).code, 0);
  for (const char* variant : {"mirror", "dull"}) {
    EXPECT_EQ(ledger_problem(square.result(variant)), "");
    EXPECT_EQ(sums_problem(square.result(variant)), "");
  }
  const Ran by_files =
      program(square.folder, {"compare", square.result("mirror"), square.result("dull"), "--csv"});
  ASSERT_EQ(by_files.code, 0) << by_files.err;
  EXPECT_EQ(lines_of(by_files.out).at(0),
            "group,name,area_m2,base_kwh_m2,variant_kwh_m2,difference_kwh_m2,difference_percent,"
            "se_kwh_m2,paired,p_value,p_corrected,significant,unmatched_area_m2");
  const Ran by_names = program(square.folder, {"compare", "square.yaml", "dull", "--csv"});
  EXPECT_EQ(by_names.out, by_files.out) << by_names.err;
  EXPECT_EQ(program(square.folder, {"compare", "square.yaml", "mirror", "dull"}).code, 0);
  EXPECT_NE(program(square.folder, {"info", square.result("dull")}).out.find("kWh"),
            std::string::npos);
  const Ran picture = program(square.folder, {"render", square.result("dull"), "-o", "a.png"});
  EXPECT_EQ(picture.code, 0) << picture.err;
  EXPECT_EQ(square.folder.read("a.png").substr(1, 3), "PNG");
}

TEST(Commands, CheckTellsOfVariantsWhatDiffers) {
  const CommandedSquare square(two_variants);
  const Ran ran = square.run({"check", "--no-refine"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto second = ran.out.find("study square, variant dull");
  ASSERT_NE(second, std::string::npos) << ran.out;
  const auto first_part = ran.out.substr(0, second), rest = ran.out.substr(second);
  EXPECT_NE(first_part.find("triangles touch the ground"), std::string::npos);
  EXPECT_NE(rest.find(": as mirror, but for\n"), std::string::npos) << rest;
  EXPECT_NE(rest.find("  glass "), std::string::npos) << rest;
  // What both have is told once.
  EXPECT_EQ(rest.find("triangles touch the ground"), std::string::npos) << rest;
  EXPECT_EQ(rest.find("  plaster "), std::string::npos) << rest;
  EXPECT_LT(rest.size(), first_part.size() / 2) << rest;
}

/// Each is found anew in the variant's own model.
TEST(Commands, CheckTellsWhatSelectionsChooseInLaterVariants) {
  const CommandedSquare square(
      "selections: {south: {surface: wall, azimuth_deg: [135, 225]}, paving: {object: square}}\n"
      "variants:\n  - {name: as_is}\n"
      "  - {name: higher, scene: {edit: [{object: house, raise: {by_m: 3}}]}}\n");
  const Ran ran = square.run({"check", "--no-refine"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto rest = ran.out.substr(ran.out.find("variant higher"));
  EXPECT_NE(rest.find("\nselections\n  south: "), std::string::npos) << rest;
  EXPECT_EQ(rest.find("  paving: "), std::string::npos) << rest;
}

TEST(Commands, PicturesOfAStudyNeedNoRun) {
  const CommandedSquare square(two_variants);
  const auto render = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "square.yaml", "-o", "scene.png", "--size", "400x320"});
    return program(square.folder, more);
  };
  for (const char* variant : {"mirror", "dull"}) {
    const Ran ran = render({"--variant", variant, "--colour", "material"});
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  EXPECT_EQ(render({"--object", "house"}).code, 0);
  EXPECT_EQ(square.folder.read("scene.png").substr(1, 3), "PNG");
  for (const auto& more : std::vector<std::vector<std::string>>{
           {"--colour", "false"}, {"--animate"}, {"--quantity", "light_load"}, {"--variant", "x"}})
    EXPECT_EQ(render(more).code, 2) << more.back();
  // Nothing is left but the picture.
  for (const auto& name : square.folder.content())
    EXPECT_EQ(name.find(".part-"), std::string::npos) << name;
}

TEST(Commands, InfoGivesTheErrorOfTheEnergyAlsoWithErrorsOfInstants) {
  const CommandedSquare square;
  square.change("standard_error: totals", "standard_error: instants");
  ASSERT_EQ(square.run({"run"}).code, 0);
  const Energy energy = energy_of(square.result());
  const Ran info = program(square.folder, {"info", square.result()});
  EXPECT_NE(
      info.out.find(fmt::format("residual {:.3g} ± {:.2g} (", energy.residual, energy.residual_se)),
      std::string::npos)
      << info.out;
}

TEST(Commands, OnlyTheVariantsAskedFor) {
  const CommandedSquare square(two_variants);
  ASSERT_EQ(square.run({"run", "--variant", "dull"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(square.result("mirror")));
  EXPECT_EQ(square.run({"run", "--resume"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(square.result("mirror")));
}

/// The variable of a script that has never been set: not the study's own folder.
TEST(Commands, AnEmptyFolderIsRefused) {
  const CommandedSquare square;
  EXPECT_EQ(square.run({"run", "--output", ""}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(square.result("baseline")));
}

TEST(Commands, RunAgain) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run"}).code, 0);
  const std::string first = square.folder.read("results/square/baseline.h5");
  const auto is_untouched = [&] {
    return square.folder.read("results/square/baseline.h5") == first;
  };
  // Finished, same hash.
  EXPECT_EQ(square.run({"run"}).code, 2);
  EXPECT_EQ(square.run({"run", "--resume"}).code, 0);
  EXPECT_TRUE(is_untouched());
  EXPECT_EQ(square.run({"run", "--overwrite"}).code, 0);
}

TEST(Commands, WhatChangesTheHash) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run"}).code, 0);
  const std::string first = square.folder.read("results/square/baseline.h5");
  square.change("name: square\n", "name: square  # a comment\n");
  square.change("folder: results, ", "folder: results, compression: 1, series: [total], ");
  EXPECT_EQ(square.run({"run", "--resume"}).code, 0);
  EXPECT_EQ(square.folder.read("results/square/baseline.h5"), first);
  // Another hash: exit code 2 unless --overwrite.
  square.change("diffuse: 0.6", "diffuse: 0.61");
  for (const auto& arguments : {Lines{"run"}, Lines{"run", "--resume"}})
    EXPECT_EQ(square.run(arguments).code, 2);
  EXPECT_EQ(square.folder.read("results/square/baseline.h5"), first);
  const Ran over = square.run({"run", "--overwrite"});
  EXPECT_EQ(over.code, 0) << over.err;
  const ResultReader result(square.result());
  EXPECT_TRUE(result.has("irradiance"));
  EXPECT_FALSE(result.has("irradiance_direct"));  // series: [total]
  EXPECT_NE(square.folder.read("results/square/baseline.h5"), first);
  EXPECT_EQ(ledger_problem(square.result()), "");
}

// Batches hold no other series than the study wants: with more of them they are computed again.
TEST(Commands, SeriesOfKeptBatchesMayBeFewerNotMore) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run", "--output", "all"}).code, 0);
  square.change("folder: results, ", "folder: results, series: [total, sky], ");
  ASSERT_EQ(square.run({"run", "--keep-batches"}).code, 0);
  const auto kept = square.folder.read(square.batch(0).substr(square.folder.path().size() + 1));
  square.change("series: [total, sky], ", "series: [total], ");
  const Ran fewer = square.run({"run", "--overwrite", "--keep-batches", "--progress", "lines"});
  EXPECT_EQ(fewer.code, 0) << fewer.err;
  EXPECT_EQ(fewer.err.find("computed again"), std::string::npos) << fewer.err;
  EXPECT_FALSE(ResultReader(square.result()).has("irradiance_sky"));
  EXPECT_EQ(square.folder.read(square.batch(0).substr(square.folder.path().size() + 1)), kept);
  square.change("series: [total], ", "");
  const Ran merged = square.run({"merge"});
  EXPECT_EQ(merged.code, 2) << merged.err;
  EXPECT_NE(merged.err.find("lacks series that the study stores"), std::string::npos) << merged.err;
  std::filesystem::remove(square.result());
  const Ran unfinished = square.run({"merge"});
  EXPECT_EQ(unfinished.code, 75) << unfinished.err;
  EXPECT_NE(unfinished.err.find("irradiance_direct"), std::string::npos) << unfinished.err;
  const Ran more = square.run({"run", "--resume"});
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_EQ(different_data(square.result(), square.folder / "all/square/baseline.h5"), Lines{});
}

TEST(Commands, RoundedSeriesAreThoseOfTheUnroundedRun) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run", "--output", "all"}).code, 0);
  square.change("folder: results, ", "folder: results, significant_bits: 9, ");
  const Ran rounded_run = square.run({"run"});
  ASSERT_EQ(rounded_run.code, 0) << rounded_run.err;
  const ResultReader all(square.folder / "all/square/baseline.h5"), less(square.result());
  EXPECT_NE(all.text_attribute("study_sha256"), less.text_attribute("study_sha256"));
  for (const char* name : {"irradiance", "irradiance_sky", "irradiance_reflected"}) {
    const auto exact = all.doubles(name), stored = less.doubles(name);
    ASSERT_EQ(exact.size(), stored.size());
    for (std::size_t i = 0; i < exact.size(); ++i)
      ASSERT_EQ(stored[i], static_cast<double>(rounded(static_cast<float>(exact[i]), 9))) << name;
  }
  for (const char* name : {"light_load", "light_load_se", "irradiance_max", "facade_irradiance",
                           "light_load_realization", "power_residual"})
    EXPECT_EQ(all.doubles(name), less.doubles(name)) << name;
}

TEST(Commands, DamagedResultIsNamedAndReplaced) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run"}).code, 0);
  std::filesystem::resize_file(square.result(), 5000);
  for (const auto& arguments : {Lines{"run"}, Lines{"run", "--resume"}, Lines{"merge"}}) {
    const Ran ran = square.run(arguments);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find("baseline.h5: "), std::string::npos) << ran.err;
  }
  EXPECT_EQ(square.run({"run", "--overwrite"}).code, 0);
  EXPECT_EQ(ledger_problem(square.result()), "");
}

TEST(Commands, MergeTwiceIsNoWork) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run", "--keep-batches"}).code, 0);
  const std::string first = square.folder.read("results/square/baseline.h5");
  const auto content = square.folder.content();
  for (int time = 0; time < 2; ++time) {
    EXPECT_EQ(square.run({"merge"}).code, 0);
    EXPECT_EQ(square.folder.read("results/square/baseline.h5"), first);
    EXPECT_EQ(square.folder.content(), content);
  }
  // From the batches alone the same comes out, twice.
  std::filesystem::rename(square.result(), square.folder / "first.h5");
  EXPECT_EQ(square.run({"merge"}).code, 0);
  EXPECT_EQ(different_data(square.result(), square.folder / "first.h5"), Lines{});
  EXPECT_EQ(square.run({"merge"}).code, 0);
}

TEST(Commands, MergeListsWhatIsMissing) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run", "--keep-batches"}).code, 0);
  std::filesystem::rename(square.result(), square.folder / "first.h5");
  std::filesystem::remove(square.batch(1));
  std::filesystem::remove(square.batch(4));
  const Ran merge = square.run({"merge"});
  EXPECT_EQ(merge.code, 75) << merge.err;
  EXPECT_NE(merge.err.find("2 of 6 batches are missing: 1 4"), std::string::npos) << merge.err;
  EXPECT_FALSE(std::filesystem::exists(square.result()));
  EXPECT_EQ(square.run({"run"}).code, 0);
  EXPECT_EQ(different_data(square.result(), square.folder / "first.h5"), Lines{});
}

TEST(Commands, MergeBeforeAnythingIsThere) {
  const CommandedSquare square;
  const Ran merge = square.run({"merge"});
  EXPECT_EQ(merge.code, 75) << merge.err;
  EXPECT_NE(merge.err.find("6 of 6 batches are missing"), std::string::npos) << merge.err;
  EXPECT_EQ(square.folder.content(), (Lines{"square.obj", "square.yaml"}));
}

/// A run with --resume would be refused: so is the merge, and not with batches that are missing.
TEST(Commands, MergeAfterAnEditTellsOfTheResultThatIsThere) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run"}).code, 0);
  square.change("max_edge_m: 1.5", "max_edge_m: 2");
  const Ran merge = square.run({"merge"});
  EXPECT_EQ(merge.code, 2) << merge.err;
  EXPECT_NE(merge.err.find("is the result of another state of the study"), std::string::npos)
      << merge.err;
  EXPECT_NE(merge.err.find("run the study with --overwrite"), std::string::npos) << merge.err;
}

TEST(Commands, DamagedBatchIsNamedAndComputedAgain) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run", "--keep-batches"}).code, 0);
  std::filesystem::rename(square.result(), square.folder / "first.h5");
  const std::string damaged = square.batch(2), cut = square.batch(3);
  {
    std::fstream file(damaged, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(20000);
    file << std::string(100, '\x5a');  // more than lies between two arrays
  }
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  const Ran merge = square.run({"merge"});
  EXPECT_EQ(merge.code, 75) << merge.err;
  for (const char* name : {"000002.batch", "000003.batch"})
    EXPECT_NE(merge.err.find(name), std::string::npos) << merge.err;
  const Ran ran = square.run({"run", "--resume"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  for (const char* name : {"000002.batch", "000003.batch"})
    EXPECT_NE(ran.err.find(name), std::string::npos) << ran.err;
  EXPECT_EQ(different_data(square.result(), square.folder / "first.h5"), Lines{});
}

/// A difference of sums is not 0 to the last digit: "unshot -7e-09" of kilowatt-hours is nothing.
TEST(Commands, InfoLeavesOutWhatRoundingMakesOfTheLedger) {
  const CommandedSquare square;
  ASSERT_EQ(square.run({"run"}).code, 0);
  const auto unshot_of = [&](const std::string& watts) {
    const Ran set = python(square.folder,
                           "import h5py, sys\n"
                           "with h5py.File(sys.argv[1], 'r+') as file:\n"
                           "    file['power_unshot'][...] = float(sys.argv[2])\n",
                           {square.result(), watts});
    EXPECT_EQ(set.code, 0) << set.err;
    const Ran info = program(square.folder, {"info", square.result()});
    EXPECT_EQ(info.code, 0) << info.err;
    const auto at = info.out.find("unshot");
    return at == std::string::npos ? std::string()
                                   : info.out.substr(at, info.out.find('\n', at) - at);
  };
  EXPECT_EQ(unshot_of("-1e-6"), "");
  // 12 hours of them.
  EXPECT_EQ(unshot_of("1000"), "unshot 12");
  EXPECT_EQ(unshot_of("-1000"), "unshot -12");
}

/// OBJ of a closed box of 2 x 3 x 4 m with a corner at (x, 0, 0), its first vertex numbered
/// `first`.
std::string box_at(const std::string& name, double x, int first) {
  std::string text = "o " + name + "\n";
  for (const int z : {0, 4})
    for (const auto& [a, b] : {std::pair{0, 0}, {2, 0}, {2, 3}, {0, 3}})
      text += fmt::format("v {} {} {}\n", x + a, b, z);
  for (const std::array face : {std::array{3, 2, 1, 0},
                                {4, 5, 6, 7},
                                {0, 1, 5, 4},
                                {1, 2, 6, 5},
                                {2, 3, 7, 6},
                                {3, 0, 4, 7}}) {
    text += "f";
    for (const int v : face) text += fmt::format(" {}", first + v);
    text += "\n";
  }
  return text;
}

TEST(Commands, InfoTellsWhatIsCovered) {
  const WorkFolder folder;
  const auto covered_with_gap = [&](double gap_m) {
    folder.write("pair.obj", box_at("left", 0, 1) + box_at("right", 2 + gap_m, 9));
    folder.write("pair.yaml",
                 "format: sunload-study-1\nname: pair\n"
                 "site: {latitude_deg: 50, longitude_deg: 14, timezone: UTC}\n"
                 "period: {days: [2026-03-21], from: \"11:00\", to: \"12:00\", step_min: 60}\n"
                 "light: {source: clear_sky}\nscene: {files: [pair.obj]}\n"
                 "mesh: {oracle: none, max_edge_m: 4}\n"
                 "solver: {lines_per_patch: 16, realizations: 4}\n");
    EXPECT_EQ(program(folder, {"run", "pair.yaml", "--overwrite"}).code, 0);
    const std::string text = program(folder, {"info", "results/pair/baseline.h5"}).out;
    const auto at = text.find("\ncovered ");
    return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
  };
  EXPECT_EQ(covered_with_gap(0), "covered      wall 24 m2");  // twice 3 m by 4 m
  EXPECT_EQ(covered_with_gap(0.5), "");
}

}  // namespace
}  // namespace sunload::test
