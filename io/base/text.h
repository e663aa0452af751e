// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Words and fields that commands print.
#pragma once

#include <string>

namespace sunload {

/// A field of CSV, quoted where its characters need it (RFC 4180). A text, other than a number,
/// that spreadsheets would take for a formula (it begins with = + - @, a tab or a carriage return)
/// gets an apostrophe before it, by which they take it as text.
std::string csv_text(const std::string& text);
/// Nine digits: more than float values carry. Empty for NaN.
std::string csv_number(double value);

/// A number of so many significant digits; a large one is whole, without an exponent (77230).
std::string number_text(double value, int digits);
/// A number as `format` of fmt says, but for exponents as above; "-" for NaN.
std::string cell_text(double value, const char* format);

/// A name in words: "light_load" → "light load".
std::string spaced(std::string name);
/// With a capital letter at its begin.
std::string capitalized(std::string words);
/// A name with its unit behind it: ("light_load", "kWh m-2") → "light_load_kwh_m2".
std::string with_units(const std::string& name, std::string units);

/// Units of a dataset as people write them: "kWh m-2" → "kWh/m²", "1" → "".
std::string display_units(const std::string& units);

}  // namespace sunload
