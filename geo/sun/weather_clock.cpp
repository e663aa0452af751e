// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/weather_clock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>

#include "geo/base/units.h"
#include "geo/sky/irradiance.h"

namespace sunload {

namespace {

/// Shorter records are joined: nothing below some minutes is told.
constexpr double row_s = 10 * seconds_per_minute;
/// Of shifts that are tried; a parabola finds what lies between.
constexpr double shift_step_s = 15 * seconds_per_minute;
constexpr int most_steps = 8;
/// A day's light and that of the model are as two vectors of this cosine. Clouds, and hills of 25
/// degrees, leave less; what still passes they shift by less than half an hour.
constexpr double cosine_of_clear = 0.99;
/// Brightest records of days with less tell of clouds alone [W m-2].
constexpr double least_light_w_m2 = 50;
/// A row with more than this share of the day's most has neighbours, or the day is not whole.
constexpr double share_at_edges = 0.3;
constexpr std::size_t fewest_days = 10;
constexpr double half_day_s = seconds_per_day / 2;

/// What the model is of.
enum class Light { global, beam_and_sky };

struct LightRow {
  UnixTime begin = 0, end = 0;
  double light = 0;  ///< mean [W m-2]

  double length_s() const { return end - begin; }
  UnixTime middle() const { return (begin + end) / 2; }
};
using LightRows = std::vector<LightRow>;

std::optional<double> light_of(const WeatherValues& values, Light light) {
  if (light == Light::global) return values.ghi;
  if (!values.dni || !values.dhi) return {};
  return *values.dni + *values.dhi;
}

/// Measured global light tells of no sun of the file's maker; it is taken where most records have
/// it.
Light light_in(const std::vector<DatedWeather>& weather) {
  const auto with = [&](Light light) {
    return std::count_if(weather.begin(), weather.end(), [&](const DatedWeather& w) {
      return light_of(w.values, light).has_value();
    });
  };
  return 2 * with(Light::global) >= with(Light::beam_and_sky) ? Light::global : Light::beam_and_sky;
}

LightRows rows_of(const std::vector<DatedWeather>& weather, Light of) {
  LightRows rows;
  for (const DatedWeather& w : weather) {
    const auto light = light_of(w.values, of);
    if (!light) continue;
    const bool goes_on = !rows.empty() && rows.back().length_s() < row_s - same_time_s &&
                         std::abs(w.begin - rows.back().end) <= same_time_s;
    if (!goes_on) {
      rows.push_back({w.begin, w.end, *light});
      continue;
    }
    LightRow& row = rows.back();
    row.light = (row.light * row.length_s() + *light * (w.end - w.begin)) / (w.end - row.begin);
    row.end = w.end;
  }
  return rows;
}

/// Clear light of the sun's height: Haurwitz (1945); the beam of Meinel & Meinel (1976), Applied
/// solar energy, with a tenth of the former as light of the sky.
double clear_light(double elevation_deg, Light light) {
  if (elevation_deg <= 0) return 0;
  const double global = haurwitz(elevation_deg);
  if (light == Light::global) return global;
  return solar_constant * std::pow(0.7, std::pow(relative_air_mass(elevation_deg), 0.678)) +
         0.1 * global;
}

/// The model's light about a day's noon.
class ClearDay {
 public:
  ClearDay(const SunEphemeris& sun, UnixTime mean_noon, Light light) : begin_(mean_noon - reach_s) {
    double weighted = 0, sum = 0;
    for (std::size_t i = 0; i + 1 < until_.size(); ++i) {
      const double middle_s = (static_cast<double>(i) + 0.5) * row_s;
      const double light_here = clear_light(sun(begin_ + middle_s).elevation_deg, light);
      until_[i + 1] = until_[i] + light_here * row_s;
      if (std::abs(middle_s - reach_s) > half_day_s) continue;
      weighted += light_here * middle_s;
      sum += light_here;
    }
    noon_ = sum > 0 ? begin_ + weighted / sum : mean_noon;
  }

  UnixTime noon() const { return noon_; }
  /// Over a row, were the sun so much later.
  double mean(const LightRow& row, double shift_s) const {
    return (until(row.end - shift_s) - until(row.begin - shift_s)) / row.length_s();
  }

 private:
  double until(UnixTime time) const {
    const double place =
        std::clamp((time - begin_) / row_s, 0.0, static_cast<double>(until_.size() - 2));
    const auto i = static_cast<std::size_t>(place);
    return until_[i] + (place - static_cast<double>(i)) * (until_[i + 1] - until_[i]);
  }

