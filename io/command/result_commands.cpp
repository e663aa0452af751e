// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "io/command/commands.h"
#include "io/command/common_options.h"
#include "io/command/sub_commands.h"

namespace sunload {
namespace {

template <class Format>
void add_formats(const Command& command, Format& format, const std::string& what_csv_is) {
  const Option csv = command.flag("--csv", format, Format::csv, what_csv_is);
  command.flag("--json", format, Format::json, "the same as JSON").excludes(csv);
}

/// Which tables; several may be asked for.
void add_tables(const Command& command, std::vector<InfoOptions::What>& tables) {
  using What = InfoOptions::What;
  const auto add = [&](const char* option, What table, const char* words) {
    command.flag(
        option, [&tables, table] { tables.push_back(table); }, words);
  };
  add("--facades", What::facades, "table of the facades: what each of them receives");
  add("--objects", What::objects, "table of the objects");
  add("--orientations", What::orientations,
      "table of what the objects' walls and windows receive by eight compass points, and their "
      "roofs");
  add("--selections", What::selections, "table of the study's selections");
  add("--sensors", What::sensors, "table of the sensors");
  add("--measures", What::measures,
      "table of the study's measures: values and verdicts of facades, objects, "
      "selections, sensors");
  add("--patches", What::patches, "every patch as CSV");
}

/// Which differences of which rows.
void add_differences(const Command& command, CompareOptions& options) {
  command.option("--quantity", options.quantity,
                 "dataset per patch to compare (default: light_load), e.g. sun_hours or "
                 "measure_NAME");
  constexpr double largest_share = 1000;  // ten times the base
  command
      .option("--least", options.least_percent,
              "percent of the base: significant is what surely differs by more; what has no "
              "errors is counted by it")
      .within(0.0, largest_share);
  command
      .option("--storey-m", options.storey_m,
              "rows of storeys of that height, of walls and windows above their object's foot")
      .within(1.0, 20.0);
  add_named(command, options.parts, "only rows of");
  command.option("--sensor", options.parts.sensors,
                 "only rows of the sensor of that number, from 0 (repeatable)");
}

/// What is explained, and in which way.
void add_questions(const Command& command, ExplainOptions& options) {
  add_named(command, options.parts, "explain");
  command
      .option("--sensor", options.parts.sensors,
              "explain the sensor of that number, from 0 (repeatable)")
      .repeatable();
  const Option against = command
                             .option("--against", options.against,
                                     "result of the base: who brings which share of the difference")
                             .read();
  const Option paint =
      command
          .flag("--paint", options.what, ExplainOptions::What::painting,
                "instead: what 0.1 more of diffuse reflectance of each material and surface brings")
          .excludes(against);
  command
      .option("-o,--output", options.picture,
              "waterfall of the rows, from the open to the result, as a picture (.png), besides")
      .written()
      .excludes(paint);
  command
      .option("--map", options.map,
              "file (.h5) of what each patch gives to the place and takes from it, "
              "besides; render and export take it")
      .written()
      .excludes(paint)
      .excludes(against);
}

}  // namespace

void add_info(CommandLine& line) {
  const auto given = std::make_shared<InfoOptions>();
  const Command command = line.command("info", "what a result holds, on one screen",
                                       [given] { return print_info(*given); });
  add_result(command, given->result.path);
  add_tables(command, given->what);
  add_named(command, given->parts, "only");
  command.option("--sensor", given->parts.sensors, "only the sensor of that number, from 0")
      .repeatable();
  add_formats(command, given->format, "tables for machines");
  add_band(command, given->result.band);
  add_period(command, given->result.period);
  command.examples(
      "sunload info results/street/glazed.h5\n"
      "sunload info results/street/glazed.h5 --facades --csv > facades.csv\n"
      "sunload info results/street/glazed.h5 --facade 'house_3/*'");
}

void add_compare(CommandLine& line) {
  const auto given = std::make_shared<CompareOptions>();
  const Command command =
      line.command("compare", "differences of two results, of the light load with significance",
                   [given] { return compare(*given); });
  command.option("BASE", given->base, "result file of the base, or a study").read().required();
  command.option("VARIANT", given->variants, "result files, or names of variants of the study")
      .read()
      .required();
  command.option("--output", given->output, "folder of the study's results");
  add_formats(command, given->format, "one row per group, for machines");
  add_differences(command, *given);
  add_band(command, given->band);
  add_period(command, given->period);
  command
      .option("--hdf5", given->differences,
              "file of the differences of groups, facades and patches, besides")
      .written();
  command.examples(
      "sunload compare street.yaml glazed                 # with the study's first variant\n"
      "sunload compare results/street/baseline.h5 results/street/glazed.h5 --csv\n"
      "sunload compare street.yaml glazed --quantity sun_hours --least 5");
}

void add_explain(CommandLine& line) {
  const auto given = std::make_shared<ExplainOptions>();
  const Command command = line.command(
      "explain", "who takes and who gives the light of a facade, an object or a sensor",
      [given] { return explain(*given); });
  add_result(command, given->result.path);
  add_questions(command, *given);
  command.option("--study-folder", given->study_folder,
                 "folder of the study file, where its scene and weather are found from "
                 "(default: the working directory)");
  add_formats(command, given->format, "all objects, for machines");
  add_period(command, given->result.period);
  command.examples(
      "sunload explain results/street/glazed.h5 --object pavement_north -o why.png\n"
      "sunload explain results/street/glazed.h5 --object 'pavement*' --against "
      "results/street/baseline.h5");
}

}  // namespace sunload
