// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Civil time, UTC, and the time scales of astronomy.
#pragma once

#include <cstdint>
#include <string>

namespace sunload {

/// Instant: seconds since 1970-01-01T00:00:00Z, leap seconds not counted.
using UnixTime = double;

/// A wall-clock reading without zone.
struct CivilTime {
  int year = 1970, month = 1, day = 1;
  int hour = 0, minute = 0;
  double second = 0;
};

/// What happened to a wall-clock reading at a change of the clocks.
enum class ClockChange { none, skipped, repeated };

/// A wall-clock reading as an instant.
struct ResolvedTime {
  UnixTime utc = 0;
  ClockChange change =
      ClockChange::none;  ///< skipped: moved forward; repeated: the first of the two
};

/// A named zone (IANA), `UTC`, or a fixed offset `+hh:mm`. Right after 2037 too.
class TimeZone {
 public:
  /// Throws InputError for a name that the system's database does not know.
  explicit TimeZone(const std::string& name);
  const std::string& name() const { return name_; }
  ResolvedTime utc_from_civil(const CivilTime& civil) const;
  CivilTime civil_from_utc(UnixTime utc) const;
  /// Offset from UTC in force at an instant [s], east positive.
  double offset_s(UnixTime utc) const;
  /// Offset of standard (winter) time in that year [s]: what weather files use.
  double standard_offset_s(int year) const;

 private:
  std::string name_;
  const void* zone_ = nullptr;  ///< owned by the time zone library
  double fixed_offset_s_ = 0;
};

/// "2026-06-21T12:00:00Z", rounded to the second (fractions shown where not zero).
std::string iso_utc(UnixTime utc);
/// An offset from UTC [s], to the minute, as a TimeZone takes it: "+02:00".
std::string offset_text(double offset_s);
/// "2026-06-21 14:00 +02:00" in that zone.
std::string iso_local(UnixTime utc, const TimeZone& zone);

/// A date or a date with time as written in a study.
struct ParsedTime {
  CivilTime civil;
  bool has_time = false;
  bool has_offset = false;  ///< "Z" or "+02:00" was written
  double offset_s = 0;
};
/// Reads `2026-06-21`, `2026-06-21T12:00`, `2026-06-21 12:00:30+02:00`, `…Z`.
/// Throws InputError (without place) for anything else and for impossible dates.
ParsedTime parse_time(const std::string& text);
/// `HH:MM` or `HH:MM:SS`, 24:00 allowed: seconds since midnight.
double parse_time_of_day(const std::string& text);

UnixTime utc_from_calendar(const CivilTime& utc);
CivilTime calendar_from_utc(UnixTime utc);
/// 1 = 1 January.
int day_of_year(const CivilTime& date);

/// UT1−UTC: `table` is the bundled table (0 outside of it), `zero` is UT1 = UTC.
enum class Ut1 { table, zero };

/// Two-part Julian dates: the sum loses nothing.
struct JulianDate {
  double day = 0, fraction = 0;
};
/// One instant in UTC, UT1 and terrestrial time.
struct TimeScales {
  JulianDate utc, ut1, tt;
};
TimeScales time_scales(UnixTime utc, Ut1 ut1);
/// As above with the given TT−UT1 [s], as reference tables state it.
TimeScales time_scales_with_tt_minus_ut1(UnixTime ut1, double tt_minus_ut1_s);

/// False where the bundled UT1 table does not reach: UT1 is then taken for UTC, which leap seconds
/// keep within 0.9 s of it (0.004° of the hour angle) until 2035.
bool ut1_table_covers(UnixTime utc);
UnixTime ut1_table_end();

}  // namespace sunload
