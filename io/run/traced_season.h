// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene of a variant in one of its seasons, traced, and what transports light there.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "io/plan/interval_lights.h"
#include "io/plan/variant_plan.h"
#include "solver/solver.h"

namespace sunload {

/// Immovable: its parts refer to each other, and to the plan.
class TracedSeason {
 public:
  /// `season`: place in the plan's seasons, 0 where there are none. `lines`: of an equal scene, or
  /// none; `nodes`: of an equal scene and period, or none. Throws Interrupted.
  TracedSeason(const VariantPlan& plan, std::size_t season, std::shared_ptr<const Hierarchy> mesh,
               const SolverRules& rules, Watch& watch, std::optional<Lines> lines = {},
               std::vector<SolvedNodes> nodes = {});
  TracedSeason(const TracedSeason&) = delete;
  TracedSeason& operator=(const TracedSeason&) = delete;

  const TracedScene& traced() const { return *traced_; }
  const IntervalLights& lights() const { return *lights_; }
  const LightTransport& transport() const { return *transport_; }
  /// Work done before any batch.
  WorkDone work() const;
  /// Share of the period's time that lies in it.
  double share() const { return share_; }
  /// Gives the lines away; nothing can be transported afterwards.
  Lines leave_lines();

 private:
  std::optional<const Scene> scene_;  ///< of its own; none: the plan's
  double share_ = 1;
  std::unique_ptr<TracedScene> traced_;
  std::optional<IntervalLights> lights_;  ///< on the sky grid of the traced scene
  std::optional<SeriesLight> period_;
  std::unique_ptr<const LightTransport> transport_;
};

}  // namespace sunload
