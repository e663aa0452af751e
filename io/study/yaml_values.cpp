// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a YamlMap: numbers, texts, words, and lists of them.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/base/file_text.h"
#include "io/base/key_names.h"
#include "io/study/yaml_map.h"

namespace sunload {

namespace {

using Kind = YamlNode::Kind;

constexpr double largest_exact_integer = 9007199254740992.0;  // 2^53

/// A decimal number with nothing around it; neither inf nor nan.
std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.empty() || text.find_first_not_of("0123456789.eE+-") != text.npos) return {};
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return {};
  return value;
}

/// What a number beside this word is multiplied by for a key: points of the compass are signs of
/// latitudes and longitudes.
std::optional<double> factor_for_key(std::string_view word, const std::string& key,
                                     const std::string& unit) {
  const std::string_view compass = key.starts_with("latitude")    ? "NS"
                                   : key.starts_with("longitude") ? "EW"
                                                                  : "";
  std::string_view letter = word;
  if (letter.starts_with("°")) letter.remove_prefix(std::string_view("°").size());
  if (letter.size() == 1 && compass.find(letter) != compass.npos)
    return letter == "S" || letter == "W" ? -1 : 1;
  return factor_to_unit(word, unit);
}

/// Of a number and a unit after it, or a point of the compass before or after it.
std::string hint_of_unit(std::string_view text, const std::string& key) {
  const std::string unit = unit_of_key(key);
  const std::string is_in = unit.empty() ? "" : ", it is in " + unit;
  const auto begin = text.find_first_of("0123456789.+-");
  if (begin == text.npos) return "";
  auto end = std::min(text.find_first_not_of("0123456789.eE+-", begin), text.size());
  // "70E" has no exponent.
  if (unit == "degrees" && end > begin + 1 && text[end - 1] == 'E') --end;
  const std::string_view head = text.substr(begin, end - begin);
  const std::string_view before = trimmed(text.substr(0, begin)), after = trimmed(text.substr(end));
  const auto value = parse_number(head);
  if (value && before.empty() != after.empty()) {
    const auto factor = factor_for_key(before.empty() ? after : before, key, unit);
    const bool has_two_signs = factor == -1 && (head.starts_with('-') || head.starts_with('+'));
    if (factor && !has_two_signs)
      return "write " +
             (*factor == 1 ? std::string(head) : fmt::format("{:.10g}", *factor * *value)) +
             " alone" + is_in;
    if (unit.empty() && is_plain_unit(after)) return "write " + std::string(head) + " alone";
  }
  if (unit == "degrees") return "write decimal degrees alone; south and west are below 0";
  return unit.empty() ? "" : "write a number alone" + is_in;
}

std::string number_hint(const YamlNode& node, const std::string& key) {
  if (node.style == YamlNode::Style::quoted && parse_number(node.text)) {
    return "leave out the quotes";
  }
  const auto comma = node.text.find(',');
  if (comma != node.text.npos) {
    std::string with_point = node.text;
    with_point[comma] = '.';
    if (parse_number(with_point)) return "write " + with_point;
  }
  return hint_of_unit(node.text, key);
}

std::string range_text(const Range& range, const std::string& key) {
  const std::string unit = unit_of_key(key);
  const std::string low = range.low_end == Range::Low::excluded ? "above " : "from ";
  return fmt::format("must be {}{} up to {}{}", low, range.low, range.high,
                     unit.empty() ? "" : " " + unit);
}

