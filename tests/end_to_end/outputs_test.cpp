// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Commands write what they were asked to, where they were asked to, and destroy nothing.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <regex>

#include "io/result/reader.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

namespace fs = std::filesystem;

/// A folder with a result and a copy of it under another name.
struct Results : SquareFolder {
  Results() {
    EXPECT_EQ(run("results").code, 0);
    fs::copy_file(result("results"), folder / "a.h5");
    fs::copy_file(result("results"), folder / "b.h5");
  }
  Ran shell(const std::string& command) const {
    return Process({"/bin/sh", "-c", command}, folder.path()).wait();
  }
};

const Results& results() {
  static const Results once;
  return once;
}

struct Call {
  std::vector<std::string> words;
  std::string target;
};

TEST(Outputs, NoCommandWritesOntoWhatItReads) {
  const auto& folder = results().folder;
  fs::create_symlink("a.h5", folder / "link.h5");
  for (const Call& call :
       {Call{{"export", "a.h5", "--to", "csv", "-o"}, "a.h5"},
        {{"export", "a.h5", "--to", "vtk", "-o"}, "./a.h5"},
        {{"export", "a.h5", "--to", "csv", "-o"}, "link.h5"},
        {{"compare", "a.h5", "b.h5", "--hdf5"}, "a.h5"},
        {{"compare", "a.h5", "b.h5", "--hdf5"}, "b.h5"},
        {{"compare", "square.yaml", "baseline", "--hdf5"}, "results/square/baseline.h5"},
        {{"render", "a.h5", "-o"}, "a.h5"},
        {{"render", "a.h5", "--same-scale", "b.h5", "-o"}, "b.h5"},
        {{"view", "a.h5", "b.h5", "-o"}, "b.h5"},
        {{"sun", "square.yaml", "--image"}, "square.yaml"},
        {{"sun", "square.yaml", "--image"}, "square.obj"},
        {{"sky", "square.yaml", "--time", "2026-03-21T12:00", "--image"}, "square.obj"}}) {
    auto words = call.words;
    words.push_back(call.target);
    const std::string before = folder.read(call.target);
    const Ran ran = program(folder, words);
    EXPECT_EQ(ran.code, 2) << fmt::format("{}", fmt::join(words, " ")) << "\n" << ran.err;
    EXPECT_NE(ran.err.find("this command reads"), std::string::npos) << ran.err;
    EXPECT_TRUE(folder.read(call.target) == before) << call.target;
  }
}

TEST(Outputs, AResultThatIsALinkToTheScenesFileIsNotOverwritten) {
  const SquareFolder square;
  fs::create_directories(square.folder / "results/square");
  fs::create_symlink("../../square.obj", square.folder / "results/square/baseline.h5");
  EXPECT_EQ(square.run("results", {"--overwrite"}).code, 2);
  EXPECT_EQ(square.folder.read("square.obj"), square_obj);
}

TEST(Outputs, EveryVariantHasAFileOfItsOwn) {
  const SquareFolder square(square_study() + "variants:\n  - {name: base}\n  - {name: other}\n");
  fs::create_directories(square.folder / "results/square");
  fs::create_symlink("base.h5", square.folder / "results/square/other.h5");
  const Ran linked = square.run("results");
  EXPECT_EQ(linked.code, 2);
  EXPECT_NE(linked.err.find("is the result of variant 'base', too"), std::string::npos)
      << linked.err;
  fs::remove(square.folder / "results/square/other.h5");
  fs::create_directories(square.folder / "results/square/base.h5");
  const Ran folder_in_the_way = square.run("results");
  EXPECT_EQ(folder_in_the_way.code, 3);
  EXPECT_FALSE(fs::exists(square.folder / "results/square/.work")) << "before the work";
}

/// Commands on a result make its scene again, from all that its study names.
TEST(Outputs, WhatTheStudyOfAResultNamesIsNotOverwritten) {
  const std::string places = "x,y,z,nx,ny,nz\n0,0,9,0,0,1\n";
  const SquareFolder square(square_study() + "sensors: {file: places.csv}\n");
  square.folder.write("places.csv", places);
  ASSERT_EQ(square.run("results").code, 0);
  fs::create_symlink("places.csv", square.folder / "places.png");
  const std::string result = square.result("results");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"export", result, "--to", "form-factors", "-o", "places.csv"},
        {"explain", result, "--sensor", "0", "-o", "places.png"}}) {
    const Ran ran = program(square.folder, words);
    EXPECT_EQ(ran.code, 2) << fmt::format("{}", fmt::join(words, " ")) << "\n" << ran.err;
    EXPECT_NE(ran.err.find("this command reads"), std::string::npos) << ran.err;
  }
  EXPECT_EQ(square.folder.read("places.csv"), places);
}

