// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/weather_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "geo/base/units.h"
#include "geo/sun/resample.h"
#include "geo/sun/weather_clock.h"
#include "io/plan/clock_words.h"
#include "io/plan/weather_gaps.h"

namespace sunload {

namespace {

/// Weather changes over some tens of kilometres; beyond, the sun's times do too.
constexpr double far_from_station_m = 50e3;
/// Below this the closure is as good as instruments are (BSRN: 2 % or 5 W/m² for GHI).
constexpr double good_closure_w_m2 = 10;
/// A shift that leaves less than half of the residual is no chance.
constexpr double telling_share = 0.5;

/// The records that overlap an interval of the path. What lies between its days is nobody's.
std::vector<DatedWeather> used_by(const SunPath& path, const std::vector<DatedWeather>& all) {
  std::vector<DatedWeather> used;
  for (const auto& w : all) {
    const auto next = std::upper_bound(path.begin(), path.end(), w.begin,
                                       [](UnixTime t, const SunInterval& i) { return t < i.end; });
    if (next != path.end() && next->begin < w.end) used.push_back(w);
  }
  return used;
}

/// Stations have an open horizon.
Site open(Site site) {
  site.horizon = Horizon();
  return site;
}

Site site_at(const WeatherPlace& place) {
  return {.latitude_deg = place.latitude_deg, .longitude_deg = place.longitude_deg};
}

/// As much of the beam as the interval's sunlit part has.
Irradiance past_hills(const Irradiance& open, const SunInterval& when) {
  const double share = when.up_s > 0 ? when.sunlit_s / when.up_s : 1;
  return {open.dni * share, open.dhi, open.dhi + (open.ghi - open.dhi) * share};
}

/// Same stretches, so that nothing is to be divided.
bool are_same(const std::vector<DatedWeather>& weather, const SunPath& path) {
  return std::equal(weather.begin(), weather.end(), path.begin(), path.end(),
                    [](const DatedWeather& w, const SunInterval& i) {
                      return w.begin == i.begin && w.end == i.end;
                    });
}

}  // namespace

StudyWeather::StudyWeather(const Study& study, const Site& site)
    : study_(study),
      site_(open(site)),
      file_(read_weather_file(study.light.weather, study.light.stamp)),
      years_(years_of(file_.records)) {
  if (std::holds_alternative<WeatherPeriod>(study.period.kind)) date_own_year();
  expect_one_offset();
  say_file();
  say(below_zero_words(file_, study_.light.missing));
  if (!dated_.empty()) fill_own_holes();
}

/// In which a record begins; the first of a year may be stamped with its end.
int begin_year(const WeatherRecord& record) {
  const bool is_before = record.month == 1 && record.day == 1 && record.begin_s < 0;
  return record.year - (is_before ? 1 : 0);
}

void StudyWeather::expect_one_offset() const {
  if (file_.offset_s || years_ != WeatherYears::actual) return;
  const int first = begin_year(file_.records.front()), last = begin_year(file_.records.back());
  for (int year = first + 1; year <= last; ++year)
    if (offset_s(year) != offset_s(first))
      throw InputError({file_.path},
                       fmt::format("standard time of {} was UTC{} in {} and is UTC{} in {}",
                                   study_.site.timezone, offset_text(offset_s(first)), first,
                                   offset_text(offset_s(year)), year),
                       "the file does not say which one it keeps",
                       "write times with an offset (2017-06-21T12:00+03:00), or a file of each");
}

int StudyWeather::first_year() const {
  const auto* own = std::get_if<WeatherPeriod>(&study_.period.kind);
  if (own && own->as_year) return *own->as_year;
  return years_ == WeatherYears::actual ? file_.records.front().year : typical_year;
}

double StudyWeather::offset_s(int year) const {
  return file_.offset_s.value_or(TimeZone(study_.site.timezone).standard_offset_s(year));
}

void StudyWeather::date_own_year() {
  const int year = first_year();
  dated_ = dated(file_.records, year, offset_s(year));
  if (dated_.size() < file_.records.size()) {
    const auto leap_day =
        std::find_if(file_.records.begin(), file_.records.end(),
                     [](const WeatherRecord& r) { return r.month == 2 && r.day == 29; });
    throw InputError({file_.path, leap_day->line, 0}, fmt::format("{} has no 29 February", year),
                     "the weather is written as that year",
                     "write period.as_year with a leap year, such as 2004");
  }
}

SunEphemeris StudyWeather::sun_of(UnixTime begin, UnixTime end) const {
  return {begin,
          end,
          site_,
          study_.sun.refraction,
          study_.sun.ut1_utc,
          standard_air(site_.elevation_m)};
}

std::vector<WeatherHole> StudyWeather::holes() const {
  const SunEphemeris sun = sun_of(dated_.front().begin, dated_.back().end);
  return sunlit_holes(dated_, sun, site_.longitude_deg);
}

void StudyWeather::fill_own_holes() {
  const auto all = holes();
  say_missing_days(all);
  std::copy_if(all.begin(), all.end(), std::back_inserter(filled_holes_),
               [](const WeatherHole& hole) { return !hole.records.empty(); });
  dated_ = with_records_of(filled_holes_, dated_);
}

/// Holes that nobody asks for are left.
void StudyWeather::fill_holes_in(const SunPath& path) {
  if (dated_.empty()) return;
  for (auto& hole : holes())
    if (!hole.records.empty() && std::any_of(path.begin(), path.end(), [&](const SunInterval& i) {
          return i.begin < hole.end && i.end > hole.begin;
        }))
      filled_holes_.push_back(std::move(hole));
  dated_ = with_records_of(filled_holes_, dated_);
}

std::vector<PeriodStep> StudyWeather::own_steps() const { return steps_of(dated_); }

void StudyWeather::date_for(const SunPath& path) {
  if (years_ == WeatherYears::actual) {
    dated_ = dated(file_.records, {}, offset_s(first_year()));
    return;
  }
  // A typical year is any year that the period touches.
  dated_.clear();
  const int first = calendar_from_utc(path.front().begin - seconds_per_day).year;
  const int last = calendar_from_utc(path.back().end + seconds_per_day).year;
  for (int year = first; year <= last; ++year) {
    const auto of_year = dated(file_.records, year, offset_s(year));
    dated_.insert(dated_.end(), of_year.begin(), of_year.end());
  }
}

std::vector<WeatherMean> StudyWeather::means(const SunPath& path) {
  if (dated_.empty()) {
    date_for(path);
    fill_holes_in(path);
  }
  const auto as_read = used_by(path, dated_);
  if (as_read.empty()) refuse_uncovered(path.front());
  choose_source(as_read);
  const auto used = without_gaps(as_read, path);
  const bool own = are_same(used, path);
  const SunPath weather_path =
      own && study_.site.horizon.is_open()
          ? path
          : sun_path(steps_of(used), site_, study_.sun.refraction, study_.sun.ut1_utc);
  say_clock(path);
  say_closure(as_read, weather_path);
  say_doubts(as_read, weather_path);
  WeatherLight light =
      with_sun(used, weather_path, source_, study_.light.decomposition, site_.elevation_m);
  say(dark_beam_words(light, used));
  std::vector<WeatherMean> means;
  if (own) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Irradiance& mean = light.intervals[i].mean;
      means.push_back({mean, past_hills(mean, path[i])});
    }
    return means;
  }
  if (!study_.site.horizon.is_open()) put_hills(used, light);
  const Resampled resampled = resample(light.intervals, path);
  expect_covered(path, resampled.uncovered);
  for (std::size_t i = 0; i < path.size(); ++i)
    means.push_back({resampled.mean[i], resampled.past_hills[i]});
  return means;
}