std::string list_of(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::optional<double> YamlMap::to_number(const YamlNode& node, const std::string& key,
                                         const Range& range) {
  const auto refuse = [&](const std::string& what, const std::string& why,
                          const std::string& hint) {
    reading_.problem(node.where, path(key) + ": " + what, why, hint);
    return std::optional<double>();
  };
  if (node.kind != Kind::text) {
    return refuse(std::string("must be a number, not ") + kind_name(node.kind), "", "");
  }
  const auto value = node.style == YamlNode::Style::plain ? parse_number(node.text) : std::nullopt;
  if (!value) return refuse("'" + node.text + "' is no number", "", number_hint(node, key));
  const bool too_low =
      range.low_end == Range::Low::excluded ? !(*value > range.low) : !(*value >= range.low);
  if (too_low || !(*value <= range.high)) {
    return refuse(node.text + " is out of range", range_text(range, key), range.hint);
  }
  return value;
}

std::optional<double> YamlMap::number(const std::string& key, const Range& range) {
  const YamlNode* node = ask(key);
  return node ? to_number(*node, key, range) : std::nullopt;
}

double YamlMap::number(const std::string& key, const Range& range, double absent) {
  return number(key, range).value_or(absent);
}

std::int64_t YamlMap::integer(const std::string& key, std::int64_t low, std::int64_t high,
                              std::int64_t absent) {
  const YamlNode* node = ask(key);
  if (!node) return absent;
  bool is_too_long = false;
  if (node->kind == Kind::text && node->style == YamlNode::Style::plain) {
    std::int64_t exact = 0;
    const char* const end = node->text.data() + node->text.size();
    const auto read = std::from_chars(node->text.data(), end, exact);
    if (read.ec == std::errc() && read.ptr == end && exact >= low && exact <= high) return exact;
    is_too_long = read.ec == std::errc::result_out_of_range && read.ptr == end;
  }
  constexpr double any = std::numeric_limits<double>::max();
  const auto value = to_number(*node, key, {-any, any});
  if (!value) return absent;
  // With bounds to the last digit, which double does not have.
  if (is_too_long || !(*value >= static_cast<double>(low) && *value <= static_cast<double>(high))) {
    const std::string unit = unit_of_key(key);
    problem(key, node->text + " is out of range",
            fmt::format("must be from {} up to {}{}", low, high, unit.empty() ? "" : " " + unit));
    return absent;
  }
  if (*value != std::round(*value) || std::abs(*value) > largest_exact_integer) {
    problem(key, node->text + " is no whole number");
    return absent;
  }
  return static_cast<std::int64_t>(*value);
}

int YamlMap::integer(const std::string& key, int low, int high, int absent) {
  return static_cast<int>(
      integer(key, std::int64_t{low}, std::int64_t{high}, std::int64_t{absent}));
}

std::optional<std::string> YamlMap::to_text(const YamlNode& node, const std::string& key) {
  if (node.kind == Kind::text && !node.text.empty()) return node.text;
  reading_.problem(node.where, path(key) + ": must be a text, not " +
                                   (node.kind == Kind::text ? "empty" : kind_name(node.kind)));
  return {};
}

std::optional<std::string> YamlMap::text(const std::string& key) {
  const YamlNode* node = ask(key);
  return node ? to_text(*node, key) : std::nullopt;
}

std::string YamlMap::text(const std::string& key, const std::string& absent) {
  return text(key).value_or(absent);
}

std::optional<std::size_t> YamlMap::find_word(const std::string& key,
                                              const std::vector<std::string>& names) {
  const auto value = text(key);
  if (!value) return {};
  const auto found = std::find(names.begin(), names.end(), *value);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  if (reading_.is_later(pattern(key), *value)) {
    problem(key, "'" + *value + "' is not supported yet in this version",
            "it reads " + list_of(names));
  } else {
    problem(key, "'" + *value + "' is not known", "must be one of " + list_of(names),
            names.size() > 1 ? key_hint(*value, names) : "");
  }
  return {};
}

std::string YamlMap::word(const std::string& key, const std::vector<std::string>& names,
                          const std::string& absent) {
  const auto found = find_word(key, names);
  return found ? names[*found] : absent;
}

std::vector<double> YamlMap::numbers(const std::string& key, const Range& range) {
  std::vector<double> result;
  const YamlNode* list = ask_list(key);
  if (!list) return result;
  for (const auto& item : list->items) {
    if (const auto value = to_number(*item, key, range)) result.push_back(*value);
  }
  return result;
}

std::vector<PlacedText> YamlMap::texts(const std::string& key) {
  std::vector<PlacedText> result;
  const YamlNode* list = ask_list(key);
  if (!list) return result;
  if (list->items.empty()) problem(key, "the list is empty");
  for (const auto& item : list->items) {
    if (auto value = to_text(*item, key)) result.push_back({std::move(*value), item->where});
  }
  return result;
}

}  // namespace sunload
