// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/refine.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "solver/base/threads.h"
#include "solver/mesh/nearness.h"

namespace sunload {

namespace {

constexpr std::size_t elements_per_task = 64;
/// Share of the squared error whose leaves are split in one pass (Dörfler's parameter).
constexpr double marked_share = 0.5;
/// Where the tolerance is out of reach because leaves of the least area hold too much of the error,
/// the others are split until they hold this share of it: more would hardly lower the sum.
constexpr double worth_splitting = 0.2;
/// A mesh is looked at by a sample of its leaves first, where it has more than this …
constexpr std::size_t few_leaves = 20'000;
/// … one of so many: a thousand leaves and more, which know the error to some per cent. Below the
/// tolerance by as much, the mesh is left as it is; to look at all of a large one costs as much as
/// half of its lines.
constexpr std::size_t leaves_per_sample = 16;
constexpr double clearly_below = 0.95;

/// A kind of which less than this is seen is looked at whole.
constexpr std::size_t few_of_kind = few_leaves / leaves_per_sample;
/// Of kinds that receive next to nothing the error is a share of this part of the mean of all.
constexpr double least_share_of_mean = 0.1;
/// Of glints a tolerance is so many times as wide: at five per cent of the mean, a quarter of their
/// own root mean square, where an eighth of their area lies at an edge.
constexpr double glint_width = 5;
/// To this tolerance leaves are no longer than the distance to the nearest wall to begin with.
constexpr double graded_tolerance = 0.05;

constexpr std::size_t kinds = mesh_kind_names.size();
constexpr std::size_t glints = static_cast<std::size_t>(MeshKind::glints);

MeshKind kind_of(Surface surface, double distance_m) {
  switch (surface) {
    case Surface::wall:
    case Surface::window:
      return MeshKind::wall;
    case Surface::roof:
      return MeshKind::roof;
    case Surface::ground:
    case Surface::floor:
      return distance_m > near_m ? MeshKind::ground : MeshKind::near_ground;
    case Surface::other:
      break;
  }
  return MeshKind::other;
}

/// Where a leaf is: what does not depend on light.
struct Place {
  std::size_t kind = 0;
  double weighted_m2 = 0;  ///< area of one side by its weight
};

/// What a pilot says of one leaf, both sides together; squares, power and area by the leaf's
/// weight.
struct Estimate {
  double squared_error = 0;        ///< ∫ (H - mean H)² dA [J2 m-2]
  double power = 0;                ///< ∫ H dA [J]
  double area_m2 = 0;              ///< of the sides that have patches
  double glint_squared_error = 0;  ///< of the light by mirrors alone
  double glint_squares = 0;        ///< ∫ H² dA of it
};

/// What the historic oracle goes by: its largest estimates.
struct HistoricEstimate {
  double by_suns_m2 = 0, by_emitters = 0;
};

/// Sums over the leaves of one kind.
struct KindSum {
  double squares = 0, power = 0, area = 0;
};

/// A pilot and what it says.
struct Look {
  MeshPilot pilot;
  std::vector<Estimate> estimates = {};  ///< per element
};

class Refinement {
 public:
  Refinement(ElementForest& forest, std::span<const PilotView> views, const SplitRules& split,
             const RefineRules& rules, Watch& watch)
      : forest_(forest), split_(split), rules_(rules), watch_(watch), nearness_(forest.scene()) {
    for (const auto& view : views)
      looks_.push_back({MeshPilot(forest, view.scene, view.caster, view.light, rules.seed)});
  }

  void run(RefineReport& report) {
    report.pilots = looks_.size();
    report.patches_before = forest_.patch_count();
    if (rules_.oracle == Oracle::historic) {
      refine_historically();
    } else {
      refine_by_load(report);
    }
    report.patches = forest_.patch_count();
  }

 private:
  using Leaves = std::vector<std::size_t>;

  Leaves all_leaves() const {
    Leaves leaves;
    for (std::size_t e = 0; e < forest_.elements().size(); ++e)
      if (forest_.elements()[e].is_leaf()) leaves.push_back(e);
    return leaves;
  }

  bool is_large_enough(std::size_t leaf) const {
    return forest_.area(leaf) >= 2 * split_.min_area_m2;
  }

  Leaves large_enough(Leaves leaves) const {
    std::erase_if(leaves, [&](std::size_t leaf) { return !is_large_enough(leaf); });
    return leaves;
  }

  std::size_t kind(std::size_t leaf) const { return places_[leaf].kind; }

