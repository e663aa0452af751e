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
constexpr double s_per_sample = 6e-7;  // shot
constexpr double facing_share = 0.62;  // of a sun's rays that need be cast

struct Cost {
  double per_line, per_direct_sample, per_shot_sample;
  double of(const SampleCounts& counts) const {
    return counts.lines_per_patch * per_line + counts.direct_samples * per_direct_sample +
           counts.samples_per_patch * per_shot_sample;
  }
};

Cost cost_of(const PatchSpread& spread, const SolverRules& rules, double suns) {
  const double samples = facing_share * suns * s_per_direct_ray;
  if (spread.of_shot.empty())
    return {s_per_line + rules.bounces * suns * s_per_link_sun, samples, 0};
  const double blocks = std::ceil(suns / static_cast<double>(block_width));
  return {s_per_line, samples, blocks * spread.shots_per_block * s_per_sample};
}

/// The smallest goal that is met on `share_to_be_met` of the area that counts, to 1 %.
double reachable(const PatchSpread& spread, const SampleCounts& counts) {
  constexpr double step = 1.01, finest = 1e-6, coarsest = 1e6;
  double low = finest, high = coarsest;
  while (high > step * low) {
    const double middle = std::sqrt(low * high);
    (share_met(spread, middle, counts) >= share_to_be_met ? high : low) = middle;
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
    watch_.advance(Stage::prepare,
                   stage == Stage::lines ? share / 2 : (1 + begin_ + share * length_) / 2);
  }
  /// The light that is solved next is this part of all.
  void begin_part(double begin, double length) {
    begin_ = begin;
    length_ = length;
  }

 private:
  Watch& watch_;
  double begin_ = 0, length_ = 1;
};

SolverRules pilot_rules(SolverRules rules) {
  const int lines = rules.lines_per_patch / rules.realizations;
  const int samples = rules.direct_samples / rules.realizations;
  const double of_study = rules.realizations;
  // The realizations are like the study's own (the errors of few scrambled points are not those
  // of many), only more.
  const int wanted = std::min(most_realizations, (fewest_lines + lines - 1) / lines);
  rules.realizations = std::max({rules.realizations, fewest_realizations, wanted});
  // The power of a sample is that of all realizations together.
  if (rules.power_per_sample_w) *rules.power_per_sample_w *= of_study / rules.realizations;
  rules.lines_per_patch = lines * rules.realizations;
  rules.direct_samples = samples * rules.realizations;
  rules.seed = mixed(rules.seed, static_cast<std::uint64_t>(Purpose::pilot));
  rules.errors = Errors::totals;
  rules.by_source = true;
  return rules;
}

/// Mean of the values [r].
template <class Value>
double mean(std::size_t realizations, Value&& value) {
  const auto n = static_cast<double>(realizations);
  double mean = 0;
  for (std::size_t r = 0; r < realizations; ++r) mean += value(r) / n;
  return mean;
}

/// Variance of the values [r].
template <class Value>
double variance(std::size_t realizations, Value&& value) {
  const double middle = mean(realizations, value);
  double squares = 0;
  for (std::size_t r = 0; r < realizations; ++r)
    squares += (value(r) - middle) * (value(r) - middle);
  return squares / (static_cast<double>(realizations) - 1);
}

/// Counts of one realization, which variances are told of.
struct OfRealization {
  double lines, samples;
  explicit OfRealization(const SolverRules& rules)
      : lines(rules.lines_per_patch / rules.realizations),
        samples(rules.direct_samples / rules.realizations) {}
};

/// Lines are shared by all suns, so that their errors add up; samples are each sun's own, so that
/// their variances do.
PatchSpread gathered_spread(const LightSolver& solver, const BatchTally& tally, double weight) {
  const OfRealization count(solver.rules());
  const auto R = tally.exposure_realization.size();
  PatchSpread spread;
  spread.area = solver.hierarchy().area();
  for (std::size_t i = 0; i < spread.area.size(); ++i) {
    const auto total = [&](std::size_t r) { return tally.exposure_realization[r][i]; };
    const auto sun = [&](std::size_t r) { return tally.by_source.sun[r][i]; };
    spread.load.push_back(weight * mean(R, total));
    const double by_lines = variance(R, [&](std::size_t r) { return total(r) - sun(r); });
    spread.of_line.push_back(weight * weight * by_lines * count.lines);
    spread.of_sample.push_back(weight * variance(R, sun) * count.samples);
  }
  return spread;
}