/// Neither by the output itself nor by what is written with it.
TEST(Outputs, WhatTheFilesOfASceneDrawInIsNotOverwritten) {
  const WorkFolder folder;
  const std::string library = "newmtl red\nKd 0.5 0.1 0.1\n",
                    wall = "#VRML V2.0 utf8\nShape { geometry Box {} }\n";
  folder.write("town.mtl", library);
  folder.write("town_v2.obj", "mtllib town.mtl\n" + std::string(square_obj));
  folder.write("wall.wrl", wall);
  folder.write("outer.wrl", "#VRML V2.0 utf8\nInline { url \"wall.wrl\" }\n");
  const auto study = [&](const std::string& name, const std::string& model) {
    folder.write(name, std::regex_replace(square_study(), std::regex("square\\.obj"), model));
  };
  study("town.yaml", "town_v2.obj");
  study("outer.yaml", "outer.wrl");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"scene", "town.yaml", "-o", "town.obj"},
        {"view", "town.yaml", "-o", "town.mtl"},
        {"view", "outer.yaml", "-o", "wall.wrl"}}) {
    const Ran ran = program(folder, words);
    EXPECT_EQ(ran.code, 2) << fmt::format("{}", fmt::join(words, " ")) << "\n" << ran.err;
    EXPECT_NE(ran.err.find("this command reads"), std::string::npos) << ran.err;
  }
  EXPECT_FALSE(fs::exists(folder / "town.obj"));
  EXPECT_EQ(folder.read("town.mtl"), library);
  EXPECT_EQ(folder.read("wall.wrl"), wall);
}

TEST(Outputs, StandardOutputByItsNameIsWrittenOn) {
  const auto& folder = results().folder;
  folder.write("listing", "before\n");
  const Ran ran = results().shell(
      program_path() + " export a.h5 --to csv --quantity series -o /dev/fd/1 >> listing");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(folder.read("listing").starts_with("before\nbegin_utc,"));
}

TEST(Outputs, ADashIsTheStandardOutput) {
  const auto& folder = results().folder;
  for (const auto& [command, mark] :
       {std::pair<std::string, std::string>{"export a.h5 --to csv --quantity series", "begin_utc,"},
        {"export a.h5 --to glb", "glTF"},
        {"export a.h5 --to vrml", "#VRML"},
        {"render a.h5 --size 320x320", "\x89PNG"},
        {"view a.h5", "<!DOCTYPE html>"}}) {
    const Ran ran = results().shell(program_path() + " " + command + " -o -");
    EXPECT_EQ(ran.code, 0) << command << "\n" << ran.err;
    EXPECT_TRUE(ran.out.starts_with(mark)) << command << "\n" << ran.out.substr(0, 40);
  }
  EXPECT_FALSE(fs::exists(folder / "-"));
}

/// As every filter ends whose reader has seen enough: by the signal, and without a word.
TEST(Outputs, NobodyIsToldOfAClosedPipe) {
  for (const std::string command :
       {"info a.h5 --patches", "export a.h5 --to csv --quantity series -o -",
        "export a.h5 --to glb -o -", "render a.h5 --size 320x320 -o -", "view a.h5 -o -"}) {
    // The reader is gone before anything is written.
    const Ran ran = results().shell("{ sleep 0.2; " + program_path() + " " + command +
                                    "; echo $? > code; } | true; cat code");
    EXPECT_EQ(ran.err, "") << command;
    EXPECT_EQ(ran.out, "141\n") << command;
  }
}

TEST(Outputs, PicturesAndBinaryFormatsGoIntoPipes) {
  const auto& folder = results().folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const auto& [command, mark] :
       {std::pair<std::string, std::string>{"render a.h5 --size 320x320 -o pipe", "\x89PNG"},
        {"export a.h5 --to glb -o pipe", "glTF"},
        {"compare a.h5 b.h5 --hdf5 pipe > table", "\x89HDF"}}) {
    const Ran ran = results().shell("cat pipe > got & " + program_path() + " " + command +
                                    "; code=$?; wait; exit $code");
    EXPECT_EQ(ran.code, 0) << command << "\n" << ran.err;
    EXPECT_TRUE(folder.read("got").starts_with(mark)) << command;
    EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
  }
}

