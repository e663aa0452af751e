// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON texts of users: parsed with the place of an error, guarded against bombs.
#pragma once

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace sunload {

/// Where the first value of the text ends (npos: it does not). Throws InputError where
/// values are nested deeper than any real file does, before a tree of them is built.
std::size_t first_json_value_end(const std::string& file, std::string_view text);

/// The tree of one JSON text; throws InputError with file:line:column.
nlohmann::json parse_json(const std::string& file, std::string_view text, int first_line = 1);

/// null for NaN.
inline nlohmann::ordered_json json_number(double value) {
  return std::isnan(value) ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(value);
}

}  // namespace sunload
