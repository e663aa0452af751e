// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/traced_season.h"

#include <utility>

namespace sunload {

namespace {

/// Which intervals lie in a season; empty where there is none but it.
std::vector<std::uint8_t> intervals_of(const VariantPlan& plan, std::size_t season) {
  std::vector<std::uint8_t> counts;
  if (plan.seasons.all.empty()) return counts;
  for (std::size_t k = 0; k < plan.intervals(); ++k)
    counts.push_back(plan.seasons.of(k) == season ? 1 : 0);
  return counts;
}

double share_of(const VariantPlan& plan, const std::vector<std::uint8_t>& counts) {
  if (counts.empty()) return 1;
  double all = 0, counted = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double length_s = plan.light.intervals[k].when.length_s();
    all += length_s;
    if (counts[k] != 0) counted += length_s;
  }
  return all > 0 ? counted / all : 0;
}

}  // namespace

TracedSeason::TracedSeason(const VariantPlan& plan, std::size_t season,
                           std::shared_ptr<const Hierarchy> mesh, const SolverRules& rules,
                           Watch& watch, std::optional<Lines> lines,
                           std::vector<SolvedNodes> nodes) {
  if (!plan.seasons.all.empty())
    scene_.emplace(scene_in(plan.built.scene, plan.seasons.all[season]));
  traced_ = trace_scene(scene_ ? *scene_ : plan.built.scene, std::move(mesh), rules, watch,
                        std::move(lines));
  auto counts = intervals_of(plan, season);
  share_ = share_of(plan, counts);
  lights_.emplace(plan.study, plan.built.site, traced_->grid);
  period_.emplace(*lights_, plan.light, std::move(counts));
  transport_ = transport_of(*traced_, *period_, watch, std::move(nodes));
}

WorkDone TracedSeason::work() const {
  WorkDone work = traced_->work;
  work += transport_->work();
  return work;
}

Lines TracedSeason::leave_lines() {
  transport_.reset();
  return std::move(traced_->patches.lines);
}

}  // namespace sunload
