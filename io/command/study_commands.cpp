// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "geo/base/check.h"
#include "io/command/check_study.h"
#include "io/command/commands.h"
#include "io/command/common_options.h"
#include "io/command/sub_commands.h"
#include "io/init/init.h"
#include "io/init/measure_text.h"
#include "io/run/run.h"
#include "io/scene/builtin.h"

namespace sunload {
namespace {

struct InitGiven {
  InitRules rules;
  std::string example;
  std::string output;  ///< study to write; of an example its folder
};

int init(const InitGiven& given) {
  if (!given.example.empty()) return init_example(given.example, given.output);
  if (given.rules.model.empty())
    throw InputError({}, "init of what?", "neither a model nor an example is named",
                     "write sunload init MODEL, or sunload init --example street");
  return init_study(given.rules, given.output);
}

/// What the model does not tell, or tells wrongly.
void add_corrections(const Command& command, InitRules& rules) {
  command.option("--at", rules.at,
                 "place, latitude first: \"52.01 4.36\", UTM or MGRS (default: from the CRS, or "
                 "the weather station)");
  command.option("--crs", rules.crs, "map projection of the coordinates, e.g. EPSG:28992");
  command.option("--zone", rules.zone, "time zone, e.g. Europe/Amsterdam (default: a guess)");
  command.choice("--up", rules.up, {{"x", "x"}, {"y", "y"}, {"z", "z"}},
                 "axis of the file that points up");
  command.option("--unit-m", rules.unit_m, "length of the file's unit [m], e.g. 0.001").positive();
  command.option("--height", rules.height,
                 "column of heights of plan data (default: by usual names)");
  command.option("--storeys", rules.storeys, "column of its numbers of storeys");
}

void add_progress(const Command& command, RunOptions& options) {
  command.choice("--progress", options.progress,
                 {{"auto", ProgressStyle::automatic},
                  {"bar", ProgressStyle::bar},
                  {"lines", ProgressStyle::lines},
                  {"json", ProgressStyle::json},
                  {"none", ProgressStyle::none}},
                 "how to tell of the work");
}

Option add_overwrite(const Command& command, RunOptions& options) {
  return command.flag("--overwrite", options.existing, Existing::overwrite,
                      "replace results that are there");
}

void add_keep_batches(const Command& command, RunOptions& options) {
  command.flag("--keep-batches", options.batches, Batches::keep,
               "do not remove batch files after the merge");
}

}  // namespace

void add_init(CommandLine& line) {
  const auto given = std::make_shared<InitGiven>();
  InitRules& rules = given->rules;
  const Command command = line.command(
      "init", "write a study to begin with: what the model and weather tell, the rest marked",
      [given] { return init(*given); });
  const Option model = command.option("MODEL", rules.model, "scene file of any format").read();
  command
      .option("WEATHER", rules.weather,
              "weather file: EPW, TMY3, WEA, CSV (default: clear sky of three days)")
      .read();
  command
      .option("-o,--output", given->output,
              "study to write (.yaml; default: the model's name); of an example: folder")
      .written();
  add_corrections(command, rules);
  command.option("--terrain", rules.terrain, "raster of bare ground, beside a raster of surfaces")
      .read();
  command.option("--canopy", rules.canopy, "raster of crowns' heights, beside a raster of surfaces")
      .read();
  command
      .option("--rule", rules.measures,
              fmt::format("rule of planning to measure by (repeatable): {}",
                          fmt::join(offered_rules(), ", ")))
      .repeatable()
      .completed_by(offered_rules());
  command.option("--example", given->example, "copy a study that comes with the program instead")
      .excludes(model)
      .completed_by(example_names());
  command.examples(
      "sunload init town.city.json                        # place and north from the file's CRS\n"
      "sunload init house.obj weather.epw                 # a year of weather\n"
      "sunload init house.obj --at \"52.01 4.36\"          # three days of clear sky\n"
      "sunload init dsm.tif --terrain dem.tif -o square.yaml\n"
      "sunload init house.obj --at \"50.09 14.42\" --rule en17037 --rule bre209vsc\n"
      "sunload init --example street                      # a study that comes with the program");
}

void add_check(CommandLine& line) {
  struct Given {
    std::string study;
    RunOptions options;
    CheckRules rules;
  };
  const auto given = std::make_shared<Given>();
  const Command command =
      line.command("check", "read everything, report scene, sun path and cost; compute nothing",
                   [given] { return check_study(given->study, given->options, given->rules); });
  add_study(command, given->study);
  add_place(command, given->options);
  CheckRules& rules = given->rules;
  command.flag("--json", rules.format, CheckFormat::json, "machine-readable");
  command.flag("--intersections", rules.search, SearchIntersections::yes,
               "look for triangles that cut or cover others");
  command.flag("--no-refine", rules.mesh, CheckMesh::unrefined,
               "do not refine the mesh: patches, memory and time are the least");
  add_progress(command, given->options);
  command.examples("sunload check street.yaml\nsunload check street.yaml --json --no-refine");
}

void add_run(CommandLine& line) {
  struct Given {
    std::string study;
    RunOptions options;
    std::string shard;
  };
  const auto given = std::make_shared<Given>();
  RunOptions& options = given->options;
  const Command command =
      line.command("run", "compute a study and write its result files", [given] {
        if (!given->shard.empty()) given->options.shard = parse_shard(given->shard);
        return run_study(given->study, given->options);
      });
  add_study(command, given->study);
  add_place(command, options);
  const Option resume = command.flag("--resume", options.existing, Existing::resume,
                                     "accept finished results, go on with the rest");
  add_overwrite(command, options).excludes(resume);
  add_keep_batches(command, options);
  command.option("--shard", given->shard,
                 "compute only a share of the batches: I/N (I from 0), auto (Slurm, OpenMPI), "
                 "auto/N (PBS)");
  command.option("--time-limit", options.time_limit_min, "stop cleanly after so many minutes")
      .positive();
  add_progress(command, options);
  command.examples(
      "sunload run street.yaml\n"
      "sunload run street.yaml --variant glazed --resume\n"
      "sunload run street.yaml --shard auto               # in an array of Slurm");
}

void add_merge(CommandLine& line) {
  struct Given {
    std::string study;
    RunOptions options;
    Merge merge = Merge::complete;
  };
  const auto given = std::make_shared<Given>();
  const Command command = line.command("merge", "put finished batches together", [given] {
    return merge_study(given->study, given->options, given->merge);
  });
  add_study(command, given->study);
  add_place(command, given->options);
  command.flag("--partial", given->merge, Merge::partial,
               "write what is there to .work/.../partial.h5 where batches are missing");
  add_overwrite(command, given->options);
  add_keep_batches(command, given->options);
  command.examples("sunload merge street.yaml\nsunload merge street.yaml --partial");
}

void add_scene(CommandLine& line) {
  const auto given = std::make_shared<BuiltinOptions>();
  const Command command = line.command(
      "scene", "write a built-in scene, or a study's model with its edits, as OBJ or CityJSON",
      [given] { return write_builtin(*given); });
  command
      .option("NAME", given->name,
              fmt::format("a study (.yaml), or one of: {}", fmt::join(builtin_scene_names(), ", ")))
      .read()
      .required()
      .completed_by(builtin_scene_names());
  command.option("--variant", given->variant, "of a study (default: its first)");
  command.option("-o,--output", given->path, "file to write (.obj, .city.json)")
      .written()
      .required();
  command.option("--set", given->parameters, "parameter of the scene, e.g. house_3=glazed")
      .repeatable();
  command.examples(
      "sunload scene street --set house_3=glazed -o street.obj\n"
      "sunload scene storeys.yaml --variant storeys-2 -o higher.city.json");
}

}  // namespace sunload
