// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/expected_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/plan/surface_shares.h"
#include "io/plan/work_estimate.h"
#include "solver/surface/material.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

namespace {

/// Worth a word: errors above this share.
constexpr double tolerable_of_lines = 0.1, tolerable_of_samples = 0.25, tolerable_of_shots = 0.25;
/// Of patches sorted by area, so many may be noisier.
constexpr double smallest_share = 0.1;

/// The next power of two: what the random sequences are best at.
int round_up(double count) {
  int rounded = 1;
  while (rounded < count) rounded *= 2;
  return rounded;
}

/// Counts whose error factor / √n falls below `tolerable`.
int count_for(double factor, double tolerable) {
  return round_up(factor * factor / (tolerable * tolerable));
}

constexpr double tolerable_offset_m = 2e-3;

/// An area that nine tenths of the patches exceed.
double small_area(const Hierarchy& mesh) {
  std::vector<double> area = mesh.area();
  if (area.empty()) return 0;
  const auto at =
      area.begin() + static_cast<std::ptrdiff_t>(smallest_share * static_cast<double>(area.size()));
  std::nth_element(area.begin(), at, area.end());
  return *at;
}

double longest_edge_m(const Hierarchy& mesh, std::size_t patch) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, norm(mesh.corner(patch, (k + 1) % 3) - mesh.corner(patch, k)));
  return longest;
}

/// Patches with edges longer than asked for, which are too small to be split. Slivers of a real
/// model are many and of no account: by area.
std::vector<std::string> coarse_warnings(const MeshStudy& rules, const Hierarchy& mesh) {
  constexpr double rounding = 1 + 1e-9, share_worth_telling = 0.01;
  struct Coarse {
    double area, edge_m;
  };
  std::vector<Coarse> coarse;
  double area = 0, coarse_area = 0;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i) {
    area += mesh.area()[i];
    const double edge_m = longest_edge_m(mesh, i);
    if (edge_m <= rules.max_edge_m * rounding) continue;
    coarse.push_back({mesh.area()[i], edge_m});
    coarse_area += mesh.area()[i];
  }
  if (coarse_area <= share_worth_telling * area) return {};
  std::sort(coarse.begin(), coarse.end(),
            [](const Coarse& a, const Coarse& b) { return a.area > b.area; });
  double longest_m = 0, fine_enough_m2 = coarse.front().area, met = 0;
  for (const Coarse& patch : coarse) {
    longest_m = std::max(longest_m, patch.edge_m);
    if (met > (1 - share_worth_telling) * coarse_area) continue;
    met += patch.area;
    // The longest edge is halved by two bisections of it, which quarter the area.
    const double halvings = std::ceil(std::log2(patch.edge_m / rules.max_edge_m / rounding));
    fine_enough_m2 = std::min(fine_enough_m2, patch.area / std::pow(4, halvings));
  }
  const double step = std::pow(10, std::floor(std::log10(fine_enough_m2)));
  return {fmt::format(
      "mesh.min_area_m2 {:g} keeps {} of {} patches above mesh.max_edge_m {:g}, with edges of up "
      "to "
      "{:.3g} m: patches below twice that area are not split; {:g} lets nearly all of them be",
      rules.min_area_m2, coarse.size(), mesh.patch_count(), rules.max_edge_m, longest_m,
      std::floor(fine_enough_m2 / step) * step)};
}

/// The sun on patches that a shadow's edge crosses is told by rays at some of them.
bool asks_rays_at_edges(const VariantPlan& plan) {
  if (plan.study.sun.disk == SunDisk::finite) return true;
  const Mesh& mesh = plan.built.scene.mesh;
  return mean_over_seasons(plan, [&](const MaterialsOfScene& of_season) {
           return share_of_screens(mesh, of_season) +
                  share_that_sends_on_by_rays(mesh, of_season, plan.study.solver.transport);
         }) > 0;
}

