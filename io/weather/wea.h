// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Weather of Daysim and Radiance (WEA).
///
/// A header of place, latitude, longitude and time_zone (degrees, both positive WEST),
/// site_elevation and weather_data_file_units; then rows `month day hour direct diffuse` in
/// local standard time. As in Radiance's gendaymtx the hour (decimal) is the instant of the
/// sun, hence the middle of the row's stretch. Units 1: direct normal and diffuse horizontal
/// irradiance; 2: direct horizontal instead of normal; 3: illuminance, which is refused.
/// Rows have no year and may leave hours out. The format has no code for missing values.
#pragma once

#include "io/weather/text.h"

namespace sunload {

bool is_wea(const WeatherText& text);
WeatherFile read_wea(const WeatherText& text, std::optional<Stamp> stamp);

}  // namespace sunload
