// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/refine.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geo/base/check.h"
#include "solver/base/threads.h"

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

/// What the pilot says of one leaf, both sides together.
struct Estimate {
  double squared_error = 0;  ///< ∫ (H - mean H)² dA [J2 m-2]
  double power = 0;          ///< ∫ H dA [J]
  double area_m2 = 0;        ///< of the sides that have patches
  double historic_m2 = 0;    ///< largest estimate of the historic oracle, by suns
  double form_factor = 0;    ///< the same by emitters
};

class Refinement {
 public:
  Refinement(ElementForest& forest, const RayCaster& caster, const SplitRules& split,
             const RefineRules& rules, const PeriodLight& light, Watch& watch)
      : forest_(forest),
        split_(split),
        rules_(rules),
        watch_(watch),
        pilot_(forest, caster, light, rules.seed) {}

  void run(RefineReport& report) {
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

  Estimate estimate(std::size_t leaf, double (&loads)[2]) const {
    Estimate e;
    const double area = forest_.area(leaf);
    for (std::uint8_t side = 0; side < (forest_.is_two_sided(leaf) ? 2 : 1); ++side) {
      const ElementLoad load = pilot_.load(leaf, side, split_.min_area_m2);
      loads[side] = load.mean;
      e.squared_error += squared_error(load.variance, area);
      e.power += load.mean * area;
      e.area_m2 += area;
      e.form_factor = std::max(e.form_factor, load.lamp_form_factor);
      if (load.sees_sun)
        e.historic_m2 =
            std::max(e.historic_m2, historic_light_estimate_m2(load.largest_cosine, area));
    }
    return e;
  }

  /// Estimates of leaves, which then are what others see of them.
  void look_at(const Leaves& leaves) {
    estimates_.resize(forest_.elements().size());
    std::vector<std::pair<double, double>> loads(leaves.size());
    parallel_for(
        leaves.size(),
        [&](std::size_t l) {
          double of_sides[2] = {};
          estimates_[leaves[l]] = estimate(leaves[l], of_sides);
          loads[l] = {of_sides[0], of_sides[1]};
        },
        elements_per_task);
    for (std::size_t l = 0; l < leaves.size(); ++l) {
      pilot_.set_load(leaves[l], 0, loads[l].first);
      pilot_.set_load(leaves[l], 1, loads[l].second);
    }
  }

  /// Root mean square of H - mean H over the leaves, as share of the mean of H.
  double relative_error(const Leaves& leaves) const {
    double squares = 0, power = 0, area = 0;
    for (const auto leaf : leaves) {
      squares += estimates_[leaf].squared_error;
      power += estimates_[leaf].power;
      area += estimates_[leaf].area_m2;
    }
    if (power <= 0) return 0;
    return std::sqrt(std::max(0.0, squares) * area) / power;
  }

  bool is_clearly_fine(const Leaves& leaves) {
    if (leaves.size() <= few_leaves) return false;
    Leaves some;
    for (const auto leaf : leaves)
      if (forest_.key(leaf) % leaves_per_sample == 0) some.push_back(leaf);
    look_at(some);
    look_at(some);  // once more, now that surfaces are known to be lit
    return relative_error(some) <= clearly_below * rules_.light_tolerance;
  }

  void refine_by_load(RefineReport& report) {
    Leaves leaves = all_leaves();
    // Where nothing may be split it does not matter what the pilot would say.
    if (large_enough(leaves).empty() || is_clearly_fine(leaves)) return;
    look_at(leaves);
    look_at(leaves);
    report.error_before = report.error = relative_error(leaves);
    while (report.error > rules_.light_tolerance) {
      const Leaves marked = those_with_most_error(leaves);
      report.is_exhausted = marked.empty();
      if (report.is_exhausted) return;
      look_at(split(marked));
      leaves = all_leaves();
      report.error = relative_error(leaves);
      watch_.advance(Stage::refine, std::min(1.0, rules_.light_tolerance / report.error));
    }
  }

  /// The fewest leaves that together make up the marked share of what splitting can lower; none
  /// where that is too little of the whole to be worth it.
  Leaves those_with_most_error(const Leaves& leaves) const {
    Leaves candidates;
    double total = 0, of_all = 0;
    for (const auto leaf : leaves) {
      of_all += estimates_[leaf].squared_error;
      if (estimates_[leaf].squared_error <= 0 || !is_large_enough(leaf)) continue;
      candidates.push_back(leaf);
      total += estimates_[leaf].squared_error;
    }
    if (total <= worth_splitting * of_all) return {};
    std::sort(candidates.begin(), candidates.end(), [&](std::size_t a, std::size_t b) {
      const double x = estimates_[a].squared_error, y = estimates_[b].squared_error;
      return x != y ? x > y : a < b;
    });
    double marked = 0;
    std::size_t count = 0;
    while (count < candidates.size() && marked < marked_share * total)
      marked += estimates_[candidates[count++]].squared_error;
    candidates.resize(count);
    return candidates;
  }

  bool exceeds_historic_threshold(const Estimate& e) const {
    return e.historic_m2 > rules_.light_threshold_m2 ||
           e.form_factor > rules_.form_factor_threshold;
  }

  void refine_historically() {
    // What others receive is not asked for: the small ones need no look.
    Leaves leaves = large_enough(all_leaves());
    while (!leaves.empty()) {
      look_at(leaves);
      Leaves lit;
      for (const auto leaf : leaves)
        if (exceeds_historic_threshold(estimates_[leaf])) lit.push_back(leaf);
      leaves = large_enough(split(lit));
    }
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
    for (const auto parent : parents) pilot_.add_children_of(parent);
  }

  ElementForest& forest_;
  const SplitRules& split_;
  const RefineRules& rules_;
  Watch& watch_;
  MeshPilot pilot_;
  std::vector<Estimate> estimates_;  ///< per element
};

}  // namespace

Hierarchy refined_mesh(const Scene& scene, const RayCaster& caster, const SplitRules& split,
                       const RefineRules& rules, const PeriodLight& light, Watch& watch,
                       RefineReport* report) {
  if (rules.oracle == Oracle::none) return Hierarchy(scene, split);
  expect_splittable(scene, split);
  ElementForest forest(scene);
  forest.split_long_edges(split);
  RefineReport own;
  Refinement(forest, caster, split, rules, light, watch).run(report ? *report : own);
  return Hierarchy(forest);
}

}  // namespace sunload
