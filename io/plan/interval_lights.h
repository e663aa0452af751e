// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The light of intervals as the solver takes it: the one maker of `IntervalLight`.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/sky/sky.h"
#include "geo/sun/site.h"
#include "io/plan/light_series.h"
#include "solver/light/sun_block.h"

namespace sunload {

/// What the intervals of a period have in common: the sky's grid, what hills leave free of its
/// cells, how light is made and counted.
///
/// DHI is that of the open sky: its part behind the hills is lost, and they shine as the far ground
/// does, unshaded by themselves; results count that as sky light. With the sun behind the hills
/// the far ground has the sky's light only. With `sun.disk: finite` the sun has its disk; with
/// `solver.bands: rgb` the light comes in bands, too (io/plan/light_colour.h).
class IntervalLights {
 public:
  /// The grid must outlive the object.
  IntervalLights(const Study& study, const Site& site, const SkyGrid& grid);
  IntervalLights(const Study&, const Site&, const SkyGrid&&) = delete;

  /// Of the interval with that number in the period.
  IntervalLight of(const LitInterval& interval, std::size_t number) const;
  /// Of `count` intervals from `first` on.
  std::vector<IntervalLight> of(const LightSeries& series, std::size_t first,
                                std::size_t count) const;
  /// Of all intervals.
  std::vector<IntervalLight> of(const LightSeries& series) const;

 private:
  void put_hills(std::vector<double>& sky, double ground_exitance) const;

  LightStudy light_;
  SunDisk disk_;
  Bands bands_;
  const SkyGrid& grid_;
  std::vector<double> open_share_;  ///< per cell; empty with an open horizon
};

}  // namespace sunload
