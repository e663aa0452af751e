// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/year_gathering.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/large_memory.h"
#include "solver/base/stopwatch.h"
#include "solver/base/threads.h"
#include "solver/gather/block_tally.h"
#include "solver/light/instant_spread.h"
#include "solver/transport/band_rays.h"
#include "solver/transport/exact_totals.h"
#include "solver/transport/gathered_sums.h"
#include "solver/transport/part_sums.h"
#include "solver/transport/period_in_band.h"
#include "solver/transport/realizations.h"

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

/// `of_receivers`: those, patches or sensors. The columns of `rays` are used up.
BlockLight light_of_nodes(const Receivers& receivers, NodeBlock::Received NodeBlock::*of_receivers,
                          const NodeLight& nodes, const std::vector<NodeWeights>& weights,
                          RayLight& rays) {
  BlockLight light =
      light_by_rays(receivers.lines.pooled, std::move(rays.pooled), receivers.lamps.pooled);
  nodes.add_light(weights, of_receivers, light);
  return light;
}

/// Sums over intervals of means over patches, by area, of the squares of what nodes are off by.
struct Squares {
  double sky = 0, reflected = 0;  ///< of each alone
  double error = 0;               ///< of both; without the noise of samples, as of the sky
  double standard_error = 0;
  Squares& operator+=(const Squares& more) {
    sky += more.sky;
    reflected += more.reflected;
    error += more.error;
    standard_error += more.standard_error;
    return *this;
  }
  double share() const { return standard_error > 0 ? std::sqrt(error / standard_error) : 0; }
};

class ReductionTest {
 public:
  /// Solves the test intervals, in the light of a band, by all lines and by each realization.
  ReductionTest(const TracedScene& traced, std::size_t band, std::vector<IntervalLight> suns,
                WorkDone& work)
      : traced_(traced),
        optics_(traced.optics_of_band[band]),
        suns_(std::make_unique<const std::vector<IntervalLight>>(std::move(suns))),
        sources_(*suns_, static_cast<std::size_t>(traced.grid.cell_count())) {
    sources_.split_sky(traced.grid);
    RayLight rays =
        light_iteration(traced, sources_, {.columns = true, .all_parts = true}, {}, work)
            .on_patches;
    const Stopwatch time(work[Work::solve_s]);
    rays_ = rays.pooled;
    rays_.circumsolar = {};
    keep_light(block_light(traced.hierarchy(), traced.patches.lines.pooled, optics_, sources_,
                           std::move(rays.pooled), traced.patches.lamps.pooled,
                           traced.bounce_rules(band)));
    InstantSpread spread(traced.patches.count(), suns_->size());
    SunColumns& of = rays.of_realizations;
    const std::size_t R = static_cast<std::size_t>(traced.rules.realizations);
    for (std::size_t r = 0; r < R; ++r) {
      if (has_circumsolar()) circumsolar_.emplace_back(of.circumsolar[r]);
      spread.add(total_of(
          block_light(traced.hierarchy(), traced.patches.lines.realizations[r], optics_, sources_,
                      {std::move(of.direct[r]), std::move(of.mirror[r]),
                       has_circumsolar() ? std::move(of.circumsolar[r]) : Columns()},
                      traced.patches.lamps.of(r), traced.bounce_rules(band))));
    }
    standard_error_ = spread.errors();
  }

  Squares squares_of(const NodeLight& nodes) const {
    const auto weights = nodes.weights(
        *suns_, ledger_of_rays(traced_, optics_, rays_.direct, rays_.mirror, suns_->size()));
    RayLight rays;
    rays.pooled = rays_;
    const BlockLight made =
        light_of_nodes(traced_.patches, &NodeBlock::patches, nodes, weights, rays);
    const std::vector<float> noise = noise_of_samples(nodes, weights);
    const std::vector<double>& area = traced_.hierarchy().area();
    const double all = std::accumulate(area.begin(), area.end(), 0.0);
    Squares sum = ordered_sum(area.size(), receivers_per_chunk, Squares{},
                              [&](std::size_t begin, std::size_t end) {
                                Squares part;
                                for (std::size_t i = begin; i < end; ++i)
                                  add_squares(made, noise, i, part);
                                return part;
                              });
    for (double* square : {&sum.sky, &sum.reflected, &sum.error, &sum.standard_error})
      *square = std::max(0.0, *square / all);
    return sum;
  }

 private:
  bool has_circumsolar() const { return any_circumsolar(sources_.circumsolar); }

