// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/weather.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {

namespace {

/// Irradiance changes steadily over a few hours at most.
constexpr double short_gap_s = 3 * seconds_per_hour;
constexpr double earth_radius_m = 6371008.8;  // IUGG mean radius R1 (Moritz 2000)

bool has_day(int year, int month, int day) {
  return std::chrono::year_month_day{std::chrono::year{year},
                                     std::chrono::month{static_cast<unsigned>(month)},
                                     std::chrono::day{static_cast<unsigned>(day)}}
      .ok();
}

double sine_of_elevation(double elevation_deg) {
  return std::max(0.0, std::sin(radians(elevation_deg)));
}

/// A run of records without a value: [first, last).
struct Gap {
  std::size_t first, last;
};

std::vector<Gap> gaps_of(const std::vector<DatedWeather>& weather, WeatherQuantity quantity) {
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < weather.size(); ++i) {
    if (weather[i].values.*quantity) continue;
    if (!gaps.empty() && gaps.back().last == i) {
      ++gaps.back().last;
    } else {
      gaps.push_back({i, i + 1});
    }
  }
  return gaps;
}

double middle(const DatedWeather& w) { return (w.begin + w.end) / 2; }

/// A value at a time, to be mixed with another by distance.
struct Neighbour {
  double distance_s = 0, value = 0;
};

double mixed(const std::optional<Neighbour>& before, const std::optional<Neighbour>& after) {
  if (!before && !after) return 0;
  if (!before) return after->value;
  if (!after) return before->value;
  return std::lerp(before->value, after->value,
                   before->distance_s / (before->distance_s + after->distance_s));
}

/// The values that a gap is filled from; `weather` is as it was read.
class GapFiller {
 public:
  GapFiller(const std::vector<DatedWeather>& weather, WeatherQuantity quantity)
      : weather_(weather), quantity_(quantity) {}

  double linear(const Gap& gap, std::size_t at) const {
    std::optional<Neighbour> before, after;
    if (gap.first > 0) before = neighbour(gap.first - 1, at);
    if (gap.last < weather_.size()) after = neighbour(gap.last, at);
    return mixed(before, after);
  }

  /// The same time of the nearest days that have it.
  double by_days(std::size_t at) const {
    return mixed(same_hour(at, -seconds_per_day), same_hour(at, seconds_per_day));
  }

 private:
  std::optional<Neighbour> neighbour(std::size_t of, std::size_t at) const {
    return Neighbour{std::abs(middle(weather_[of]) - middle(weather_[at])),
                     *(weather_[of].values.*quantity_)};
  }

  std::optional<Neighbour> same_hour(std::size_t at, double step_s) const {
    for (double t = weather_[at].begin + step_s;
         t >= weather_.front().begin - same_time_s && t <= weather_.back().begin + same_time_s;
         t += step_s) {
      const auto found =
          std::lower_bound(weather_.begin(), weather_.end(), t - same_time_s,
                           [](const DatedWeather& w, double time) { return w.begin < time; });
      if (found == weather_.end() || found->begin > t + same_time_s) continue;
      if (found->values.*quantity_)
        return neighbour(static_cast<std::size_t>(found - weather_.begin()), at);
    }
    return {};
  }

  const std::vector<DatedWeather>& weather_;
  WeatherQuantity quantity_;
};