  Place place_of(std::size_t leaf) const {
    const auto triangle = static_cast<std::size_t>(forest_.elements()[leaf].triangle);
    const double distance_m = nearness_.distance_m(forest_, leaf);
    return {static_cast<std::size_t>(
                kind_of(forest_.scene().mesh.triangle_surface[triangle], distance_m)),
            weight_at(distance_m) * forest_.area(leaf)};
  }

  /// Of leaves that were not placed yet.
  void place(const Leaves& leaves) {
    places_.resize(forest_.elements().size());
    parallel_for(
        leaves.size(), [&](std::size_t l) { places_[leaves[l]] = place_of(leaves[l]); },
        elements_per_task);
  }

  Estimate estimate(const MeshPilot& pilot, std::size_t leaf, double (&loads)[2]) const {
    Estimate e;
    const double weighted = places_[leaf].weighted_m2;
    const std::uint8_t sides = forest_.is_two_sided(leaf) ? 2 : 1;
    for (std::uint8_t side = 0; side < sides; ++side) {
      const ElementLoad load = pilot.load(leaf, side, split_.min_area_m2);
      loads[side] = load.mean;
      e.squared_error += squared_error(load.variance, weighted);
      e.power += load.mean * weighted;
      e.area_m2 += weighted;
      e.glint_squared_error += squared_error(load.glint_variance, weighted);
      e.glint_squares +=
          squared_error(load.glint_mean * load.glint_mean + load.glint_variance, weighted);
    }
    return e;
  }

  /// What the historic oracle asks for.
  HistoricEstimate historic_estimate(const MeshPilot& pilot, std::size_t leaf) const {
    HistoricEstimate e;
    const double area = forest_.area(leaf);
    const std::uint8_t sides = forest_.is_two_sided(leaf) ? 2 : 1;
    for (std::uint8_t side = 0; side < sides; ++side) {
      const ElementLoad load = pilot.sources(leaf, side, split_.min_area_m2);
      e.by_emitters = std::max(e.by_emitters, load.lamp_form_factor);
      if (load.sees_sun)
        e.by_suns_m2 =
            std::max(e.by_suns_m2, historic_light_estimate_m2(load.largest_cosine, area));
    }
    return e;
  }

  /// Estimates of leaves, which then are what others see of them.
  void look_at(const Leaves& leaves) {
    for (Look& look : looks_) {
      look.estimates.resize(forest_.elements().size());
      std::vector<std::pair<double, double>> loads(leaves.size());
      parallel_for(
          leaves.size(),
          [&](std::size_t l) {
            double of_sides[2] = {};
            look.estimates[leaves[l]] = estimate(look.pilot, leaves[l], of_sides);
            loads[l] = {of_sides[0], of_sides[1]};
          },
          elements_per_task);
      for (std::size_t l = 0; l < leaves.size(); ++l) {
        look.pilot.set_load(leaves[l], 0, loads[l].first);
        look.pilot.set_load(leaves[l], 1, loads[l].second);
      }
    }
  }

  /// The estimate's part in the error of a kind, of glints only where they can be seen.
  static double squares_of(const Estimate& e, std::size_t kind, double visible) {
    if (kind != glints) return e.squared_error;
    return e.glint_squares > visible * visible * e.area_m2 ? e.glint_squared_error : 0;
  }

  /// What light load is seen against the mean of all.
  double visible_load(const Look& look, const Leaves& leaves) const {
    double power = 0, area = 0;
    for (const auto leaf : leaves) {
      power += look.estimates[leaf].power;
      area += look.estimates[leaf].area_m2;
    }
    return area > 0 ? rules_.light_tolerance * power / area : 0;
  }

  /// Per kind: root mean square of H - mean H over its leaves, as share of the mean of H.
  std::array<double, kinds> relative_errors(const Look& look, const Leaves& leaves) const {
    std::array<KindSum, kinds> sums;
    KindSum all;
    const double visible = visible_load(look, leaves);
    for (const auto leaf : leaves) {
      const Estimate& e = look.estimates[leaf];
      KindSum& sum = sums[kind(leaf)];
      for (KindSum* each : {&sum, &all}) {
        each->power += e.power;
        each->area += e.area_m2;
      }
      sum.squares += e.squared_error;
      sums[glints].squares += squares_of(e, glints, visible);
      if (e.glint_squares > visible * visible * e.area_m2) sums[glints].power += e.glint_squares;
    }
    std::array<double, kinds> errors{};
    if (all.power <= 0) return errors;
    for (std::size_t k = 0; k < glints; ++k) {
      if (sums[k].area <= 0) continue;
      const double mean =
          std::max(sums[k].power / sums[k].area, least_share_of_mean * all.power / all.area);
      errors[k] = std::sqrt(std::max(0.0, sums[k].squares) / sums[k].area) / mean;
    }
    if (sums[glints].power > 0)
      errors[glints] =
          std::sqrt(std::max(0.0, sums[glints].squares) / sums[glints].power) / glint_width;
    return errors;
  }

