/// The command line of sunload: one function per command, exit codes of DESIGN 1.

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <new>
#include <sstream>

#include "geo/check.h"
#include "io/bands.h"
#include "io/compare.h"
#include "io/export.h"
#include "io/file_aside.h"
#include "io/info.h"
#include "io/key_names.h"
#include "io/material_table.h"
#include "io/progress.h"
#include "io/render.h"
#include "io/result_file.h"
#include "io/run.h"
#include "io/scene_builtin.h"
#include "io/scene_cityjson_write.h"
#include "io/scene_obj_write.h"
#include "io/version.h"
#include "io/view.h"

namespace sunload {
namespace {

/// Parses "x,y,z".
Vec3 point(const std::string& text, const char* option) {
  std::istringstream words(text);
  Vec3 p;
  char comma = 0, second = 0;
  if (!(words >> p.x >> comma >> p.y >> second >> p.z) || comma != ',' || second != ',')
    throw InputError({}, std::string(option) + " " + text, "not three numbers",
                     "write x,y,z in metres, e.g. 10,-20,1.7");
  return p;
}

const std::map<std::string, Palette> palettes{
    {"false", Palette::false_colour}, {"grey", Palette::grey}, {"hue", Palette::hue}};

const std::map<std::string, std::pair<PictureColours, Palette>> picture_colours{
    {"false", {PictureColours::of_values, Palette::false_colour}},
    {"grey", {PictureColours::of_values, Palette::grey}},
    {"hue", {PictureColours::of_values, Palette::hue}},
    {"rgb", {PictureColours::of_bands, Palette::false_colour}}};

/// An option that takes one of some words.
template <class Value>
void add_word(CLI::App* sub, const std::string& option, Value& target,
              const std::map<std::string, Value>& words, const std::string& what) {
  std::string list;
  for (const auto& [word, value] : words) list += (list.empty() ? "" : ", ") + word;
  sub->add_option_function<std::string>(
      option,
      [&target, words, option, list](const std::string& word) {
        const auto found = words.find(word);
        if (found == words.end())
          throw InputError({}, option + " " + word, "no such word", "write one of: " + list);
        target = found->second;
      },
      what + ": " + list);
}

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
  const bool is_near = nearest != known.end() &&
                       edit_distance(word, *nearest) <= static_cast<int>(word.size() / 3);
  return is_near ? "did you mean '" + *nearest + "'?" : "see " + help;
}

/// The commands and what they were given.
class CommandLine {
 public:
  CommandLine() {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", std::string("sunload ") + version + " (" + commit + ")");
    add_run();
    add_merge();
    add_check();
    add_sun();
    add_sky();
    add_info();
    add_compare();
    add_render();
    add_view();
    add_export();
    add_scene();
    add_materials();
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
    const std::string help = chosen ? "sunload " + chosen->get_name() + " --help" : "sunload --help";
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

  /// A sub-command that runs `action` once the line is parsed.
  CLI::App* command(const char* name, const char* what, std::function<int()> action) {
    CLI::App* sub = app_.add_subcommand(name, what);
    sub->callback([this, action = std::move(action)] { action_ = action; });
    return sub;
  }

  void add_study(CLI::App* sub) {
    sub->add_option("STUDY", study_, "study file (YAML)")->required();
  }

  void add_place(CLI::App* sub) {
    sub->add_option("--variant", options_.variants, "only these variants (repeatable)")
        ->allow_extra_args(false);
    sub->add_option("--output", options_.output, "folder for results, replaces output.folder");
    sub->add_option("--threads", options_.threads,
                    "threads (default: the processors this process may use)")
        ->envname("SUNLOAD_THREADS")
        ->check(CLI::Range(1, 4096));
  }

  void add_run() {
    CLI::App* sub = command("run", "compute a study and write its result files", [this] {
      if (overwrite_) options_.existing = Existing::overwrite;
      if (resume_) options_.existing = Existing::resume;
      if (keep_batches_) options_.batches = Batches::keep;
      if (!shard_.empty()) options_.shard = parse_shard(shard_);
      install_stop_signals();
      return run_study(study_, options_);
    });
    add_study(sub);
    add_place(sub);
    auto* resume = sub->add_flag("--resume", resume_, "accept finished results, go on with the rest");
    sub->add_flag("--overwrite", overwrite_, "replace results that are there")->excludes(resume);
    sub->add_flag("--keep-batches", keep_batches_, "do not remove batch files after the merge");
    sub->add_option("--shard", shard_,
                    "compute only a share of the batches: I/N (I from 0), auto (Slurm, OpenMPI), "
                    "auto/N (PBS)");
    sub->add_option("--time-limit", options_.time_limit_min, "stop cleanly after so many minutes")
        ->check(positive);
    add_word(sub, "--progress", options_.progress, progress_styles, "how to tell of the work");
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
    CLI::App* sub =
        command("check", "read everything, report scene, sun path and cost; compute nothing", [this] {
          return check_study(study_, options_, json_ ? CheckFormat::json : CheckFormat::text,
                             intersections_ ? SearchIntersections::yes : SearchIntersections::no);
        });
    add_study(sub);
    add_place(sub);
    sub->add_flag("--json", json_, "machine-readable");
    sub->add_flag("--intersections", intersections_, "look for triangles that cut or cover others");
  }

  void add_sun() {
    CLI::App* sub = command("sun", "the sun path as CSV or as a stereographic diagram",
                            [this] { return print_sun(study_, picture_); });
    add_study(sub);
    add_picture(sub);
  }

  void add_picture(CLI::App* sub) {
    sub->add_option("--image", picture_, "picture to write instead of CSV (.png)");
  }

  void add_sky() {
    CLI::App* sub = command("sky", "the sky dome at one instant as CSV or as a fisheye picture",
                            [this] { return sky(); });
    add_study(sub);
    add_picture(sub);
    sub->add_option("--time", sky_.time,
                    "instant, e.g. 2026-06-21T12:00 (civil time of the site), …Z, …+02:00")
        ->required();
    sub->add_option("--colour", sky_.rules.kind, "of the picture: false (luminance) or rgb")
        ->transform(CLI::CheckedTransformer(std::map<std::string, SkyPicture>{
            {"false", SkyPicture::luminance}, {"rgb", SkyPicture::colour}}));
    sub->add_option("--colour-model", sky_.rules.model, "of rgb: second (default) or first")
        ->transform(CLI::CheckedTransformer(std::map<std::string, SkyColourModel>{
            {"first", SkyColourModel::first}, {"second", SkyColourModel::second}}));
    sub->add_option("--subdivision", subdivision_,
                    "patches of the CSV: cells (64 x 64, default), tregenza, mf2 or mf4")
        ->check(CLI::IsMember({"cells", "tregenza", "mf2", "mf4"}));
  }

  int sky() {
    const std::map<std::string, Subdivision> subdivisions{{"tregenza", Subdivision::tregenza},
                                                          {"mf2", Subdivision::reinhart_mf2},
                                                          {"mf4", Subdivision::reinhart_mf4}};
    const auto found = subdivisions.find(subdivision_);
    if (found != subdivisions.end()) sky_.subdivision = found->second;
    sky_.picture = picture_;
    return print_sky(study_, sky_);
  }

  /// Which band of a result in bands.
  void add_band(CLI::App* sub) {
    sub->add_option("--band", band_,
                    "of a result with solver.bands: rgb: red, green or blue (default: their mean)");
  }

  std::optional<std::size_t> band() const {
    return band_.empty() ? std::nullopt : std::optional(band_by_name(band_));
  }

  void add_info() {
    CLI::App* sub = command("info", "what a result holds, on one screen", [this] {
      const ResultReader result(results_.front(), band());
      std::cout << (patches_ ? patches_csv(result) : info_text(result));
      return exit_code::done;
    });
    sub->add_option("RESULT", results_, "result file (.h5)")->required()->expected(1);
    sub->add_flag("--patches", patches_, "every patch as CSV");
    add_band(sub);
  }

  void add_compare() {
    CLI::App* sub = command("compare", "differences of the light load with their significance",
                            [this] { return compare(); });
    sub->add_option("BASE", base_, "result file of the base, or a study")->required();
    sub->add_option("VARIANT", results_, "result files, or names of variants of the study")
        ->required();
    sub->add_option("--output", options_.output, "folder of the study's results");
    auto* csv = sub->add_flag("--csv", csv_, "one row per group, for machines");
    sub->add_flag("--json", json_, "the same as JSON")->excludes(csv);
    add_band(sub);
    sub->add_option("--hdf5", differences_, "file of the differences of groups, facades and patches, besides");
  }

  /// A result file as it is, or the result of a study's variant.
  std::string result_named(const std::string& study, const std::string& variant) const {
    const StudyFile file = read_study(study);
    RunOptions options = options_;
    options.variants = {variant};
    const Study chosen = chosen_variants(file, options).front();
    const std::string folder = options_.output.empty() ? chosen.output.folder : options_.output;
    return folder + "/" + chosen.name + "/" + chosen.variant + ".h5";
  }

  int compare() const {
    std::string base = base_;
    std::vector<std::string> variants = results_;
    const bool is_study = base_.ends_with(".yaml") || base_.ends_with(".yml");
    if (is_study) {
      // The first name is the base; a single one is compared with the study's first variant.
      if (variants.size() == 1)
        variants.insert(variants.begin(), read_study(base_).variants.front().variant);
      for (auto& name : variants) name = result_named(base_, name);
      base = variants.front();
      variants.erase(variants.begin());
    }
    if ((csv_ || json_) && variants.size() > 1)
      throw InputError({}, "--csv and --json take one variant", "their header has no column for it",
                       "call compare once per variant");
    if (!differences_.empty() && variants.size() > 1)
      throw InputError({}, "--hdf5 takes one variant", "a file holds one comparison",
                       "call compare once per variant");
    const ResultReader base_result(base, band());
    for (const auto& variant : variants) {
      const ResultReader variant_result(variant, band());
      const Comparison comparison = compare_results(base_result, variant_result);
      if (!differences_.empty())
        write_comparison_hdf5(comparison, base_result, variant_result, differences_);
      std::cout << (csv_    ? comparison_csv(comparison)
                    : json_ ? comparison_json(comparison)
                            : comparison_table(comparison));
    }
    return exit_code::done;
  }

  void add_render() {
    CLI::App* sub = command("render", "picture of a result in false colour, with legend", [this] {
      if (!eye_.empty()) render_.eye = point(eye_, "--eye");
      if (!look_.empty()) render_.look = point(look_, "--look");
      if (largest_ > 0) render_.largest = largest_;
      if (mesh_lines_) render_.mesh = MeshLines::patches;
      if (std::sscanf(size_.c_str(), "%dx%d", &render_.width, &render_.height) != 2)
        throw InputError({}, "--size " + size_, "not a size", "write e.g. 1600x1000");
      render_.colours = render_colours_.first;
      render_.palette = render_colours_.second;
      const ResultReader result(results_.front(), band());
      if (!day_.empty() && !animate_)
        throw InputError({}, "--day without --animate", "one picture shows one time", "use --time");
      animate_ ? render_animation(result, render_, day_, picture_)
               : render_png(result, render_, picture_);
      return exit_code::done;
    });
    sub->add_option("RESULT", results_, "result file (.h5)")->required()->expected(1);
    sub->add_option("-o,--output", picture_, "picture to write (.png)")->required();
    sub->add_option("--quantity", render_.quantity,
                    "dataset to draw (default: light_load; animated: irradiance)");
    sub->add_option("--time", render_.time, "instant of a series, e.g. 2026-06-21T12:00");
    add_word(sub, "--camera", render_.view,
             {{"overview", View::overview}, {"sun", View::sun}, {"top", View::top}}, "view");
    sub->add_option("--facade", render_.facade, "camera before the facade of that name");
    sub->add_option("--eye", eye_, "camera at the eye point x,y,z [m]");
    sub->add_option("--look", look_, "point looked at x,y,z [m]");
    add_word(sub, "--projection", render_.projection,
             {{"perspective", Projection::perspective}, {"parallel", Projection::parallel}},
             "of overview and eye point");
    sub->add_option("--size", size_, "WIDTHxHEIGHT in pixels")->capture_default_str();
    sub->add_option("--max", largest_, "value of the last colour")->check(positive);
    add_word(sub, "--colour", render_colours_, picture_colours,
             "colours (rgb: the bands themselves, default quantity power_load)");
    add_band(sub);
    sub->add_option("--same-scale", render_.same_scale,
                    "results that the scale is to do for, too, so that pictures can be compared");
    add_word<std::optional<SkyBackground>>(sub, "--sky", render_.sky,
                                           {{"plain", SkyBackground::plain},
                                            {"first", SkyBackground::first},
                                            {"second", SkyBackground::second}},
                                           "sky behind (default: plain for totals, second for series)");
    sub->add_flag("--mesh", mesh_lines_, "draw the patches' edges");
    sub->add_flag("--interpolate", render_.interpolate, "colours run between corners");
    sub->add_option("--crease-angle", render_.crease_angle_deg,
                    "patches that turn by more are not interpolated [degrees, default 20]");
    sub->add_flag("--animate", animate_,
                  "a picture for every sun position, NAME-0001.png ..., and NAME.png with all (APNG)");
    sub->add_option("--day", day_, "animate this day only (year-month-day)");
  }

  void add_view() {
    CLI::App* sub = command("view", "one self-contained page: walk through the scene, any time, two results",
                            [this] {
                              if (view_step_ > 0) view_.step = view_step_;
                              view_.band = band();
                              view_html(results_, view_, picture_);
                              return exit_code::done;
                            });
    sub->add_option("RESULT", results_, "one result file (.h5), or two to compare")->required();
    sub->add_option("-o,--output", picture_, "page to write (.html)")->required();
    sub->add_option("--step", view_step_, "hold every N-th interval only (default: as many as 60 MB hold)")
        ->check(CLI::Range(1, 1'000'000));
    add_band(sub);
  }

  void add_export() {
    CLI::App* sub = command("export", "a result in the format of another program", [this] {
      export_result(ResultReader(results_.front(), band()), export_, picture_);
      return exit_code::done;
    });
    sub->add_option("RESULT", results_, "result file (.h5)")->required()->expected(1);
    sub->add_option("--to", export_.format, "format: " + export_formats())->required();
    sub->add_option("-o,--output", picture_, "file to write (csv, vrml, cityjson, energyplus: default standard output)");
    sub->add_option("--model", export_.model,
                    "cityjson: the study's own model, whose surfaces and objects get the values as attributes");
    sub->add_option("--quantity", export_.quantity,
                    "dataset per patch (default: light_load; csv and xdmf: all); csv: series");
    sub->add_option("--time", export_.time, "instant of a series, e.g. 2026-06-21T12:00 (default: the brightest)");
    add_word<std::optional<Palette>>(sub, "--colour", export_.palette,
                                     {palettes.begin(), palettes.end()}, "colours");
    sub->add_option("--max", export_.largest, "value of the last colour")->check(positive);
    add_band(sub);
    sub->add_flag("--interpolate", export_.interpolate, "colours of corners, not of patches (glb, vrml)");
    sub->add_option("--crease-angle", export_.crease_angle_deg,
                    "patches that turn by more are not interpolated [degrees, default 20]");
  }

  static void write_scene(const PolygonModel& model, const std::string& path) {
    if (path.ends_with(".obj")) return write_obj(model, path);
    if (path.ends_with(".json")) return write_cityjson(model, path);
    throw InputError({path}, "is of no format that scenes are written in", "",
                     "let its name end in .obj or .city.json");
  }

  void add_scene() {
    CLI::App* sub = command("scene", "write a built-in scene as OBJ or CityJSON", [this] {
      BuiltinRules rules{scene_, {}};
      for (const auto& set : parameters_) {
        const auto equals = set.find('=');
        if (equals == std::string::npos)
          throw InputError({}, "--set " + set, "no '='", "write --set parameter=value");
        rules.parameters[set.substr(0, equals)] = set.substr(equals + 1);
      }
      write_scene(builtin_scene(rules), picture_);
      return exit_code::done;
    });
    std::string names;
    for (const auto& name : builtin_scene_names()) names += (names.empty() ? "" : ", ") + name;
    sub->add_option("NAME", scene_, "one of: " + names)->required();
    sub->add_option("-o,--output", picture_, "file to write (.obj, .city.json)")->required();
    sub->add_option("--set", parameters_, "parameter of the scene, e.g. house_3=glazed")
        ->allow_extra_args(false);
  }

  void add_materials() {
    CLI::App* sub = command("materials", "list the materials that studies may name without defining them", [this] {
      std::cout << (markdown_ ? material_page() : material_listing());
      return exit_code::done;
    });
    sub->add_flag("--markdown", markdown_, "as the page docs/materials.md");
  }

  CLI::App app_{"sunload: how much sun and sky light falls on every patch of a city"};
  std::function<int()> action_;
  std::string study_, base_, differences_, eye_, look_, picture_, scene_, shard_, day_, size_ = "1600x1000",
      subdivision_ = "cells", band_;
  std::vector<std::string> results_, parameters_;
  RunOptions options_;
  RenderRules render_;
  std::pair<PictureColours, Palette> render_colours_{PictureColours::of_values,
                                                     Palette::false_colour};
  ExportRules export_;
  SkyOptions sky_;
  ViewRules view_;
  std::size_t view_step_ = 0;
  double largest_ = 0;
  bool resume_ = false, overwrite_ = false, keep_batches_ = false, json_ = false, csv_ = false,
       patches_ = false, animate_ = false, mesh_lines_ = false, partial_ = false, markdown_ = false, intersections_ = false;
};

/// Listings count as written only once they have left the program.
int finished_output(int code) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) != 0 || !std::cout) throw_cannot_write("to standard output", errno);
  return code;
}

int guarded(int argc, char** argv) {
  try {
    return finished_output(CommandLine().run(argc, argv));
  } catch (const InputError& error) {
    for (const auto& problem : error.problems()) fmt::print(stderr, "{}\n", problem);
    return exit_code::wrong_input;
  } catch (const MachineError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exit_code::machine_limit;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "out of memory; use a larger mesh.max_edge_m or fewer lines_per_patch\n");
    return exit_code::machine_limit;
  } catch (const Interrupted& error) {
    const std::string signal = stop_signal();
    fmt::print(stderr, "{} ({}); finished batches are kept, go on with: sunload run … --resume\n",
               error.what(), signal.empty() ? "time limit" : signal);
    return exit_code::unfinished;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bug in sunload: {}\n", error.what());
    return exit_code::bug;
  }
}

}  // namespace
}  // namespace sunload

int main(int argc, char** argv) {
  // A file that grows beyond `ulimit -f` is an error of writing, not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
  return sunload::guarded(argc, argv);
}
