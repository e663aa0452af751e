// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Plain CSV with named columns, separated by comma, semicolon or tab.
///
///     # latitude_deg: 49.75        (optional comments: also longitude_deg, elevation_m,
///     # utc_offset: +01:00          place, and the zone of stamps that have no offset)
///     time,dni_w_m2,dhi_w_m2,ghi_w_m2
///     2026-06-21T12:00,812,95,
///
/// `time` is ISO 8601, with `Z` or an offset in all rows or in none; instead of it there may
/// be `date` and `time` columns. Of dni_w_m2, dhi_w_m2, ghi_w_m2 (or dni, dhi, ghi) and of albedo
/// what is there is read; other columns are left alone. Empty fields, nan, na and codes below
/// zero (-999) are missing.
#pragma once

#include "io/weather/text.h"

namespace sunload {

bool is_weather_csv(const WeatherText& text);
/// InputError without `stamp`: nothing in the file says what its stamps name.
WeatherFile read_weather_csv(const WeatherText& text, std::optional<Stamp> stamp);

}  // namespace sunload
