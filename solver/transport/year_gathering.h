// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A long period from few solutions: gathering for some hundred skies and suns, from which the
/// sky's light and all reflected light of every interval are made up (node_light.h). The sun's own
/// rays, straight and by mirrors, are those of the interval, and the totals of the realizations
/// have the exact sources, integrated over time.
///
/// How far this is from solving each interval is measured on intervals that are no nodes, and more
/// nodes are taken until it is a given share of the standard error of an interval.
#pragma once

#include <memory>
#include <vector>

#include "solver/transport/node_light.h"

namespace sunload {

class YearGathering : public LightTransport {
 public:
  /// Solves nodes. Where the rules leave the choice open, solves none if even the first are too
  /// many to pay. `traced` and `period` must outlive it. Throws Interrupted.
  YearGathering(const TracedScene& traced, const LitPeriod& period, Watch& watch);
  /// By nodes that are solved already, of each band.
  YearGathering(const TracedScene& traced, const LitPeriod& period, std::vector<SolvedNodes> ready);
  std::unique_ptr<BatchTransport> begin(std::vector<BatchTally>& tallies, WorkDone& work,
                                        RayRecord* record) const override;
  /// The errors of the band that is furthest off, the number of nodes of the band that has most.
  const Reduction* reduction() const override { return &reduction_; }
  std::vector<const SolvedNodes*> nodes() const override;

 private:
  const LitPeriod& in_band(const LitPeriod& period, std::size_t band);
  void keep_worst_reduction();

  std::vector<std::unique_ptr<const LitPeriod>> periods_;  ///< of each band; none: broadband
  std::vector<std::unique_ptr<NodeLight>> nodes_;          ///< of each band
  Reduction reduction_;
};

/// The solution by nodes where the rules ask for it, or leave it open and it keeps its aim and
/// costs less than solving each interval; else null, and the work of trying is added to `work`.
std::unique_ptr<const LightTransport> year_where_it_pays(const TracedScene& traced,
                                                         const LitPeriod& period, WorkDone& work,
                                                         Watch& watch);

}  // namespace sunload
