// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A line of a table of numbers as text, by whatever program: fields divided by commas, semicolons,
/// tabs or blanks; # begins a comment.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "geo/base/check.h"

namespace sunload {

std::vector<std::string_view> table_fields(std::string_view line);
/// Finite, of all of the field, a sign of either kind; or nothing.
std::optional<double> table_number(std::string_view field);

/// Semicolons and commas in one line: `1,5;2,5` is two numbers of some programs and four here.
bool may_have_decimal_commas(std::string_view line);
/// What is said of such a row.
InputError decimal_commas(const Where& row);

}  // namespace sunload
