// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// UTC to the time scales of astronomy.
#include <cmath>

#include "geo/base/units.h"
#include "geo/time/ephemeris.h"
#include "geo/time/time.h"
#include "geo/time/ut1_table.h"

namespace sunload {

namespace {

constexpr double julian_day_of_unix_epoch = 2440587.5;
constexpr double tt_minus_tai_s = 32.184;  // IAU 1991, recommendation IV

JulianDate julian_date(UnixTime t) {
  const double days = std::floor(t / seconds_per_day);
  return {julian_day_of_unix_epoch + days, (t - days * seconds_per_day) / seconds_per_day};
}

JulianDate later(JulianDate date, double seconds) {
  return {date.day, date.fraction + seconds / seconds_per_day};
}

UnixTime half_year_begin(int half_years) {
  constexpr int july = 7;
  return utc_from_calendar({.year = ut1_table::first_year + half_years / 2,
                            .month = half_years % 2 == 0 ? 1 : july,
                            .day = 1});
}

constexpr int last_half_year = static_cast<int>(ut1_table::ut1_minus_tai_s.size()) - 1;

double table_ut1_minus_utc_s(UnixTime utc, double tai_minus_utc) {
  const CivilTime date = calendar_from_utc(utc);
  constexpr int july = 7;
  const int k = 2 * (date.year - ut1_table::first_year) + (date.month >= july ? 1 : 0);
  if (k < 0 || k >= last_half_year) return 0;
  const double begin = half_year_begin(k), end = half_year_begin(k + 1);
  const double share = (utc - begin) / (end - begin);
  const auto i = static_cast<std::size_t>(k);
  return std::lerp(ut1_table::ut1_minus_tai_s[i], ut1_table::ut1_minus_tai_s[i + 1], share) +
         tai_minus_utc;
}

}  // namespace

TimeScales time_scales(UnixTime utc, Ut1 ut1) {
  const JulianDate date = julian_date(utc);
  const double tai_minus_utc = tai_minus_utc_s(utc);
  const double ut1_minus_utc = ut1 == Ut1::table ? table_ut1_minus_utc_s(utc, tai_minus_utc) : 0;
  return {date, later(date, ut1_minus_utc), later(date, tai_minus_utc + tt_minus_tai_s)};
}

TimeScales time_scales_with_tt_minus_ut1(UnixTime ut1, double tt_minus_ut1_s) {
  const JulianDate date = julian_date(ut1);
  return {date, date, later(date, tt_minus_ut1_s)};
}

bool ut1_table_covers(UnixTime utc) { return utc >= half_year_begin(0) && utc < ut1_table_end(); }

UnixTime ut1_table_end() { return half_year_begin(last_half_year); }

}  // namespace sunload
