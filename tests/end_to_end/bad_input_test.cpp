// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What is wrong is said in one line each, all at once, and nothing is left behind.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "io/result/reader.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/result_change.h"
#include "tests/support/result_check.h"
#include "tests/support/small_result.h"
#include "tests/support/small_study.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

/// A folder with the small study, to be spoilt.
struct Small : SquareFolder {
  void spoil(const std::string& from, const std::string& to) const {
    write_study(replaced(folder.read("square.yaml"), from, to));
  }
};

/// Lines of the standard error but for warnings of the study.
std::vector<std::string> problems(const Ran& ran) {
  auto lines = ran.lines();
  std::erase_if(lines, [](const auto& line) { return line.find("warning: ") != line.npos; });
  return lines;
}

/// Every line is one problem that contains one of the parts, each part has its line.
void expect_problems(const Ran& ran, const std::vector<std::string>& parts) {
  const auto lines = problems(ran);
  EXPECT_EQ(lines.size(), parts.size()) << ran.err;
  for (const auto& part : parts)
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(),
                            [&](const auto& line) { return line.find(part) != line.npos; }))
        << part << "\nis missing in\n"
        << ran.err;
}

/// Refused with exit code 2; the folder is as it was.
void expect_refused(const WorkFolder& folder, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& parts) {
  const auto before = folder.content();
  const Ran ran = program(folder, arguments);
  EXPECT_EQ(ran.code, 2) << ran.err;
  EXPECT_EQ(ran.out, "");
  expect_problems(ran, parts);
  EXPECT_EQ(folder.content(), before);
}

struct Wrong {
  const char *from, *to, *said;
};

TEST(BadInput, OneWrongValueInAStudyIsSaidWithItsPlace) {
  for (const auto& [from, to, said] : {
           Wrong{"max_edge_m", "max_egde_m",
                 "square.yaml:14:22: unknown key 'max_egde_m' in mesh; did you mean 'max_edge_m'?"},
           Wrong{"max_edge_m", "max_edge_cm", "did you mean 'max_edge_m'? Its unit is metres"},
           Wrong{"latitude_deg: 49.7475", "latitude_deg: 148.2",
                 "square.yaml:3:22: site.latitude_deg: 148.2 is out of range"},
           Wrong{"Europe/Prague", "Europe/Pragu", "unknown time zone 'Europe/Pragu'"},
           Wrong{"square.obj", "triangle.obj", "'triangle.obj' is not there"},
           Wrong{"diffuse: 0.3}", "diffuse: 1.3}", "square.yaml:9:23: "},
           Wrong{"step_min: 60", "step_min: sixty", "square.yaml:4:"},
           Wrong{"days: [2026-03-21]", "days: [2026-02-30]", "square.yaml:4:"},
           Wrong{"realizations: 16", "realizations: 15", "cannot be shared by 15 realizations"},
           Wrong{"mirror: 0.85", "mirror: 0.99", "glass"},
       }) {
    const Small small;
    small.spoil(from, to);
    const Ran ran = program(small.folder, {"run", "square.yaml"});
    EXPECT_NE(ran.err.find(said), std::string::npos) << said << "\nis missing in\n" << ran.err;
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_EQ(small.folder.content(), (std::vector<std::string>{"square.obj", "square.yaml"}));
    const std::regex place("square\\.yaml:[0-9]+:[0-9]+: .+");
    for (const auto& line : ran.lines()) EXPECT_TRUE(std::regex_match(line, place)) << line;
  }
}