/// Light of a record while the sun is up, as means over the whole record.
Irradiance divided(const WeatherValues& values, const SunInterval& when, WeatherSource source,
                   Decomposition decomposition, double elevation_m) {
  const double sine = sine_of_sun(when);
  const double share = when.up_s / when.length_s();
  const double outside = extraterrestrial(when.sun.distance_au);
  const double strongest = strongest_beam(when);
  switch (source) {
    case WeatherSource::dni_and_dhi:
      return {*values.dni, *values.dhi, 0};
    case WeatherSource::ghi_and_dhi: {
      const double beam = std::max(0.0, *values.ghi - *values.dhi);
      if (sine > 0 && beam / sine <= strongest) return {beam / sine, *values.dhi, 0};
      const double dni = sine > 0 ? strongest : 0;
      return {dni, std::max(*values.dhi, *values.ghi - dni * sine), 0};
    }
    case WeatherSource::ghi_and_dni:
      return {*values.dni, std::max(0.0, *values.ghi - *values.dni * sine), 0};
    case WeatherSource::ghi_alone: {
      const double lit = *values.ghi / share;
      const Irradiance parts =
          decomposition == Decomposition::erbs
              ? erbs(lit, when.sun.elevation_deg, outside)
              : disc(lit, when.sun.elevation_deg,
                     extraterrestrial(when.sun.distance_au, disc_solar_constant),
                     standard_pressure(elevation_m));
      const double dni = std::min(parts.dni * share, strongest);
      return {dni, std::max(0.0, *values.ghi - dni * sine), 0};
    }
    case WeatherSource::none:
      break;
  }
  contract_failed("weather has values", __FILE__, __LINE__, "source none");
}

/// Without sun all of the global irradiance is diffuse, unless both DNI and DHI were measured.
double dark_dhi(const WeatherValues& values, WeatherSource source) {
  if (source == WeatherSource::ghi_and_dhi) return std::max(*values.dhi, *values.ghi);
  return values.dhi ? *values.dhi : values.ghi.value_or(0);
}

/// Light of a record, by night as well: no beam then. Keeps a measured GHI.
Irradiance mean_light(const WeatherValues& values, const SunInterval& when, WeatherSource source,
                      Decomposition decomposition, double elevation_m) {
  Irradiance mean;
  if (when.up_s > 0) {
    mean = divided(values, when, source, decomposition, elevation_m);
  } else {
    mean.dhi = dark_dhi(values, source);
  }
  mean.ghi = values.ghi ? *values.ghi : mean.dni * sine_of_sun(when) + mean.dhi;
  return mean;
}

WeatherSource source_with(bool dni, bool dhi, bool ghi) {
  if (dni && dhi) return WeatherSource::dni_and_dhi;
  if (ghi && dhi) return WeatherSource::ghi_and_dhi;
  if (ghi && dni) return WeatherSource::ghi_and_dni;
  return ghi ? WeatherSource::ghi_alone : WeatherSource::none;
}

/// Squares of closure residuals with the sun of other times.
class ShiftedClosure {
 public:
  explicit ShiftedClosure(const SunEphemeris& sun) : sun_(sun) {}

  /// `rest`: DHI - GHI. Intervals that are partly dark have no sun to be shifted.
  void add(const SunInterval& when, double dni, double rest) {
    if (when.up_s < when.length_s() - same_time_s) return;
    step_s_ = when.length_s();
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const double sine = sine_of_elevation(sun_(when.sun_time + steps[s] * step_s_).elevation_deg);
      squares_[s] += (dni * sine + rest) * (dni * sine + rest);
    }
  }
  double best_s() const { return steps[best()] * step_s_; }
  /// Of the root mean square without shift.
  double best_share() const {
    return squares_[0] > 0 ? std::sqrt(squares_[best()] / squares_[0]) : 0;
  }

 private:
  static constexpr std::array steps{0.0, -0.5, 0.5, -1.0, 1.0};
  std::size_t best() const {
    return static_cast<std::size_t>(std::min_element(squares_.begin(), squares_.end()) -
                                    squares_.begin());
  }

  const SunEphemeris& sun_;
  std::array<double, steps.size()> squares_{};
  double step_s_ = 0;
};

/// 28 February as well: typical years have no other one.
bool is_last_of_month(const WeatherRecord& r) {
  return !has_day(r.year, r.month, r.day + 1) || (r.month == 2 && r.day == 28);
}

/// One after the other, whole, in the order of the calendar, whatever their years are.
bool are_twelve_months(const std::vector<WeatherRecord>& records) {
  constexpr int months_of_a_year = 12;
  int months = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const WeatherRecord& now = records[i];
    const WeatherRecord* before = i > 0 ? &records[i - 1] : nullptr;
    if (before && now.month == before->month && now.year == before->year) continue;
    const bool follows =
        !before || (is_last_of_month(*before) && now.month == before->month % months_of_a_year + 1);
    if (!follows || now.day != 1 || ++months > months_of_a_year) return false;
  }
  return months == months_of_a_year && is_last_of_month(records.back());
}