/// Failure to write a message is no failure of the work.
TEST(Messages, ThatCannotBeWrittenStopNothing) {
  const SquareFolder square;
  for (const std::string stream : {"2>/dev/full", "2>&-", "0<&- 1>&- 2>&-"}) {
    const std::string output = "o" + std::to_string(std::hash<std::string>{}(stream));
    const Ran ran = Process({"/bin/sh", "-c",
                             program_path() + " run square.yaml --output " + output + " " + stream},
                            square.folder.path())
                        .wait();
    EXPECT_EQ(ran.code, 0) << stream;
    EXPECT_EQ(different_data(square.result(output), results().result("results")),
              std::vector<std::string>{})
        << stream;
  }
}

TEST(Messages, ThatNobodyReadsStopNothing) {
  const SquareFolder square;
  // The reader of the messages is gone before the first one comes.
  const Ran ran = Process({"/bin/sh", "-c",
                           "mkfifo log; (exec 3< log) & exec 4> log; wait; " + program_path() +
                               " run square.yaml --output o 2>&4"},
                          square.folder.path())
                      .wait();
  EXPECT_EQ(ran.code, 0);
  EXPECT_TRUE(fs::exists(square.folder / "o/square/baseline.h5"));
}

TEST(Messages, WrongInputIsWrongInputWhereNobodyCanBeTold) {
  const SquareFolder square;
  for (const std::string stream : {"2>/dev/full", "2>&-"})
    EXPECT_EQ(Process({"/bin/sh", "-c", program_path() + " run none.yaml " + stream},
                      square.folder.path())
                  .wait()
                  .code,
              2);
}

TEST(Listings, OnAClosedStandardOutputAreNotSaidToBeWritten) {
  const SquareFolder square;
  EXPECT_EQ(
      Process({"/bin/sh", "-c", program_path() + " sun square.yaml >&-"}, square.folder.path())
          .wait()
          .code,
      3);
}

TEST(Listings, LongerThanTheDiskTellsTheError) {
  const Ran ran = Process({"/bin/sh", "-c", program_path() + " info a.h5 --patches > /dev/full"},
                          results().folder.path())
                      .wait();
  EXPECT_EQ(ran.code, 3) << ran.err;
  EXPECT_NE(ran.err.find("No space left on device"), std::string::npos) << ran.err;
}

TEST(Outputs, TotalsNeedNoSeries) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("square.yaml", square_study());
  folder.write("none.yaml", std::regex_replace(square_study(), std::regex("output: \\{"),
                                               "output: {series: none, "));
  for (const char* study : {"square", "none"})
    ASSERT_EQ(program(folder, {"run", std::string(study) + ".yaml", "--output", study}).code, 0);
  const std::string all = folder / "square/square/baseline.h5";
  const std::string none = folder / "none/square/baseline.h5";
  for (const std::string& name : different_data(all, none))
    EXPECT_EQ(name.find("light_load"), std::string::npos) << name;
  const Ran table = program(folder, {"info", none, "--facades", "--hours", "8-10"});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_NE(table.out.find("house/south_1"), std::string::npos) << table.out;
  const Ran instant =
      program(folder, {"render", none, "--time", "2026-03-21T12:00", "-o", "a.png"});
  EXPECT_EQ(instant.code, 2);
  EXPECT_NE(instant.err.find("output.series"), std::string::npos) << instant.err;
}

TEST(Outputs, TellHowManySunsStandForAnInterval) {
  const std::string rest =
      " suns per interval, each at the middle of an equal part of the "
      "interval's sunlit time";
  for (const auto& [asked, said] :
       {std::pair<std::string, std::string>{"1",
                                            "sun at the middle of the sunlit part of the "
                                            "interval"},
        {"12", "12" + rest},
        {"auto", "auto: up to 3" + rest}}) {
    const SquareFolder square(square_study("none", ", sun_samples_per_interval: " + asked));
    ASSERT_EQ(square.run("o").code, 0) << asked;
    EXPECT_EQ(ResultReader(square.result("o")).text_attribute("sun_sampling"), said);
  }
  const SquareFolder by_hand(
      "format: sunload-study-1\nname: square\n"
      "period: {positions: [{azimuth_deg: 180, elevation_deg: 40}]}\n"
      "light: {source: fixed, dni_w_m2: 800, dhi_w_m2: 100, sky: uniform}\n"
      "scene: {builtin: {name: box_on_plane}}\nsolver: {lines_per_patch: 64}\n");
  ASSERT_EQ(by_hand.run("o").code, 0);
  EXPECT_EQ(ResultReader(by_hand.result("o")).text_attribute("sun_sampling"),
            "sun at the given position");
  const Ran told = program(by_hand.folder, {"info", by_hand.result("o")});
  EXPECT_NE(told.out.find("sun 1 of 1: azimuth 180°, elevation 40°"), std::string::npos);
  EXPECT_EQ(told.out.find("2000-01-01"), std::string::npos) << told.out;
}

