// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Several variants, one after another: each result as soon as its last batch is there, and what
/// comes of a run that ends between two of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>
#include <tuple>

#include "geo/edit/objects.h"
#include "io/result/reader.h"
#include "io/scene/file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Names = std::vector<std::string>;

const Names variants{"first", "second", "third"};
constexpr std::ptrdiff_t batches_of_a_variant = 6;
const Names only_results{"square/", "square/first.h5", "square/second.h5", "square/third.h5"};

std::string variants_study(const std::string& plaster = "0.6") {
  return std::regex_replace(square_study(), std::regex("plaster: \\{diffuse: 0.6\\}"),
                            "plaster: {diffuse: " + plaster + "}") +
         "variants:\n"
         "  - {name: first}\n"
         "  - {name: second, scene: {materials: {glass: {diffuse: 0.3, mirror: 0}}}}\n"
         "  - {name: third, scene: {materials: {paving: {diffuse: 0.2}}}}\n";
}

/// Variants of which rays tell the same have the bits of their own runs, and nobody else shares.
TEST(Variants, ShareRaysWhereOnlyDiffuseReflectancesDiffer) {
  const std::string without_lamp =
      std::regex_replace(square_study("totals", "", "3"), std::regex("emission_w_m2: 200"),
                         "emission_w_m2: 0") +
      "sensors: {points: [{position_m: [0, 2.9, 2], normal: [0, -1, 0]}]}\n"
      "variants:\n"
      "  - {name: first}\n"
      "  - {name: painted, scene: {materials: {paving: {diffuse: 0.2}, plaster: {diffuse: 0.3}}}}\n"
      "  - {name: dimmer, scene: {materials: {glass: {diffuse: 0.05, mirror: 0.5}}}}\n"
      "  - {name: black, scene: {materials: {paving: {diffuse: 0}}}}\n"
      "  - {name: dark, scene: {materials: {paving: {diffuse: 0.1}}}}\n";
  for (const auto& [errors, solver] :
       {std::pair{"totals", ""}, std::pair{"instants", ""}, std::pair{"totals", ", year: modes"},
        std::pair{"totals", ", bands: rgb"}}) {
    const WorkFolder folder;
    folder.write("square.obj", square_obj);
    std::string text = std::regex_replace(without_lamp, std::regex("standard_error: totals"),
                                          std::string("standard_error: ") + errors);
    text = std::regex_replace(text, std::regex("batch_suns: 2"),
                              "batch_suns: 2" + std::string(solver));
    folder.write("square.yaml", text);
    const Ran together = program(folder, {"run", "square.yaml", "--output", "together"});
    ASSERT_EQ(together.code, 0) << together.err;
    std::vector<std::string> sharing;
    for (const std::string name : {"first", "painted", "dimmer", "black", "dark"}) {
      if (together.err.find(name + ": rays tell of it what they told of first") !=
          std::string::npos)
        sharing.push_back(name);
      const Ran alone =
          program(folder, {"run", "square.yaml", "--variant", name, "--output", "alone"});
      ASSERT_EQ(alone.code, 0) << alone.err;
      EXPECT_EQ(different_data(folder / ("together/square/" + name + ".h5"),
                               folder / ("alone/square/" + name + ".h5")),
                Names{})
          << name << " " << errors << solver;
    }
    EXPECT_EQ(sharing, (Names{"painted", "dark"})) << errors << solver;
  }
}

/// Studies of docs/examples-variants.md, coarser: each runs, with all of its variants.
TEST(Examples, OfVariantsRun) {
  const WorkFolder folder;
  const auto configs = source_folder() + "/configs/";
  for (const auto& [name, count] :
       {std::pair{"storeys", 3}, std::pair{"courtyard", 12}, std::pair{"trees", 4}}) {
    std::string text = bytes_of(configs + name + ".yaml");
    for (const auto& [from, to] :
         {std::pair{std::string("max_edge_m: [23]"), std::string("max_edge_m: 12")},
          {"lines_per_patch: 128", "lines_per_patch: 16, direct_samples: 16"},
          {"step_min: 60", "step_min: 240"},
          {"models/", configs + "models/"}})
      text = std::regex_replace(text, std::regex(from), to);
    folder.write(std::string(name) + ".yaml", text);
    const Ran ran = program(folder, {"run", std::string(name) + ".yaml"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / ("results/" + std::string(name))),
                            fs::directory_iterator()) -
                  fs::exists(folder / ("results/" + std::string(name) + "/.work")),
              count);
  }
}

