// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/check_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "geo/mesh/intersections.h"
#include "geo/mesh/surface_kind.h"
#include "io/base/exit_code.h"
#include "io/base/machine.h"
#include "io/base/output_target.h"
#include "io/base/standard_streams.h"
#include "io/picture/picture.h"
#include "io/picture/sun_diagram.h"
#include "io/plan/expected_error.h"
#include "io/plan/mesh_family.h"
#include "io/plan/planner.h"
#include "io/plan/room.h"
#include "io/plan/rules_of_study.h"
#include "io/plan/seasons_of_plan.h"
#include "io/plan/selection.h"
#include "io/plan/study_measures.h"
#include "io/plan/time_words.h"
#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "io/plan/work_estimate.h"
#include "io/plan/work_probe.h"
#include "io/run/progress.h"
#include "io/study/named_files.h"
#include "io/study/words.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

std::string counts_text(const PrepareReport& r) {
  std::string text = fmt::format(
      "  read      {} polygons ({} with holes), {} vertices\n"
      "  repaired  {} vertices welded, {} triangles turned, {} fronts with a back made two-sided, "
      "{} T-joints split\n"
      "  dropped   {} degenerate, {} duplicate, {} polygons not triangulable\n"
      "  doubtful  {} polygons not planar, {} crossing themselves, {} bodies without consistent "
      "fronts\n"
      "  bodies    {} closed ({:.6g} m3), {} with their fronts inward, {} open sheets; {} open "
      "edges, {} non-manifold edges\n"
      "  floors    {} triangles touch the ground: they cast shadows, are no patches\n"
      "  shape     the thinnest triangle is {:.4g} times as long as high\n",
      r.polygons_read, r.polygons_with_holes, r.vertices_read, r.vertices_welded,
      r.triangles_flipped, r.sheets_merged, r.t_joints_split, r.degenerates_dropped,
      r.duplicates_dropped, r.polygons_untriangulated, r.polygons_nonplanar, r.polygons_crossing,
      r.unorientable, r.closed_bodies, r.volume_m3, r.inside_out_bodies, r.open_sheets,
      r.open_edges, r.nonmanifold_edges, r.floors, r.worst_aspect);
  text += "  area     ";
  for (std::size_t s = 0; s < surface_names.size(); ++s)
    if (r.area_m2[s] > 0) text += fmt::format(" {} {:.6g} m2", surface_names[s], r.area_m2[s]);
  text += "\n";
  std::string covered;
  for (std::size_t s = 0; s < surface_names.size(); ++s)
    if (r.covered_m2[s] > 0)
      covered += fmt::format(" {} {:.6g} m2", surface_names[s], r.covered_m2[s]);
  if (!covered.empty())
    text += "  covered  " + covered +
            ": inside of bodies, against other surfaces or below land; no patches\n";
  return text;
}

/// "+0.12", "-0.30", and 0.00 without a sign.
std::string signed_text(double metres) {
  const double cm = std::round(metres * 100);
  return cm == 0 ? "0.00" : fmt::format("{:+.2f}", cm / 100);
}

std::string gaps_text(const std::vector<FootGap>& gaps, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(gaps.size(), most); ++i)
    text +=
        fmt::format("{}{} {} m", i == 0 ? "" : ", ", gaps[i].object, signed_text(gaps[i].gap_m));
  return text + (gaps.size() > most ? ", …" : "");
}

/// How the land goes on beyond the outermost feet, by the largest slope there (a tangent).
std::string beyond_text(double steepest) {
  constexpr double worth_telling = 0.005;
  if (steepest < worth_telling) return "level beyond the outermost";
  return fmt::format("beyond the outermost by their slope ({:.0f} % at most)", 100 * steepest);
}

