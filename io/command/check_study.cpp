// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/check_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/base/exit_code.h"
#include "io/base/machine.h"
#include "io/base/standard_streams.h"
#include "io/command/scene_in_words.h"
#include "io/command/variant_texts.h"
#include "io/plan/expected_error.h"
#include "io/plan/material_uses.h"
#include "io/plan/mesh_family.h"
#include "io/plan/planner.h"
#include "io/plan/room.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/seasons_of_plan.h"
#include "io/plan/selection.h"
#include "io/plan/study_measures.h"
#include "io/plan/time_words.h"
#include "io/plan/variant_plan.h"
#include "io/plan/work_estimate.h"
#include "io/plan/work_probe.h"
#include "io/study/words.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// How many suns stand for intervals; what more of them would do where one is coarse. Empty where
/// every interval has its one sun, and is short.
std::string suns_text(const VariantPlan& plan) {
  std::size_t sunlit = 0, more = 0;
  double longest_s = 0;
  for (const LitInterval& interval : plan.light.intervals) {
    if (interval.when.sunlit_s <= 0) continue;
    ++sunlit;
    longest_s = std::max(longest_s, interval.when.sunlit_s);
    more += static_cast<std::size_t>(sun_sample_count({std::nullopt}, interval.when.sunlit_s));
  }
  const std::size_t suns = plan.light.sun_samples();
  if (suns > sunlit) return fmt::format("  {} suns stand for {} intervals\n", suns, sunlit);
  const bool suns_are_given = std::holds_alternative<InstantsPeriod>(plan.study.period.kind) ||
                              std::holds_alternative<PositionsPeriod>(plan.study.period.kind);
  if (suns_are_given || more == sunlit) return {};
  constexpr double minutes_per_degree = 4;  // of the sun's way about the pole
  const double minutes = longest_s / seconds_per_minute;
  return fmt::format(
      "  one sun stands for up to {:.0f} min, and shadows stay where it puts them while it moves "
      "by "
      "{:.0f} degrees; solver.sun_samples_per_interval: auto takes {:.2g} times as many suns\n",
      minutes, minutes / minutes_per_degree,
      static_cast<double>(more) / static_cast<double>(sunlit));
}

std::string work_text(const VariantPlan& plan, const WorkEstimate& work) {
  std::string text = suns_text(plan);
  if (const auto& accuracy = plan.study.solver.accuracy)
    text += fmt::format(
        "  a standard error of {} is asked for: counts are decided at the start of the run, "
        "from {} lines and {} direct samples up to {}; what follows is with the least\n",
        goal_words(*accuracy), plan.study.solver.lines_per_patch, plan.study.solver.direct_samples,
        plan.study.solver.max_lines_per_patch);
  const std::string shot =
      work.samples > 0 ? fmt::format(", {:.3g} samples shot", static_cast<double>(work.samples))
                       : "";
  if (!plan.steps.empty())
    text += fmt::format("  series are means over {} steps: {}\n", plan.steps.size(),
                        word_of(plan.study.output.series_step));
  return text + fmt::format(
                    "  {} patches, {} intervals ({} with light) in {} batches\n"
                    "  {:.3g} lines, about {:.3g} shadow rays{}; estimated {:.0f} MiB memory, "
                    "{:.0f} MiB disk, "
                    "{:.0f} s on {} threads{}\n",
                    work.patches, plan.intervals(), lit_intervals(plan), plan.batches(),
                    static_cast<double>(work.line_rays), static_cast<double>(work.direct_rays),
                    shot, work.memory_bytes / mib, work.disk_bytes / mib, work.seconds,
                    thread_count(), work.is_of_this_machine ? ", by a trial on this machine" : "");
}

/// What a selection chooses.
struct SelectionSize {
  std::string name;
  std::size_t patches = 0;
  double area_m2 = 0;
};

std::vector<SelectionSize> selection_sizes(const VariantPlan& plan, const Hierarchy& hierarchy) {
  std::vector<SelectionSize> sizes;
  for (const NamedSelection& selection : plan.study.selections) {
    const ChosenParts chosen = selected_patches(selection, plan.built, hierarchy);
    SelectionSize size{selection.name};
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i] == 0) continue;
      ++size.patches;
      size.area_m2 += hierarchy.area()[i];
    }
    sizes.push_back(std::move(size));
  }
  return sizes;
}