/// Intervals below what instants resolve, a beam without a solid angle.
TEST(BadInput, WhatIsTooSmallToBeResolved) {
  const WorkFolder folder;
  const std::string head =
      "format: sunload-study-1\nname: t\nsite: {latitude_deg: 49.7, longitude_deg: 13.4, "
      "timezone: UTC}\nmesh: {oracle: none}\n";
  const std::string box = "scene: {builtin: {name: box_on_plane}}\n";
  for (const auto& [key, text] :
       {std::pair<std::string, std::string>{
            "period.interval_min",
            "period: {instants: ['2026-06-21T12:00'], interval_min: 1e-9}\n" + box},
        {"period.positions[].interval_min",
         "period: {positions: [{azimuth_deg: 10, elevation_deg: 40, interval_min: 1e-11}]}\n"
         "light: {source: fixed, dni_w_m2: 500, dhi_w_m2: 100}\n" +
             box},
        {"scene.luminaires[].beam_deg",
         "period: {instants: ['2026-06-21T12:00']}\nlight: {quantity: illuminance}\nscene: "
         "{builtin: {name: box_on_plane}, luminaires: [{position_m: [0, 0, 30], flux_lm: 1000, "
         "beam_deg: 1e-6}]}\n"}}) {
    folder.write("t.yaml", head + text);
    const Ran ran = program(folder, {"check", "t.yaml"});
    EXPECT_EQ(ran.code, 2) << key << "\n" << ran.err;
    EXPECT_NE(ran.err.find("is out of range"), std::string::npos) << key << "\n" << ran.err;
  }
}

TEST(BadInput, ShotsOfMoreSamplesThanCanBeKeptAreRefusedBeforeTheRun) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("square.yaml",
               square_study("totals", ", transport: shoot, power_per_sample_w: 1e-20"));
  for (const char* command : {"check", "run"}) {
    const Ran ran = program(folder, {command, "square.yaml"});
    EXPECT_EQ(ran.code, 2) << command << "\n" << ran.err;
    EXPECT_NE(ran.err.find("solver.power_per_sample_w asks for"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("use a smaller"), std::string::npos) << ran.err;
  }
}

TEST(BadInput, AllErrorsOfAStudyAtOnce) {
  const Small small;
  small.spoil("latitude_deg: 49.7475", "latitude_deg: 148.2");
  small.spoil("max_edge_m", "max_egde_m");
  small.spoil("square.obj", "triangle.obj");
  small.spoil("batch_suns: 2", "batch_suns: 2, boucnes: 3");
  expect_refused(small.folder, {"run", "square.yaml"},
                 {"square.yaml:3:22: ", "square.yaml:7:11: ", "square.yaml:14:22: ",
                  "did you mean 'bounces'?"});
}

