// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures of a series: hours above a threshold, peaks, sums.
#pragma once

#include <string>

#include "io/measure/rule.h"

namespace sunload {

/// Asks for every value of a series once.
class SeriesMeasure : public Measure {
 public:
  /// `light`: total, direct, sky, mirror, …
  SeriesMeasure(const std::string& light, const MeasuredScene& scene);
  std::string series() const override { return series_; }
  void watch(const SeriesRows& rows) override;

 protected:
  /// Irradiance (illuminance) of a point in an interval.
  virtual void take(std::size_t point, double value, const MeasuredInterval& interval) = 0;
  std::size_t points() const { return scene_.points.size(); }

 private:
  std::string series_;
  const MeasuredScene& scene_;
};

/// Hours of the period above above_w_m2, or above_lx.
std::unique_ptr<Measure> start_light_hours(const std::string& light,
                                           const MeasureParameters& parameters,
                                           const MeasuredScene& scene);

}  // namespace sunload
