// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Values that weather records lack: made from what else a record has, 0 in the dark, or filled
/// from its neighbours as the study wants.
#pragma once

#include <map>
#include <vector>

#include "geo/sun/site.h"
#include "geo/sun/weather.h"
#include "io/study/study.h"

namespace sunload {

/// One step per record.
std::vector<PeriodStep> steps_of(const std::vector<DatedWeather>& weather);

class WeatherGaps {
 public:
  /// `source`: what light is made from. `study` must outlive it.
  WeatherGaps(const Study& study, const Site& site, WeatherSource source)
      : study_(study), site_(site), source_(source) {}

  /// Records that lack something which follows from what else they have; how many, by that.
  std::map<WeatherSource, std::size_t> complete(std::vector<DatedWeather>& weather) const;
  /// Gives records that lack values while the sun is down 0 in their place: loggers may write
  /// nothing then. Returns how many they are.
  std::size_t complete_dark(std::vector<DatedWeather>& weather) const;
  /// `light.missing`, after `complete`. Nights count where it is asked how long a gap is.
  std::vector<DatedWeather> filled(const std::vector<DatedWeather>& weather) const;

 private:
  using Records = std::vector<std::size_t>;
  /// The sun of some records.
  SunPath path_of(const std::vector<DatedWeather>& weather, const Records& records) const;
  /// For what is lacking.
  void put_zeros(WeatherValues& values) const;
  /// That lack values in the dark.
  Records dark(const std::vector<DatedWeather>& weather) const;

  const Study& study_;
  Site site_;
  WeatherSource source_;
};

}  // namespace sunload