  /// Half a day, and all shifts.
  static constexpr double reach_s = half_day_s + 2 * most_steps * shift_step_s;
  UnixTime begin_, noon_ = 0;
  std::array<double, static_cast<std::size_t>(2 * reach_s / row_s) + 1> until_{};
};

/// Sums over rows of the model and the records.
struct Products {
  double model2 = 0, product = 0, light2 = 0;

  double cosine() const {
    return model2 > 0 && light2 > 0 ? product / std::sqrt(model2 * light2) : 0;
  }
  /// What a factor times the model leaves.
  double squares(double factor) const {
    return factor * factor * model2 - 2 * factor * product + light2;
  }
};

template <class Iterator>
Products products(Iterator first, Iterator last, const ClearDay& day, double shift_s) {
  Products sums;
  for (; first != last; ++first) {
    const double model = day.mean(*first, shift_s);
    sums.model2 += model * model;
    sums.product += model * first->light;
    sums.light2 += first->light * first->light;
  }
  return sums;
}

/// Where `badness` of a shift is least, about `middle_s`; none where it is at the end of what is
/// tried.
template <class Badness>
std::optional<double> best_shift(double middle_s, const Badness& badness) {
  std::array<double, 2 * most_steps + 1> at{};
  for (std::size_t i = 0; i < at.size(); ++i)
    at[i] = badness(middle_s + (static_cast<double>(i) - most_steps) * shift_step_s);
  const auto best = static_cast<std::size_t>(std::min_element(at.begin(), at.end()) - at.begin());
  if (best == 0 || best + 1 == at.size()) return {};
  const double before = at[best - 1], behind = at[best + 1];
  const double bend = before - 2 * at[best] + behind;
  const double rest = bend > 0 ? 0.5 * (before - behind) / bend : 0;
  return middle_s + (static_cast<double>(best) - most_steps + rest) * shift_step_s;
}

struct DayShift {
  UnixTime noon = 0;
  double whole = 0, morning = 0, evening = 0;
};

/// Absent where the day is not clear.
std::optional<DayShift> shift_of(LightRows::const_iterator first, LightRows::const_iterator last,
                                 const ClearDay& day, double middle_s) {
  const auto whole =
      best_shift(middle_s, [&](double s) { return -products(first, last, day, s).cosine(); });
  if (!whole) return {};
  const Products fit = products(first, last, day, *whole);
  if (fit.cosine() < cosine_of_clear) return {};
  const double factor = fit.product / fit.model2;
  const auto noon = std::partition_point(
      first, last, [&](const LightRow& row) { return row.middle() < day.noon() + *whole; });
  const auto flank = [&](auto from, auto to) {
    return best_shift(*whole, [&](double s) { return products(from, to, day, s).squares(factor); });
  };
  const auto morning = flank(first, noon), evening = flank(noon, last);
  if (!morning || !evening) return {};
  return DayShift{day.noon(), *whole, *morning, *evening};
}

/// Rows that are left out have no light, where that of their neighbours says so.
bool is_whole(LightRows::const_iterator first, LightRows::const_iterator last, UnixTime begin,
              UnixTime end) {
  if (first == last) return false;
  const double most = std::max_element(first, last, [](const LightRow& a, const LightRow& b) {
                        return a.light < b.light;
                      })->light;
  if (most < least_light_w_m2) return false;
  UnixTime until = begin;
  double before = 0;
  for (auto row = first;; ++row) {
    const UnixTime next = row == last ? end : row->begin;
    const double behind = row == last ? 0 : row->light;
    const bool is_gap = next - until > std::max(row_s, first->length_s()) / 2;
    if (is_gap && std::max(before, behind) > share_at_edges * most) return false;
    if (row == last) return true;
    until = row->end;
    before = row->light;
  }
}

/// To full hours, from the middle of all light over the hours of the day.
double coarse_shift_s(const LightRows& rows, double to_solar_s) {
  constexpr double small_s = 1.5 * seconds_per_hour;
  std::complex<double> sum;
  for (const LightRow& row : rows)
    sum += std::polar(
        row.light * row.length_s(),
        2 * pi * std::fmod(row.middle() + to_solar_s, seconds_per_day) / seconds_per_day);
  if (std::abs(sum) == 0) return 0;
  const double later_s = std::arg(-sum) / (2 * pi) * seconds_per_day;
  return std::abs(later_s) <= small_s ? 0
                                      : std::round(later_s / seconds_per_hour) * seconds_per_hour;
}

std::vector<DayShift> shifts_of(const LightRows& rows, Light light, const SunEphemeris& sun,
                                double longitude_deg) {
  std::vector<DayShift> shifts;
  if (rows.empty()) return shifts;
  const double to_solar_s = longitude_deg / degrees_of_sun_per_hour * seconds_per_hour;
  const double coarse_s = coarse_shift_s(rows, to_solar_s);
  const double first_day =
      std::floor((rows.front().begin - coarse_s + to_solar_s) / seconds_per_day);
  UnixTime begin = first_day * seconds_per_day - to_solar_s + coarse_s;
  auto row = rows.begin();
  while (row != rows.end()) {
    const UnixTime end = begin + seconds_per_day;
    const auto next =
        std::find_if(row, rows.end(), [&](const LightRow& each) { return each.middle() >= end; });
    if (is_whole(row, next, begin, end)) {
      const ClearDay day(sun, begin - coarse_s + half_day_s, light);
      if (const auto shift = shift_of(row, next, day, coarse_s)) shifts.push_back(*shift);
    }
    row = next;
    begin = end;
  }
  return shifts;
}

Quartiles quartiles_of(const std::vector<DayShift>& shifts, double DayShift::*part) {
  if (shifts.empty()) return {};
  std::vector<double> sorted;
  sorted.reserve(shifts.size());
  for (const DayShift& shift : shifts) sorted.push_back(shift.*part);
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(
        std::lround(share * static_cast<double>(sorted.size() - 1)))];
  };
  return {at(0.25), at(0.5), at(0.75)};
}