/// When the sun of the records stands above the hills of the site.
void StudyWeather::put_hills(const std::vector<DatedWeather>& used, WeatherLight& light) const {
  Site site = site_;
  site.horizon = study_.site.horizon;
  const SunPath path = sun_path(steps_of(used), site, study_.sun.refraction, study_.sun.ut1_utc);
  for (std::size_t i = 0; i < path.size(); ++i) {
    SunInterval& when = light.intervals[i].when;
    when.sunlit_s = path[i].sunlit_s;
    when.sunlit_begin = path[i].sunlit_begin;
    when.sunlit_end = path[i].sunlit_end;
  }
}

/// From what the period uses: a value elsewhere is no column. Where that has nothing, other days
/// may fill it.
void StudyWeather::choose_source(const std::vector<DatedWeather>& used) {
  source_ = source_of(used);
  if (source_ == WeatherSource::none) source_ = source_of(dated_);
  words_.push_back(source_words(source_, study_.light.decomposition));
  if (source_ == WeatherSource::none)
    throw InputError({file_.path}, "has no irradiance that light could be made from",
                     "all values of GHI, DNI and DHI are missing");
}

std::vector<DatedWeather> StudyWeather::without_gaps(std::vector<DatedWeather> used,
                                                     const SunPath& path) {
  const WeatherGaps gaps(study_, site_, source_);
  for (const auto& [has, records] : gaps.complete(used))
    warnings_.push_back(fmt::format("weather: {} of {} records {}", records, used.size(),
                                    completed_words(has, study_.light.decomposition)));
  const FilledWeather lacking = fill_missing(used, source_, Missing::refuse);
  if (gaps.complete_dark(used) == lacking.records) return used;
  say_filled(lacking);
  auto all = dated_;  // neighbours may lie outside of the period
  gaps.complete(all);
  return used_by(path, gaps.filled(all));
}