void add(std::vector<std::vector<double>>& to, const std::vector<std::vector<double>>& from) {
  for (std::size_t r = 0; r < to.size(); ++r)
    for (std::size_t i = 0; i < to[r].size(); ++i) to[r][i] += from[r][i];
}

/// Exposures of all suns; so many at a time share their samples.
BatchTally solved_in_blocks(LightSolver& solver, std::span<const SunLight> suns,
                            std::size_t block, PilotWatch& watch) {
  BatchTally sum = solver.solve({}, watch);
  for (std::size_t begin = 0; begin < suns.size(); begin += block) {
    const auto part = suns.subspan(begin, std::min(block, suns.size() - begin));
    const auto all = static_cast<double>(suns.size());
    watch.begin_part(static_cast<double>(begin) / all, static_cast<double>(part.size()) / all);
    const BatchTally of_part = solver.solve(part, watch);
    add(sum.exposure_realization, of_part.exposure_realization);
    add(sum.by_source.sun, of_part.by_source.sun);
    add(sum.by_source.parallel, of_part.by_source.parallel);
    add(sum.by_source.emitted, of_part.by_source.emitted);
    add(sum.by_source.reflected, of_part.by_source.reflected);
  }
  return sum;
}

/// So many samples of a pilot came for every one that its power asked for.
double excess(const WorkDone& work) {
  return work.wanted_samples > 0 ? static_cast<double>(work.samples) / work.wanted_samples : 1;
}

/// Every block of suns has samples of its own, which its suns share. Where patches got a sample
/// that they would not have had by their power, more samples than those must be asked for before
/// errors fall.
PatchSpread shot_spread(const LightSolver& solver, const BatchTally& tally, double weight,
                        const WorkDone& by_emitters, const WorkDone& by_patches) {
  const OfRealization count(solver.rules());
  const auto R = tally.exposure_realization.size();
  const ExposureBySource& by = tally.by_source;
  PatchSpread spread;
  spread.area = solver.hierarchy().area();
  for (std::size_t i = 0; i < spread.area.size(); ++i) {
    const auto of = [i](const std::vector<std::vector<double>>& exposure) {
      return [&exposure, i](std::size_t r) { return exposure[r][i]; };
    };
    const auto total = of(tally.exposure_realization);
    const auto by_lines = [&](std::size_t r) {
      return total(r) - by.sun[r][i] - by.parallel[r][i] - by.emitted[r][i] - by.reflected[r][i];
    };
    spread.load.push_back(weight * mean(R, total));
    spread.of_line.push_back(weight * weight * variance(R, by_lines) * count.lines);
    const double of_suns = weight * variance(R, of(by.sun));
    const double of_parallel = weight * weight * variance(R, of(by.parallel));
    spread.of_sample.push_back((of_suns + of_parallel) * count.samples);
    const double of_blocks = weight * variance(R, of(by.reflected)) * excess(by_patches);
    const double of_emitters =
        weight * weight * variance(R, of(by.emitted)) * excess(by_emitters);
    spread.of_shot.push_back((of_blocks + of_emitters) * count.lines);
  }
  return spread;
}

}  // namespace

double share_met(const PatchSpread& spread, double light_load_relative,
                 const SampleCounts& by) {
  if (spread.load.empty()) return 1;
  const double largest = *std::max_element(spread.load.begin(), spread.load.end());
  double counts = 0, met = 0;
  for (std::size_t i = 0; i < spread.load.size(); ++i) {
    const double load = spread.load[i];
    if (load <= 0 || load < share_that_counts * largest) continue;
    counts += spread.area[i];
    const double goal = light_load_relative * load;
    double variance =
        spread.of_line[i] / by.lines_per_patch + spread.of_sample[i] / by.direct_samples;
    if (!spread.of_shot.empty()) variance += spread.of_shot[i] / by.samples_per_patch;
    if (variance <= goal * goal) met += spread.area[i];
  }
  return counts > 0 ? met / counts : 1;
}

