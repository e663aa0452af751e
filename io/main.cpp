/// The command line of sunload: one function per command, exit codes of DESIGN 1.

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>

#include "geo/check.h"
#include "io/compare.h"
#include "io/info.h"
#include "io/progress.h"
#include "io/render.h"
#include "io/result_file.h"
#include "io/run.h"
#include "io/scene_builtin.h"
#include "io/scene_obj_write.h"
#include "io/version.h"

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

const std::map<std::string, ProgressStyle> progress_styles{{"auto", ProgressStyle::automatic},
                                                           {"bar", ProgressStyle::bar},
                                                           {"lines", ProgressStyle::lines},
                                                           {"json", ProgressStyle::json},
                                                           {"none", ProgressStyle::none}};

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
    add_info();
    add_compare();
    add_render();
    add_scene();
  }

  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      const int code = app_.exit(error);
      return code == 0 ? exit_code::done : exit_code::wrong_input;
    }
    return action_();
  }

 private:
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
      install_stop_signals();
      return run_study(study_, options_);
    });
    add_study(sub);
    add_place(sub);
    auto* resume = sub->add_flag("--resume", resume_, "accept finished results, go on with the rest");
    sub->add_flag("--overwrite", overwrite_, "replace results that are there")->excludes(resume);
    sub->add_flag("--keep-batches", keep_batches_, "do not remove batch files after the merge");
    sub->add_option("--time-limit", options_.time_limit_min, "stop cleanly after so many minutes")
        ->check(CLI::PositiveNumber);
    sub->add_option("--progress", options_.progress, "auto, bar, lines, json or none")
        ->transform(CLI::CheckedTransformer(progress_styles));
  }

  void add_merge() {
    CLI::App* sub = command("merge", "put finished batches together", [this] {
      if (overwrite_) options_.existing = Existing::overwrite;
      if (keep_batches_) options_.batches = Batches::keep;
      return merge_study(study_, options_);
    });
    add_study(sub);
    add_place(sub);
    sub->add_flag("--overwrite", overwrite_, "replace results that are there");
    sub->add_flag("--keep-batches", keep_batches_, "do not remove batch files after the merge");
  }

  void add_check() {
    CLI::App* sub =
        command("check", "read everything, report scene, sun path and cost; compute nothing", [this] {
          return check_study(study_, options_, json_ ? CheckFormat::json : CheckFormat::text);
        });
    add_study(sub);
    add_place(sub);
    sub->add_flag("--json", json_, "machine-readable");
  }

  void add_sun() {
    add_study(command("sun", "print the sun path as CSV", [this] { return print_sun(study_); }));
  }

  void add_info() {
    CLI::App* sub = command("info", "what a result holds, on one screen", [this] {
      const ResultReader result(results_.front());
      std::cout << (patches_ ? patches_csv(result) : info_text(result));
      return exit_code::done;
    });
    sub->add_option("RESULT", results_, "result file (.h5)")->required()->expected(1);
    sub->add_flag("--patches", patches_, "every patch as CSV");
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
    const ResultReader base_result(base);
    for (const auto& variant : variants) {
      const Comparison comparison = compare_results(base_result, ResultReader(variant));
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
      render_png(ResultReader(results_.front()), render_, picture_);
      return exit_code::done;
    });
    sub->add_option("RESULT", results_, "result file (.h5)")->required()->expected(1);
    sub->add_option("-o,--output", picture_, "picture to write (.png)")->required();
    sub->add_option("--quantity", render_.quantity, "dataset to draw")->capture_default_str();
    sub->add_option("--time", render_.time, "instant of a series, e.g. 2026-06-21T12:00");
    sub->add_option("--camera", render_.view, "overview, sun or top")
        ->transform(CLI::CheckedTransformer(std::map<std::string, View>{
            {"overview", View::overview}, {"sun", View::sun}, {"top", View::top}}));
    sub->add_option("--eye", eye_, "eye point x,y,z [m]");
    sub->add_option("--look", look_, "point looked at x,y,z [m]");
    sub->add_option("--size", size_, "WIDTHxHEIGHT in pixels")->capture_default_str();
    sub->add_option("--max", largest_, "value of the last colour")->check(CLI::PositiveNumber);
    sub->add_option("--colour", render_.palette, "false or grey")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Palette>{
            {"false", Palette::false_colour}, {"grey", Palette::grey}}));
    sub->add_flag("--mesh", mesh_lines_, "draw the patches' edges");
  }

  void add_scene() {
    CLI::App* sub = command("scene", "write a built-in scene as OBJ", [this] {
      BuiltinRules rules{scene_, {}};
      for (const auto& set : parameters_) {
        const auto equals = set.find('=');
        if (equals == std::string::npos)
          throw InputError({}, "--set " + set, "no '='", "write --set parameter=value");
        rules.parameters[set.substr(0, equals)] = set.substr(equals + 1);
      }
      write_obj(builtin_scene(rules), picture_);
      return exit_code::done;
    });
    std::string names;
    for (const auto& name : builtin_scene_names()) names += (names.empty() ? "" : ", ") + name;
    sub->add_option("NAME", scene_, "one of: " + names)->required();
    sub->add_option("-o,--output", picture_, "file to write (.obj)")->required();
    sub->add_option("--set", parameters_, "parameter of the scene, e.g. house_3=glazed")
        ->allow_extra_args(false);
  }

  CLI::App app_{"sunload: how much sun and sky light falls on every patch of a city"};
  std::function<int()> action_;
  std::string study_, base_, eye_, look_, picture_, scene_, size_ = "1600x1000";
  std::vector<std::string> results_, parameters_;
  RunOptions options_;
  RenderRules render_;
  double largest_ = 0;
  bool resume_ = false, overwrite_ = false, keep_batches_ = false, json_ = false, csv_ = false,
       patches_ = false, mesh_lines_ = false;
};

int guarded(int argc, char** argv) {
  try {
    return CommandLine().run(argc, argv);
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

int main(int argc, char** argv) { return sunload::guarded(argc, argv); }
