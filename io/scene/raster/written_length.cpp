// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/written_length.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "io/base/file_text.h"

namespace sunload {

namespace {

/// Inches behind feet, `6"`.
std::optional<double> inches_in(const std::string& text) {
  char* end = nullptr;
  const double inches = std::strtod(text.c_str(), &end);
  const bool are_inches = end != text.c_str() && trimmed(end) == "\"" && inches >= 0;
  return are_inches ? std::optional(inches) : std::nullopt;
}

}  // namespace

std::optional<WrittenLength> written_length(const std::string& text) {
  constexpr double inches_per_foot = 12;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(value)) return {};
  const WrittenLength length{value, std::string(trimmed(end))};
  if (length.unit.empty() || length.unit == "m" || length.is_in_feet()) return length;
  if (length.unit.front() != '\'') return {};
  const auto inches = inches_in(length.unit.substr(1));
  if (!inches) return {};
  return WrittenLength{value + *inches / inches_per_foot, "'"};
}

std::string with_decimal_point(std::string text) {
  constexpr std::size_t of_thousands = 3;
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || comma == 0 ||
      text.find_first_of(".,", comma + 1) != text.npos || text.find('.') < comma)
    return text;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", comma + 1), text.size());
  const std::size_t digits = end - comma - 1;
  if (digits > 0 && digits != of_thousands) text[comma] = '.';
  return text;
}

}  // namespace sunload