  /// Of patch i, by its area.
  void add_squares(const BlockLight& made, const std::vector<float>& noise, std::size_t i,
                   Squares& sum) const {
    const std::vector<double>& area = traced_.hierarchy().area();
    for (std::size_t k = 0; k < suns_->size(); ++k) {
      const std::size_t at = i * block_width + k, row = k * area.size() + i;
      const auto sky = static_cast<double>(made.sky[at] + made.mirror[at] - sky_[at] - mirror_[at]);
      const auto noisy = static_cast<double>(noise[row]);
      const auto reflected = static_cast<double>(made.reflected[at] - reflected_[at]);
      sum.sky += area[i] * (sky * sky - noisy * noisy);
      sum.reflected += area[i] * reflected * reflected;
      sum.error += area[i] * ((sky + reflected) * (sky + reflected) - noisy * noisy);
      const auto se = static_cast<double>(standard_error_[row]);
      sum.standard_error += area[i] * se * se;
    }
  }

  void keep_light(BlockLight exact) {
    sky_ = std::move(exact.sky);
    mirror_ = std::move(exact.mirror);
    reflected_ = std::move(exact.reflected);
  }

  /// Standard error of what nodes and test differ by, by their samples of the sky about the sun,
  /// [interval][patch]: both solutions have it, and it says nothing of the nodes.
  std::vector<float> noise_of_samples(const NodeLight& nodes,
                                      const std::vector<NodeWeights>& weights) const {
    if (!has_circumsolar()) return std::vector<float>(standard_error_.size(), 0);
    InstantSpread spread(traced_.patches.count(), suns_->size());
    for (std::size_t r = 0; r < circumsolar_.size(); ++r) {
      Columns difference = columns(traced_.patches.count());
      nodes.add_circumsolar(weights, r, difference);
      spread.add([&](std::size_t i, std::size_t k) {
        return difference[i * block_width + k] - circumsolar_[r].at(i, k);
      });
    }
    return spread.errors();
  }

  const TracedScene& traced_;
  const PatchOptics& optics_;                               ///< of the band
  std::unique_ptr<const std::vector<IntervalLight>> suns_;  ///< where `sources_` looks for them
  BlockSources sources_;
  RayColumns rays_;                         ///< direct and by mirrors
  Columns sky_, mirror_, reflected_;        ///< of the exact solution
  std::vector<PackedColumns> circumsolar_;  ///< [R] samples of the sky about the sun; none: none
  std::vector<float> standard_error_;       ///< [interval][patch]
};

/// One band of a batch.
class YearBand {
 public:
  YearBand(const TracedScene& traced, std::size_t band, const NodeLight& nodes, BatchTally& tally)
      : traced_(traced),
        optics_(traced.optics_of_band[band]),
        band_(band),
        nodes_(nodes),
        tally_(tally),
        sums_(empty_sums(traced)),
        parts_(traced, band, tally),
        shares_of_parts_(parts_.count()) {}

  /// What the rays of a block are added to as they are traced, where they are of this band.
  std::vector<TimedSums> timed(const Block& block) { return parts_.timed(block, sums_); }
  /// Of the whole batch.
  std::vector<TimeSums*> sums() { return parts_.all(sums_); }
  /// Adds rays that were traced for all bands; the block has this band's light.
  void add_rays(const Block& block, const BlockRays& rays, const BandFactors& factors) {
    add_exposures(rays, factors, block.suns, sums_);
    parts_.add_rays(block, rays, factors);
  }

  /// All are of this band; `rays` are used up.
  void light(const Block& block, const BlockSources& sources, BlockRays& rays) {
    const auto by_rays = ledger_of_rays(traced_, optics_, rays.on_patches.pooled.direct,
                                        rays.on_patches.pooled.mirror, block.suns.size());
    const auto weights = nodes_.weights(block.suns, by_rays);
    put_rows(by_rays, block, tally_.ledger);
    parts_.add_sources(block, sources, PartSums::Sky::whole);
    for (std::size_t p = 0; p < parts_.count(); ++p)
      add_shares(block, weights, parts_.shares(p, block), shares_of_parts_[p]);
    const Columns on_patches = light_patches(block, weights, rays.on_patches);
    const bool any_sensors = traced_.sensors.count() > 0;
    const Columns on_sensors =
        any_sensors ? light_sensors(block, weights, rays.on_sensors) : Columns();
    exact_.keep(block, on_patches, any_sensors ? &on_sensors : nullptr);
    book_sent_on(traced_, block, rays.sent_on, sums_, tally_);
    sums_.add_whole_sources(sources);
    add_shares(block, weights, std::vector<double>(block.suns.size(), 1), shares_);
  }

  void finish() {
    nodes_.split_circumsolar(shares_, sums_);
    solve_realizations(traced_, band_, sums_, tally_);
    for (std::size_t p = 0; p < parts_.count(); ++p)
      nodes_.split_circumsolar(shares_of_parts_[p], parts_.sums(p));
    parts_.solve();
    exact_.take(optics_, tally_);
  }

