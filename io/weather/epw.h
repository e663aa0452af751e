// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// EnergyPlus weather (EPW).
///
/// U.S. Department of Energy, EnergyPlus Auxiliary Programs, "EnergyPlus Weather File (EPW)
/// Data Dictionary". Hour 1 is 00:00 to 01:00 local standard time, whatever the minute field
/// says (files have 0, 30 and 60); with n records per hour the k-th one of an hour is its
/// k-th part. Missing irradiances are 9999.
#pragma once

#include "io/weather/text.h"

namespace sunload {

bool is_epw(const WeatherText& text);
/// Throws InputError for a file that is not whole: hours left out, or another end than the
/// header's DATA PERIODS says. 29 February may be left out.
WeatherFile read_epw(const WeatherText& text);

}  // namespace sunload