void StudyWeather::expect_covered(const SunPath& path, const std::vector<std::size_t>& uncovered) {
  std::vector<WeatherHole> lit;
  bool is_lit_known = false;
  std::size_t dark = 0, edges = 0;
  double edges_s = 0;
  for (const std::size_t i : uncovered) {
    const SunInterval& when = path[i];
    if (when.up_s <= 0) {
      ++dark;
      continue;
    }
    if (!is_lit_known) lit = holes();
    is_lit_known = true;
    const bool is_in_hole = std::any_of(lit.begin(), lit.end(), [&](const WeatherHole& hole) {
      return hole.begin < when.end && hole.end > when.begin;
    });
    if (is_in_hole || !lies_between_records(when)) refuse_uncovered(when);
    ++edges;
    edges_s += when.up_s;
  }
  if (dark > 0)
    words_.push_back(fmt::format("{} intervals in the dark have no rows: no light is taken", dark));
  if (edges > 0)
    warnings_.push_back(
        fmt::format("weather: {} intervals at sunrise and sunset, {:.3g} h of sun, lack rows; no "
                    "light is taken where they do",
                    edges, edges_s / seconds_per_hour));
}

/// Where whole rows are left out about it: shorter gaps are another clock.
bool StudyWeather::lies_between_records(const SunInterval& when) const {
  constexpr double rounding_s = 1;
  if (when.begin < dated_.front().begin || when.end > dated_.back().end) return false;
  auto next = std::upper_bound(dated_.begin(), dated_.end(), when.begin,
                               [](UnixTime t, const DatedWeather& w) { return t < w.begin; });
  for (; next != dated_.end(); ++next) {
    const DatedWeather& before = *std::prev(next);
    if (next->begin - before.end > rounding_s && rows_left_out(before, *next) < 1) return false;
    if (next->begin >= when.end) break;
  }
  return true;
}

DayAlbedos StudyWeather::albedos(const SunPath& path) const {
  const SunEphemeris sun = sun_of(dated_.front().begin, dated_.back().end);
  return day_albedos(dated_, path, TimeZone(study_.site.timezone),
                     [&](UnixTime at) { return std::sin(radians(sun(at).elevation_deg)); });
}

void StudyWeather::say_file() {
  const WeatherRecord& first = file_.records.front();
  const double offset = offset_s(first_year());
  const TimeZone zone(offset_text(offset));
  const bool own = !dated_.empty();
  words_.push_back(
      fmt::format("{} {}{}: {} records of {:g} min", file_.format, file_.path,
                  file_.place && !file_.place->name.empty() ? " (" + file_.place->name + ")" : "",
                  file_.records.size(), (first.end_s - first.begin_s) / seconds_per_minute));
  words_.push_back(fmt::format(
      "{}, local standard time UTC{}{}{}",
      years_ == WeatherYears::typical
          ? (own ? fmt::format("typical year written as {}", first_year())
                 : std::string("typical year, taken for the dates of the period"))
          : fmt::format("years {} to {}{}", begin_year(first), begin_year(file_.records.back()),
                        own && first_year() != first.year
                            ? fmt::format(" written as {}", first_year())
                            : ""),
      offset_text(offset), file_.offset_s ? "" : " (from site.timezone; the file does not say)",
      own ? fmt::format("; first record {} to {}", iso_local(dated_.front().begin, zone),
                        iso_local(dated_.front().end, zone))
          : ""));
  for (const auto& note : file_.notes) words_.push_back(note);
  if (!file_.place) return;
  const double away = distance_m(site_, site_at(*file_.place));
  if (away > far_from_station_m)
    warnings_.push_back(fmt::format(
        "the weather station {} stands {:.0f} km from the site; its weather and its hours of "
        "sunrise are not those of the site",
        file_.place->name, away / 1000));
}