/// A typical year may be written from any month on; all of it is of one year.
void begin_with_january(std::vector<DatedWeather>& weather) {
  constexpr double months_s = 180 * seconds_per_day;  // rows in disorder do not go back so far
  const auto new_year = std::adjacent_find(
      weather.begin(), weather.end(), [](const DatedWeather& before, const DatedWeather& after) {
        return after.begin < before.begin - months_s;
      });
  if (new_year != weather.end()) std::rotate(weather.begin(), new_year + 1, weather.end());
}

}  // namespace

double sine_of_sun(const SunInterval& when) { return sine_of_elevation(when.sun.elevation_deg); }

bool years_follow(const std::vector<WeatherRecord>& records) {
  return std::adjacent_find(records.begin(), records.end(),
                            [](const WeatherRecord& before, const WeatherRecord& now) {
                              const int later = now.month < before.month ? 1 : 0;
                              return now.year != before.year + later;
                            }) == records.end();
}

WeatherYears years_of(const std::vector<WeatherRecord>& records) {
  const bool has_no_year = std::any_of(records.begin(), records.end(),
                                       [](const WeatherRecord& r) { return r.year == 0; });
  const bool goes_back =
      std::adjacent_find(records.begin(), records.end(),
                         [](const WeatherRecord& before, const WeatherRecord& now) {
                           return std::pair(now.year, now.month) <
                                  std::pair(before.year, before.month);
                         }) != records.end();
  if (has_no_year || goes_back) return WeatherYears::typical;
  return !years_follow(records) && are_twelve_months(records) ? WeatherYears::typical
                                                              : WeatherYears::actual;
}

std::vector<DatedWeather> dated(const std::vector<WeatherRecord>& records,
                                std::optional<int> first_year, double offset_s) {
  const bool is_typical = years_of(records) == WeatherYears::typical;
  SUNLOAD_EXPECT(first_year || !is_typical, "a typical year needs a year to be written as");
  std::vector<DatedWeather> weather;
  weather.reserve(records.size());
  for (const auto& r : records) {
    const int year =
        !first_year ? r.year : *first_year + (is_typical ? 0 : r.year - records.front().year);
    if (!has_day(year, r.month, r.day)) continue;
    const UnixTime midnight = utc_from_calendar({year, r.month, r.day, 0, 0, 0}) - offset_s;
    weather.push_back({midnight + r.begin_s, midnight + r.end_s, r.values, r.line});
  }
  if (is_typical) begin_with_january(weather);
  return weather;
}

std::size_t first_out_of_order(const std::vector<DatedWeather>& weather) {
  for (std::size_t i = 1; i < weather.size(); ++i)
    if (weather[i].begin < weather[i - 1].end - same_time_s) return i;
  return weather.size();
}

double strongest_beam(const SunInterval& when) {
  return extraterrestrial(when.sun.distance_au) * (when.up_s / when.length_s());
}

WeatherSource source_of(const std::vector<DatedWeather>& weather) {
  const auto any = [&](WeatherQuantity quantity) {
    return std::any_of(weather.begin(), weather.end(),
                       [&](const DatedWeather& w) { return (w.values.*quantity).has_value(); });
  };
  return source_with(any(&WeatherValues::dni), any(&WeatherValues::dhi), any(&WeatherValues::ghi));
}

WeatherSource source_of(const WeatherValues& values) {
  return source_with(values.dni.has_value(), values.dhi.has_value(), values.ghi.has_value());
}

std::vector<WeatherQuantity> needed(WeatherSource source) {
  switch (source) {
    case WeatherSource::dni_and_dhi:
      return {&WeatherValues::dni, &WeatherValues::dhi};
    case WeatherSource::ghi_and_dhi:
      return {&WeatherValues::ghi, &WeatherValues::dhi};
    case WeatherSource::ghi_and_dni:
      return {&WeatherValues::ghi, &WeatherValues::dni};
    case WeatherSource::ghi_alone:
      return {&WeatherValues::ghi};
    case WeatherSource::none:
      break;
  }
  return {};
}