SampleCounts needed_counts(const PatchSpread& spread, const SolverRules& least,
                           const AccuracyGoal& goal, std::size_t suns) {
  const auto lines = doubled(least.lines_per_patch, goal.most_per_patch, least.realizations);
  const auto samples = doubled(least.direct_samples, goal.most_per_patch, least.realizations);
  const auto shots = spread.of_shot.empty() ? std::vector{least.lines_per_patch} : lines;
  // The errors that the result states are known to one part in √(2(R − 1)); they shall keep the
  // goal too.
  const double noise = 1 / std::sqrt(2.0 * (least.realizations - 1));
  const double stated = goal.light_load_relative / (1 + noise);
  // Where it is out of reach, errors are to be nearly as small as the most can make them.
  constexpr double nearly = 1.1;
  const SampleCounts most{lines.back(), samples.back(), shots.back()};
  const bool is_met = share_met(spread, stated, most) >= share_to_be_met;
  const double relative = is_met ? stated : nearly * reachable(spread, most);
  const Cost cost = cost_of(spread, least, static_cast<double>(suns));
  SampleCounts chosen = most;
  const auto too_few = [&](const SampleCounts& counts) {
    return share_met(spread, relative, counts) < share_to_be_met;
  };
  for (const int L : lines)
    for (const int D : samples) {
      if (cost.of({L, D, shots.front()}) >= cost.of(chosen)) continue;
      const auto S = std::partition_point(shots.begin(), shots.end(),
                                          [&](int count) { return too_few({L, D, count}); });
      if (S != shots.end() && cost.of({L, D, *S}) < cost.of(chosen)) chosen = {L, D, *S};
    }
  chosen.share = share_met(spread, stated, chosen);
  return chosen;
}

SolverRules with_counts(const SolverRules& least, const SampleCounts& counts) {
  SolverRules rules = least;
  rules.lines_per_patch = counts.lines_per_patch;
  rules.direct_samples = counts.direct_samples;
  if (least.transport != Transport::shoot) return rules;
  rules.samples_per_patch = counts.samples_per_patch;
  if (rules.power_per_sample_w)
    *rules.power_per_sample_w *=
        static_cast<double>(least.lines_per_patch) / counts.samples_per_patch;
  return rules;
}

PatchSpread pilot_spread(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                         const SolverRules& rules, std::span<const SunLight> suns, double weight,
                         Watch& watch, std::size_t batch_suns) {
  const SolverRules of_pilot = pilot_rules(rules);
  PilotWatch pilot_watch(watch);
  std::optional<Scene> without_sensors;
  if (!scene.sensors.empty()) {
    without_sensors = scene;
    without_sensors->sensors.clear();
  }
  LightSolver solver(without_sensors ? *without_sensors : scene, std::move(mesh), of_pilot,
                     pilot_watch);
  if (rules.transport == Transport::gather)
    return gathered_spread(solver, solver.solve(suns, pilot_watch), weight);
  const WorkDone by_emitters = solver.work();
  const std::size_t block = std::min(batch_suns, block_width);
  const BatchTally tally = solved_in_blocks(solver, suns, block, pilot_watch);
  WorkDone by_patches = solver.work();
  by_patches -= by_emitters;
  PatchSpread spread = shot_spread(solver, tally, weight, by_emitters, by_patches);
  const double first =
      static_cast<double>(of_pilot.lines_per_patch) * static_cast<double>(spread.area.size());
  const double blocks = std::ceil(static_cast<double>(suns.size()) / static_cast<double>(block));
  if (blocks > 0 && first > 0)
    spread.shots_per_block = by_patches.wanted_samples / first / blocks;
  return spread;
}

}  // namespace sunload
