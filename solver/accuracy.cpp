#include "solver/accuracy.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/rng.h"

namespace sunload {

namespace {

// Fewer realizations say little of a variance; more than most take memory.
constexpr int fewest_realizations = 8, most_realizations = 256;
// None of so many lines meets what sends a patch 1 % of the largest load: 0.6 % of patches.
constexpr int fewest_lines = 512;

// Costs of one core [s], docs/scaling.md; here only their ratios matter.
constexpr double s_per_line = 2.3e-7, s_per_link_sun = 2.0e-10, s_per_direct_ray = 3.5e-8;
constexpr double facing_share = 0.62;  // of a sun's rays that need be cast

double cost(double lines, double samples, int bounces, double suns) {
  return lines * (s_per_line + bounces * suns * s_per_link_sun) +
         samples * facing_share * suns * s_per_direct_ray;
}

/// The smallest goal that is met on `share_to_be_met` of the area that counts, to 1 %.
double reachable(const PatchSpread& spread, int lines, int samples) {
  constexpr double step = 1.01, finest = 1e-6, coarsest = 1e6;
  double low = finest, high = coarsest;
  while (high > step * low) {
    const double middle = std::sqrt(low * high);
    (share_met(spread, middle, lines, samples) >= share_to_be_met ? high : low) = middle;
  }
  return high;
}

/// least, 2·least, … and at last the most that all realizations can share.
std::vector<int> doubled(int least, int most, int realizations) {
  most = std::max(least, most / realizations * realizations);
  std::vector<int> counts;
  for (int count = least; count < most; count = count > most / 2 ? most : 2 * count)
    counts.push_back(count);
  counts.push_back(most);
  return counts;
}

/// A pilot is part of the preparation.
class PilotWatch : public Watch {
 public:
  explicit PilotWatch(Watch& watch) : watch_(watch) {}
  void advance(Stage stage, double share) override {
    watch_.advance(Stage::prepare, stage == Stage::lines ? share / 2 : (1 + share) / 2);
  }

 private:
  Watch& watch_;
};

SolverRules pilot_rules(SolverRules rules) {
  const int lines = rules.lines_per_patch / rules.realizations;
  const int samples = rules.direct_samples / rules.realizations;
  // The realizations are like the study's own (the errors of few scrambled points are not those
  // of many), only more.
  const int wanted = std::min(most_realizations, (fewest_lines + lines - 1) / lines);
  rules.realizations = std::max({rules.realizations, fewest_realizations, wanted});
  rules.lines_per_patch = lines * rules.realizations;
  rules.direct_samples = samples * rules.realizations;
  rules.seed = mixed(rules.seed, static_cast<std::uint64_t>(Purpose::pilot));
  rules.errors = Errors::totals;
  return rules;
}

/// Variance of the values [r][patch].
template <class Value>
double variance(std::size_t realizations, Value&& value) {
  const auto n = static_cast<double>(realizations);
  double mean = 0, squares = 0;
  for (std::size_t r = 0; r < realizations; ++r) mean += value(r) / n;
  for (std::size_t r = 0; r < realizations; ++r)
    squares += (value(r) - mean) * (value(r) - mean);
  return squares / (n - 1);
}

}  // namespace

double share_met(const PatchSpread& spread, double light_load_relative, int lines, int samples) {
  if (spread.load.empty()) return 1;
  const double largest = *std::max_element(spread.load.begin(), spread.load.end());
  double counts = 0, met = 0;
  for (std::size_t i = 0; i < spread.load.size(); ++i) {
    const double load = spread.load[i];
    if (load <= 0 || load < share_that_counts * largest) continue;
    counts += spread.area[i];
    const double goal = light_load_relative * load;
    if (spread.of_line[i] / lines + spread.of_sample[i] / samples <= goal * goal)
      met += spread.area[i];
  }
  return counts > 0 ? met / counts : 1;
}

SampleCounts needed_counts(const PatchSpread& spread, const SolverRules& least,
                           const AccuracyGoal& goal, std::size_t suns) {
  const auto lines = doubled(least.lines_per_patch, goal.most_per_patch, least.realizations);
  const auto samples = doubled(least.direct_samples, goal.most_per_patch, least.realizations);
  // The errors that the result states are known to one part in √(2(R − 1)); they shall keep the
  // goal too.
  const double noise = 1 / std::sqrt(2.0 * (least.realizations - 1));
  const double stated = goal.light_load_relative / (1 + noise);
  // Where it is out of reach, errors are to be nearly as small as the most can make them.
  constexpr double nearly = 1.1;
  const bool is_met = share_met(spread, stated, lines.back(), samples.back()) >= share_to_be_met;
  const double relative =
      is_met ? stated : nearly * reachable(spread, lines.back(), samples.back());
  SampleCounts chosen{lines.back(), samples.back(), 0};
  double least_cost = cost(lines.back(), samples.back(), least.bounces, static_cast<double>(suns));
  for (const int L : lines)
    for (const int D : samples) {
      const double costs = cost(L, D, least.bounces, static_cast<double>(suns));
      if (costs >= least_cost) continue;
      if (share_met(spread, relative, L, D) < share_to_be_met) continue;
      chosen = {L, D, 0};
      least_cost = costs;
    }
  chosen.share = share_met(spread, stated, chosen.lines_per_patch, chosen.direct_samples);
  return chosen;
}

PatchSpread pilot_spread(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                         const SolverRules& rules, std::span<const SunLight> suns, double weight,
                         Watch& watch) {
  const SolverRules of_pilot = pilot_rules(rules);
  const auto R = static_cast<std::size_t>(of_pilot.realizations);
  PilotWatch pilot_watch(watch);
  std::optional<Scene> without_sensors;
  if (!scene.sensors.empty()) {
    without_sensors = scene;
    without_sensors->sensors.clear();
  }
  LightSolver solver(without_sensors ? *without_sensors : scene, std::move(mesh), of_pilot,
                     pilot_watch);
  const BatchTally tally = solver.solve(suns, pilot_watch);

  PatchSpread spread;
  spread.area = solver.hierarchy().area();
  const auto lines = static_cast<double>(of_pilot.lines_per_patch / of_pilot.realizations);
  const auto samples = static_cast<double>(of_pilot.direct_samples / of_pilot.realizations);
  for (std::size_t i = 0; i < spread.area.size(); ++i) {
    const auto total = [&](std::size_t r) { return tally.exposure_realization[r][i]; };
    const auto sun = [&](std::size_t r) { return tally.sun_realization[r][i]; };
    double mean = 0;
    for (std::size_t r = 0; r < R; ++r) mean += total(r) / static_cast<double>(R);
    spread.load.push_back(weight * mean);
    // Lines are shared by all suns, so that their errors add up; samples are each sun's own,
    // so that their variances do.
    const double by_lines = variance(R, [&](std::size_t r) { return total(r) - sun(r); });
    spread.of_line.push_back(weight * weight * by_lines * lines);
    spread.of_sample.push_back(weight * variance(R, sun) * samples);
  }
  return spread;
}

}  // namespace sunload
