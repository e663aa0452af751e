// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// TMY3 and files in its style: a line of the station, a line of column names.
///
/// Wilcox & Marion (2008), Users Manual for TMY3 Data Sets, NREL/TP-581-43156: local standard
/// time, stamps at the end of the stretch, 24:00 the end of a day, missing values -9900.
/// Columns are found by name, so sub-hourly measurements with fewer of them are read too.
#pragma once

#include "io/weather/text.h"

namespace sunload {

bool is_tmy3(const WeatherText& text);
WeatherFile read_tmy3(const WeatherText& text, std::optional<Stamp> stamp);

}  // namespace sunload
