// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/command_line.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <tuple>

#include "geo/base/check.h"
#include "io/base/exit_code.h"
#include "io/base/key_names.h"
#include "io/base/output_target.h"
#include "io/base/version.h"
#include "io/command/check_study.h"
#include "io/command/commands.h"
#include "io/command/doctor.h"
#include "io/command/horizon_command.h"
#include "io/command/manual.h"
#include "io/export/export.h"
#include "io/init/init.h"
#include "io/init/measure_text.h"
#include "io/run/progress.h"
#include "io/run/run.h"
#include "io/scene/builtin.h"
#include "io/study/material_table.h"

namespace sunload {
namespace {

const std::map<std::string, Palette> palettes{
    {"false", Palette::false_colour}, {"grey", Palette::grey}, {"hue", Palette::hue}};

const std::map<std::string, std::pair<PictureColours, Palette>> picture_colours{
    {"false", {PictureColours::of_values, Palette::false_colour}},
    {"grey", {PictureColours::of_values, Palette::grey}},
    {"hue", {PictureColours::of_values, Palette::hue}},
    {"rgb", {PictureColours::of_bands, Palette::false_colour}},
    {"surface", {PictureColours::of_surfaces, Palette::false_colour}},
    {"material", {PictureColours::of_materials, Palette::false_colour}}};

/// What options take that take one of some words.
using Choices = std::map<const CLI::Option*, std::vector<std::string>>;

/// An option that takes one of some words.
template <class Value>
const CLI::Option* add_word(CLI::App* sub, const std::string& option, Value& target,
                            const std::map<std::string, Value>& words, const std::string& what) {
  std::string list;
  for (const auto& [word, value] : words) list += (list.empty() ? "" : ", ") + word;
  return sub->add_option_function<std::string>(
      option,
      [&target, words, option, list](const std::string& word) {
        const auto found = words.find(word);
        if (found == words.end())
          throw InputError({}, option + " " + word, "no such word", "write one of: " + list);
        target = found->second;
      },
      what + ": " + list);
}

/// What people try first, at the end of a command's help and of its page.
const std::map<std::string, std::string> examples{
    {"init",
     "sunload init town.city.json                        # place and north from the file's CRS\n"
     "sunload init house.obj weather.epw                 # a year of weather\n"
     "sunload init house.obj --at \"52.01 4.36\"          # three days of clear sky\n"
     "sunload init dsm.tif --terrain dem.tif -o square.yaml\n"
     "sunload init house.obj --at \"50.09 14.42\" --rule en17037 --rule bre209vsc\n"
     "sunload init --example street                      # a study that comes with the program"},
    {"check", "sunload check street.yaml\nsunload check street.yaml --json --no-refine"},
    {"run",
     "sunload run street.yaml\n"
     "sunload run street.yaml --variant glazed --resume\n"
     "sunload run street.yaml --shard auto               # in an array of Slurm"},
    {"merge", "sunload merge street.yaml\nsunload merge street.yaml --partial"},
    {"sun", "sunload sun street.yaml > sun.csv\nsunload sun street.yaml --image sun.png"},
    {"sky", "sunload sky street.yaml --time 2026-03-08T10:00 --image sky.png"},
    {"horizon",
     "sunload horizon dem.tif --study town.yaml -o hills.csv   # then site: {horizon: hills.csv}\n"
     "sunload horizon dem.tif --at \"47.38 8.54\" --from-m 500 > hills.csv"},
    {"info",
     "sunload info results/street/glazed.h5\n"
     "sunload info results/street/glazed.h5 --facades --csv > facades.csv\n"
     "sunload info results/street/glazed.h5 --facade 'house_3/*'"},
    {"compare",
     "sunload compare street.yaml glazed                 # with the study's first variant\n"
     "sunload compare results/street/baseline.h5 results/street/glazed.h5 --csv\n"
     "sunload compare street.yaml glazed --quantity sun_hours --least 5"},
    {"explain",
     "sunload explain results/street/glazed.h5 --object pavement_north -o why.png\n"
     "sunload explain results/street/glazed.h5 --object 'pavement*' --against "
     "results/street/baseline.h5"},
    {"render",
     "sunload render results/street/glazed.h5 -o glazed.png\n"
     "sunload render results/street/glazed.h5 -o top.png --camera top --mesh\n"
     "sunload render street.yaml -o scene.png --colour material"},
    {"view",
     "sunload view results/street/baseline.h5 results/street/glazed.h5 -o street.html\n"
     "sunload view street.yaml -o scene.html"},
    {"export",
     "sunload export results/street/glazed.h5 --to csv --of facade -o facades.csv\n"
     "sunload export results/street/glazed.h5 --to glb -o glazed.glb\n"
     "sunload export street.yaml --to form-factors --of object -o factors.h5"},
    {"scene",
     "sunload scene street --set house_3=glazed -o street.obj\n"
     "sunload scene storeys.yaml --variant storeys-2 -o higher.city.json"},
    {"doctor", "sunload doctor"},
    {"manual", "sunload manual -o manual && man -l manual/man1/sunload-run.1"}};

const CLI::Validator positive(
    [](const std::string& text) {
      double value = 0;
      return CLI::detail::lexical_cast(text, value) && value > 0
                 ? std::string()
                 : "'" + text + "' is not a number above 0";
    },
    "NUMBER > 0");

const std::map<std::string, ProgressStyle> progress_styles{{"auto", ProgressStyle::automatic},
                                                           {"bar", ProgressStyle::bar},
                                                           {"lines", ProgressStyle::lines},
                                                           {"json", ProgressStyle::json},
                                                           {"none", ProgressStyle::none}};

/// What to try instead of a word that is not known.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known,
                         const std::string& help) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](auto& a, auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  // A third of the letters wrong is as far as a slip of the hand goes.
  const bool is_near =
      nearest != known.end() && edit_distance(word, *nearest) <= static_cast<int>(word.size() / 3);
  return is_near ? "did you mean '" + *nearest + "'?" : "see " + help;
}

