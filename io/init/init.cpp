// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/init/init.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>

#include "geo/base/check.h"
#include "io/base/data_folder.h"
#include "io/base/exit_code.h"
#include "io/base/file_aside.h"
#include "io/base/standard_streams.h"
#include "io/init/measure_text.h"
#include "io/init/study_text.h"
#include "io/plan/planner.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/variant_mesh.h"
#include "io/plan/work_estimate.h"
#include "io/scene/file.h"
#include "io/study/named_files.h"
#include "solver/mesh/hierarchy.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

// What a first picture may cost: most of a minute is left for reading, writing and drawing.
constexpr double most_seconds = 8, most_disk_bytes = 5e8;
constexpr double most_patches = 60'000;
constexpr std::size_t most_lands = 16;  // tiles of a terrain
constexpr std::array<double, 10> edges_m{0.25, 0.5, 1, 2, 3, 5, 10, 20, 50, 100};

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

void expect_free(const std::string& path) {
  std::error_code unknown;
  if (fs::exists(fs::symlink_status(path, unknown)))
    throw InputError({path, 0, 0}, "is there already", "init replaces no file",
                     "remove it, or write another name with -o");
}

/// Before anything is read, which takes time.
void expect_writable(const std::string& path) {
  const fs::path folder = folder_of(path);
  std::error_code unknown;
  if (!fs::is_directory(folder, unknown))
    throw MachineError("cannot write " + path + ": there is no folder " + folder.string() +
                       "; make it first, or write another name with -o");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw MachineError("cannot write " + path + ": " + std::strerror(errno) +
                       "; write another name with -o, or go into a folder of yours");
}

/// Before anything is read, too.
void expect_names_for_study(const InitRules& rules, const std::string& path) {
  for (const std::string* file : {&rules.model, &rules.weather, &rules.terrain, &rules.canopy})
    if (!file->empty()) path_in_study(*file, folder_of(path));
}

/// Where columns are named.
void expect_plan_data(const InitRules& rules) {
  if ((rules.height.empty() && rules.storeys.empty()) || is_of_footprints(rules.model)) return;
  throw InputError({rules.model}, "--height and --storeys name columns of plan data",
                   "the model is of another format", "leave them out");
}

/// The same, with each `from` in it as `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// A study from its text. The file stands in the folder of the study, so that paths are right.
StudyFile read_text(const std::string& text, const std::string& path) {
  const FileAside aside(path);
  write_file(aside.aside(), text);
  try {
    return read_study(aside.aside());
  } catch (const InputError& error) {
    std::vector<std::string> problems;
    for (const auto& problem : error.problems())
      problems.push_back(replaced(problem, aside.aside(), path));
    throw InputError(std::move(problems));
  }
}

/// The finest mesh that a first picture can have; nothing where even the coarsest costs too much.
std::optional<double> affordable_edge_m(VariantPlan& plan) {
  for (const double edge : edges_m) {
    plan.study.mesh.max_edge_m = edge;
    const auto least = least_patch_count(plan.built.scene, split_rules(plan.study));
    if (static_cast<double>(least) > most_patches) continue;
    const auto patches = unrefined_mesh(plan).mesh->patch_count();
    const WorkEstimate work = estimate_work(plan, patches);
    if (static_cast<double>(patches) <= most_patches && work.seconds <= most_seconds &&
        work.disk_bytes <= most_disk_bytes)
      return edge;
  }
  return {};
}

/// The study as it is written, after a look at the scene that its text makes.
std::string affordable_text(const std::string& name, const InitRules& rules, Findings found,
                            const std::string& path) {
  const std::string folder = folder_of(path);
  const auto text = [&](const FirstPicture& first) {
    return study_text(name, rules, found, first, folder);
  };
  Planner planner;
  const auto plan_of_text = [&] {
    return planner.plan(read_text(text({}), path).variants.front());
  };
  VariantPlan plan = plan_of_text();
  auto edge = affordable_edge_m(plan);
  if (!edge && first_period(found) == FirstPeriod::year && !is_year_needed(rules.measures)) {
    found.is_year_too_long = true;
    plan = plan_of_text();
    edge = affordable_edge_m(plan);
  }
  for (std::size_t r = 0; r < plan.built.rules.size(); ++r)
    if (plan.built.rules[r].given == 0) found.idle_rules.insert(r);
  return text({.max_edge_m = edge.value_or(edges_m.back())});
}