/// How the ground was made, and how far bodies are above it or below.
std::string ground_text(const GroundReport& g) {
  constexpr std::size_t most = 10;
  std::string text = "  ground    ";
  if (g.made_m2 == 0)
    text += "none made";
  else if (g.is_level)
    text +=
        fmt::format("{:.6g} m2, level at {:.2f} m{}", g.made_m2, g.low_m,
                    g.surface == GroundSurface::feet && g.standing > 0 ? " as all feet are" : "");
  else
    text += fmt::format("{:.6g} m2 through the feet, from {:.2f} to {:.2f} m, {}", g.made_m2,
                        g.low_m, g.high_m, beyond_text(g.steepest_beyond));
  if (g.terrain_m2 > 0)
    text += fmt::format("; the model's own terrain goes first, {:.6g} m2", g.terrain_m2);
  text += fmt::format("\n  feet      {} bodies stand on it, {} on other bodies", g.standing,
                      g.on_others);
  if (g.standing > 0)
    text +=
        fmt::format("; above it (below: -) by {} {} {} {} {} m (least, 5 %, median, 95 %, most)",
                    signed_text(g.gap_m[0]), signed_text(g.gap_m[1]), signed_text(g.gap_m[2]),
                    signed_text(g.gap_m[3]), signed_text(g.gap_m[4]));
  if (g.drawn > 0)
    text +=
        fmt::format("\n            walls of {} are drawn down to the terrain, by {:.2f} m at most",
                    g.drawn, g.longest_drawn_m);
  if (!g.worst.empty() && std::abs(g.worst.front().gap_m) > touching_m)
    text += "\n            farthest: " + gaps_text(g.worst, most);
  if (!g.hovering.empty())
    text += fmt::format("\n            {} hover, too far from the feet beside them: {}",
                        g.hovering.size(), gaps_text(g.hovering, most));
  return text + "\n";
}

std::string intersections_text(const Mesh& mesh) {
  const Intersections found = find_intersections(mesh);
  std::string text = fmt::format(
      "  meeting   {} pairs of triangles cut and {} cover each other ({} of both between objects), "
      "{} of {} triangles",
      found.cutting, found.covering, found.between_objects, found.triangles, mesh.triangle_count());
  if (found.pairs() > 0) {
    const Vec3 p = mesh.corner(found.first[0], 0) + mesh.origin;
    const auto name = [&](std::size_t t) {
      return mesh.object_names[mesh.triangle_object[t].index()];
    };
    text += fmt::format("; first {} and {} near ({:.10g}, {:.10g}, {:.10g})", name(found.first[0]),
                        name(found.first[1]), p.x, p.y, p.z);
  }
  return text + "\n";
}

/// What float can resolve at the scene's largest coordinate (a float has 24 bits).
std::string extent_text(const Mesh& mesh, const Box& bounds) {
  double largest = 0;
  for (const double c :
       {bounds.low.x, bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z})
    largest = std::max(largest, std::abs(c));
  const Vec3 size = bounds.high - bounds.low;
  return fmt::format(
      "  extent    {:.6g} x {:.6g} x {:.6g} m, local origin at ({:.10g}, {:.10g}, {:.10g}); "
      "rays resolve {:.2g} mm\n",
      size.x, size.y, size.z, mesh.origin.x, mesh.origin.y, mesh.origin.z,
      1000 * largest * 0x1p-24);
}

/// Shares of light from the normal, and what decides at other angles.
std::string shares_text(const Material& m) {
  const SmoothShares smooth = smooth_shares(m, 1);
  std::string text = fmt::format("diffuse {:.3f}  mirror {:.3f}", m.diffuse, smooth.mirror);
  if (m.glossy > 0)
    text += fmt::format("  glossy {:.3f} (exponent {:g})", m.glossy, m.glossy_exponent);
  if (m.transmittance > 0) text += fmt::format("  passes {:.3f}", m.transmittance);
  if (const auto* metal = std::get_if<Metal>(&m.smooth)) {
    text += fmt::format("  metal n {:g} k {:g}", metal->refractive_index,
                        metal->extinction_coefficient);
  } else if (const auto* panes = std::get_if<Panes>(&m.smooth)) {
    text += fmt::format("  transmits {:.3f}  {} x {:g} mm of n {:g}", smooth.transmitted,
                        panes->count, 1000 * panes->thickness_m, panes->refractive_index);
    if (panes->absorption_per_m > 0) text += fmt::format(", K {:g} /m", panes->absorption_per_m);
  } else if (const auto* glass = std::get_if<ClearGlass>(&m.smooth)) {
    text += fmt::format("  transmits {:.3f}  clear glass of {:g}", smooth.transmitted,
                        glass->normal_transmittance);
  }
  return text;
}

std::string materials_text(const Scene& scene) {
  std::vector<double> area(scene.materials.size(), 0);
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t)
    area[scene.material[t].index()] += norm(scene.mesh.area_vector2(t)) / 2;
  std::string text;
  for (std::size_t m = 0; m < area.size(); ++m) {
    const Material& material = scene.materials[m];
    text += fmt::format("  {:<24} {}", material.name, shares_text(material));
    if (material.emission_w_m2 > 0)
      text += fmt::format("  emits {:.4g} W/m2", material.emission_w_m2);
    text += fmt::format("  {:.6g} m2\n", area[m]);
  }
  return text;
}