void StudyWeather::say_filled(const FilledWeather& gaps) {
  const std::string count =
      fmt::format("{} of {} records lack a value: {}; the longest gap has {:.4g} h", gaps.records,
                  gaps.weather.size(), lacking_words(gaps.weather, source_),
                  gaps.longest_gap_s / seconds_per_hour);
  if (study_.light.missing == Missing::refuse) {
    const auto first =
        std::find_if(gaps.weather.begin(), gaps.weather.end(),
                     [&](const DatedWeather& w) { return is_incomplete(w.values, source_); });
    const auto hole =
        std::find_if(filled_holes_.begin(), filled_holes_.end(), [&](const WeatherHole& each) {
          return each.begin <= first->begin && first->begin < each.end;
        });
    const std::string hint =
        "choose another file or period, or write light.missing: interpolate or zero";
    if (hole != filled_holes_.end())
      throw InputError({file_.path, hole->line, 0}, "rows are missing before this one",
                       words_of(*hole) + "; in all " + count, hint);
    throw InputError({file_.path, first->line, 0},
                     missing_words(first->values, source_) + " missing here", count, hint);
  }
  warnings_.push_back(
      "weather: " + count +
      (study_.light.missing == Missing::zero ? "; 0 is taken" : "; filled by interpolation"));
  if (filled_holes_.empty()) return;
  std::size_t records = 0;
  for (const auto& hole : filled_holes_) records += hole.records.size();
  warnings_.push_back(fmt::format(
      "weather: {} of them have no row, in {} places, first before line {}: {}", records,
      filled_holes_.size(), filled_holes_.front().line, words_of(filled_holes_.front())));
}

std::string StudyWeather::in_file_time(UnixTime time) const {
  return iso_local(time, TimeZone(offset_text(offset_s(first_year()))));
}

std::string StudyWeather::words_of(const WeatherHole& hole) const {
  const DatedWeather& record = hole.records.front();
  return fmt::format("{} of {:g} min with sun between {} and {}", hole.records.size(),
                     (record.end - record.begin) / seconds_per_minute, in_file_time(hole.begin),
                     in_file_time(hole.end));
}

/// Series of several campaigns have such; a period that asks for those days is refused.
void StudyWeather::say_missing_days(const std::vector<WeatherHole>& all) {
  int days = 0, places = 0;
  std::string first;
  for (const auto& hole : all) {
    const CivilTime date = calendar_from_utc(hole.end + offset_s(first_year()) - seconds_per_day);
    const bool is_leap_day = std::lround(hole.end - hole.begin) == std::lround(seconds_per_day) &&
                             date.month == 2 && date.day == 29;
    if (!hole.records.empty() || (is_leap_day && years_ == WeatherYears::typical)) continue;
    days += hole.whole_days;
    if (places++ == 0)
      first = fmt::format("from {} to {} (line {})", in_file_time(hole.begin),
                          in_file_time(hole.end), hole.line);
  }
  if (places == 0) return;
  warnings_.push_back(fmt::format(
      "weather: {}have no rows, {}{}; they are no part of the period",
      days > 0 ? fmt::format("{} whole days ", days) : "hours with sun before or after midnight ",
      places == 1 ? std::string() : fmt::format("in {} places, first ", places), first));
}

