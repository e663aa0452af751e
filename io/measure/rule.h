// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A rule of planning: what every file of this room but rules has one of.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geo/sun/site.h"
#include "geo/sun/sun.h"
#include "io/measure/parameters.h"
#include "solver/measure/sun_share.h"
#include "solver/measure/sun_spans.h"

namespace sunload {

/// An interval of the period, as far as measures ask for it.
struct MeasuredInterval {
  UnixTime begin = 0, end = 0;
  double dni = 0;                ///< while it is sunlit [W m-2]
  double dhi = 0;                ///< on open level ground, in the unit of the series
  std::vector<SunStretch> suns;  ///< of its sunlit part; empty in the dark
};

/// Light, and none of it of the sun itself.
inline bool is_without_sun(const MeasuredInterval& interval) {
  return interval.dni <= 0 && interval.dhi > 0;
}

/// What is measured, and in what light. What it refers to outlives it.
struct MeasuredScene {
  std::vector<MeasuredPoint> points;  ///< centres of the chosen patches, then sensors
  std::size_t patches = 0;            ///< how many of the points are of patches
  const RayCaster& caster;            ///< every surface of it stops light
  const Site& site;
  Refraction refraction = Refraction::spa;
  Ut1 ut1 = Ut1::table;
  const std::vector<MeasuredInterval>& intervals;
};

/// Values of all points, patches first; NaN where there is none.
struct MeasureValues {
  std::vector<double> value;
  /// Stretches of sun, UTC s since 1970; empty of rules that have none.
  std::vector<std::vector<SunSpan>> spans = {};
};

/// Rows of a series for the intervals [first, first + rows): of the chosen patches, and of sensors.
struct SeriesRows {
  std::size_t first = 0, rows = 0;
  const std::vector<double>&patch, &sensor;  ///< [rows × n]
};

/// A rule at work on one scene.
class Measure {
 public:
  Measure() = default;
  Measure(const Measure&) = delete;
  Measure& operator=(const Measure&) = delete;
  virtual ~Measure() = default;
  /// Name of the series that it watches, as of patches where light is irradiance; empty: none.
  virtual std::string series() const { return {}; }
  /// Batches come in any order, each once.
  virtual void watch(const SeriesRows& rows) { static_cast<void>(rows); }
  virtual MeasureValues values() = 0;
};

/// A word for values that reach a threshold.
struct MeasureLevel {
  std::string word;
  double value = 0;
};

/// A key that a rule knows; without a number it must be written.
struct RuleKey {
  std::string key;
  std::optional<double> absent;
  /// Written in place of such another, by the quantity of the study's light: one of them is needed.
  bool is_one_of = false;

  bool is_needed() const { return !absent || is_one_of; }
};
/// A key with words; the first is what an absent one means.
struct RuleWords {
  std::string key;
  std::vector<std::string> words;
};

/// What a rule is, which keys it knows, and how a measure by it is begun.
struct MeasureRule {
  std::string word;        ///< by which studies name it
  std::string definition;  ///< one sentence
  std::string source;      ///< title and clause
  std::string units;       ///< UDUNITS
  std::vector<RuleKey> keys = {};
  std::vector<RuleWords> words = {};
  /// Month and day of the year in which the period begins; {0, 0}: a date must be written.
  std::optional<std::pair<int, int>> day = {};
  /// The most that it asks of a study: the scene alone, the sun of a day, the light of intervals,
  /// or series of the solution.
  enum class Needs { geometry, sun_path, intervals, series } needs = Needs::geometry;
  /// The period must be a year, or one of measured or typical weather.
  enum class Spans { any_period, whole_year, year_of_weather } spans = Spans::any_period;
  /// Part of the light whose series it watches where its words have no `light`.
  std::string light = "total";
  /// Intervals that it is taken over.
  enum class Counts { all, without_sun } counts = Counts::all;
  /// Levels from low to high that values reach from below, or stay below; none: no verdict.
  enum class Better { more, less } better = Better::more;
  std::vector<MeasureLevel> (*levels)(const MeasureParameters&) = nullptr;
  std::unique_ptr<Measure> (*start)(const MeasureParameters&, const MeasuredScene&) = nullptr;
};

/// Share of the area, in per cent, that must reach a level before a facade or object has it: half,
/// which BRE 209 (3.3.17) asks of gardens.
inline constexpr double usual_area_percent = 50;

}  // namespace sunload
