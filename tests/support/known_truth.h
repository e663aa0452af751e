// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Cases of which the truth is known: how they are built and solved, and what is demanded of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/support/scenes.h"

namespace sunload::test {

/// A scene of emitters of exitance 1, so that irradiances are form factors, and of black receivers.
struct LampStage {
  SceneBuilder builder;
  int black = builder.material({"black", 0, 0, 0});
  int lamp = builder.material({"lamp", 0, 0, 1});
};

/// For light without sun: one direct sample per realization, no chain of mirrors cut.
SolverRules diffuse_rules(int lines_per_realization, int bounces = 0, int realizations = 16);

/// How far lines start above their surface (solver/surface/ray_caster.h: 16 roundings to float)
/// [m], where no coordinate is larger than this.
double lift(double coordinate);

/// Irradiance at night, per realization, at a point with a unit normal: the mean of so many
/// sensors there. As patches have as many lines as sensors, it is cheaper by many sensors with few
/// lines each.
std::vector<double> at_point(Scene scene, Vec3 position, Vec3 normal, std::size_t sensors,
                             const SolverRules& rules, const SplitRules& split = {});

struct Demand {
  /// A wrong truth that must be refused; none: not to be seen.
  std::optional<double> fault;
  std::optional<double> standard_error;  ///< at most, as a share of the truth
};
/// Expects that the mean of realizations is the truth (expect_mean), at least as precise as
/// demanded.
void expect_truth(const std::string& id, const std::vector<double>& realizations, double truth,
                  double bias_bound, const Demand& demand);

/// The same as a file of tests demands it of all its cases: `constexpr TruthCheck check{1.02,
/// 0.005};`
struct TruthCheck {
  double fault_factor;  ///< a truth that is off by it is refused
  std::optional<double> standard_error = {};

  /// `own_factor`: that of a case of its own kind.
  void operator()(const std::string& id, const std::vector<double>& realizations, double truth,
                  double bias_bound, std::optional<double> own_factor = {}) const;
};

}  // namespace sunload::test