TEST(BadInput, SceneFiles) {
  const std::string city = R"({"type":"CityJSON","version":"2.0","vertices":[[0,0,0],)";
  struct Case {
    const char* name;
    std::string text;
    const char* said;
  };
  for (const auto& [name, text, said] : {
           Case{"cut.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2", "cut.obj:4"},
           Case{"index.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n", "index.obj:4"},
           Case{"nan.obj", "v 0 0 0\nv 1 0 0\nv 1 1 nan\nf 1 2 3\n", "nan.obj:3"},
           Case{"empty.obj", "", "empty.obj: is empty"},
           Case{"points.obj", "v 0 0 0\n", "points.obj: the scene has no polygons"},
           Case{"line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "nothing is left of the scene"},
           Case{"cut.city.json", city, "cut.city.json:1:"},
           Case{"none.city.json", "{}", "none.city.json"},
           Case{"word.txt", "hello", "word.txt"},
       }) {
    const Small small;
    small.folder.write(name, text);
    small.spoil("square.obj", name);
    expect_refused(small.folder, {"run", "square.yaml"}, {said});
    expect_refused(small.folder, {"check", "square.yaml"}, {said});
  }
}

TEST(BadInput, EveryBadSceneFileIsNamed) {
  const Small small;
  small.folder.write("cut.obj", "v 0 0 0\nf 1 2");
  small.folder.write("nan.obj", "v 0 0 nan\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  small.spoil("square.obj", "cut.obj, nan.obj, square.obj");
  expect_refused(small.folder, {"run", "square.yaml"}, {"cut.obj:", "nan.obj:"});
}

TEST(BadInput, StudyFiles) {
  const WorkFolder folder;
  folder.write("empty.yaml", "");
  folder.write("cut.yaml", "format: [1, 2\nname: 3");
  folder.write("bytes.yaml", std::string("\xff\xfe\0\1", 4));
  folder.write("folder.yaml/file", "");
  expect_refused(folder, {"run", "none.yaml"}, {"none.yaml: "});
  expect_refused(folder, {"run", "empty.yaml"}, {"empty.yaml:1:1: is empty"});
  expect_refused(folder, {"run", "cut.yaml"}, {"cut.yaml:2:"});
  expect_refused(folder, {"run", "bytes.yaml"}, {"bytes.yaml:1:1: "});
  expect_refused(folder, {"run", "folder.yaml"}, {"folder.yaml: is a folder"});
}

/// HDF5 reads the file, and what it says points out of its arrays.
TEST(BadInput, ResultsThatAreChanged) {
  const WorkFolder folder;
  std::filesystem::copy_file(write_small_result({}, "good"), folder / "good.h5");
  std::filesystem::copy_file(folder / "good.h5", folder / "bad.h5");
  change_number(folder / "bad.h5", "patch_vertices", 1, 1e6);
  const std::vector<std::vector<std::string>> commands{
      {"info", "bad.h5"},
      {"info", "bad.h5", "--patches"},
      {"compare", "bad.h5", "good.h5"},
      {"compare", "good.h5", "bad.h5", "--csv"},
      {"export", "bad.h5", "--to", "csv"},
      {"export", "bad.h5", "--to", "glb", "-o", "bad.glb"},
      {"render", "bad.h5", "-o", "bad.png"},
      {"render", "good.h5", "--same-scale", "bad.h5", "-o", "good.png"},
      {"view", "bad.h5", "-o", "bad.html"}};
  for (const auto& command : commands)
    expect_refused(folder, command, {"bad.h5: dataset patch_vertices has 1000000 at place 1"});
}

TEST(BadInput, CommandLines) {
  const Small small;
  const auto refused = [&](std::vector<std::string> arguments, const char* said) {
    expect_refused(small.folder, arguments, {said});
  };
  refused({}, "see sunload --help");
  refused({"runn", "square.yaml"}, "unknown command 'runn'; did you mean 'run'?");
  refused({"frobnicate"}, "unknown command 'frobnicate'");
  refused({"run"}, "STUDY is required");
  refused({"run", "square.yaml", "--resum"},
          "unknown argument '--resum'; did you mean '--resume'?");
  refused({"run", "square.yaml", "more.yaml"}, "unknown argument 'more.yaml'");
  refused({"run", "square.yaml", "--threads", "0"}, "--threads");
  refused({"run", "square.yaml", "--time-limit", "-1"}, "is not a number above 0");
  refused({"run", "square.yaml", "--progress", "loud"}, "write one of: ");
  refused({"run", "square.yaml", "--resume", "--overwrite"}, "excludes");
  refused({"run", "square.yaml", "--variant", "other"}, "no variant 'other'");
  refused({"info", "none.h5"}, "none.h5: ");
  refused({"info", "square.yaml"}, "square.yaml: is not a readable HDF5 file");
  refused({"compare", "square.yaml", "other"}, "no variant 'other'");
  refused({"scene", "stret", "-o", "x.obj"}, "unknown built-in scene 'stret'");
  refused({"scene", "street", "-o", "x.obj", "--set", "house_3=wood"}, "house_3 = 'wood'");
  const Ran two = program(small.folder, {"run", "square.yaml", "--variant", "a", "--variant", "b"});
  EXPECT_EQ(two.lines().size(), 2u) << two.err;
}

TEST(BadInput, NoOptionTakesWhatIsNoNumber) {
  const Small small;
  const std::regex number("\\s+(?:-\\w,)?(--[\\w-]+) FLOAT.*");
  std::set<std::string> asked;
  for (const char* command : {"check", "compare", "explain", "export", "horizon", "info", "init",
                              "merge", "render", "run", "scene", "sky", "sun", "view"}) {
    std::istringstream help(program(small.folder, {command, "--help"}).out);
    std::smatch words;
    for (std::string line; std::getline(help, line);) {
      if (!std::regex_match(line, words, number)) continue;
      asked.insert(words[1]);
      for (const char* value : {"nan", "inf", "-inf"})
        expect_refused(small.folder, {command, words[1].str() + "=" + value}, {value});
    }
  }
  EXPECT_TRUE(asked.contains("--storey-m") && asked.contains("--time-limit")) << asked.size();
}

TEST(BadInput, HelpAndVersionAreNoErrors) {
  const WorkFolder folder;
  for (const char* words : {"--help", "--version"}) {
    const Ran ran = program(folder, {words});
    EXPECT_EQ(ran.code, 0);
    EXPECT_NE(ran.out, "");
    EXPECT_EQ(ran.err, "");
  }
}

// Limits of the machine: exit code 3.

/// Nothing half-written: no file aside, results only whole, no empty folders of ours.
void expect_nothing_half_written(const WorkFolder& folder, const std::string& results) {
  for (const auto& name : folder.content(results)) {
    EXPECT_EQ(name.find(".part-"), std::string::npos) << name;
    if (name.ends_with(".h5")) {
      EXPECT_NO_THROW(ResultReader{folder / (results + "/" + name)});
    }
  }
}

TEST(MachineLimits, FolderThatCannotBeWritten) {
  const Small small;
  small.folder.write("file", "no folder");
  const auto before = small.folder.content();
  for (const char* output : {"file", "file/below", "/proc/sunload"}) {
    const Ran ran = program(small.folder, {"run", "square.yaml", "--output", output});
    EXPECT_EQ(ran.code, 3) << ran.err;
    expect_problems(ran, {output});
  }
  EXPECT_EQ(program(small.folder, {"scene", "canyon", "-o", "none/x.obj"}).code, 3);
  EXPECT_EQ(small.folder.content(), before);
}

TEST(MachineLimits, ListingsThatCannotBeWritten) {
  const Small small;
  const std::string command = test::program_path() + " sun square.yaml > /dev/full";
  const Ran ran = Process({"/bin/sh", "-c", command}, small.folder.path()).wait();
  EXPECT_EQ(ran.code, 3) << ran.err;
  // Beside a warning of the study, perhaps.
  EXPECT_NE(ran.err.find("cannot write to standard output: No space left on device"),
            std::string::npos)
      << ran.err;
}

/// Like a disk that becomes full sooner or later: while a batch is written, while
/// the result is, after it.
TEST(MachineLimits, FilesThatCannotGrow) {
  const Small whole;
  ASSERT_EQ(program(whole.folder, {"run", "square.yaml"}).code, 0);
  const std::string expected = whole.folder / "results/square/baseline.h5";
  const auto size = std::filesystem::file_size(expected);
  int failed = 0;
  for (const double share : {0.001, 0.2, 0.5, 0.8, 0.99}) {
    const Small small;
    Limits limits;
    limits.file_bytes = static_cast<std::uint64_t>(share * static_cast<double>(size));
    const Ran ran = program(small.folder, {"run", "square.yaml", "--progress", "none"}, limits);
    EXPECT_EQ(ran.code, 3) << share << ran.err;
    expect_problems(ran, {"cannot write"});
    expect_nothing_half_written(small.folder, "results");
    EXPECT_FALSE(std::filesystem::exists(small.folder / "results/square/baseline.h5"));
    failed += ran.code == 3 ? 1 : 0;
    const Ran again = program(small.folder, {"run", "square.yaml", "--resume"});
    EXPECT_EQ(again.code, 0) << again.err;
    // The result that is to be replaced is none that somebody else has merged meanwhile.
    const Ran anew = program(
        small.folder,
        {"run", "square.yaml", "--overwrite", "--time-limit", "1", "--progress", "none"}, limits);
    EXPECT_EQ(anew.code, 3) << share << anew.err;
    expect_problems(anew, {"cannot write"});
    EXPECT_EQ(different_data(small.folder / "results/square/baseline.h5", expected),
              std::vector<std::string>{});
  }
  EXPECT_GE(failed, 1);
}

/// Needs the right to mount; without it the limit on file sizes stands for a full disk.
TEST(MachineLimits, FullDisk) {
  const Small small;
  small.folder.write("results/none", "");
  const std::string disk = small.folder / "results";
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=256k") != 0)
    GTEST_SKIP() << "NOT RUN: mounting a tmpfs needs root";
  const Ran ran = program(small.folder, {"run", "square.yaml", "--progress", "none"});
  expect_nothing_half_written(small.folder, "results");
  ::umount(disk.c_str());
  EXPECT_EQ(ran.code, 3) << ran.err;
  EXPECT_EQ(problems(ran).size(), 1u) << ran.err;
}

TEST(MachineLimits, MorePatchesThanAnyMachineHolds) {
  const Small small;
  small.spoil("max_edge_m: 1.5", "max_edge_m: 0.001, min_area_m2: 0");
  const auto before = small.folder.content();
  const Ran ran = program(small.folder, {"run", "square.yaml", "--progress", "none"});
  EXPECT_EQ(ran.code, 3) << ran.err;
  expect_problems(ran, {"too little memory"});
  EXPECT_EQ(small.folder.content(), before);
  const Ran check = program(small.folder, {"check", "square.yaml"});
  EXPECT_EQ(check.code, 3) << check.err;
  expect_problems(check, {"too little memory"});
}

TEST(MachineLimits, FoldersThatTakeNoFilesAreToldAsWhatTheyAre) {
  const Small small;
  small.folder.write("results/none", "");
  const std::string disk = small.folder / "results";
  const auto told = [&](unsigned long flags, const char* options, int files) {
    EXPECT_EQ(::mount("tmpfs", disk.c_str(), "tmpfs", flags, options), 0);
    for (int k = 0; k < files; ++k) small.folder.write("results/" + std::to_string(k), "");
    const Ran ran = program(small.folder, {"run", "square.yaml", "--progress", "none"});
    ::umount(disk.c_str());
    EXPECT_EQ(ran.code, 3) << ran.err;
    return ran.err;
  };
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "") != 0)
    GTEST_SKIP() << "NOT RUN: mounting a tmpfs needs root";
  ::umount(disk.c_str());
  EXPECT_NE(told(MS_RDONLY, "", 0).find("Read-only file system"), std::string::npos);
  EXPECT_NE(told(0, "nr_inodes=3", 2).find("no inodes left"), std::string::npos);
  EXPECT_NE(told(0, "size=64k", 0).find("64.0 KiB are free"), std::string::npos);
}

