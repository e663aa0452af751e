// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/accuracy_pilot.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geo/base/keys.h"
#include "solver/base/rng.h"
#include "solver/base/spread.h"

namespace sunload {

namespace {

// Fewer realizations say little of a variance; more than most take memory, the more if each keeps
// the light of every instant.
constexpr int fewest_realizations = 8, most_realizations = 256, most_realizations_of_instants = 16;
// None of so many lines meets what sends a patch 1 % of the largest load: 0.6 % of patches.
constexpr int fewest_lines = 512;
/// Makes the pilot's random numbers others than the study's.
constexpr std::uint64_t mixed_into_the_seed = 4;

/// A pilot is part of the preparation.
class PreparationWatch : public Watch {
 public:
  explicit PreparationWatch(Watch& watch) : watch_(watch) {}
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

}  // namespace

AccuracyPilotSuns accuracy_pilot_suns(std::size_t lit) {
  AccuracyPilotSuns suns;
  const std::size_t count = std::min(most_accuracy_pilot_suns, lit);
  for (std::size_t p = 0; p < count; ++p) suns.places.push_back((2 * p + 1) * lit / (2 * count));
  if (count > 0) suns.weight = static_cast<double>(lit) / static_cast<double>(count);
  return suns;
}

SolverRules rules_of_accuracy_pilot(SolverRules rules, bool of_instants) {
  int lines = rules.lines_per_patch / rules.realizations;
  const int samples = rules.direct_samples / rules.realizations;
  const double of_study = static_cast<double>(rules.realizations) * lines;
  const int most = of_instants ? most_realizations_of_instants : most_realizations;
  const int wanted = std::min(most, (fewest_lines + lines - 1) / lines);
  rules.realizations = std::max({rules.realizations, fewest_realizations, wanted});
  lines = std::max(lines, (fewest_lines + rules.realizations - 1) / rules.realizations);
  // The power of a sample is that of all realizations together; shots go with lines.
  if (rules.power_per_sample_w)
    *rules.power_per_sample_w *= of_study / (static_cast<double>(rules.realizations) * lines);
  rules.lines_per_patch = lines * rules.realizations;
  rules.direct_samples = samples * rules.realizations;
  rules.seed = mixed(rules.seed, mixed_into_the_seed);
  rules.errors = of_instants ? Errors::instants : Errors::totals;
  rules.bands = Bands::broadband;  // goals are for the mean of the bands
  rules.by_source = true;
  return rules;
}

namespace {

/// Counts of one realization, which variances are told of.
struct OfRealization {
  int lines, samples;
  explicit OfRealization(const SolverRules& rules)
      : lines(rules.lines_per_patch / rules.realizations),
        samples(rules.direct_samples / rules.realizations) {}
};

/// Lines are shared by all suns, so that their errors add up; samples are each sun's own, so that
/// their variances do.
Spread gathered_load(const TracedScene& traced, const BatchTally& tally, double weight) {
  const OfRealization count(traced.rules);
  const auto R = tally.exposure_realization.size();
  Spread spread;
  for (std::size_t i = 0; i < traced.hierarchy().patch_count(); ++i) {
    const auto total = [&](std::size_t r) { return tally.exposure_realization[r][i]; };
    const auto sun = [&](std::size_t r) { return tally.by_source.sun[r][i]; };
    spread.value.push_back(weight * mean_of(R, total));
    const auto parallel = [&](std::size_t r) {
      const auto& exposure = tally.by_source.parallel[r];
      return exposure.empty() ? 0 : exposure[i];
    };
    const double by_lines =
        variance_of(R, [&](std::size_t r) { return total(r) - sun(r) - parallel(r); });
    spread.of_line.push_back(weight * weight * by_lines * count.lines);
    const double by_samples =
        weight * variance_of(R, sun) + weight * weight * variance_of(R, parallel);
    spread.of_sample.push_back(by_samples * count.samples);
  }
  return spread;
}

void add(std::vector<std::vector<double>>& to, const std::vector<std::vector<double>>& from) {
  for (std::size_t r = 0; r < to.size(); ++r)
    for (std::size_t i = 0; i < to[r].size(); ++i) to[r][i] += from[r][i];
}

template <class Values>
void append(Values& to, const Values& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Exposures of all suns, and what is told of every one; so many at a time share their samples.
Solved solved_in_blocks(const LightTransport& transport, std::span<const IntervalLight> suns,
                        std::size_t block, PreparationWatch& watch) {
  Solved all_blocks = solve(transport, {}, watch);
  BatchTally& sum = all_blocks.bands.front();
  constexpr auto total = static_cast<std::size_t>(Part::total);
  for (std::size_t begin = 0; begin < suns.size(); begin += block) {
    const auto part = suns.subspan(begin, std::min(block, suns.size() - begin));
    const auto all = static_cast<double>(suns.size());
    watch.begin_part(static_cast<double>(begin) / all, static_cast<double>(part.size()) / all);
    const Solved solved = solve(transport, part, watch);
    const BatchTally& of_part = solved.bands.front();
    all_blocks.work += solved.work;
    add(sum.exposure_realization, of_part.exposure_realization);
    add(sum.by_source.sun, of_part.by_source.sun);
    add(sum.by_source.parallel, of_part.by_source.parallel);
    add(sum.by_source.emitted, of_part.by_source.emitted);
    add(sum.by_source.reflected, of_part.by_source.reflected);
    append(sum.irradiance[total], of_part.irradiance[total]);
    append(sum.se_by_source.samples, of_part.se_by_source.samples);
    append(sum.se_by_source.shots, of_part.se_by_source.shots);
    append(sum.se_by_source.lines, of_part.se_by_source.lines);
  }
  return all_blocks;
}

/// So many samples of a pilot came for every one that its power asked for.
double excess(const WorkDone& work) {
  return work[Work::wanted_samples] > 0 ? work[Work::samples] / work[Work::wanted_samples] : 1;
}

/// What shots were done for: emitters once, patches for every block of suns.
struct Excess {
  double of_emitters, of_patches;
};

/// Every block of suns has samples of its own, which its suns share. Where patches got a sample
/// that they would not have had by their power, more samples than those must be asked for before
/// errors fall.
Spread shot_load(const TracedScene& traced, const BatchTally& tally, double weight,
                 const Excess& excess) {
  const OfRealization count(traced.rules);
  const auto R = tally.exposure_realization.size();
  const ExposureBySource& by = tally.by_source;
  Spread spread;
  for (std::size_t i = 0; i < traced.hierarchy().patch_count(); ++i) {
    const auto of = [i](const std::vector<std::vector<double>>& exposure) {
      return [&exposure, i](std::size_t r) { return exposure[r][i]; };
    };
    const auto total = of(tally.exposure_realization);
    const auto by_lines = [&](std::size_t r) {
      return total(r) - by.sun[r][i] - by.parallel[r][i] - by.emitted[r][i] - by.reflected[r][i];
    };
    spread.value.push_back(weight * mean_of(R, total));
    spread.of_line.push_back(weight * weight * variance_of(R, by_lines) * count.lines);
    const double of_suns = weight * variance_of(R, of(by.sun));
    const double of_parallel = weight * weight * variance_of(R, of(by.parallel));
    spread.of_sample.push_back((of_suns + of_parallel) * count.samples);
    const double of_blocks = weight * variance_of(R, of(by.reflected)) * excess.of_patches;
    const double of_emitters =
        weight * weight * variance_of(R, of(by.emitted)) * excess.of_emitters;
    spread.of_shot.push_back((of_blocks + of_emitters) * count.lines);
  }
  return spread;
}

/// Of every sun; `excess`: of all that is shot, 0 where nothing is.
std::vector<Spread> spread_of_instants(const TracedScene& traced, const BatchTally& tally,
                                       double excess) {
  const OfRealization count(traced.rules);
  const std::size_t patches = traced.hierarchy().patch_count();
  const double R = traced.rules.realizations;
  const auto variances = [&](const std::vector<float>& se, std::size_t begin, double factor) {
    std::vector<double> of_patches(patches);
    for (std::size_t i = 0; i < patches; ++i) {
      const auto error = static_cast<double>(se[begin + i]);
      of_patches[i] = error * error * R * factor;
    }
    return of_patches;
  };
  const auto& irradiance = tally.irradiance[static_cast<std::size_t>(Part::total)];
  std::vector<Spread> spreads;
  for (std::size_t begin = 0; begin < irradiance.size(); begin += patches) {
    const auto first = irradiance.begin() + static_cast<std::ptrdiff_t>(begin);
    Spread spread;
    spread.value.assign(first, first + static_cast<std::ptrdiff_t>(patches));
    spread.of_line = variances(tally.se_by_source.lines, begin, count.lines);
    spread.of_sample = variances(tally.se_by_source.samples, begin, count.samples);
    if (excess > 0)
      spread.of_shot = variances(tally.se_by_source.shots, begin, excess * count.lines);
    spreads.push_back(std::move(spread));
  }
  return spreads;
}

/// Neighbours on one side of an input triangle see much the same: together they know variances
/// better than few realizations of one patch do.
void share_with_neighbours(const Hierarchy& hierarchy, std::vector<double>& of_line) {
  constexpr std::ptrdiff_t reach = 2;  // to either side
  constexpr double weight_of_others = 0.5;
  const auto patches = static_cast<std::ptrdiff_t>(of_line.size());
  const auto are_on_one = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    return j >= 0 && j < patches &&
           hierarchy.patches()[static_cast<std::size_t>(i)].triangle ==
               hierarchy.patches()[static_cast<std::size_t>(j)].triangle;
  };
  const auto side = [&](std::ptrdiff_t i) {
    return hierarchy.patches()[static_cast<std::size_t>(i)].side;
  };
  const std::vector<double> own = of_line;
  for (std::ptrdiff_t i = 0; i < patches; ++i) {
    double sum = 0, weights = 0;
    const std::ptrdiff_t back = side(i) == 0 ? i + 1 : i - 1;  // if there is one
    const std::ptrdiff_t step = are_on_one(i, back) && side(back) != side(i) ? 2 : 1;
    for (auto j = i - reach * step; j <= i + reach * step; j += step) {
      if (!are_on_one(i, j)) continue;
      const double weight = j == i ? 1 : weight_of_others;
      sum += weight * own[static_cast<std::size_t>(j)];
      weights += weight;
    }
    of_line[static_cast<std::size_t>(i)] = sum / weights;
  }
}

PatchSpread gathered_spread(const LightTransport& transport, std::span<const IntervalLight> suns,
                            const AccuracyPilotRules& pilot, PreparationWatch& watch) {
  const TracedScene& traced = transport.traced();
  const Solved solved = solve(transport, suns, watch);
  PatchSpread spread;
  spread.load = gathered_load(traced, solved.bands.front(), pilot.weight);
  if (pilot.of_instants) spread.irradiance = spread_of_instants(traced, solved.bands.front(), 0);
  return spread;
}

PatchSpread shot_spread(const LightTransport& transport, std::span<const IntervalLight> suns,
                        const AccuracyPilotRules& pilot, PreparationWatch& watch) {
  const TracedScene& traced = transport.traced();
  const std::size_t block = std::min(pilot.batch_suns, block_width);
  const Solved solved = solved_in_blocks(transport, suns, block, watch);
  const BatchTally& tally = solved.bands.front();
  const Excess excess_of{excess(transport.work()), excess(solved.work)};
  PatchSpread spread;
  spread.load = shot_load(traced, tally, pilot.weight, excess_of);
  if (pilot.of_instants)
    spread.irradiance =
        spread_of_instants(traced, tally, std::max(excess_of.of_emitters, excess_of.of_patches));
  const double first = static_cast<double>(traced.rules.lines_per_patch) *
                       static_cast<double>(traced.patches.count());
  const double blocks = std::ceil(static_cast<double>(suns.size()) / static_cast<double>(block));
  if (blocks > 0 && first > 0)
    spread.shots_per_block = solved.work[Work::wanted_samples] / first / blocks;
  return spread;
}

}  // namespace

PatchSpread accuracy_pilot_spread(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                                  const SolverRules& rules, std::span<const IntervalLight> suns,
                                  const AccuracyPilotRules& pilot, Watch& watch) {
  PreparationWatch pilot_watch(watch);
  std::optional<Scene> without_sensors;
  if (!scene.sensors.empty()) {
    without_sensors = scene;
    without_sensors->sensors.clear();
  }
  const auto traced = trace_scene(without_sensors ? *without_sensors : scene, std::move(mesh),
                                  rules_of_accuracy_pilot(rules, pilot.of_instants), pilot_watch);
  const auto transport = transport_of(*traced);
  PatchSpread spread = rules.transport == Transport::gather
                           ? gathered_spread(*transport, suns, pilot, pilot_watch)
                           : shot_spread(*transport, suns, pilot, pilot_watch);
  spread.area = traced->hierarchy().area();
  share_with_neighbours(traced->hierarchy(), spread.load.of_line);
  for (Spread& of_sun : spread.irradiance)
    share_with_neighbours(traced->hierarchy(), of_sun.of_line);
  return spread;
}

}  // namespace sunload