/// What the user has to look at: remarks that begin with the mark. Names may hold it, too.
void tell_marked(const std::string& text, const std::string& path) {
  const std::string marked = std::string("# ") + mark + " ";
  int line = 0;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string words = text.substr(begin, end - begin);
    begin = end + 1;
    if (const auto at = words.find(marked); at != std::string::npos)
      tell(fmt::format("{}:{}: {}", path, line + 1, words.substr(at + marked.size())));
  }
}

std::string word_of_shell(const std::string& text) {
  const bool is_plain = text.find_first_not_of(
                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                            "0123456789_-./+,:@") == std::string::npos;
  if (is_plain) return text;
  std::string out = "'";
  for (const char letter : text)
    out += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return out + "'";
}

void print_next(const std::string& path, const std::string& name, const std::string& variant,
                const std::vector<std::string>& measures = {}) {
  const std::string study = word_of_shell(path);
  const std::string result = fmt::format("results/{}/{}.h5", name, variant);
  std::cout << fmt::format(
      "wrote {0}; next:\n"
      "  sunload check {0}\n"
      "  sunload run {0}\n"
      "  sunload render {1} -o {2}.png\n"
      "  sunload view {1} -o {2}.html\n",
      study, result, name);
  if (!measures.empty()) std::cout << fmt::format("  sunload info {} --measures\n", result);
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

std::vector<std::string> example_names() {
  const std::string data = data_folder();
  std::vector<std::string> names;
  if (data.empty()) return names;
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(fs::path(data) / "configs", unknown))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

int init_study(const InitRules& given, const std::string& wanted) {
  InitRules rules = given;
  rules.measures = rules_of_words(given.measures);
  const std::string name = study_name(wanted.empty() ? rules.model : wanted);
  const std::string path = wanted.empty() ? name + ".yaml" : wanted;
  if (!path.ends_with(".yaml") && !path.ends_with(".yml"))
    throw InputError({path, 0, 0}, "is no name of a study", "commands tell studies by it",
                     "let it end in .yaml");
  expect_names_for_study(rules, path);
  expect_plan_data(rules);
  expect_free(path);
  expect_writable(path);
  Findings found = findings_of(rules);
  if (found.unit_of_crs_m != 1 && rules.unit_m == 1) {
    rules.unit_m = found.unit_of_crs_m;
    rules.is_unit_of_crs = true;
    found = findings_of(rules);
  }
  if (found.is_on_its_side) {
    rules.up = "y";
    rules.is_up_guessed = true;
    found = findings_of(rules);
  }
  while (!found.sunk_into.empty() && rules.land.size() < most_lands &&
         std::find(rules.land.begin(), rules.land.end(), found.sunk_into) == rules.land.end()) {
    rules.land.push_back(found.sunk_into);
    found = findings_of(rules);
  }
  expect_measurable(rules.measures, found);
  const std::string text = affordable_text(name, rules, found, path);
  const StudyFile study = read_text(text, path);
  expect_free(path);
  write_file(path, text);
  tell_warnings(found.warnings);
  tell_marked(text, path);
  print_next(path, name, study.variants.front().variant, rules.measures);
  return exit_code::done;
}

int init_example(const std::string& name, const std::string& wanted) {
  const std::string data = data_folder();
  if (data.empty())
    throw InputError({}, "--example " + name, "the examples are not beside this program",
                     "install it with `cmake --install`, or run it where it was built");
  const fs::path configs = fs::path(data) / "configs";
  const fs::path study = configs / (name + ".yaml");
  const auto names = example_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError({}, "--example " + name, "there is no such example",
                     "write one of: " + listed(names));
  const fs::path folder = wanted.empty() ? "." : wanted;
  std::vector<std::pair<fs::path, fs::path>> copies;
  std::vector<std::string> files = named_files(read_study(study.string()));
  files.push_back(study.string());
  for (const auto& file : files) {
    const fs::path relative = fs::relative(file, configs);
    const auto copy = std::pair(fs::path(file), folder / relative);
    const bool is_new = std::find(copies.begin(), copies.end(), copy) == copies.end();
    if (!is_new || relative.empty() || *relative.begin() == "..") continue;
    expect_free(copy.second.string());
    copies.push_back(copy);
  }
  for (const auto& [from, to] : copies) {
    std::error_code failed;
    fs::create_directories(to.parent_path(), failed);
    if (!failed) fs::copy_file(from, to, failed);
    if (failed) throw MachineError("cannot write " + to.string() + ": " + failed.message());
  }
  const StudyFile copied = read_study((folder / study.filename()).string());
  print_next((folder / study.filename()).lexically_normal().string(), copied.name,
             copied.variants.front().variant);
  return exit_code::done;
}

}  // namespace sunload
