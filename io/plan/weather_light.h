// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The weather file of a study as light on its intervals.
#pragma once

#include <string>
#include <vector>

#include "geo/sun/day_albedo.h"
#include "geo/sun/site.h"
#include "geo/sun/weather.h"
#include "geo/sun/weather_holes.h"
#include "io/plan/weather_words.h"
#include "io/study/study.h"
#include "io/weather/file.h"

namespace sunload {

/// Year that typical weather is written as where the study does not choose one.
inline constexpr int typical_year = 2001;

/// Light of an interval: of an open horizon, and without the beam that hills take.
struct WeatherMean {
  Irradiance open, past_hills;
};

/// Weather for one study: read, dated, filled, with its sun. Throws InputError for what the
/// file lacks; everything that was done to the data is said in `words`.
class StudyWeather {
 public:
  StudyWeather(const Study& study, const Site& site);

  /// One step per record, also of those that are missing within days: the period
  /// `year_of: weather`.
  std::vector<PeriodStep> own_steps() const;
  /// Means over the intervals of `path`, which are the own steps or any others. InputError
  /// where the weather does not reach.
  std::vector<WeatherMean> means(const SunPath& path);

  /// Of the ground in the intervals of `path`, after `means`: by days of the site's clock.
  DayAlbedos albedos(const SunPath& path) const;

  const std::vector<std::string>& words() const { return words_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  /// Throws InputError where the zone changes its standard time within the file's years, and the
  /// file does not tell its own.
  void expect_one_offset() const;
  void date_own_year();
  void date_for(const SunPath& path);
  SunEphemeris sun_of(UnixTime begin, UnixTime end) const;
  std::vector<WeatherHole> holes() const;
  void fill_own_holes();
  void fill_holes_in(const SunPath& path);
  double offset_s(int year) const;
  int first_year() const;
  void put_hills(const std::vector<DatedWeather>& used, WeatherLight& light) const;
  void choose_source(const std::vector<DatedWeather>& used);
  /// `used`: by the path, as read.
  std::vector<DatedWeather> without_gaps(std::vector<DatedWeather> used, const SunPath& path);
  void say_file();
  void say_closure(const std::vector<DatedWeather>& used, const SunPath& path);
  /// Of a year about the path where that is shorter: a few days tell little.
  void say_clock(const SunPath& path);
  void say_doubts(const std::vector<DatedWeather>& used, const SunPath& path);
  void say(const WeatherSayings& said);
  void say_filled(const FilledWeather& gaps);
  void say_missing_days(const std::vector<WeatherHole>& holes);
  std::string in_file_time(UnixTime time) const;
  std::string words_of(const WeatherHole& hole) const;
  /// Rows of the dark, and of sunrise and sunset, may be left out (`sunlit_holes`): throws
  /// InputError for the first other interval.
  void expect_covered(const SunPath& path, const std::vector<std::size_t>& uncovered);
  bool lies_between_records(const SunInterval& when) const;
  [[noreturn]] void refuse_uncovered(const SunInterval& when) const;

  const Study& study_;
  Site site_;
  WeatherFile file_;
  WeatherYears years_;
  std::vector<DatedWeather> dated_;  ///< as read, and records without values in `filled_holes_`
  std::vector<WeatherHole> filled_holes_;
  WeatherSource source_ = WeatherSource::none;
  std::vector<std::string> words_, warnings_;
};

/// The station's place, where the study has a weather file whose header says it.
std::optional<WeatherPlace> weather_place(const Study& study);

}  // namespace sunload