bool is_incomplete(const WeatherValues& values, WeatherSource source) {
  const auto quantities = needed(source);
  return std::any_of(quantities.begin(), quantities.end(),
                     [&](WeatherQuantity q) { return !(values.*q).has_value(); });
}

WeatherValues completed(const WeatherValues& values, const SunInterval& when,
                        Decomposition decomposition, double elevation_m) {
  const WeatherSource own = source_of(values);
  SUNLOAD_EXPECT(own != WeatherSource::none, "light follows from the record's own values");
  const Irradiance light = mean_light(values, when, own, decomposition, elevation_m);
  WeatherValues all = values;
  all.dni = values.dni.value_or(light.dni);
  all.dhi = light.dhi;  // with what no beam can have
  all.ghi = values.ghi.value_or(light.ghi);
  return all;
}

FilledWeather fill_missing(std::vector<DatedWeather> weather, WeatherSource source,
                           Missing missing) {
  FilledWeather filled;
  for (const auto& w : weather)
    if (is_incomplete(w.values, source)) ++filled.records;
  for (const WeatherQuantity quantity : needed(source)) {
    const auto gaps = gaps_of(weather, quantity);
    if (gaps.empty()) continue;
    const auto read = weather;
    const GapFiller filler(read, quantity);
    for (const Gap& gap : gaps) {
      const double length = read[gap.last - 1].end - read[gap.first].begin;
      filled.longest_gap_s = std::max(filled.longest_gap_s, length);
      if (missing == Missing::refuse) continue;
      for (std::size_t i = gap.first; i < gap.last; ++i)
        weather[i].values.*quantity = missing == Missing::zero              ? 0
                                      : length <= short_gap_s + same_time_s ? filler.linear(gap, i)
                                                                            : filler.by_days(i);
    }
  }
  filled.weather = std::move(weather);
  return filled;
}

WeatherLight with_sun(const std::vector<DatedWeather>& weather, const SunPath& path,
                      WeatherSource source, Decomposition decomposition, double elevation_m) {
  SUNLOAD_EXPECT(weather.size() == path.size(), "one interval per record");
  WeatherLight light;
  light.intervals.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const WeatherValues& values = weather[i].values;
    SUNLOAD_EXPECT(!is_incomplete(values, source), "missing values are filled or refused before");
    if (path[i].up_s <= 0 && values.dni.value_or(0) > 0) {
      ++light.dark_beams;
      light.dropped_dni_wh_m2 += *values.dni * path[i].length_s() / seconds_per_hour;
    }
    light.intervals.push_back(
        {path[i], mean_light(values, path[i], source, decomposition, elevation_m)});
  }
  return light;
}

Closure closure(const std::vector<DatedWeather>& weather, const SunPath& path,
                const SunEphemeris& sun) {
  SUNLOAD_EXPECT(weather.size() == path.size(), "one interval per record");
  ShiftedClosure shifted(sun);
  Closure result;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto& [dni, dhi, ghi, albedo] = weather[i].values;
    if (!dni || !dhi || !ghi || path[i].up_s <= 0) continue;
    const double residual = *dni * sine_of_sun(path[i]) + *dhi - *ghi;
    ++result.intervals;
    result.mean_ghi += *ghi;
    result.bias += residual;
    result.rms += residual * residual;
    if (std::abs(residual) > std::abs(result.worst)) {
      result.worst = residual;
      result.worst_at = path[i].sun_time;
    }
    shifted.add(path[i], *dni, *dhi - *ghi);
  }
  if (result.intervals == 0) return result;
  const auto count = static_cast<double>(result.intervals);
  result.mean_ghi /= count;
  result.bias /= count;
  result.rms = std::sqrt(result.rms / count);
  result.best_shift_s = shifted.best_s();
  result.best_rms = result.rms * shifted.best_share();
  return result;
}

double distance_m(const Site& a, const Site& b) {
  const Vec3 from = enu_direction({a.longitude_deg, a.latitude_deg});
  const Vec3 to = enu_direction({b.longitude_deg, b.latitude_deg});
  return earth_radius_m * std::atan2(norm(cross(from, to)), dot(from, to));
}

}  // namespace sunload