std::string rules_text(const std::vector<RuleUse>& rules) {
  std::string text;
  for (const RuleUse& use : rules) {
    text +=
        fmt::format("  rule      {}  {} triangles, {:.6g} m2", use.rule, use.given, use.given_m2);
    if (use.given < use.matched)
      text += fmt::format("  ({} more have it from elsewhere)", use.matched - use.given);
    text += "\n";
  }
  return text;
}

std::string parallel_sources_text(const ParallelSources& sources) {
  if (sources.exitance.empty()) return {};
  double area = 0, power = 0;
  for (std::size_t t = 0; t < sources.exitance.size(); ++t) {
    const double own = norm(sources.mesh.area_vector2(t)) / 2;
    area += own;
    power += own * sources.exitance[t];
  }
  return fmt::format("  parallel  {} triangles of {:.6g} m2 send {:.6g} W along their normals\n",
                     sources.exitance.size(), area, power);
}

std::string luminaires_text(const Luminaires& luminaires) {
  if (!luminaires.any()) return {};
  return fmt::format("  luminaires {} send {:.6g} lm\n", luminaires.all.size(), luminaires.flux());
}

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

bool is_left_unrefined(const VariantPlan& plan, CheckMesh mesh) {
  return mesh == CheckMesh::unrefined && plan.study.mesh.oracle != Oracle::none;
}

/// What each selection chooses; `empty` gets a warning for those of nothing.
std::string selections_text(const VariantPlan& plan, const Hierarchy& hierarchy,
                            std::vector<std::string>& empty) {
  std::string text;
  for (const NamedSelection& selection : plan.study.selections) {
    const ChosenParts chosen = selected_patches(selection, plan.built, hierarchy);
    std::size_t count = 0;
    double area_m2 = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i] == 0) continue;
      ++count;
      area_m2 += hierarchy.area()[i];
    }
    if (count == 0) empty.push_back(empty_selection_warning(selection.name));
    text += fmt::format("  {}: {} patches, {:.1f} m2\n", selection.name, count, area_m2);
  }
  return text;
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

/// What is told of a variant, under headings, all of them in order whether they have words or not;
/// that of warnings is empty.
struct CheckText {
  std::string head;
  std::vector<std::pair<std::string, std::string>> sections;
};

std::string seasons_section(const VariantPlan& plan) {
  std::string text = seasons_text(plan.seasons, plan.light);
  if (!text.empty()) text = "  " + text + "; each is traced as a scene of its own\n";
  for (const auto& [season, albedo, where] : plan.study.light.far_ground_seasons)
    text += fmt::format("  far ground {:g} in {}\n", albedo, season);
  return text;
}

