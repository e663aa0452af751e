// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/year_gathering.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/large_memory.h"
#include "solver/base/threads.h"
#include "solver/transport/period_in_band.h"
#include "solver/transport/reduction_test.h"
#include "solver/transport/year_batch.h"

namespace sunload {

namespace {

/// Where nodes begin: rest of the skies, and distance between a sun and its nearest node.
constexpr double first_rest = 0.01, first_distance = 7 * radians_per_degree;
/// The reduction may be so much of the standard error of an interval: then it adds 5 % to it.
constexpr double wanted_share = 1.0 / 3;
constexpr double growth = 1.5;

bool is_lit(const TracedScene& traced, const LitPeriod& period, std::size_t interval) {
  return traced.optics.any_emission || !period.is_dark(interval);
}

double lit_intervals(const TracedScene& traced, const LitPeriod& period) {
  double lit = 0;
  for (std::size_t k = 0; k < period.intervals(); ++k) lit += is_lit(traced, period, k) ? 1 : 0;
  return lit;
}

/// Intervals on which the reduction is measured: with a sun, spread evenly over the period; of all
/// that have light where few have a sun.
std::vector<std::size_t> test_intervals(const TracedScene& traced, const LitPeriod& period) {
  std::vector<std::size_t> from, lit;
  for (std::size_t k = 0; k < period.intervals(); ++k) {
    if (period.has_sun(k)) from.push_back(k);
    if (is_lit(traced, period, k)) lit.push_back(k);
  }
  if (from.size() < year_tests) from.swap(lit);
  const std::size_t count = std::min(year_tests, from.size());
  std::vector<std::size_t> some(count);
  for (std::size_t t = 0; t < count; ++t) some[t] = from[(2 * t + 1) * from.size() / (2 * count)];
  return some;
}

std::vector<IntervalLight> lights_of(const LitPeriod& period,
                                     const std::vector<std::size_t>& intervals) {
  std::vector<IntervalLight> lights(intervals.size());
  parallel_for(intervals.size(), [&](std::size_t t) { lights[t] = period.of(intervals[t]); });
  return lights;
}

/// Tells how far the nodes are. How many there will be nobody knows beforehand: each turn takes a
/// share of what is left.
class NodesAhead {
 public:
  explicit NodesAhead(Watch& watch) : watch_(watch) {}
  void begin_turn(double of_left) {
    told_ += turn_;
    turn_ = of_left * (1 - told_);
    advance(0);
  }
  /// Share of the turn that is done.
  void advance(double share) { watch_.advance(Stage::nodes, told_ + turn_ * share); }
  void end() { watch_.advance(Stage::nodes, 1); }

