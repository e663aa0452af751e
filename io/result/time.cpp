// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/time.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geo/base/check.h"

namespace sunload {
namespace {

UnixTime utc_of(const std::string& time, const TimeZone& zone) {
  const auto parsed = parse_time(time);
  if (parsed.has_offset) return utc_from_calendar(parsed.civil) - parsed.offset_s;
  return zone.utc_from_civil(parsed.civil).utc;
}

/// Only the time of day of an ISO time that shares the date of another.
std::string clock(const std::string& time, const std::string& other) {
  constexpr std::size_t date_letters = 10, clock_begin = 11;
  if (time.substr(0, date_letters) != other.substr(0, date_letters)) return time;
  auto text = time.substr(clock_begin);
  text = text.substr(0, text.find_first_of(" Z"));
  constexpr std::size_t minutes_end = 5;
  return text.substr(minutes_end) == ":00" ? text.substr(0, minutes_end) : text;
}

/// Begin, end and the share of it that is chosen.
std::vector<std::array<double, 3>> chosen_intervals(const ResultReader& result) {
  const auto bounds = result.doubles("time_bounds");
  const auto shares = result.chosen_shares();
  std::vector<std::array<double, 3>> chosen;
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (shares[k] > 0) chosen.push_back({bounds[2 * k], bounds[2 * k + 1], shares[k]});
  return chosen;
}

}  // namespace

TimeZone result_zone(const ResultReader& result) {
  const auto name = result.text_attribute("timezone");
  return TimeZone(name.empty() ? "UTC" : name);
}

std::string series_step(const ResultReader& result) { return result.text_attribute("series_step"); }

bool has_no_dates(const ResultReader& result) {
  return result.number_attribute("time_is_synthetic") > 0;
}

bool has_long_steps(const ResultReader& result) {
  const std::string step = series_step(result);
  return step == "day" || step == "month";
}

std::size_t brightest_interval(const ResultReader& result) {
  auto shares = result.chosen_shares();
  // Of a result that lacks batches only rows that are there.
  if (!result.lacking().empty() && result.has("power_sun")) {
    const auto power = result.doubles("power_sun");
    const std::size_t bands = shares.empty() ? 1 : power.size() / shares.size();
    for (std::size_t k = 0; k < shares.size(); ++k)
      if (std::isnan(power[k * bands])) shares[k] = 0;
  }
  const auto largest = [&](const std::vector<double>& values) {
    std::optional<std::size_t> place;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (shares[k] > 0 && (!place || values[k] > values[*place])) place = k;
    return place.value_or(0);
  };
  const auto ghi = result.doubles("ghi");
  const std::size_t brightest = largest(ghi);
  return brightest < ghi.size() && ghi[brightest] > 0 ? brightest
                                                      : largest(result.doubles("sun_elevation"));
}

std::size_t interval_at(const ResultReader& result, const std::string& time) {
  const auto zone = result_zone(result);
  const auto utc = utc_of(time, zone);
  const auto bounds = result.doubles("time_bounds");
  for (std::size_t i = 0; 2 * i + 1 < bounds.size(); ++i)
    if (bounds[2 * i] <= utc && utc < bounds[2 * i + 1]) return i;
  if (!bounds.empty() && utc == bounds.back()) return bounds.size() / 2 - 1;
  const auto covered =
      bounds.empty() ? std::string("no time at all")
                     : iso_local(bounds.front(), zone) + " … " + iso_local(bounds.back(), zone);
  throw InputError({result.path()}, "no interval holds " + time,
                   "the result covers " + covered + ", with its gaps", "choose a time within");
}

std::string interval_in_words(const ResultReader& result, std::size_t interval) {
  const auto zone = result_zone(result);
  const auto sun = result.doubles("time").at(interval);
  const auto bounds = result.row("time_bounds", interval);
  const auto local_sun = iso_local(sun, zone);
  return fmt::format(
      "{} for {} … {} ({} for {} … {})", local_sun, clock(iso_local(bounds.at(0), zone), local_sun),
      clock(iso_local(bounds.at(1), zone), local_sun), iso_utc(sun),
      clock(iso_utc(bounds[0]), iso_utc(sun)), clock(iso_utc(bounds[1]), iso_utc(sun)));
}

std::string row_in_words(const ResultReader& result, std::size_t row) {
  if (has_no_dates(result))
    return fmt::format("sun {} of {}: azimuth {:.6g}°, elevation {:.6g}°", row + 1,
                       result.shape("time").front(), result.doubles("sun_azimuth").at(row),
                       result.doubles("sun_elevation").at(row));
  if (series_step(result).empty()) {
    const bool is_up = result.doubles("sun_elevation").at(row) > 0;
    return (is_up ? "sun of " : "") + interval_in_words(result, row);
  }
  const auto zone = result_zone(result);
  const auto bounds = result.row("time_bounds", row);
  const std::string begin = iso_local(bounds.at(0), zone);
  return "mean of " + begin + " … " + clock(iso_local(bounds.at(1), zone), begin);
}

std::string period_in_words(const ResultReader& result) {
  if (result.is_derived()) return result.text_attribute("period");
  const auto bounds = result.doubles("time_bounds");
  const auto shares = result.chosen_shares();
  std::vector<TimeSpan> intervals;
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (shares[k] > 0) intervals.push_back({bounds[2 * k], bounds[2 * k + 1]});
  if (intervals.empty()) return "no intervals";
  if (has_no_dates(result)) return "sun positions without a date";
  const auto zone = result_zone(result);
  const auto chosen = result.chosen().words();
  const bool is_one_stretch =
      std::adjacent_find(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) {
        return a[1] < b[0];
      }) == intervals.end();
  const std::string words = is_one_stretch
                                ? fmt::format("{} … {}", iso_local(intervals.front()[0], zone),
                                              iso_local(intervals.back()[1], zone))
                                : days_in_words(intervals, zone);
  return chosen.empty() ? words : chosen + ": " + words;
}

bool have_same_times(const ResultReader& base, const ResultReader& variant) {
  return chosen_intervals(base) == chosen_intervals(variant);
}

std::string different_times_in_words(const ResultReader& base, const ResultReader& variant) {
  if (have_same_times(base, variant)) return {};
  const std::string of_base = period_in_words(base), of_variant = period_in_words(variant);
  if (of_base == of_variant)
    return fmt::format("the two results divide {} into different intervals, {} and {}", of_base,
                       chosen_intervals(base).size(), chosen_intervals(variant).size());
  return "the two results cover different intervals of time: " + of_base + " and " + of_variant;
}

std::vector<double> interval_lengths(const ResultReader& result) {
  const auto bounds = result.doubles("time_bounds");
  std::vector<double> lengths(bounds.size() / 2);
  for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = bounds[2 * i + 1] - bounds[2 * i];
  return lengths;
}

}  // namespace sunload