CheckText text_of(const VariantPlan& plan, const VariantMesh& made, const WorkEstimate& work,
                  const CheckRules& rules, SunTexts& suns) {
  CheckText text{fmt::format("study {}, variant {} (content {})", plan.study.name,
                             plan.study.variant, plan.content_hash.substr(0, 12)),
                 {}};
  const auto add = [&](const char* heading, std::string words) {
    text.sections.emplace_back(heading, std::move(words));
  };
  std::string scene =
      counts_text(plan.built.report) + extent_text(plan.built.scene.mesh, plan.built.report.bounds);
  if (rules.search == SearchIntersections::yes) scene += intersections_text(plan.built.scene.mesh);
  if (plan.built.report.ground) scene += ground_text(*plan.built.report.ground);
  for (const auto& note : plan.built.notes) scene += "  note      " + note + "\n";
  add("scene", scene);
  add("materials", materials_text(plan.built.scene) + rules_text(plan.built.rules) +
                       parallel_sources_text(plan.built.scene.parallel_sources) +
                       luminaires_text(plan.built.scene.luminaires));
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
  std::vector<std::string> empty_selections;
  add("selections", selections_text(plan, *made.mesh, empty_selections));
  std::string measures;
  for (const auto& line : measures_in_words(plan, *made.mesh)) measures += "  " + line + "\n";
  add("measures", measures);
  add("work", work_text(plan, work));
  std::string warnings;
  for (const auto& list : {plan.built.warnings, plan.light.notes,
                           expected_error_warnings(plan, *made.mesh), empty_selections})
    for (const auto& line : list) warnings += "warning: " + line + "\n";
  add("", warnings);
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What a line is about: the word that it begins with.
std::string subject(const std::string& line) {
  std::istringstream words(line);
  std::string first;
  words >> first;
  return first;
}

template <class IsIt>
bool has_line(const std::vector<std::string>& lines, const IsIt& is_it) {
  return std::any_of(lines.begin(), lines.end(), is_it);
}

/// Lines of a section that are not in the first variant's.
std::string changed_lines(const std::string& first, const std::string& own) {
  const auto theirs = lines_of(first);
  std::string text;
  for (const auto& line : lines_of(own))
    if (!has_line(theirs, [&](const auto& other) { return other == line; })) text += line + "\n";
  return text;
}

/// Subjects that the first variant's section has alone.
std::string missing_subjects(const std::string& first, const std::string& own) {
  const auto mine = lines_of(own);
  std::string text;
  for (const auto& line : lines_of(first))
    if (!has_line(mine, [&](const auto& other) { return subject(other) == subject(line); }))
      text += "  without   " + subject(line) + "\n";
  return text;
}

const std::string& section_of(const CheckText& text, const std::string& heading) {
  static const std::string none;
  for (const auto& [name, words] : text.sections)
    if (name == heading) return words;
  return none;
}

std::string whole_text(const CheckText& text) {
  std::string words = text.head + "\n";
  for (const auto& [heading, lines] : text.sections) {
    if (!heading.empty() && !lines.empty()) words += heading + "\n";
    words += lines;
  }
  return words;
}

/// A later variant by what differs from the first one: what both have is told once.
std::string text_beside(const CheckText& first, const CheckText& text,
                        const std::string& first_name) {
  std::string words;
  for (const auto& [heading, own] : text.sections) {
    const auto& theirs = section_of(first, heading);
    auto apart = changed_lines(theirs, own);
    if (heading == "materials") apart += missing_subjects(theirs, own);
    if (heading == "seasons" && own.empty() && !theirs.empty()) apart = "  none\n";
    if (apart.empty()) continue;
    if (!heading.empty()) words += heading + "\n";
    words += apart;
  }
  return text.head + (words.empty() ? ": as " + first_name + "\n"
                                    : ": as " + first_name + ", but for\n" + words);
}

/// Variants in the order of the study: the first in full, the others beside it.
class VariantTexts {
 public:
  void print(const std::string& name, CheckText text) {
    if (!first_) {
      std::cout << whole_text(text);
      first_ = std::move(text);
      first_name_ = name;
      return;
    }
    std::cout << "\n" << text_beside(*first_, text, first_name_);
  }

 private:
  std::optional<CheckText> first_;
  std::string first_name_;
};

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
                              {"lit", plan.light.lit_count()},
                              {"batches", plan.batches()},
                              {"lines", work.line_rays},
                              {"memory_bytes", static_cast<std::uint64_t>(work.memory_bytes)},
                              {"disk_bytes", static_cast<std::uint64_t>(work.disk_bytes)},
                              {"seconds", work.seconds},
                              {"seasons", seasons_json(plan)}};
  if (mesh == CheckMesh::unrefined) told["refined"] = !is_left_unrefined(plan, mesh);
  return told;
}

/// Meshes of variants one after the other. Refinement is told of before it begins, and while it
/// goes on; without it the mesh follows from triangles alone, and most variants have the same.
class Meshes {
 public:
  Meshes(CheckMesh kind, ProgressStyle progress) : kind_(kind), progress_(progress) {}

  const VariantMesh& of(const VariantPlan& plan) {
    if (plan.study.mesh.oracle == Oracle::none || kind_ == CheckMesh::unrefined) {
      if (!has_unrefined_of(plan)) keep_unrefined_of(plan);
      return unrefined_;
    }
    if (!plan.family || !plan.family->made) tell_of_refinement(plan);
    progress_.begin_variant(plan.study.variant, 0);
    refined_ = make_mesh(plan, progress_);
    return refined_;
  }

 private:
  bool has_unrefined_of(const VariantPlan& plan) const {
    const Mesh& mesh = plan.built.scene.mesh;
    const SplitRules rules = split_rules(plan.study);
    return unrefined_.mesh && rules.max_edge_m == rules_.max_edge_m &&
           rules.min_area_m2 == rules_.min_area_m2 && mesh.triangles == triangles_ &&
           mesh.vertices == vertices_ && mesh.triangle_sides == sides_ &&
           mesh.triangle_surface == surfaces_ && mesh.triangle_object == objects_;
  }

  void keep_unrefined_of(const VariantPlan& plan) {
    unrefined_ = unrefined_mesh(plan);
    const Mesh& mesh = plan.built.scene.mesh;
    rules_ = split_rules(plan.study);
    triangles_ = mesh.triangles;
    vertices_ = mesh.vertices;
    sides_ = mesh.triangle_sides;
    surfaces_ = mesh.triangle_surface;
    objects_ = mesh.triangle_object;
  }

