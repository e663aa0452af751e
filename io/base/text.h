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

/// Units of a dataset as people write them: "kWh m-2" → "kWh/m²", "1" → "".
std::string display_units(const std::string& units);

}  // namespace sunload