 private:
  Watch& watch_;
  double told_ = 0, turn_ = 0;
};

std::vector<ReductionTest> reduction_tests(const TracedScene& traced, std::size_t band,
                                           const LitPeriod& period,
                                           const std::vector<std::size_t>& intervals,
                                           WorkDone& work, NodesAhead& ahead) {
  // Each realization solves them, too: they take about as long as half of the first nodes.
  constexpr double of_all = 0.25;
  ahead.begin_turn(of_all);
  std::vector<ReductionTest> made;
  made.reserve(year_tests / block_width);
  for (std::size_t first = 0; first < intervals.size(); first += block_width) {
    const auto begin = intervals.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::min(block_width, intervals.size() - first);
    made.emplace_back(traced, band,
                      lights_of(period, {begin, begin + static_cast<std::ptrdiff_t>(count)}), work);
    ahead.advance(static_cast<double>(first + count) / static_cast<double>(intervals.size()));
  }
  return made;
}

Squares mean_squares(const std::vector<ReductionTest>& made, const NodeLight& nodes,
                     std::size_t intervals) {
  Squares sum;
  for (const ReductionTest& test : made) sum += test.squares_of(nodes);
  for (double* square : {&sum.sky, &sum.reflected, &sum.error, &sum.standard_error, &sum.error2})
    *square /= static_cast<double>(intervals);
  return sum;
}

/// Of a mean over so many intervals: surely below a third of the standard error, that of the mean
/// itself taken in. A few hours may have most of the error (low suns on snow), and the nodes that
/// the tests like best are those that come near to the tests.
bool is_met(const Squares& mean, std::size_t intervals) {
  if (mean.standard_error <= 0) return true;  // nothing is by chance there
  const auto n = static_cast<double>(intervals);
  const double variance = std::max(0.0, mean.error2 - mean.error * mean.error);
  const double error_of_mean = n > 1 ? std::sqrt(variance / (n - 1)) : 0;
  return mean.error + error_of_mean <= wanted_share * wanted_share * mean.standard_error;
}

/// Nodes to begin with.
struct FirstNodes {
  std::size_t skies, suns;
  explicit FirstNodes(const NodeLight& nodes)
      : skies(in_whole_blocks(nodes.skies().count_for(first_rest))),
        suns(in_whole_blocks(nodes.suns().count_for(first_distance))) {}
  double all() const { return static_cast<double>(skies + suns); }
};

/// Takes nodes until they are near enough to the tests, or too many to pay, or all there are.
Reduction take_nodes(NodeLight& nodes, const std::vector<ReductionTest>& made,
                     std::size_t intervals, double most, WorkDone& work, NodesAhead& ahead) {
  constexpr double of_left = 0.75;
  auto [skies, suns] = FirstNodes(nodes);
  for (;;) {
    ahead.begin_turn(of_left);
    nodes.take(skies, suns, work, [&](double share) { ahead.advance(share); });
    const Squares squares = mean_squares(made, nodes, intervals);
    const Reduction reduction{nodes.skies().count(), nodes.suns().count(), std::sqrt(squares.error),
                              std::sqrt(squares.standard_error), is_met(squares, intervals)};
    if (reduction.is_met || static_cast<double>(reduction.skies + reduction.suns) >= most)
      return reduction;
    const bool no_more_suns = nodes.suns().count() == nodes.suns().ranked().size();
    const bool no_more_skies = nodes.skies().count() == nodes.skies().ranked().size();
    if (no_more_suns && no_more_skies) return reduction;
    std::size_t& more = no_more_suns || (squares.sky > squares.reflected && !no_more_skies)
                            ? (skies = nodes.skies().count())
                            : (suns = nodes.suns().count());
    more = static_cast<std::size_t>(growth * static_cast<double>(more)) + 1;
  }
}

}  // namespace

YearGathering::YearGathering(const TracedScene& traced, const LitPeriod& period, Watch& watch)
    : LightTransport(traced) {
  SUNLOAD_EXPECT(year_can_serve(traced.rules), "gathered light, errors of totals");
  NodesAhead ahead(watch);
  const double most = most_of_few(traced.rules, lit_intervals(traced, period));
  const std::vector<std::size_t> tested = test_intervals(traced, period);
  for (std::size_t b = 0; b < traced.optics_of_band.size(); ++b) {
    const LitPeriod& light = in_band(period, b);
    NodeLight& nodes =
        *nodes_.emplace_back(std::make_unique<NodeLight>(traced, b, light, tested, work_));
    if (traced.rules.year == Year::automatic && FirstNodes(nodes).all() > most) return;
    // Before nodes are solved: while they are made, tests take more memory than later.
    const auto made = reduction_tests(traced, b, light, tested, work_, ahead);
    nodes.set_reduction(take_nodes(nodes, made, tested.size(), most, work_, ahead));
    if (traced.rules.year == Year::automatic && !nodes.solved().reduction.is_met) return;
  }
  keep_worst_reduction();
  ahead.end();
  return_large_memory();  // of what the nodes were made from
}

YearGathering::YearGathering(const TracedScene& traced, const LitPeriod& period,
                             std::vector<SolvedNodes> ready)
    : LightTransport(traced) {
  const std::vector<std::size_t> tested = test_intervals(traced, period);
  for (std::size_t b = 0; b < ready.size(); ++b)
    nodes_.push_back(
        std::make_unique<NodeLight>(traced, b, in_band(period, b), tested, std::move(ready[b])));
  keep_worst_reduction();
}

const LitPeriod& YearGathering::in_band(const LitPeriod& period, std::size_t band) {
  if (!traced_.is_rgb()) return period;
  return *periods_.emplace_back(std::make_unique<PeriodInBand>(period, band));
}

void YearGathering::keep_worst_reduction() {
  reduction_ = nodes_.front()->solved().reduction;
  for (const auto& nodes : nodes_) {
    const Reduction& of_band = nodes->solved().reduction;
    const Reduction& worst = of_band.share() > reduction_.share() ? of_band : reduction_;
    reduction_ = {std::max(reduction_.skies, of_band.skies),
                  std::max(reduction_.suns, of_band.suns), worst.error_w_m2,
                  worst.standard_error_w_m2, reduction_.is_met && of_band.is_met};
  }
}

std::vector<const SolvedNodes*> YearGathering::nodes() const {
  std::vector<const SolvedNodes*> of_bands;
  for (const auto& nodes : nodes_) of_bands.push_back(&nodes->solved());
  return of_bands;
}

std::unique_ptr<BatchTransport> YearGathering::begin(std::vector<BatchTally>& tallies,
                                                     WorkDone& work, RayRecord* record) const {
  return year_batch(traced_, nodes_, tallies, work, record);
}

std::unique_ptr<const LightTransport> year_where_it_pays(const TracedScene& traced,
                                                         const LitPeriod& period, WorkDone& work,
                                                         Watch& watch) {
  if (traced.rules.year == Year::each || !year_can_serve(traced.rules)) return nullptr;
  // So many are tests that few would be left to choose from.
  const double lit = lit_intervals(traced, period);
  if (lit < static_cast<double>(2 * year_tests)) return nullptr;
  // Before anything is solved or ranked: there are at least a block of skies and one of suns.
  const bool is_asked_for = traced.rules.year == Year::modes;
  if (!is_asked_for && most_of_few(traced.rules, lit) < static_cast<double>(2 * block_width))
    return nullptr;
  auto year = std::make_unique<YearGathering>(traced, period, watch);
  const Reduction& reached = *year->reduction();
  const auto nodes = static_cast<double>(reached.skies + reached.suns);
  if (is_asked_for || (reached.is_met && nodes <= most_of_few(traced.rules, lit))) return year;
  work += year->work();
  return nullptr;
}

}  // namespace sunload