TEST(Scene, TellsWhatItWritesByNameAlone) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  std::string text = square_study();
  text.insert(
      text.find("  files: [square.obj]"),
      "  edit: [{add: {tree: {position_m: [15, 15], height_m: 9, crown_m: 6, trunk_m: 2}}}]\n");
  folder.write("trees.yaml", text);
  const Ran ran = program(folder, {"scene", "trees.yaml", "-o", "trees.obj"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  for (const char* part : {"warning: trees.obj: of crown, wood it has the names alone",
                           "scene.materials: {crown: {}, wood: {}} takes the table's\n"})
    EXPECT_NE(ran.err.find(part), std::string::npos) << part << ran.err;
}

/// Written and read back: types, CRS, closed bodies, and what the steps did.
TEST(Scene, WritesTheEditedModelOfAStudy) {
  const WorkFolder folder;
  const std::string storeys = source_folder() + "/configs/storeys.yaml";
  const auto written = [&](const std::string& variant) {
    const std::string name = variant + ".city.json";
    const Ran ran = program(folder, {"scene", storeys, "--variant", variant, "-o", name});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return read_scene_file(folder / name, {});
  };
  const PolygonModel low = written("storeys-0"), high = written("storeys-2");
  ASSERT_EQ(low.object_names, high.object_names);
  EXPECT_EQ(low.object_kinds, high.object_kinds);
  EXPECT_EQ(low.crs, high.crs);
  EXPECT_FALSE(low.crs.empty());
  const auto before = extents_of(low), after = extents_of(high);
  for (std::size_t o = 0; o < before.size(); ++o) {
    const double risen = after[o].box.high.z - before[o].box.high.z;
    EXPECT_NEAR(risen, low.object_names[o] == "house_a3" ? 6 : 0, 2e-6) << low.object_names[o];
  }
  const auto lime = std::find(low.object_names.begin(), low.object_names.end(), "lime_1");
  ASSERT_NE(lime, low.object_names.end());
  EXPECT_EQ(low.object_kinds[static_cast<std::size_t>(lime - low.object_names.begin())],
            "SolitaryVegetationObject");
  EXPECT_EQ(program(folder, {"scene", storeys, "--variant", "storeys-9", "-o", "x.city.json"}).code,
            2);
  EXPECT_EQ(program(folder, {"scene", "street", "--variant", "a", "-o", "x.obj"}).code, 2);
}

struct Three {
  WorkFolder folder;
  Three() {
    folder.write("square.obj", square_obj);
    folder.write("square.yaml", variants_study());
  }
  Ran run(const Names& options = {}) const {
    Names words{"run", "square.yaml"};
    words.insert(words.end(), options.begin(), options.end());
    return program(folder, words);
  }
  std::string result(const std::string& variant) const {
    return folder / ("results/square/" + variant + ".h5");
  }
  std::ptrdiff_t batches(const std::string& variant) const {
    const Names names = folder.content("results");
    return std::count_if(names.begin(), names.end(), [&](const std::string& name) {
      return name.ends_with(".batch") && name.find("/" + variant + "-") != std::string::npos;
    });
  }
  /// Runs, and kills when `seen()` first holds.
  template <class Seen>
  Ran killed_when(const Names& options, Seen&& seen) const {
    Names words{"run", "square.yaml"};
    words.insert(words.end(), options.begin(), options.end());
    Process process(program_words(words), folder.path());
    while (process.is_running() && !seen()) std::this_thread::sleep_for(100us);
    process.send(SIGKILL);
    return process.wait();
  }
  Ran killed_at_the_first_result() const {
    return killed_when({}, [&] { return fs::exists(result("first")); });
  }
  /// Whether the first result was there before the last variant was computed.
  bool first_is_early() const {
    return fs::exists(result("first")) && !fs::exists(result("third")) &&
           batches("third") < batches_of_a_variant;
  }
};

/// The results of a run that nobody disturbed.
const Three& undisturbed_variants() {
  static const Three three;
  static const Ran ran = three.run();
  EXPECT_EQ(ran.code, 0) << ran.err;
  return three;
}

void expect_same_results(const Three& three) {
  for (const auto& variant : variants)
    EXPECT_EQ(different_data(three.result(variant), undisturbed_variants().result(variant)),
              Names{})
        << variant;
  EXPECT_EQ(three.folder.content("results"), only_results);
}

/// Whether a run has said what a variant's work cost: where all batches were there it does not.
bool was_computed(const Ran& ran, const std::string& variant) {
  return std::regex_search(ran.err, std::regex(variant + ": [0-9]+ patches\n"));
}

TEST(Variants, TheFirstResultIsThereWhileOthersAreComputed) {
  const Three three;
  const Ran killed = three.killed_at_the_first_result();
  ASSERT_EQ(killed.signal, SIGKILL) << killed.err;
  EXPECT_TRUE(three.first_is_early());
  const std::string first = three.folder.read("results/square/first.h5");

  const Ran plain = three.run();
  EXPECT_EQ(plain.code, 2) << plain.err;
  EXPECT_NE(plain.err.find("use --resume to accept it"), std::string::npos) << plain.err;
  const Ran resumed = three.run({"--resume"});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_FALSE(was_computed(resumed, "first")) << resumed.err;
  EXPECT_EQ(three.folder.read("results/square/first.h5"), first);
  expect_same_results(three);
}

// The twin: all variants computed before the first is merged.
TEST(Variants, ResultsAfterAllBatchesAreNotEarly) {
  const Three three;
  ASSERT_EQ(three.run({"--keep-batches"}).code, 0);
  for (const char* later : {"second", "third"}) fs::remove(three.result(later));
  EXPECT_EQ(three.batches("third"), batches_of_a_variant);
  EXPECT_FALSE(three.first_is_early());
}

TEST(Variants, OverwritingComesAgainWithoutComputingTwice) {
  const Three three;
  three.folder.write("square.yaml", variants_study("0.5"));
  ASSERT_EQ(three.run().code, 0);
  three.folder.write("square.yaml", variants_study());
  const auto before = fs::last_write_time(three.result("first"));
  const Ran killed = three.killed_when(
      {"--overwrite"}, [&] { return fs::last_write_time(three.result("first")) != before; });
  ASSERT_EQ(killed.signal, SIGKILL) << killed.err;
  EXPECT_LT(three.batches("third"), batches_of_a_variant);
  // What a scheduler does: the same line again.
  const Ran again = three.run({"--overwrite"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_FALSE(was_computed(again, "first")) << again.err;
  EXPECT_TRUE(was_computed(again, "third")) << again.err;
  expect_same_results(three);
}

TEST(Variants, ADamagedResultIsReplacedByShardsThatOverwrite) {
  const Three three;
  ASSERT_EQ(three.run().code, 0);
  fs::resize_file(three.result("first"), 5000);
  for (const char* shard : {"0/2", "1/2"}) {
    const Ran ran = three.run({"--overwrite", "--shard", shard});
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  expect_same_results(three);
}

TEST(Variants, ShardsOneAfterAnotherGiveTheSameBits) {
  const Three three;
  for (const char* shard : {"0/3", "1/3", "2/3"}) {
    const Ran ran = three.run({"--resume", "--shard", shard});
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  expect_same_results(three);
}

TEST(Variants, AllThatIsWrongIsSaidBeforeAnythingIsComputed) {
  const Three three;
  three.folder.write("cut.obj", "v 0 0 0\nf 1 2");
  three.folder.write("nan.obj", "v 0 0 nan\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  three.folder.write("square.yaml", square_study() +
                                        "variants:\n"
                                        "  - {name: first}\n"
                                        "  - {name: second, scene: {files: [cut.obj]}}\n"
                                        "  - {name: third, scene: {files: [nan.obj]}}\n");
  const Ran ran = three.run();
  EXPECT_EQ(ran.code, 2) << ran.err;
  for (const char* file : {"cut.obj", "nan.obj"})
    EXPECT_NE(ran.err.find(file), std::string::npos) << ran.err;
  EXPECT_FALSE(fs::exists(three.folder / "results"));
}

/// What reflected light is off by where patches are others, beside the standard errors.
TEST(Variants, OfOtherPatchesHaveAnErrorOfTheMesh) {
  const SquareFolder square(square_study("totals", "", "3") +
                            "variants:\n  - {name: base}\n  - {name: dark, scene: {materials: "
                            "{paving: {diffuse: 0.1}}}}\n  - {name: coarse, mesh: {max_edge_m: "
                            "6}}\n");
  ASSERT_EQ(square.run("results").code, 0);
  const auto compared = [&](const char* variant, const char* how) {
    return program(square.folder, {"compare", "square.yaml", "base", variant, "--least", "1", how})
        .out;
  };
  const auto dark = nlohmann::json::parse(compared("dark", "--json"))["rows"];
  ASSERT_FALSE(dark.empty());
  for (const auto& row : dark) EXPECT_EQ(row["mesh_error_kwh_m2"], 0) << row["name"];
  EXPECT_EQ(compared("dark", "--storey-m=3").find("mesh:"), std::string::npos);

  const auto reflected = [&](const char* variant) {
    const ResultReader result(square.result("results", variant));
    const auto area = result.doubles("patch_area"), load = result.doubles("light_load_reflected");
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < area.size(); ++i) sum += area[i] * load[i], all += area[i];
    return sum / all;
  };
  const auto rows = nlohmann::json::parse(compared("coarse", "--json"))["rows"];
  const double told = rows[0]["mesh_error_kwh_m2"].get<double>();
  EXPECT_EQ(rows[0]["group"], "whole");
  EXPECT_NE(compared("coarse", "--storey-m=3").find("mesh:"), std::string::npos);
  // A few small patches are the same in both.
  const double of_all = 0.1 * std::hypot(reflected("base"), reflected("coarse"));
  EXPECT_LE(told, of_all * (1 + 1e-6));
  EXPECT_GT(told, 0.95 * of_all);
}

/// Selections and storeys have patches by their middles: those of other meshes lie elsewhere.
TEST(Variants, OfOtherPatchesAreComparedInTheSamePlaces) {
  const SquareFolder square(square_study("totals", "", "1.2") +
                            "selections:\n  low: {object: house, surface: wall, height_m: "
                            "[0, 2.5]}\nvariants:\n  - {name: base}\n  - {name: coarse, "
                            "mesh: {max_edge_m: 5}}\n");
  ASSERT_EQ(square.run("results").code, 0);
  using Row = std::pair<double, double>;  // area that is compared, difference
  std::map<std::string, Row> there, back;
  for (const auto& [one, other, found] :
       {std::tuple{"base", "coarse", &there}, {"coarse", "base", &back}}) {
    const auto rows = nlohmann::json::parse(
        program(square.folder, {"compare", "square.yaml", one, other, "--storey-m", "3", "--json"})
            .out)["rows"];
    for (const auto& row : rows) {
      if (row["group"] != "selection" && row["group"] != "storey") continue;
      if (row["base_kwh_m2"].is_null() || row["variant_kwh_m2"].is_null()) continue;
      EXPECT_FALSE(row["significant"].get<bool>()) << row;
      EXPECT_LT(std::abs(row["difference_percent"].get<double>()), 2) << row;
      (*found)[row["name"].get<std::string>()] = {row["area_m2"].get<double>(),
                                                  row["difference_kwh_m2"].get<double>()};
    }
  }
  EXPECT_GE(there.size(), 2u);
  ASSERT_EQ(there.size(), back.size());
  for (const auto& [name, row] : there) {
    EXPECT_NEAR(row.first, back[name].first, 1e-3 * row.first) << name;
    EXPECT_NEAR(row.second, -back[name].second, 1e-3) << name;
  }
}

}  // namespace
}  // namespace sunload::test
