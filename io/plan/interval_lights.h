// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The light of intervals as the solver takes it: the one maker of `IntervalLight`.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geo/sky/sky.h"
#include "geo/sun/site.h"
#include "io/plan/far_ground.h"
#include "io/plan/light_series.h"
#include "solver/light/lit_period.h"
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
  /// Cost: that of a sky for each of its parts.
  IntervalLight of(const LitInterval& interval, std::size_t number) const;
  /// Of `count` intervals from `first` on.
  std::vector<IntervalLight> of(const LightSeries& series, std::size_t first,
                                std::size_t count) const;
  /// Of all intervals.
  std::vector<IntervalLight> of(const LightSeries& series) const;

 private:
  IntervalLight of_parts(const LitInterval& interval, std::size_t number) const;
  void put_hills(std::vector<double>& sky, double ground_exitance) const;

  LightStudy light_;
  FarGround far_ground_;
  SunDisk disk_;
  Bands bands_;
  const SkyGrid& grid_;
  std::vector<double> open_share_;  ///< per cell; empty with an open horizon
};

/// The light of a series; both must outlive it. `counts`: 0 for each interval that shall be dark;
/// empty: for none.
class SeriesLight : public LitPeriod {
 public:
  SeriesLight(const IntervalLights& lights, const LightSeries& series,
              std::vector<std::uint8_t> counts = {})
      : lights_(lights), series_(series), counts_(std::move(counts)) {}
  std::size_t intervals() const override { return series_.intervals.size(); }
  bool is_dark(std::size_t interval) const override {
    return !does_count(interval) || sunload::is_dark(series_.intervals[interval]);
  }
  bool has_sun(std::size_t interval) const override {
    const SunInterval& when = series_.intervals[interval].when;
    return does_count(interval) && when.sunlit_s > 0 && when.direction.z > 0;
  }
  Vec3 direction(std::size_t interval) const override {
    return series_.intervals[interval].when.direction;
  }
  std::vector<Vec3> suns(std::size_t interval) const override {
    std::vector<Vec3> suns;
    for (const SunSample& sun : series_.intervals[interval].sun_samples)
      suns.push_back(sun.direction);
    if (suns.empty()) suns.push_back(series_.intervals[interval].when.direction);
    return suns;
  }
  IntervalLight of(std::size_t interval) const override {
    return lights_.of(series_.intervals[interval], interval);
  }

 private:
  bool does_count(std::size_t interval) const { return counts_.empty() || counts_[interval] != 0; }

  const IntervalLights& lights_;
  const LightSeries& series_;
  std::vector<std::uint8_t> counts_;
};

}  // namespace sunload