  void tell_errors(const Leaves& leaves, RefineReport& report) const {
    report.error_of_kind = {};
    for (const Look& look : looks_) {
      const auto errors = relative_errors(look, leaves);
      for (std::size_t k = 0; k < kinds; ++k)
        report.error_of_kind[k] = std::max(report.error_of_kind[k], errors[k]);
    }
    report.error = *std::max_element(report.error_of_kind.begin(), report.error_of_kind.end());
  }

  /// Of every kind some leaves of a large mesh, known by their keys.
  Leaves sample(const Leaves& leaves) const {
    std::array<std::size_t, kinds> counts{};
    for (const auto leaf : leaves) ++counts[kind(leaf)];
    Leaves some;
    for (const auto leaf : leaves) {
      const std::size_t one_of =
          std::clamp<std::size_t>(counts[kind(leaf)] / few_of_kind, 1, leaves_per_sample);
      if (forest_.key(leaf) % one_of == 0) some.push_back(leaf);
    }
    return some;
  }

  bool is_clearly_fine(const Leaves& leaves) {
    if (leaves.size() <= few_leaves) return false;
    const Leaves some = sample(leaves);
    look_at(some);
    look_at(some);  // once more, now that surfaces are known to be lit
    RefineReport of_sample;
    tell_errors(some, of_sample);
    return of_sample.error <= clearly_below * rules_.light_tolerance;
  }

  /// Splits leaves that a look could not see through: longer than the distance to the nearest wall.
  void grade() {
    if (!nearness_.has_walls()) return;
    const double per_distance = rules_.light_tolerance / graded_tolerance;
    Leaves leaves = large_enough(all_leaves());
    while (!leaves.empty()) {
      std::vector<std::uint8_t> is_too_long(leaves.size());
      parallel_for(
          leaves.size(),
          [&](std::size_t l) {
            // The longest edge of a right triangle of two equal sides; thin ones hold little.
            const double length_m = 2 * std::sqrt(forest_.area(leaves[l]));
            is_too_long[l] = length_m > near_m * per_distance &&
                             length_m > nearness_.distance_m(forest_, leaves[l]) * per_distance;
          },
          elements_per_task);
      Leaves marked;
      for (std::size_t l = 0; l < leaves.size(); ++l)
        if (is_too_long[l]) marked.push_back(leaves[l]);
      leaves = large_enough(split(marked));
    }
  }

  void refine_by_load(RefineReport& report) {
    // Where nothing may be split it does not matter what the pilot would say.
    if (large_enough(all_leaves()).empty()) return;
    grade();
    Leaves leaves = all_leaves();
    place(leaves);
    if (is_clearly_fine(leaves)) return;
    look_at(leaves);
    look_at(leaves);
    tell_errors(leaves, report);
    report.error_before = report.error;
    while (report.error > rules_.light_tolerance) {
      const Leaves marked = those_with_most_error(leaves);
      report.is_exhausted = marked.empty();
      if (report.is_exhausted) return;
      const Leaves fresh = split(marked);
      place(fresh);
      look_at(fresh);
      leaves = all_leaves();
      tell_errors(leaves, report);
      watch_.advance(Stage::refine, std::min(1.0, rules_.light_tolerance / report.error));
    }
  }

  /// Of every pilot and kind above the tolerance.
  Leaves those_with_most_error(const Leaves& leaves) const {
    Leaves marked;
    for (const Look& look : looks_) {
      const auto errors = relative_errors(look, leaves);
      for (std::size_t k = 0; k < kinds; ++k)
        if (errors[k] > rules_.light_tolerance) mark(look, k, leaves, marked);
    }
    std::sort(marked.begin(), marked.end());
    marked.erase(std::unique(marked.begin(), marked.end()), marked.end());
    return marked;
  }

  /// The fewest leaves that together make up the marked share of what splitting can lower; none
  /// where that is too little of the whole to be worth it.
  void mark(const Look& look, std::size_t of_kind, const Leaves& leaves, Leaves& marked) const {
    struct Candidate {
      std::size_t leaf;
      double squares;
    };
    std::vector<Candidate> candidates;
    double total = 0, of_all = 0;
    const double visible = visible_load(look, leaves);
    for (const auto leaf : leaves) {
      if (of_kind != glints && kind(leaf) != of_kind) continue;
      const double squares = squares_of(look.estimates[leaf], of_kind, visible);
      of_all += squares;
      if (squares <= 0 || !is_large_enough(leaf)) continue;
      candidates.push_back({leaf, squares});
      total += squares;
    }
    if (total <= worth_splitting * of_all) return;
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      return a.squares != b.squares ? a.squares > b.squares : a.leaf < b.leaf;
    });
    double sum = 0;
    for (const auto& candidate : candidates) {
      if (sum >= marked_share * total) break;
      sum += candidate.squares;
      marked.push_back(candidate.leaf);
    }
  }