/// The commands and what they were given.
class CommandLine {
 public:
  CommandLine() {
    app_.name("sunload");
    app_.require_subcommand(1);
    app_.set_version_flag("--version", std::string("sunload ") + version + " (" + commit + ")");
    add_init();
    add_check();
    add_run();
    add_merge();
    add_sun();
    add_sky();
    add_horizon();
    add_info();
    add_compare();
    add_explain();
    add_render();
    add_view();
    add_export();
    add_scene();
    add_materials();
    add_doctor();
    add_manual();
    app_.footer(
        "Begin with:\n  sunload init MODEL            a study of a model\n"
        "  sunload init --example street a study that comes with the program\n"
        "Options of a command: sunload COMMAND --help");
    for (CLI::App* sub : app_.get_subcommands({}))
      if (const auto found = examples.find(sub->get_name()); found != examples.end())
        sub->footer("Examples:\n" + indented(found->second));
  }

  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
      app_.exit(asked);
      return exit_code::done;
    } catch (const CLI::ParseError& error) {
      refuse(error, argc > 1 ? argv[1] : "");
    }
    for (const CLI::Option* output : outputs_)
      for (const CLI::Option* input : inputs_)
        for (const auto& path : output->results()) expect_not_read(path, input->results());
    return action_();
  }

 private:
  /// Tells what is wrong with the command line, in one line, and the nearest right word.
  [[noreturn]] void refuse(const CLI::ParseError& error, const std::string& first) const {
    std::vector<std::string> commands, options;
    const CLI::App* chosen = nullptr;
    for (const CLI::App* sub : app_.get_subcommands({})) {
      commands.push_back(sub->get_name());
      if (sub->parsed()) chosen = sub;
    }
    const std::string help =
        chosen ? "sunload " + chosen->get_name() + " --help" : "sunload --help";
    if (!chosen && !first.empty() && first.front() != '-')
      throw InputError({}, "unknown command '" + first + "'", {},
                       nearest_word(first, commands, help));
    if (const auto rest = chosen ? chosen->remaining() : app_.remaining(); !rest.empty()) {
      for (const CLI::Option* option : (chosen ? chosen : &app_)->get_options())
        options.push_back(option->get_name());
      const std::string word = rest.front().substr(0, rest.front().find('='));
      throw InputError({}, "unknown argument '" + word + "'", {},
                       nearest_word(word, options, help));
    }
    throw InputError({}, error.what(), {}, "see " + help);
  }

  static std::string indented(const std::string& lines) {
    std::string text = "  ";
    for (const char letter : lines)
      text += letter == '\n' ? std::string("\n  ") : std::string(1, letter);
    return text;
  }

  /// What the help of all commands tells.
  std::vector<CommandWords> words() const {
    std::vector<CommandWords> commands;
    for (const CLI::App* sub : app_.get_subcommands({})) {
      CommandWords command{sub->get_name(), sub->get_description(), {}, {}};
      if (const auto found = examples.find(command.name); found != examples.end())
        command.examples = found->second;
      for (const CLI::Option* option : sub->get_options()) {
        OptionWords words{{}, {}, option->get_description(), {}};
        for (const auto& name : option->get_snames()) words.names.push_back("-" + name);
        for (const auto& name : option->get_lnames()) words.names.push_back("--" + name);
        const bool is_flag = option->get_items_expected_max() == 0;
        if (words.names.empty())
          words.argument = option->get_name(true);
        else if (!is_flag)
          words.argument = "VALUE";
        if (const auto found = choices_.find(option); found != choices_.end())
          words.choices = found->second;
        command.options.push_back(std::move(words));
      }
      commands.push_back(std::move(command));
    }
    return commands;
  }

  /// An option that takes one of some words, which completions know.
  template <class Value>
  void add_choice(CLI::App* sub, const std::string& option, Value& target,
                  const std::map<std::string, Value>& words, const std::string& what) {
    auto& list = choices_[add_word(sub, option, target, words, what)];
    for (const auto& [word, value] : words) list.push_back(word);
  }

  /// A sub-command that runs `action` once the line is parsed.
  CLI::App* command(const char* name, const char* what, std::function<int()> action) {
    CLI::App* sub = app_.add_subcommand(name, what);
    sub->callback([this, action = std::move(action)] { action_ = action; });
    return sub;
  }

  /// Marks files that a command reads, and those that it writes: none may be both. Only the options
  /// of the command that was called have values.
  CLI::Option* reads(CLI::Option* option) { return inputs_.emplace_back(option); }
  CLI::Option* writes(CLI::Option* option) { return outputs_.emplace_back(option); }

  void add_study(CLI::App* sub) {
    reads(sub->add_option("STUDY", study_, "study file (YAML)"))->required();
  }

  void add_place(CLI::App* sub) {
    sub->add_option("--variant", options_.variants, "only these variants (repeatable)")
        ->allow_extra_args(false);
    sub->add_option("--output", options_.output, "folder for results, replaces output.folder");
    sub->add_option("--threads", options_.threads,
                    "threads (default: the processors this process may use)")
        ->envname("SUNLOAD_THREADS")
        ->check(CLI::Range(1, 4096).description("1 to 4096"));
  }

  void add_init() {
    CLI::App* sub = command(
        "init", "write a study to begin with: what the model and weather tell, the rest marked",
        [this] { return init(); });
    CLI::Option* model = reads(sub->add_option("MODEL", init_.model, "scene file of any format"));
    reads(sub->add_option("WEATHER", init_.weather,
                          "weather file: EPW, TMY3, WEA, CSV (default: clear sky of three days)"));
    writes(sub->add_option("-o,--output", picture_,
                           "study to write (.yaml; default: the model's name); of an example: "
                           "folder"));
    sub->add_option("--at", init_.at,
                    "place, latitude first: \"52.01 4.36\", UTM or MGRS (default: from the CRS, or "
                    "the weather station)");
    sub->add_option("--crs", init_.crs, "map projection of the coordinates, e.g. EPSG:28992");
    sub->add_option("--zone", init_.zone, "time zone, e.g. Europe/Amsterdam (default: a guess)");
    const std::map<std::string, std::string> axes{{"x", "x"}, {"y", "y"}, {"z", "z"}};
    add_choice(sub, "--up", init_.up, axes, "axis of the file that points up");
    sub->add_option("--unit-m", init_.unit_m, "length of the file's unit [m], e.g. 0.001")
        ->check(positive);
    reads(sub->add_option("--terrain", init_.terrain,
                          "raster of bare ground, beside a raster of surfaces"));
    reads(sub->add_option("--canopy", init_.canopy,
                          "raster of crowns' heights, beside a raster of surfaces"));
    choices_[sub->add_option("--rule", init_.measures,
                             fmt::format("rule of planning to measure by (repeatable): {}",
                                         fmt::join(offered_rules(), ", ")))
                 ->allow_extra_args(false)] = offered_rules();
    sub->add_option("--example", example_, "copy a study that comes with the program instead")
        ->excludes(model);
  }

  int init() {
    if (!example_.empty()) return init_example(example_, picture_);
    if (init_.model.empty())
      throw InputError({}, "init of what?", "neither a model nor an example is named",
                       "write sunload init MODEL, or sunload init --example street");
    return init_study(init_, picture_);
  }

  void add_doctor() {
    command("doctor", "what this build has, what this machine gives, and a self-test of seconds",
            [] { return doctor(); });
  }

  void add_manual() {
    CLI::App* sub = command("manual", "write pages of man and completions of shells", [this] {
      write_manual(picture_, words());
      return exit_code::done;
    });
    sub->add_option("-o,--output", picture_, "folder for man1 and completion")->required();
  }

  void add_run() {
    CLI::App* sub = command("run", "compute a study and write its result files", [this] {
      if (overwrite_) options_.existing = Existing::overwrite;
      if (resume_) options_.existing = Existing::resume;
      if (keep_batches_) options_.batches = Batches::keep;
      if (!shard_.empty()) options_.shard = parse_shard(shard_);
      return run_study(study_, options_);
    });
    add_study(sub);
    add_place(sub);
    auto* resume =
        sub->add_flag("--resume", resume_, "accept finished results, go on with the rest");
    sub->add_flag("--overwrite", overwrite_, "replace results that are there")->excludes(resume);
    sub->add_flag("--keep-batches", keep_batches_, "do not remove batch files after the merge");
    sub->add_option("--shard", shard_,
                    "compute only a share of the batches: I/N (I from 0), auto (Slurm, OpenMPI), "
                    "auto/N (PBS)");
    sub->add_option("--time-limit", options_.time_limit_min, "stop cleanly after so many minutes")
        ->check(positive);
    add_choice(sub, "--progress", options_.progress, progress_styles, "how to tell of the work");
  }

  void add_merge() {
    CLI::App* sub = command("merge", "put finished batches together", [this] {
      if (overwrite_) options_.existing = Existing::overwrite;
      if (keep_batches_) options_.batches = Batches::keep;
      return merge_study(study_, options_, partial_ ? Merge::partial : Merge::complete);
    });
    add_study(sub);
    add_place(sub);
    sub->add_flag("--partial", partial_,
                  "write what is there to .work/.../partial.h5 where batches are missing");
    sub->add_flag("--overwrite", overwrite_, "replace results that are there");
    sub->add_flag("--keep-batches", keep_batches_, "do not remove batch files after the merge");
  }

  void add_check() {
    CLI::App* sub = command(
        "check", "read everything, report scene, sun path and cost; compute nothing", [this] {
          return check_study(
              study_, options_,
              {.format = json_ ? CheckFormat::json : CheckFormat::text,
               .search = intersections_ ? SearchIntersections::yes : SearchIntersections::no,
               .mesh = no_refine_ ? CheckMesh::unrefined : CheckMesh::refined});
        });
    add_study(sub);
    add_place(sub);
    sub->add_flag("--json", json_, "machine-readable");
    sub->add_flag("--intersections", intersections_, "look for triangles that cut or cover others");
    sub->add_flag("--no-refine", no_refine_,
                  "do not refine the mesh: patches, memory and time are the least");
    add_choice(sub, "--progress", options_.progress, progress_styles, "how to tell of the work");
  }

  void add_sun() {
    CLI::App* sub = command("sun", "the sun path as CSV or as a stereographic diagram",
                            [this] { return print_sun(study_, picture_); });
    add_study(sub);
    add_picture(sub);
  }

  void add_horizon() {
    CLI::App* sub = command("horizon", "the line of far hills of a site, from an elevation model",
                            [this] { return horizon(horizon_); });
    reads(
        sub->add_option("DEM", horizon_.land, "raster of the land's height (GeoTIFF, ESRI ASCII)"))
        ->required();
    CLI::Option* study =
        reads(sub->add_option("--study", horizon_.study, "study whose site it is"));
    sub->add_option("--at", horizon_.at, "place, latitude first: \"47.38 8.54\", UTM or MGRS")
        ->excludes(study);
    sub->add_option("--crs", horizon_.crs, "map projection of a raster that names none");
    sub->add_option("--unit-m", horizon_.unit_m, "length of the raster's unit [m] (default: 1)")
        ->check(positive);
    sub->add_option("--above-m", horizon_.above_m, "eye above the land of the place (default: 2)");
    sub->add_option("--from-m", horizon_.from_m,
                    "land nearer than this is left out: it is the scene's own (default: as far as "
                    "the study's scene reaches; of --at: 0)");
    sub->add_option("--to-m", horizon_.to_m, "how far is looked (default: 50000)")->check(positive);
    sub->add_option("--step-deg", horizon_.step_deg, "between two azimuths (default: 1)")
        ->check(CLI::Range(0.01, 30.0));
    writes(sub->add_option("-o,--output", horizon_.output,
                           "file to write (.csv; default: standard output)"));
  }

  void add_picture(CLI::App* sub) {
    writes(sub->add_option("--image", picture_, "picture to write instead of CSV (.png)"));
  }

  void add_sky() {
    CLI::App* sub = command("sky", "the sky dome at one instant as CSV or as a fisheye picture",
                            [this] { return sky(); });
    add_study(sub);
    add_picture(sub);
    sub->add_option("--time", sky_.time,
                    "instant, e.g. 2026-06-21T12:00 (civil time of the site), …Z, …+02:00")
        ->required();
    add_choice(sub, "--colour", sky_.rules.kind,
               {{"false", SkyPicture::luminance}, {"rgb", SkyPicture::colour}},
               "of the picture, by luminance or as it looks");
    add_choice(sub, "--colour-model", sky_.rules.model,
               {{"first", SkyColourModel::first}, {"second", SkyColourModel::second}},
               "of rgb (default: second)");
    add_choice<std::optional<Subdivision>>(sub, "--subdivision", sky_.subdivision,
                                           {{"cells", std::nullopt},
                                            {"tregenza", Subdivision::tregenza},
                                            {"mf2", Subdivision::reinhart_mf2},
                                            {"mf4", Subdivision::reinhart_mf4}},
                                           "patches of the CSV (default: cells, 64 x 64)");
  }

  int sky() {
    sky_.picture = picture_;
    return print_sky(study_, sky_);
  }

  /// Which band of a result in bands.
  void add_band(CLI::App* sub) {
    sub->add_option("--band", band_,
                    "of a result with solver.bands: rgb: red, green or blue (default: their mean)");
  }

  /// Which part of the period: of all commands on results, in the same words.
  void add_period(CLI::App* sub) {
    const std::string group =
        "Part of the period (civil time of the site; all that is given holds)";
    const auto add = [&](const char* option, std::string& words, const char* meaning) {
      sub->add_option(option, words, meaning)->group(group);
    };
    add("--month", period_.month, "totals of a month: 1 to 12, or 2026-06");
    add("--season", period_.season, "of a season of the study, or spring, summer, autumn, winter");
    add("--day", period_.day, "of a day: 2026-06-21");
    add("--hours", period_.hours, "of hours of day: 8-12, from 8:00 to 12:00");
    add("--from", period_.from, "from a date or time on: 2026-06-01, 2026-06-21T12:00");
    // The format of an export has the shorter word.
    const bool is_free = sub->get_option_no_throw("--to") == nullptr;
    add(is_free ? "--to,--until" : "--until", period_.to, "up to a date or time, exclusive");
  }

  NamedResult result() const { return {results_.front(), band_, period_}; }

  void add_info() {
    CLI::App* sub = command("info", "what a result holds, on one screen", [this] {
      info_.result = result();
      if (csv_) info_.format = InfoOptions::Format::csv;
      if (json_) info_.format = InfoOptions::Format::json;
      return print_info(info_);
    });
    add_result(sub);
    using What = InfoOptions::What;
    const auto add_table = [&](const char* option, What what, const char* words) {
      sub->add_flag_callback(
          option, [this, what] { info_.what.push_back(what); }, words);
    };
    add_table("--facades", What::facades, "table of the facades: what each of them receives");
    add_table("--objects", What::objects, "table of the objects");
    add_table("--selections", What::selections, "table of the study's selections");
    add_table("--sensors", What::sensors, "table of the sensors");
    add_table("--measures", What::measures,
              "table of the study's measures: values and verdicts of facades, objects, "
              "selections, sensors");
    add_table("--patches", What::patches, "every patch as CSV");
    add_named(sub, info_.parts, "only");
    sub->add_option("--sensor", info_.parts.sensors, "only the sensor of that number, from 0")
        ->allow_extra_args(false);
    auto* csv = sub->add_flag("--csv", csv_, "tables for machines");
    sub->add_flag("--json", json_, "the same as JSON")->excludes(csv);
    add_band(sub);
    add_period(sub);
  }

  /// Facades and objects by name or pattern.
  void add_named(CLI::App* sub, NamedParts& parts, const std::string& only) {
    sub->add_option("--facade", parts.facades,
                    only +
                        " the facade of that name, or those of a pattern: 'house_3/*' "
                        "(repeatable)")
        ->allow_extra_args(false);
    sub->add_option("--object", parts.objects, only + " the object of that name or pattern")
        ->allow_extra_args(false);
    sub->add_option("--selection", parts.selections,
                    only + " the study's selection of that name or pattern")
        ->allow_extra_args(false);
  }

  void add_result(CLI::App* sub) {
    reads(sub->add_option("RESULT", results_, "result file (.h5)"))->required()->expected(1);
  }

  void add_compare() {
    CLI::App* sub = command(
        "compare", "differences of two results, of the light load with significance", [this] {
          compare_.band = band_;
          compare_.period = period_;
          if (json_) compare_.format = CompareOptions::Format::json;
          if (csv_) compare_.format = CompareOptions::Format::csv;
          return compare(compare_);
        });
    reads(sub->add_option("BASE", compare_.base, "result file of the base, or a study"))
        ->required();
    reads(sub->add_option("VARIANT", compare_.variants,
                          "result files, or names of variants of the study"))
        ->required();
    sub->add_option("--output", compare_.output, "folder of the study's results");
    auto* csv = sub->add_flag("--csv", csv_, "one row per group, for machines");
    sub->add_flag("--json", json_, "the same as JSON")->excludes(csv);
    sub->add_option("--quantity", compare_.quantity,
                    "dataset per patch to compare (default: light_load), e.g. sun_hours or "
                    "measure_NAME");
    constexpr double largest_share = 1000;  // ten times the base
    sub->add_option("--least", compare_.least_percent,
                    "percent of the base: significant is what surely differs by more; what has no "
                    "errors is counted by it")
        ->check(CLI::Range(0.0, largest_share));
    sub->add_option(
           "--storey-m", compare_.storey_m,
           "rows of storeys of that height, of walls and windows above their object's foot")
        ->check(CLI::Range(1.0, 20.0));
    add_named(sub, compare_.parts, "only rows of");
    add_band(sub);
    add_period(sub);
    writes(sub->add_option("--hdf5", compare_.differences,
                           "file of the differences of groups, facades and patches, besides"));
  }

  void add_explain() {
    CLI::App* sub = command(
        "explain", "who takes and who gives the light of a facade, an object or a sensor", [this] {
          explain_.result = result();
          if (csv_) explain_.format = ExplainOptions::Format::csv;
          if (json_) explain_.format = ExplainOptions::Format::json;
          return explain(explain_);
        });
    add_result(sub);
    add_named(sub, explain_.parts, "explain");
    sub->add_option("--sensor", explain_.parts.sensors,
                    "explain the sensor of that number, from 0 (repeatable)")
        ->allow_extra_args(false);
    reads(sub->add_option("--against", explain_.against,
                          "result of the base: who brings which share of the difference"));
    sub->add_flag_callback(
           "--paint", [this] { explain_.what = ExplainOptions::What::painting; },
           "instead: what 0.1 more of diffuse reflectance of each material and surface brings")
        ->excludes("--against");
    writes(sub->add_option("-o,--output", explain_.picture,
                           "waterfall of the rows, from the open to the result, as a picture "
                           "(.png), besides"))
        ->excludes("--paint");
    writes(sub->add_option("--map", explain_.map,
                           "file (.h5) of what each patch gives to the place and takes from it, "
                           "besides; render and export take it"))
        ->excludes("--paint", "--against");
    sub->add_option("--study-folder", explain_.study_folder,
                    "folder of the study file, where its scene and weather are found from "
                    "(default: the working directory)");
    auto* csv = sub->add_flag("--csv", csv_, "all objects, for machines");
    sub->add_flag("--json", json_, "the same as JSON")->excludes(csv);
    add_period(sub);
  }

  void add_render() {
    CLI::App* sub = command("render", "picture of a result in false colour, with legend", [this] {
      render_.result = result();
      RenderRules& rules = render_.rules;
      if (largest_ > 0) rules.largest = largest_;
      if (mesh_lines_) rules.mesh = MeshLines::patches;
      render_.has_colours = render_colours_.has_value();
      if (render_colours_) std::tie(rules.colours, rules.palette) = *render_colours_;
      return render(render_);
    });
    reads(sub->add_option("RESULT", results_,
                          "result file (.h5), comparison file, map of a place, or a study (.yaml), "
                          "whose scene is "
                          "drawn without light"))
        ->required()
        ->expected(1);
    writes(sub->add_option("-o,--output", render_.picture, "picture to write (.png)"))->required();
    sub->add_option("--quantity", render_.rules.quantity,
                    "dataset to draw (default: light_load; animated: irradiance), or radiance "
                    "(luminance): of diffuse light, at --time or in the mean");
    sub->add_option("--time", render_.rules.time, "instant of a series, e.g. 2026-06-21T12:00");
    add_choice(sub, "--camera", render_.rules.view,
               {{"overview", View::overview}, {"sun", View::sun}, {"top", View::top}}, "view");
    add_named(sub, render_.rules.parts, "picture of");
    sub->add_option("--eye", render_.rules.eye,
                    "camera at x,y,z [m], NAME+dx,dy,dz [m from the foot of an object or facade], "
                    "before a facade NAME, or on top of an object NAME");
    sub->add_option("--look", render_.rules.look, "what is looked at: x,y,z, NAME, NAME+dx,dy,dz");
    add_choice(sub, "--projection", render_.rules.projection,
               {{"perspective", Projection::perspective}, {"parallel", Projection::parallel}},
               "of overview and eye point");
    sub->add_option("--size", render_.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    sub->add_option("--max", largest_, "value of the last colour")->check(positive);
    add_choice<std::optional<std::pair<PictureColours, Palette>>>(
        sub, "--colour", render_colours_, {picture_colours.begin(), picture_colours.end()},
        "colours (rgb: the bands themselves, default quantity power_load; surface, material: the "
        "scene without light, default surface of a study)");
    add_word(sub, "--scale", render_.rules.scale,
             {{"linear", ColourScale::linear}, {"log", ColourScale::logarithmic}},
             "of the colours (log: three powers of ten below the last one)");
    sub->add_option("--variant", render_.variant, "of a study (default: its first)");
    add_band(sub);
    add_period(sub);
    reads(sub->add_option("--same-scale", render_.rules.same_scale,
                          "results that the scale is to do for, too, so that pictures can be "
                          "compared"));
    add_choice<std::optional<SkyBackground>>(sub, "--sky", render_.rules.sky,
                                             {{"plain", SkyBackground::plain},
                                              {"first", SkyBackground::first},
                                              {"second", SkyBackground::second}},
                                             "sky behind (default: plain for totals, second for "
                                             "series)");
    sub->add_flag("--mesh", mesh_lines_, "draw the patches' edges");
    sub->add_flag("--interpolate", render_.rules.interpolate, "colours run between corners");
    sub->add_option("--crease-angle", render_.rules.crease_angle_deg,
                    "patches that turn by more are not interpolated [degrees, default 20]");
    sub->add_flag("--animate", render_.animate,
                  "a picture for every sun position, NAME-0001.png ..., and NAME.png with all "
                  "(APNG)");
  }

  void add_view() {
    CLI::App* sub = command(
        "view", "one self-contained page: walk through the scene, any time, two results", [this] {
          if (view_step_ > 0) view_.rules.step = view_step_;
          view_.rules.band = chosen_band(band_);
          view_.rules.period = period_;
          return view(view_);
        });
    reads(sub->add_option("RESULT", view_.inputs,
                          "one result file (.h5), or two to compare; or a study (.yaml), whose "
                          "scene is shown without light"))
        ->required();
    writes(sub->add_option("-o,--output", view_.page, "page to write (.html)"))->required();
    sub->add_option("--variant", view_.variants,
                    "of a study: its variants to show, at most two (default: the first two)");
    sub->add_option("--step", view_step_,
                    "hold every N-th interval only (default: as many as 60 MB hold)")
        ->check(CLI::Range(1, 1'000'000).description("1 to 1000000"));
    add_band(sub);
    add_period(sub);
  }

  void add_export() {
    CLI::App* sub = command("export", "a result in the format of another program", [this] {
      if (export_.format == form_factors_word) return form_factors();
      if (!factors_.variant.empty() || !factors_.study_folder.empty())
        throw InputError({}, "--variant and --study-folder with --to " + export_.format,
                         "they are of form factors", "leave them out");
      export_result(*opened(result(), Opens::derived_too), export_, picture_);
      return exit_code::done;
    });
    reads(sub->add_option("RESULT", results_,
                          "result file (.h5), comparison file or map of a place; form-factors: or "
                          "a study (.yaml)"))
        ->required()
        ->expected(1);
    sub->add_option("--to", export_.format, "format: " + export_formats())->required();
    writes(sub->add_option(
        "-o,--output", picture_,
        "file to write (csv, vrml, cityjson, energyplus, form-factors as CSV: default standard "
        "output)"));
    reads(sub->add_option(
        "--model", export_.model,
        "cityjson: the study's own model, whose surfaces and objects get the values as "
        "attributes"));
    sub->add_option("--of", export_.of,
                    "csv: a row for every patch (default), facade, object or sensor; form-factors: "
                    "between patches (default), facades, objects or kinds of surface");
    add_named(sub, export_.parts, "csv, gpkg, energyplus: only");
    sub->add_option("--sensor", export_.parts.sensors, "csv, gpkg: only the sensor of that number")
        ->allow_extra_args(false);
    sub->add_option("--quantity", export_.quantity,
                    "dataset per patch, or radiance (default: light_load; csv and xdmf: all); "
                    "csv: series");
    sub->add_option("--time", export_.time,
                    "instant of a series, e.g. 2026-06-21T12:00 (default: the brightest)");
    add_choice<std::optional<Palette>>(sub, "--colour", export_.palette,
                                       {palettes.begin(), palettes.end()}, "colours");
    sub->add_option("--max", export_.largest, "value of the last colour")->check(positive);
    add_band(sub);
    add_period(sub);
    sub->add_flag("--interpolate", export_.interpolate,
                  "colours of corners, not of patches (glb, vrml)");
    sub->add_option("--crease-angle", export_.crease_angle_deg,
                    "patches that turn by more are not interpolated [degrees, default 20]");
    sub->add_flag("--lightmap", export_.light_map,
                  "colours in a texture, a block of texels for each patch (glb)");
    sub->add_option("--variant", factors_.variant, "form-factors: of a study (default: its first)");
    sub->add_option("--study-folder", factors_.study_folder,
                    "form-factors of a result: folder of its study file (default: the working "
                    "directory)");
  }

  /// What chooses light says nothing of form factors.
  int form_factors() {
    const bool chooses_light = !export_.quantity.empty() || !export_.time.empty() ||
                               period_.any() || !band_.empty() || export_.palette ||
                               export_.largest || export_.interpolate || export_.crease_angle_deg ||
                               export_.light_map;
    if (chooses_light || !export_.parts.empty() || !export_.model.empty())
      throw InputError({}, "--to form-factors takes --of, --variant and --study-folder alone",
                       "they are geometry, of the whole scene", "leave out the other options");
    factors_.input = results_.front();
    factors_.of = export_.of;
    factors_.output = picture_;
    return export_form_factors(factors_);
  }

  void add_scene() {
    CLI::App* sub = command(
        "scene", "write a built-in scene, or a study's model with its edits, as OBJ or CityJSON",
        [this] { return write_builtin(builtin_); });
    std::string names;
    for (const auto& name : builtin_scene_names()) names += (names.empty() ? "" : ", ") + name;
    reads(sub->add_option("NAME", builtin_.name, "a study (.yaml), or one of: " + names))
        ->required();
    sub->add_option("--variant", builtin_.variant, "of a study (default: its first)");
    writes(sub->add_option("-o,--output", builtin_.path, "file to write (.obj, .city.json)"))
        ->required();
    sub->add_option("--set", builtin_.parameters, "parameter of the scene, e.g. house_3=glazed")
        ->allow_extra_args(false);
  }

  void add_materials() {
    CLI::App* sub = command(
        "materials", "list the materials that studies may name without defining them", [this] {
          std::cout << (angles_     ? angle_listing()
                        : markdown_ ? material_page()
                                    : material_listing());
          return exit_code::done;
        });
    CLI::Option* markdown = sub->add_flag("--markdown", markdown_, "as the page docs/materials.md");
    sub->add_flag("--angles", angles_, "what they reflect and let pass, by angle of incidence")
        ->excludes(markdown);
  }

  CLI::App app_{"sunload: how much sun and sky light falls on every patch of a city"};
  std::function<int()> action_;
  std::vector<CLI::Option*> inputs_, outputs_;
  std::string study_, picture_, shard_, band_;
  std::vector<std::string> results_;
  RunOptions options_;
  InfoOptions info_;
  CompareOptions compare_;
  ExplainOptions explain_;
  PeriodChoice period_;
  RenderOptions render_;
  std::optional<std::pair<PictureColours, Palette>> render_colours_;
  ExportRules export_;
  FormFactorOptions factors_;
  SkyOptions sky_;
  ViewOptions view_;
  BuiltinOptions builtin_;
  HorizonOptions horizon_;
  InitRules init_;
  std::string example_;
  Choices choices_;
  std::size_t view_step_ = 0;
  double largest_ = 0;
  bool resume_ = false, overwrite_ = false, keep_batches_ = false, json_ = false, csv_ = false,
       mesh_lines_ = false, partial_ = false, markdown_ = false, angles_ = false,
       intersections_ = false, no_refine_ = false;
};

}  // namespace

int run_command(int argc, char** argv) { return CommandLine().run(argc, argv); }

}  // namespace sunload
