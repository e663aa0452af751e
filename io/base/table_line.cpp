// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/table_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sunload {

namespace {

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

}  // namespace

std::vector<std::string_view> table_fields(std::string_view line) {
  constexpr std::string_view separators = ",; \t\r";
  line = without_comment(line);
  std::vector<std::string_view> fields;
  while (true) {
    const auto begin = line.find_first_not_of(separators);
    if (begin == line.npos) return fields;
    const auto end = std::min(line.find_first_of(separators, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

std::optional<double> table_number(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0;
  const auto result = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool is_whole = result.ec == std::errc() && result.ptr == field.data() + field.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool may_have_decimal_commas(std::string_view line) {
  line = without_comment(line);
  return line.find(';') != line.npos && line.find(',') != line.npos;
}

InputError decimal_commas(const Where& row) {
  return {row, "semicolons and commas stand in one row",
          "a decimal comma would make two numbers of one", "write decimal points"};
}

}  // namespace sunload