void StudyWeather::say_closure(const std::vector<DatedWeather>& used, const SunPath& path) {
  UnixTime begin = path.front().begin - seconds_per_day, end = path.back().end + seconds_per_day;
  const SunEphemeris sun = sun_of(begin, end);
  const Closure c = closure(used, path, sun);
  if (c.intervals == 0) return;
  words_.push_back(fmt::format(
      "closure DNI sin(elevation) + DHI - GHI over {} sunlit records: mean {:+.2f} W/m2 "
      "({:+.2f} % of GHI), root mean square {:.2f}, worst {:+.0f} at {}",
      c.intervals, c.bias, c.mean_ghi > 0 ? 100 * c.bias / c.mean_ghi : 0.0, c.rms, c.worst,
      iso_utc(c.worst_at)));
  if (c.rms > good_closure_w_m2 && c.best_shift_s != 0 && c.best_rms < telling_share * c.rms)
    warnings_.push_back(fmt::format(
        "the sun {:g} min {} fits GHI, DNI and DHI better (root mean square {:.1f} instead of "
        "{:.1f} W/m2); are stamp and time zone of the weather right?",
        std::abs(c.best_shift_s) / seconds_per_minute, c.best_shift_s > 0 ? "later" : "earlier",
        c.best_rms, c.rms));
  if (auto lacking = lacking_light_warning(c, file_.path); !lacking.empty())
    warnings_.push_back(std::move(lacking));
}

void StudyWeather::say_clock(const SunPath& path) {
  constexpr double year_s = 365 * seconds_per_day, margin_s = 2 * seconds_per_day;
  const UnixTime begin = path.front().begin, end = path.back().end;
  const double before_s = std::max(0.0, year_s - (end - begin)) / 2;  // typical years come again
  std::vector<DatedWeather> about;
  std::copy_if(dated_.begin(), dated_.end(), std::back_inserter(about), [&](const auto& w) {
    return w.begin >= begin - before_s - same_time_s && w.end <= end + before_s + same_time_s;
  });
  if (about.empty()) return;
  Site place = site_;  // far weather has the sun of its station; that it is far is told
  if (file_.place && distance_m(site_, site_at(*file_.place)) > far_from_station_m) {
    place.latitude_deg = file_.place->latitude_deg;
    place.longitude_deg = file_.place->longitude_deg;
  }
  const SunEphemeris sun(about.front().begin - margin_s, about.back().end + margin_s, place,
                         study_.sun.refraction, study_.sun.ut1_utc,
                         standard_air(place.elevation_m));
  say(clock_words(clock_of(about, sun, place.latitude_deg, place.longitude_deg), file_,
                  offset_s(first_year())));
}

void StudyWeather::say_doubts(const std::vector<DatedWeather>& used, const SunPath& path) {
  say(doubt_words(doubts_of(used, path), file_.path));
}

void StudyWeather::say(const WeatherSayings& said) {
  words_.insert(words_.end(), said.notes.begin(), said.notes.end());
  warnings_.insert(warnings_.end(), said.warnings.begin(), said.warnings.end());
}

void StudyWeather::refuse_uncovered(const SunInterval& when) const {
  const int year = calendar_from_utc(when.begin).year;
  const CivilTime date = calendar_from_utc(when.begin + offset_s(year));
  const bool is_leap_day = date.month == 2 && date.day == 29;
  const std::string why =
      years_ == WeatherYears::typical && is_leap_day
          ? std::string("typical years have no 29 February")
      : dated_.empty()
          ? std::string("it has no date in that year")
          : fmt::format("it reaches from {} to {}{}", iso_utc(dated_.front().begin),
                        iso_utc(dated_.back().end),
                        when.begin >= dated_.front().begin && when.end <= dated_.back().end
                            ? ", with gaps"
                            : "");
  throw InputError(
      study_.period.where,
      fmt::format("the weather does not cover {} to {}", iso_utc(when.begin), iso_utc(when.end)),
      why,
      years_ == WeatherYears::actual
          ? std::string("choose dates that have rows, or year_of: weather")
      : is_leap_day ? "choose other dates; of a whole year write year_of: weather, with as_year " +
                          std::to_string(year)
                    : std::string("choose other dates, or year_of: weather"));
}

std::optional<WeatherPlace> weather_place(const Study& study) {
  if (study.light.source != LightSource::weather) return {};
  return read_weather_file(study.light.weather, study.light.stamp).place;
}

}  // namespace sunload