TEST(Outputs, WhatIsNoFolderIsSaidToBeNone) {
  const SquareFolder square;
  square.folder.write("afile", "mine");
  for (const auto& [output, said] :
       {std::pair<std::string, std::string>{"afile", "afile is no folder"},
        {"afile/below", "afile is no folder"},
        {"/dev/null/x", "/dev/null is no folder"}}) {
    const Ran ran = square.run(output);
    EXPECT_EQ(ran.code, 3) << output << "\n" << ran.err;
    EXPECT_NE(ran.err.find(said), std::string::npos) << ran.err;
  }
  EXPECT_EQ(square.folder.read("afile"), "mine");
}

/// From outside a closed room shows its backs alone, which have no values.
TEST(Outputs, AClosedRoomIsLookedInto) {
  const WorkFolder folder;
  folder.write("room.yaml",
               "format: sunload-study-1\nname: room\nscene: {builtin: {name: room}}\n"
               "period: {positions: [{azimuth_deg: 180, elevation_deg: 40}]}\n"
               "light: {source: fixed, dni_w_m2: 700, dhi_w_m2: 120}\n"
               "mesh: {oracle: none, max_edge_m: 2}\n"
               "solver: {lines_per_patch: 32, realizations: 4}\n");
  ASSERT_EQ(program(folder, {"run", "room.yaml"}).code, 0);
  for (const char* camera : {"overview", "top"}) {
    const Ran ran = program(folder, {"render", "results/room/baseline.h5", "--camera", camera, "-o",
                                     "room.png", "--size", "320x320"});
    EXPECT_EQ(ran.code, 0) << camera << " " << ran.err;
  }
  const Ran past = program(folder, {"render", "results/room/baseline.h5", "--eye", "20,20,20",
                                    "--look", "40,40,40", "-o", "past.png"});
  EXPECT_EQ(past.code, 2);
}

/// From an elevation model to a sun path without its first hours.
TEST(Outputs, AHorizonIsReadByTheStudyItIsOf) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  // 60 × 60 cells of 100 m about the site in UTM 33; a plateau of 1000 m from 2050 m eastwards,
  // 998 m above the eye: atan(998 / 2050) = 25.96 deg.
  std::string rows = "ncols 60\nnrows 60\nxllcorner 497000\nyllcorner 5497000\ncellsize 100\n";
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 60; ++column) rows += column < 50 ? "0 " : "1000 ";
    rows += "\n";
  }
  folder.write("dem.asc", rows);
  const std::string study = std::regex_replace(
      square_study(), std::regex("latitude_deg: 49.7475, longitude_deg: 13.3776"),
      "latitude_deg: 49.6535, longitude_deg: 15");
  folder.write("square.yaml", study);
  const Ran none = program(folder, {"horizon", "dem.asc", "--study", "square.yaml"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("--crs"), std::string::npos) << none.err;
  // Distances on it are 1.54 times those on the ground.
  const Ran mercator =
      program(folder, {"horizon", "dem.asc", "--study", "square.yaml", "--crs", "EPSG:3857"});
  EXPECT_EQ(mercator.code, 2);
  EXPECT_NE(mercator.err.find("longer than on the ground"), std::string::npos) << mercator.err;
  const Ran ran = program(folder, {"horizon", "dem.asc", "--study", "square.yaml", "--crs",
                                   "EPSG:32633", "-o", "hills.csv"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.err.find("the raster ends after"), std::string::npos) << ran.err;
  folder.write("hills.yaml",
               std::regex_replace(study, std::regex("site: \\{"), "site: {horizon: hills.csv, "));
  const Ran checked = program(folder, {"check", "hills.yaml"});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_NE(checked.out.find("hills      360 points, up to 25.9"), std::string::npos)
      << checked.out;
}

}  // namespace
}  // namespace sunload::test