  bool exceeds_historic_threshold(const HistoricEstimate& e) const {
    return e.by_suns_m2 > rules_.light_threshold_m2 || e.by_emitters > rules_.form_factor_threshold;
  }

  void refine_historically() {
    // What others receive is not asked for: the small ones need no look.
    Leaves leaves = large_enough(all_leaves());
    while (!leaves.empty()) {
      // How many patches each will be divided into.
      std::vector<double> parts(leaves.size());
      parallel_for(
          leaves.size(), [&](std::size_t l) { parts[l] = historic_parts(leaves[l]); },
          elements_per_task);
      Leaves lit;
      double to_come = 0;
      for (std::size_t l = 0; l < leaves.size(); ++l) {
        if (parts[l] <= 1) continue;
        lit.push_back(leaves[l]);
        to_come += parts[l] - 1;
      }
      const auto patches = static_cast<double>(forest_.patch_count());
      watch_.advance(Stage::refine, patches / (patches + to_come));
      leaves = large_enough(split(lit));
    }
  }

  /// Above 1 where the leaf is to be split: its estimates over their thresholds, at most what the
  /// least area leaves.
  double historic_parts(std::size_t leaf) const {
    double parts = 0;
    for (const Look& look : looks_) {
      const HistoricEstimate e = historic_estimate(look.pilot, leaf);
      if (!exceeds_historic_threshold(e)) continue;
      parts = std::max({parts, e.by_suns_m2 / rules_.light_threshold_m2,
                        e.by_emitters / rules_.form_factor_threshold});
    }
    return split_.min_area_m2 > 0 ? std::min(parts, forest_.area(leaf) / split_.min_area_m2)
                                  : parts;
  }

  /// Bisects leaves, unless a neighbour's split has done so; the new leaves.
  Leaves split(const Leaves& leaves) {
    const std::size_t before = forest_.elements().size();
    for (const auto leaf : leaves) {
      if (!forest_.elements()[leaf].is_leaf()) continue;
      forest_.split(leaf, rules_.t_vertices);
      if (forest_.patch_count() > split_.max_patches)
        throw InputError({}, "more than " + std::to_string(split_.max_patches) + " patches",
                         "refinement needs them for its tolerance",
                         "use a larger mesh.min_area_m2 or light tolerance");
    }
    hand_loads_down(before);
    Leaves fresh;
    for (std::size_t e = before; e < forest_.elements().size(); ++e)
      if (forest_.elements()[e].is_leaf()) fresh.push_back(e);
    return fresh;
  }

  /// Children come after their parents: in order of their numbers, each finds its parent's load.
  void hand_loads_down(std::size_t first_new) {
    std::vector<std::size_t> parents;
    for (std::size_t e = 0; e < forest_.elements().size(); ++e)
      if (!forest_.elements()[e].is_leaf() &&
          static_cast<std::size_t>(forest_.elements()[e].first_child) >= first_new)
        parents.push_back(e);
    for (Look& look : looks_)
      for (const auto parent : parents) look.pilot.add_children_of(parent);
  }

  ElementForest& forest_;
  const SplitRules& split_;
  const RefineRules& rules_;
  Watch& watch_;
  Nearness nearness_;
  std::vector<Place> places_;  ///< per element
  std::vector<Look> looks_;
};

}  // namespace

Hierarchy refined_mesh(std::span<const PilotView> views, const SplitRules& split,
                       const RefineRules& rules, Watch& watch, RefineReport* report) {
  SUNLOAD_EXPECT(!views.empty(), "a mesh is refined by one pilot at least");
  const Scene& scene = views.front().scene;
  if (rules.oracle == Oracle::none) return Hierarchy(scene, split);
  expect_splittable(scene, split);
  ElementForest forest(scene);
  forest.split_long_edges(split);
  RefineReport own;
  Refinement(forest, views, split, rules, watch).run(report ? *report : own);
  return Hierarchy(forest);
}

Hierarchy refined_mesh(const Scene& scene, const RayCaster& caster, const SplitRules& split,
                       const RefineRules& rules, const PeriodLight& light, Watch& watch,
                       RefineReport* report) {
  const PilotView view{scene, caster, light};
  return refined_mesh(std::span(&view, 1), split, rules, watch, report);
}

}  // namespace sunload