/// The sun in words, made once for variants that have it in common.
class SunTexts {
 public:
  const std::string& of(const VariantPlan& plan) {
    const BuiltScene& built = plan.built;
    const std::string key =
        Planner::key_of_light(plan.study, built.site) + "\n" + built.site_source;
    if (const std::string* known = made_.of(key)) return *known;
    return made_.keep(key, time_words(plan.light, built.site, plan.study, built.site_source), 1);
  }

 private:
  static constexpr double most = 4096;
  RecentlyMade<std::string> made_{most};
};

std::string seasons_section(const VariantPlan& plan) {
  std::string text = seasons_text(plan.seasons, plan.light);
  if (!text.empty()) text = "  " + text + "; each is traced as a scene of its own\n";
  for (const auto& [season, albedo, where] : plan.study.light.far_ground_seasons)
    text += fmt::format("  far ground {:g} in {}\n", albedo, season);
  return text;
}

/// Those of the run, and of selections in which nothing lies.
std::vector<std::string> warnings_of(const VariantPlan& plan, const Hierarchy& mesh,
                                     const std::vector<SelectionSize>& selections) {
  std::vector<std::string> all;
  for (const auto& list :
       {plan.built.warnings, plan.light.notes, expected_error_warnings(plan, mesh)})
    all.insert(all.end(), list.begin(), list.end());
  for (const SelectionSize& selection : selections)
    if (selection.patches == 0) all.push_back(empty_selection_warning(selection.name));
  return all;
}

CheckText text_of(const VariantPlan& plan, const VariantMesh& made, const WorkEstimate& work,
                  const CheckRules& rules, SunTexts& suns) {
  CheckText text{fmt::format("study {}, variant {} (content {})", plan.study.name,
                             plan.study.variant, plan.content_hash.substr(0, 12)),
                 {}};
  const auto add = [&](const char* heading, std::string words) {
    text.sections.emplace_back(heading, std::move(words));
  };
  add("scene", scene_in_words(plan.built, rules.search == SearchIntersections::yes));
  add("materials", materials_in_words(plan.built));
  add("seasons", seasons_section(plan));
  const std::size_t sensors = plan.built.scene.sensors.size();
  add("sensors", sensors > 0 ? fmt::format("  {} points\n", sensors) : "");
  add("sun", suns.of(plan));
  std::string mesh;
  if (const auto refined = refine_text(made.report, plan.study); !refined.empty())
    mesh = "  " + refined + "\n";
  if (is_left_unrefined(plan, rules.mesh))
    mesh += "  not refined here (--no-refine): a run has these patches or more\n";
  mesh += "  largest   " + largest_patches_text(plan, *made.mesh) + "\n";
  add("mesh", mesh);
  const auto selections = selection_sizes(plan, *made.mesh);
  std::string chosen;
  for (const auto& [name, patches, area_m2] : selections)
    chosen += fmt::format("  {}: {} patches, {:.1f} m2\n", name, patches, area_m2);
  add("selections", chosen);
  std::string measures;
  for (const auto& line : measures_in_words(plan, *made.mesh)) measures += "  " + line + "\n";
  add("measures", measures);
  add("work", work_text(plan, work));
  std::string warnings;
  for (const auto& line : warnings_of(plan, *made.mesh, selections))
    warnings += "warning: " + line + "\n";
  add("", warnings);
  return text;
}

/// The scenes that the period has one after the other, and what is traced of each.
nlohmann::ordered_json seasons_json(const VariantPlan& plan) {
  auto list = nlohmann::ordered_json::array();
  const auto hours = season_hours(plan.seasons, plan.light);
  for (std::size_t s = 0; s < hours.size(); ++s)
    list.push_back({{"name", words_of(plan.seasons.all[s])}, {"hours", hours[s]}});
  return list;
}

nlohmann::ordered_json as_json(const VariantPlan& plan, const WorkEstimate& work, CheckMesh mesh) {
  nlohmann::ordered_json told{{"name", plan.study.variant},
                              {"hash", plan.content_hash},
                              {"patches", work.patches},
                              {"intervals", plan.intervals()},
                              {"lit", lit_intervals(plan)},
                              {"batches", plan.batches()},
                              {"lines", work.line_rays},
                              {"memory_bytes", static_cast<std::uint64_t>(work.memory_bytes)},
                              {"disk_bytes", static_cast<std::uint64_t>(work.disk_bytes)},
                              {"seconds", work.seconds},
                              {"seasons", seasons_json(plan)}};
  if (mesh == CheckMesh::unrefined) told["refined"] = !is_left_unrefined(plan, mesh);
  return told;
}