template <class Choice>
ClockShift shift_over(const std::vector<DayShift>& all, const Choice& choice) {
  std::vector<DayShift> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [&](const DayShift& shift) { return choice(shift.noon); });
  return {some.size(), quartiles_of(some, &DayShift::whole), quartiles_of(some, &DayShift::morning),
          quartiles_of(some, &DayShift::evening)};
}

/// Months in which clocks are advanced wherever they are at some time of the year, on that side of
/// the equator.
bool is_of_summer_time(UnixTime time, double latitude_deg) {
  const int month = calendar_from_utc(time).month;
  return latitude_deg >= 0 ? month >= 4 && month <= 9 : month <= 2 || month >= 11;
}

/// Months in which none is.
bool is_of_standard_time(UnixTime time, double latitude_deg) {
  const int month = calendar_from_utc(time).month;
  return latitude_deg >= 0 ? month <= 2 || month == 12 : month >= 5 && month <= 8;
}

}  // namespace

double Quartiles::surely() const {
  if (lower > 0) return lower;
  return upper < 0 ? upper : 0;
}

bool ClockShift::exceeds(double length_s) const {
  constexpr double telling_share = 0.4;  // hills and fog leave none in the morning, or the evening
  const double sign = whole.median < 0 ? -1 : 1;
  const double surely =
      std::min({sign * whole.surely(), sign * morning.surely(), sign * evening.surely()});
  return days >= fewest_days && sign * whole.median >= length_s &&
         surely >= telling_share * length_s;
}

bool WeatherClock::has_summer_time() const {
  constexpr double tolerance_s = 20 * seconds_per_minute;
  if (summer.days < fewest_days || winter.days < fewest_days) return false;
  const double advanced_s = summer.whole.median - winter.whole.median;
  const double flank_s = std::min(summer.morning.median - winter.morning.median,
                                  summer.evening.median - winter.evening.median);
  return std::abs(advanced_s - seconds_per_hour) <= tolerance_s &&
         flank_s >= seconds_per_hour / 2 && summer.whole.lower > winter.whole.upper;
}

WeatherClock clock_of(const std::vector<DatedWeather>& weather, const SunEphemeris& sun,
                      double latitude_deg, double longitude_deg) {
  const Light light = light_in(weather);
  const auto shifts = shifts_of(rows_of(weather, light), light, sun, longitude_deg);
  return {shift_over(shifts, [](UnixTime) { return true; }),
          shift_over(shifts, [&](UnixTime at) { return is_of_summer_time(at, latitude_deg); }),
          shift_over(shifts, [&](UnixTime at) { return is_of_standard_time(at, latitude_deg); })};
}

}  // namespace sunload