 private:
  /// Return what is reflected.
  Columns light_patches(const Block& block, const std::vector<NodeWeights>& weights,
                        RayLight& rays) {
    BlockLight light = light_of_nodes(traced_.patches, &NodeBlock::patches, nodes_, weights, rays);
    for (std::size_t k = 0; k < block.suns.size(); ++k)
      tally_.ledger[block.rows[k]] += nodes_.ledger(weights, k);
    store_patches(optics_, light, block.suns, block.rows, rays.sunlit, tally_);
    return std::move(light.reflected);
  }

  Columns light_sensors(const Block& block, const std::vector<NodeWeights>& weights,
                        RayLight& rays) {
    BlockLight light = light_of_nodes(traced_.sensors, &NodeBlock::sensors, nodes_, weights, rays);
    store_received(light, block.suns, block.rows, rays.sunlit, tally_.sensors);
    return std::move(light.reflected);
  }

  /// Time that each node shines, in all intervals together, of each so much of its time.
  static void add_shares(const Block& block, const std::vector<NodeWeights>& weights,
                         const std::vector<double>& of_suns, std::vector<NodeSeconds>& shares) {
    shares.resize(weights.size());
    for (std::size_t b = 0; b < weights.size(); ++b)
      for (std::size_t j = 0; j < block_width; ++j)
        for (std::size_t k = 0; k < block.suns.size(); ++k)
          shares[b][j] += static_cast<double>(weights[b].of[j * block_width + k]) *
                          (of_suns[k] * block.suns[k].length_s);
  }

  const TracedScene& traced_;
  const PatchOptics& optics_;
  std::size_t band_;
  const NodeLight& nodes_;
  BatchTally& tally_;
  TimeSums sums_;
  PartSums parts_;
  ExactTotals exact_;
  std::vector<NodeSeconds> shares_;  ///< of each block of nodes
  std::vector<std::vector<NodeSeconds>> shares_of_parts_;
};

/// One batch.
class YearBatch : public BatchTransport {
 public:
  YearBatch(const TracedScene& traced, const std::vector<std::unique_ptr<NodeLight>>& nodes,
            std::vector<BatchTally>& tallies, WorkDone& work, RayRecord* record)
      : traced_(traced), work_(work), rays_(traced, SunsSky::elsewhere, record) {
    bands_.reserve(tallies.size());
    for (std::size_t b = 0; b < tallies.size(); ++b)
      bands_.emplace_back(traced, b, *nodes[b], tallies[b]);
  }

  void light(const Block& block) override {
    const BlockSources sources(block.suns, static_cast<std::size_t>(traced_.grid.cell_count()));
    if (traced_.is_rgb()) return light_in_bands(block, sources);
    BlockRays rays = rays_.next(sources, {}, bands_.front().timed(block), work_);
    const Stopwatch time(work_[Work::solve_s]);
    bands_.front().light(block, sources, rays);
  }

  void finish() override {
    const Stopwatch time(work_[Work::realizations_s]);
    rays_.end(traced_.is_rgb() ? std::vector<TimeSums*>() : bands_.front().sums(), work_);
    for (YearBand& band : bands_) band.finish();
  }

 private:
  /// Rays are traced once, for the mean of the bands.
  void light_in_bands(const Block& block, const BlockSources& sources) {
    const BlockRays rays = rays_.next(sources, {.columns = true}, {}, work_);
    const Stopwatch time(work_[Work::solve_s]);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const auto suns = suns_in_band(block.suns, b);
      const Block of_band{suns, block.rows};
      const BandFactors factors = sun_factors(block.suns, suns);
      bands_[b].add_rays(of_band, rays, factors);
      BlockRays rays_of_band = in_band(rays, factors, Errors::totals);
      bands_[b].light(of_band, BlockSources(suns, sources.sky.size() / block_width), rays_of_band);
    }
  }

  const TracedScene& traced_;
  WorkDone& work_;
  BatchRays rays_;
  std::vector<YearBand> bands_;
};

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
  for (double* square : {&sum.sky, &sum.reflected, &sum.error, &sum.standard_error})
    *square /= static_cast<double>(intervals);
  return sum;
}

}  // namespace

namespace {

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
                              std::sqrt(squares.standard_error), squares.share() <= wanted_share};
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
  const auto share = [](const Reduction& of) {
    return of.standard_error_w_m2 > 0 ? of.error_w_m2 / of.standard_error_w_m2 : 0;
  };
  reduction_ = nodes_.front()->solved().reduction;
  for (const auto& nodes : nodes_) {
    const Reduction& of_band = nodes->solved().reduction;
    const Reduction& worst = share(of_band) > share(reduction_) ? of_band : reduction_;
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
  return std::make_unique<YearBatch>(traced_, nodes_, tallies, work, record);
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
