// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/refine.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "solver/base/threads.h"
#include "solver/mesh/load_sums.h"
#include "solver/mesh/nearness.h"

namespace sunload {

namespace {

constexpr std::size_t elements_per_task = 64;
/// A mesh is looked at by a sample of its leaves first, where it has more than this …
constexpr std::size_t few_leaves = 20'000;
/// … one of so many: a thousand leaves of a kind and more, which know the error to some per cent.
/// Kinds that are below the tolerance by as much are left as they are; to look at all of a large
/// mesh costs more than its lines.
constexpr std::size_t leaves_per_sample = 16;
constexpr double clearly_below = 0.95;
/// A kind of which less than this is seen is looked at whole.
constexpr std::size_t few_of_kind = few_leaves / leaves_per_sample;
/// Sectors of azimuth that surfaces which are not looked at may face, besides up and down.
constexpr std::size_t sectors = 8, facings = sectors + 2;
constexpr double cos_of_level = 0.7;
/// To this tolerance leaves are no longer than the distance to the nearest wall to begin with.
constexpr double graded_tolerance = 0.05;

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

/// Up, down, or a sector of azimuth.
std::size_t facing_of(Vec3 normal) {
  if (std::abs(normal.z) > cos_of_level) return sectors + (normal.z > 0 ? 0 : 1);
  const double turns = std::atan2(normal.y, normal.x) / (2 * pi) + 1;
  return static_cast<std::size_t>(std::lround(turns * sectors)) % sectors;
}

/// What the historic oracle goes by: its largest estimates.
struct HistoricEstimate {
  double by_suns_m2 = 0, by_emitters = 0;
};

/// Light on leaves of one kind that face alike.
struct FacingSum {
  double power = 0, area = 0;
};

/// Kinds, and of each whether something holds.
using OfKinds = std::array<bool, mesh_kinds>;

/// Mean light load of both sides of an element [J m-2].
using LoadOfSides = std::array<double, 2>;

/// A pilot and what it says.
struct Look {
  MeshPilot pilot;
  std::vector<LoadEstimate> estimates = {};  ///< per element
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

  LeafPlace place_of(std::size_t leaf) const {
    const auto triangle = static_cast<std::size_t>(forest_.elements()[leaf].triangle);
    const double distance_m = nearness_.distance_m(forest_, leaf);
    return {static_cast<std::size_t>(
                kind_of(forest_.scene().mesh.triangle_surface[triangle], distance_m)),
            weight_at(distance_m) * forest_.area(leaf), is_large_enough(leaf)};
  }

  /// Of leaves that were not placed yet.
  void place(const Leaves& leaves) {
    places_.resize(forest_.elements().size());
    parallel_for(
        leaves.size(), [&](std::size_t l) { places_[leaves[l]] = place_of(leaves[l]); },
        elements_per_task);
  }

  using Sights = std::vector<PilotSight>;  // of each side
  Sights sights_of(const MeshPilot& pilot, std::size_t leaf) const {
    Sights sights;
    for (std::uint8_t side = 0; side < sides_of(leaf); ++side)
      sights.push_back(pilot.sight(leaf, side, split_.min_area_m2));
    return sights;
  }