// Sanitizers need terabytes of address space themselves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(MachineLimits, CheckWarnsOfWhatRunWouldRefuse) {
  const Small small;
  // A square of 2 GB of address space: the mesh is small, its lines are not.
  small.spoil("lines_per_patch: 64", "lines_per_patch: 1000000");
  Limits limits;
  limits.memory_bytes = 2'000'000'000;
  EXPECT_EQ(program(small.folder, {"run", "square.yaml", "--progress", "none"}, limits).code, 3);
  const Ran check = program(small.folder, {"check", "square.yaml"}, limits);
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_NE(check.err.find("warning: baseline: too little memory: about "), std::string::npos)
      << check.err;
  EXPECT_EQ(check.err.find(" 0.0 "), std::string::npos) << check.err;
}

TEST(MachineLimits, AddressSpace) {
  const Small small;
  small.spoil("max_edge_m: 1.5", "max_edge_m: 0.05, min_area_m2: 0");
  const auto before = small.folder.content();
  Limits limits;
  limits.memory_bytes = 600'000'000;
  const Ran ran = program(small.folder, {"run", "square.yaml", "--progress", "none"}, limits);
  EXPECT_EQ(ran.code, 3) << ran.err;
  expect_problems(ran, {"memory"});
  EXPECT_EQ(small.folder.content(), before);
}

/// Well below what is just enough it is threads of the ray caster that have no room.
TEST(MachineLimits, AddressSpaceForThreadsOfTheRayCaster) {
  const Small small;
  const auto ran_with = [&](std::uint64_t megabytes) {
    Limits limits;
    limits.memory_bytes = megabytes * 1'000'000;
    return program(small.folder, {"run", "square.yaml", "--overwrite", "--progress", "none"},
                   limits);
  };
  constexpr std::uint64_t step = 20, fine_step = 2, threads_from = 66, threads_to = 36;
  std::uint64_t enough = 200;
  while (enough < 800 && ran_with(enough).code != 0) enough += step;
  ASSERT_LT(enough, 800u);
  for (std::uint64_t megabytes = enough - threads_from; megabytes < enough - threads_to;
       megabytes += fine_step) {
    const Ran ran = ran_with(megabytes);
    EXPECT_TRUE(ran.code == 0 || ran.code == 3) << megabytes << ": " << ran.code << ran.err;
  }
}
#endif

}  // namespace
}  // namespace sunload::test
