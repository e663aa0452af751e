// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/text.h"

#include <fmt/format.h>

#include <cmath>

namespace sunload {

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csv_number(double value) {
  return std::isnan(value) ? std::string() : fmt::format("{:.9g}", value);
}

std::string display_units(const std::string& units) {
  if (units == "1") return {};
  const auto per_area = units.find(" m-2");
  return per_area == std::string::npos ? units : units.substr(0, per_area) + "/m²";
}

}  // namespace sunload