  LoadEstimate estimate(const MeshPilot& pilot, std::size_t leaf, const Sights& sights,
                        LoadOfSides& loads) const {
    LoadEstimate e;
    const double weighted = places_[leaf].weighted_m2 * places_[leaf].stands_for;
    for (std::size_t side = 0; side < sights.size(); ++side) {
      const ElementLoad load = pilot.load(sights[side]);
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
    for (std::uint8_t side = 0; side < sides_of(leaf); ++side) {
      const ElementLoad load = pilot.sources(pilot.points(leaf, side, split_.min_area_m2));
      e.by_emitters = std::max(e.by_emitters, load.lamp_form_factor);
      if (load.sees_sun)
        e.by_suns_m2 =
            std::max(e.by_suns_m2, historic_light_estimate_m2(load.largest_cosine, area));
    }
    return e;
  }

  /// Estimates of leaves, which then are what others see of them.
  void look_at(const Leaves& leaves) {
    std::vector<std::vector<LoadOfSides>> loads(looks_.size());
    for (std::size_t k = 0; k < looks_.size(); ++k) {
      looks_[k].estimates.resize(forest_.elements().size());
      loads[k].resize(leaves.size());
    }
    parallel_for(
        leaves.size(),
        [&](std::size_t l) {
          Sights sights;
          for (std::size_t k = 0; k < looks_.size(); ++k) {
            Look& look = looks_[k];
            if (k == 0 || !look.pilot.sees_as(looks_[k - 1].pilot))
              sights = sights_of(look.pilot, leaves[l]);
            look.estimates[leaves[l]] = estimate(look.pilot, leaves[l], sights, loads[k][l]);
          }
        },
        elements_per_task);
    for (std::size_t k = 0; k < looks_.size(); ++k)
      for (std::size_t l = 0; l < leaves.size(); ++l)
        for (std::uint8_t side = 0; side < 2; ++side)
          looks_[k].pilot.set_load(leaves[l], side, loads[k][l][side]);
  }

  LoadSums sums_of(const Look& look) const {
    return {places_, look.estimates, rules_.light_tolerance};
  }

  void tell_errors(const Leaves& leaves, RefineReport& report) const {
    report.error_of_kind = {};
    for (const Look& look : looks_) {
      const KindErrors errors = sums_of(look).errors(leaves);
      for (std::size_t k = 0; k < mesh_kinds; ++k)
        report.error_of_kind[k] = std::max(report.error_of_kind[k], errors[k]);
    }
    report.error = *std::max_element(report.error_of_kind.begin(), report.error_of_kind.end());
  }

  /// All that can be split and are not of fine kinds; of the others, which only add to the sums, a
  /// sample of every kind, known by the leaves' keys, that stands for all of them.
  Leaves representatives(const Leaves& leaves, const OfKinds& is_fine) {
    Leaves chosen, others;
    for (const auto leaf : leaves)
      (places_[leaf].can_be_split && !is_fine[kind(leaf)] ? chosen : others).push_back(leaf);
    for (const auto leaf : chosen) places_[leaf].stands_for = 1;
    std::array<std::size_t, mesh_kinds> one_of{};
    for (const auto leaf : others) ++one_of[kind(leaf)];
    for (auto& count : one_of)
      count = std::clamp<std::size_t>(count / few_of_kind, 1, leaves_per_sample);
    for (const auto leaf : others) {
      if (forest_.key(leaf) % one_of[kind(leaf)] != 0) continue;
      places_[leaf].stands_for = static_cast<double>(one_of[kind(leaf)]);
      chosen.push_back(leaf);
    }
    return chosen;
  }

  std::uint8_t sides_of(std::size_t leaf) const { return forest_.is_two_sided(leaf) ? 2 : 1; }

  std::size_t class_of(std::size_t leaf, std::size_t side) const {
    const auto triangle = static_cast<std::size_t>(forest_.elements()[leaf].triangle);
    return kind(leaf) * facings + facing_of(forest_.scene().mesh.normal(triangle, side == 0));
  }

  /// Leaves that were not looked at receive what those of their kind that face as they do receive.
  void spread_loads(const Leaves& seen, const Leaves& leaves) {
    std::vector<bool> is_seen(forest_.elements().size());
    for (const auto leaf : seen) is_seen[leaf] = true;
    for (Look& look : looks_) {
      std::vector<FacingSum> sums(mesh_kinds * facings);
      for (const auto leaf : seen)
        for (std::uint8_t side = 0; side < sides_of(leaf); ++side) {
          FacingSum& sum = sums[class_of(leaf, side)];
          sum.power += look.pilot.load_of(leaf, side) * forest_.area(leaf);
          sum.area += forest_.area(leaf);
        }
      for (const auto leaf : leaves)
        for (std::uint8_t side = 0; side < sides_of(leaf) && !is_seen[leaf]; ++side)
          if (const FacingSum& sum = sums[class_of(leaf, side)]; sum.area > 0)
            look.pilot.set_load(leaf, side, sum.power / sum.area);
    }
  }

  /// Kinds whose error a sample of the leaves says is below the tolerance; all or none where suns
  /// are seen in mirrors: their images are small, on surfaces of any kind.
  OfKinds clearly_fine(const Leaves& leaves) {
    OfKinds is_fine;
    is_fine.fill(true);
    const Leaves some = representatives(leaves, is_fine);
    look_at(some);
    spread_loads(some, leaves);
    look_at(some);  // once more, now that surfaces are known to be lit
    RefineReport of_sample;
    tell_errors(some, of_sample);
    for (std::size_t k = 0; k < mesh_kinds; ++k)
      is_fine[k] = of_sample.error_of_kind[k] <= clearly_below * rules_.light_tolerance;
    const bool are_all = std::all_of(is_fine.begin(), is_fine.end(), [](bool is) { return is; });
    const bool any_glints = std::any_of(looks_.begin(), looks_.end(),
                                        [](const Look& look) { return look.pilot.has_glints(); });
    if (any_glints && !are_all) is_fine.fill(false);
    return is_fine;
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
    OfKinds is_fine{};
    if (leaves.size() > few_leaves) {
      is_fine = clearly_fine(leaves);
      if (std::all_of(is_fine.begin(), is_fine.end(), [](bool is) { return is; })) return;
    } else {
      look_at(leaves);
    }
    leaves = representatives(leaves, is_fine);
    look_at(leaves);
    tell_errors(leaves, report);
    report.error_before = report.error;
    while (report.error > rules_.light_tolerance) {
      if (look_closer(report, is_fine)) {
        leaves = representatives(all_leaves(), is_fine);
        look_at(leaves);
        tell_errors(leaves, report);
        continue;
      }
      const Leaves marked = those_with_most_error(leaves);
      report.is_exhausted = marked.empty();
      if (report.is_exhausted) return;
      const Leaves fresh = split(marked);
      place(fresh);
      const Leaves looked_at = representatives(fresh, is_fine);
      look_at(looked_at);
      std::erase_if(leaves, [&](std::size_t leaf) { return !forest_.elements()[leaf].is_leaf(); });
      leaves.insert(leaves.end(), looked_at.begin(), looked_at.end());
      tell_errors(leaves, report);
      watch_.advance(Stage::refine, std::min(1.0, rules_.light_tolerance / report.error));
    }
  }

  /// Whether kinds that seemed fine by a sample have to be looked at whole after all.
  bool look_closer(const RefineReport& report, OfKinds& is_fine) const {
    const auto exceeds = [&](std::size_t k) {
      return report.error_of_kind[k] > rules_.light_tolerance;
    };
    bool is_needed = exceeds(mesh_kind_glints), were_fine = false;
    for (std::size_t k = 0; k < mesh_kind_glints; ++k) {
      is_needed |= is_fine[k] && exceeds(k);
      were_fine |= is_fine[k];
    }
    if (is_needed) is_fine.fill(false);
    return is_needed && were_fine;
  }

  /// Of every pilot and kind above the tolerance.
  Leaves those_with_most_error(const Leaves& leaves) const {
    Leaves marked;
    for (const Look& look : looks_) {
      const KindErrors errors = sums_of(look).errors(leaves);
      for (std::size_t k = 0; k < mesh_kinds; ++k)
        if (errors[k] > rules_.light_tolerance) sums_of(look).mark(k, leaves, marked);
    }
    std::sort(marked.begin(), marked.end());
    marked.erase(std::unique(marked.begin(), marked.end()), marked.end());
    return marked;
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
  std::vector<LeafPlace> places_;  ///< per element
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
