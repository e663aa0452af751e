// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Equinoxes and solstices.
#pragma once

#include <string>

#include "geo/time/time.h"

namespace sunload {

/// Where the sun stands on the ecliptic, by quarters of the year.
enum class Season { march_equinox, june_solstice, september_equinox, december_solstice };

/// When the sun's apparent geocentric longitude is 0°, 90°, 180° or 270° in a year of the
/// calendar, from the ephemeris of geo/sun/sun.h: within some seconds for 1900 … 2100.
UnixTime season_instant(Season season, int year);

/// Civil date (midnight) of that instant in a zone: it differs between zones, and years.
CivilTime season_date(Season season, int year, const TimeZone& zone);

/// A day named as in `june_solstice 2026`, also `summer_solstice` and `winter_solstice`,
/// which the sign of the latitude tells apart.
struct NamedDay {
  /// The first four are the same everywhere; summer and winter depend on the hemisphere.
  enum class Name {
    march_equinox,
    june_solstice,
    september_equinox,
    december_solstice,
    summer_solstice,
    winter_solstice
  };
  Name name = Name::march_equinox;
  int year = 2000;

  bool depends_on_hemisphere() const { return name >= Name::summer_solstice; }
};

/// Whether a text is meant as the name of a day: it begins with a letter.
bool is_day_name(const std::string& text);
/// Throws InputError (without place) for an unknown name and a missing year.
NamedDay parse_named_day(const std::string& text);
/// `latitude_deg` matters where the name depends on the hemisphere; 0 counts as north.
CivilTime civil_date(const NamedDay& day, const TimeZone& zone, double latitude_deg);

}  // namespace sunload