/// Of light that gathering follows no farther (solver/README.md, What is left out): a mirror worth
/// the name, and gloss. Empty where there is none.
std::string cut_gloss_warning(const VariantPlan& plan) {
  constexpr double least_mirror = 0.2;  // panes send on a tenth
  if (plan.study.solver.transport == Transport::shoot) return {};
  std::string mirror, gloss;
  for (const Material& material : materials_of(plan)) {
    if (mirror_reflectance(material, 1) >= least_mirror) mirror = material.name;
    if (material.glossy > 0) gloss = material.name;
  }
  if (mirror.empty() || gloss.empty()) return {};
  return fmt::format(
      "sun that mirrors ({}) send to glossy surfaces ({}) goes no farther by gloss where light is "
      "gathered: single patches that face both may lack half of what reaches them by mirrors "
      "(sums a few percent of it); solver.transport: shoot follows it",
      mirror, gloss);
}

}  // namespace

std::vector<std::string> expected_error_warnings(const VariantPlan& plan, const Hierarchy& mesh) {
  const SolverStudy& s = plan.study.solver;
  std::vector<std::string> warnings = coarse_warnings(plan.study.mesh, mesh);
  if (const double offset_m = ray_offset_m(plan.built.scene.mesh); offset_m > tolerable_offset_m)
    warnings.push_back(fmt::format(
        "the scene is so wide that rays start {:.1f} mm off its surfaces (single precision of the "
        "ray caster): shadows of what is smaller, and light within as much of edges and feet of "
        "walls, are wrong; cut what is far away, or make it a line of far hills (site.horizon)",
        offset_m * 1000));
  if (std::string cut = cut_gloss_warning(plan); !cut.empty()) warnings.push_back(std::move(cut));
  if (s.accuracy) return warnings;  // its pilot decides the counts
  constexpr double of_lines = 0.6, of_samples = 0.5;
  if (const double error = of_lines / std::sqrt(s.lines_per_patch); error > tolerable_of_lines)
    warnings.push_back(fmt::format(
        "solver.lines_per_patch {} lets expect a standard error of some {:.0f} % in the light of "
        "sky and surroundings on a patch (facades and totals are better); {} would give less "
        "than {:.0f} %",
        s.lines_per_patch, 100 * error, count_for(of_lines, tolerable_of_lines),
        100 * tolerable_of_lines));
  if (const double error = of_samples / std::sqrt(s.direct_samples);
      error > tolerable_of_samples && asks_rays_at_edges(plan))
    warnings.push_back(fmt::format(
        "solver.direct_samples {} lets expect a standard error of up to {:.0f} % of the sun on "
        "patches that a shadow's edge crosses and rays look from (mirrors, panes and gloss "
        "where there is much of them; behind screens; where the sun has a disk); {} would give at "
        "most {:.0f} %",
        s.direct_samples, 100 * error, count_for(of_samples, tolerable_of_samples),
        100 * tolerable_of_samples));
  if (s.transport != Transport::shoot) return warnings;
  double area = 0;
  for (const double a : mesh.area()) area += a;
  const double small = small_area(mesh);
  const auto samples = static_cast<double>(estimate_work(plan, mesh.patch_count()).samples);
  const double blocks = std::max(1.0, std::ceil(static_cast<double>(plan.intervals()) / 16));
  const double each = samples / blocks / std::max(1, s.bounces);
  if (const double error = std::sqrt(area / (std::max(each, 1.0) * small));
      error > tolerable_of_shots)
    warnings.push_back(fmt::format(
        "{:.3g} samples for {} patches let expect a standard error of {:.0f} % or more in the "
        "reflected light on a tenth of the patches (those below {:.2g} m2); use a smaller "
        "solver.power_per_sample_w or lines_per_patch {} or a larger mesh.min_area_m2",
        each, mesh.patch_count(), 100 * error, small,
        round_up(s.lines_per_patch * error * error / (tolerable_of_shots * tolerable_of_shots))));
  return warnings;
}

}  // namespace sunload