/// A mesh that is larger than any could be is refused as `run` refuses it: for want of memory,
/// where that is too little, and otherwise when it is made.
void expect_meshable(const VariantPlan& plan) {
  const SplitRules rules = split_rules(plan.study);
  const WorkEstimate least = estimate_work(plan, least_patch_count(plan.built.scene, rules));
  if (least.patches <= rules.max_patches) return;
  if (const auto problem = memory_problem(least, PatchesAre::at_least); !problem.empty())
    throw MachineError(problem);
}

/// By what this machine takes for a little of the work; of patches that a run refines, or that have
/// no room here, by the cost model alone.
WorkEstimate estimated(const VariantPlan& plan, const VariantMesh& made, CheckMesh kind,
                       StudyPaces& paces) {
  const std::size_t patches = made.mesh->patch_count();
  const WorkEstimate by_model = estimate_work(plan, patches);
  if (is_left_unrefined(plan, kind) || !memory_problem(by_model).empty()) return by_model;
  return estimate_work(plan, patches, paces.of(plan, made.mesh));
}

/// Where each variant finds room, but not all of them: when the largest one is merged the results
/// of the others are there, about half of what these took with their batches.
void tell_disk_of_all(const std::vector<WorkEstimate>& works, const std::string& folder) {
  if (works.size() < 2) return;
  const auto smaller = [](const auto& a, const auto& b) { return a.disk_bytes < b.disk_bytes; };
  WorkEstimate all = *std::max_element(works.begin(), works.end(), smaller);
  if (!disk_problem(all, folder).empty()) return;
  all.disk_bytes /= 2;
  for (const WorkEstimate& work : works) all.disk_bytes += work.disk_bytes / 2;
  if (const auto problem = disk_problem(all, folder); !problem.empty())
    tell_warnings({problem}, "all variants");
}

}  // namespace

int check_study(const std::string& path, const RunOptions& options, const CheckRules& rules) {
  use_threads(options);
  const StudyFile file = read_study(path);
  tell_warnings(file.warnings);
  const std::string folder = results_folder(file, options);
  nlohmann::ordered_json json{{"study", file.name}, {"folder", folder}};
  json["variants"] = nlohmann::ordered_json::array();
  std::size_t units = 0;
  Problems problems;
  Planner planner;
  const MeshFamilies families(file, planner);
  MaterialUses uses(file, planner);
  CheckMeshes meshes(rules.mesh, options.progress);
  StudyPaces paces;
  VariantTexts texts;
  SunTexts suns;
  std::vector<WorkEstimate> works;
  const std::vector<Study> chosen = chosen_variants(file, options);
  expect_measured_somewhere(file, chosen, planner);
  for (const auto& study : chosen) {
    try {
      VariantPlan plan = planner.plan(study);
      families.join(plan);
      uses.warn_of_idle(plan);
      expect_meshable(plan);
      const VariantMesh& made = meshes.of(plan);
      const WorkEstimate work = estimated(plan, made, rules.mesh, paces);
      // A warning: the machine that runs it may be another.
      for (const auto& problem : {memory_problem(work), disk_problem(work, folder),
                                  accuracy_pilot_problem(plan, made.mesh->patch_count())})
        if (!problem.empty()) tell_warnings({problem}, plan.study.variant);
      works.push_back(work);
      units += plan.batches();
      json["variants"].push_back(as_json(plan, work, rules.mesh));
      json["batch_suns"] = plan.batch_suns();
      if (rules.format == CheckFormat::text)
        texts.print(plan.study.variant, text_of(plan, made, work, rules, suns));
      else
        tell_warnings(warnings_of(plan, *made.mesh, selection_sizes(plan, *made.mesh)),
                      plan.study.variant);
    } catch (const InputError& error) {
      problems.add(error);
    }
  }
  problems.throw_if_any();
  json["units"] = units;
  tell_disk_of_all(works, folder);
  // Names may be anything.
  if (rules.format == CheckFormat::json)
    std::cout << json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << "\n";
  return exit_code::done;
}

}  // namespace sunload