  /// So that nobody waits without knowing for what.
  void tell_of_refinement(const VariantPlan& plan) {
    constexpr double worth_telling_s = 2;
    const std::size_t patches = least_patch_count(plan.built.scene, split_rules(plan.study));
    const auto [least_s, most_s] = refinement_seconds(plan, patches);
    if (most_s < worth_telling_s) return;
    progress_.say(
        fmt::format("{}: refines its mesh of {} patches, which takes between {:.0f} s and {:.0f} "
                    "s; --no-refine "
                    "leaves this out",
                    plan.study.variant, patches, least_s, most_s));
  }

  CheckMesh kind_;
  Progress progress_;
  VariantMesh refined_, unrefined_;
  // What `unrefined_` was made from.
  SplitRules rules_;
  decltype(Mesh::triangles) triangles_;
  decltype(Mesh::vertices) vertices_;
  decltype(Mesh::triangle_sides) sides_;
  decltype(Mesh::triangle_surface) surfaces_;
  decltype(Mesh::triangle_object) objects_;
};

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

/// To the standard error: what was asked for goes to stdout.
void print_warnings(const std::vector<std::string>& warnings) {
  for (const auto& warning : warnings) tell("warning: " + warning);
}

}  // namespace

int check_study(const std::string& path, const RunOptions& options, const CheckRules& rules) {
  use_threads(options);
  const StudyFile file = read_study(path);
  print_warnings(file.warnings);
  nlohmann::ordered_json json;
  json["variants"] = nlohmann::ordered_json::array();
  std::size_t units = 0;
  const std::string folder = results_folder(file, options);
  Problems problems;
  Planner planner;
  const MeshFamilies families(file, planner);
  Meshes meshes(rules.mesh, options.progress);
  StudyPaces paces;
  VariantTexts texts;
  SunTexts suns;
  const std::vector<Study> chosen = chosen_variants(file, options);
  expect_measured_somewhere(file, chosen, planner);
  for (const auto& study : chosen) {
    try {
      VariantPlan plan = planner.plan(study);
      families.join(plan);
      expect_meshable(plan);
      const VariantMesh& made = meshes.of(plan);
      const WorkEstimate work = estimated(plan, made, rules.mesh, paces);
      // A warning: the machine that runs it may be another.
      for (const auto& problem : {memory_problem(work), disk_problem(work, folder)})
        if (!problem.empty()) tell("warning: " + plan.study.variant + ": " + problem);
      units += plan.batches();
      json["variants"].push_back(as_json(plan, work, rules.mesh));
      json["batch_suns"] = plan.batch_suns();
      if (rules.format == CheckFormat::text)
        texts.print(plan.study.variant, text_of(plan, made, work, rules, suns));
    } catch (const InputError& error) {
      problems.add(error);
    }
  }
  problems.throw_if_any();
  json["units"] = units;
  if (rules.format == CheckFormat::json) std::cout << json.dump(2) << "\n";
  return exit_code::done;
}

int print_sun(const std::string& path, const std::string& picture) {
  const StudyFile file = read_study(path);
  expect_not_read(picture, named_files(file));
  expect_picture_name(picture);
  print_warnings(file.warnings);
  const Study& study = file.variants.front();
  // The site may come from the scene's CRS, which only its reader knows.
  const BuiltScene built = build_scene(study);
  expect_not_read(picture, built.files);
  const Site& site = built.site;
  const LightSeries light = light_series(study, site);
  print_warnings(light.notes);
  if (!picture.empty()) {
    draw_sun_diagram(study, site, light, picture);
    return exit_code::done;
  }
  std::cout << "time,azimuth_deg,elevation_deg,dni_w_m2,dhi_w_m2,ghi_w_m2\n";
  for (const auto& i : light.intervals)
    std::cout << fmt::format("{},{:.6f},{:.6f},{:.4f},{:.4f},{:.4f}\n", iso_utc(i.when.sun_time),
                             i.when.sun.azimuth_deg, i.when.sun.elevation_deg, i.mean.dni,
                             i.mean.dhi, i.mean.ghi);
  return exit_code::done;
}

int print_sky(const std::string& path, const SkyOptions& options) {
  const StudyFile file = read_study(path);
  expect_not_read(options.picture, named_files(file));
  expect_picture_name(options.picture);
  print_warnings(file.warnings);
  const SkyDome dome = sky_dome(file.variants.front(), options.time);
  print_warnings(dome.notes);
  if (options.picture.empty()) {
    std::cout << sky_csv(sky_rows(dome, options.subdivision));
  } else {
    draw_sky(dome, options.rules, options.picture);
  }
  return exit_code::done;
}

}  // namespace sunload
