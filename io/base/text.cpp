// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace sunload {

namespace {

bool is_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// OWASP, CSV Injection.
bool is_formula(const std::string& text) {
  return !text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos &&
         !is_number(text);
}

}  // namespace

std::string csv_text(const std::string& given) {
  std::string text = (is_formula(given) ? "'" : "") + given;
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

namespace {

/// 7.723e+04 as 77230, and +1e+02 as +100.
std::string without_exponent(std::string text) {
  if (text.find("e+") == std::string::npos) return text;
  const char* const format = text.front() == '+' ? "{:+.0f}" : "{:.0f}";
  return fmt::format(fmt::runtime(format), std::strtod(text.c_str(), nullptr));
}

}  // namespace

std::string number_text(double value, int digits) {
  return without_exponent(fmt::format("{:.{}g}", value, digits));
}

std::string cell_text(double value, const char* format) {
  if (std::isnan(value)) return "-";
  return without_exponent(fmt::format(fmt::runtime(format), value));
}

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string capitalized(std::string words) {
  if (!words.empty())
    words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  return words;
}

std::string with_units(const std::string& name, std::string units) {
  if (units == "1" || units.empty()) return name;
  for (char& c : units)
    c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::erase(units, '-');
  return name + "_" + units;
}

std::string display_units(const std::string& units) {
  if (units == "1") return {};
  if (units == "percent") return "%";
  if (units == "m2") return "m²";
  // Light of a place for each square metre of what gives it.
  if (units == "kWh m-4") return "kWh/m² per m²";
  if (units == "klx h m-2") return "klx h per m²";
  if (units == "W m-2 sr-1") return "W/(m² sr)";
  const auto per_area = units.find(" m-2");
  return per_area == std::string::npos ? units : units.substr(0, per_area) + "/m²";
}

}  // namespace sunload
