// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/key_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

namespace sunload {

namespace {

struct UnitSuffix {
  std::string_view suffix, name;
};

// Those that studies use and those that users write instead; longer ones first where one
// ends like another.
constexpr std::array<UnitSuffix, 28> unit_suffixes{
    {{"_cd_m2", "cd/m²"},     {"_lm_m2", "lm/m²"},      {"_per_m", "1/m"},
     {"_percent", "percent"}, {"_lx", "lux"},           {"_lm", "lumens"},
     {"_cd", "candelas"},     {"_w_m2", "W/m²"},        {"_kw_m2", "kW/m²"},
     {"_wm2", "W/m²"},        {"_m2", "square metres"}, {"_degrees", "degrees"},
     {"_degree", "degrees"},  {"_deg", "degrees"},      {"_rad", "radians"},
     {"_minutes", "minutes"}, {"_min", "minutes"},      {"_hours", "hours"},
     {"_hour", "hours"},      {"_seconds", "seconds"},  {"_sec", "seconds"},
     {"_km", "kilometres"},   {"_cm", "centimetres"},   {"_mm", "millimetres"},
     {"_m", "metres"},        {"_h", "hours"},          {"_s", "seconds"},
     {"_w", "watts"}}};

const UnitSuffix* suffix_of(std::string_view key) {
  const auto found =
      std::find_if(unit_suffixes.begin(), unit_suffixes.end(), [&](const UnitSuffix& unit) {
        return key.size() > unit.suffix.size() && key.ends_with(unit.suffix);
      });
  return found == unit_suffixes.end() ? nullptr : &*found;
}

/// What a word after a number means in the unit of a key.
struct WrittenUnit {
  std::string_view word, unit;
  double factor;
};
constexpr std::array<WrittenUnit, 59> written_units{{
    {"m", "metres", 1},
    {"metre", "metres", 1},
    {"metres", "metres", 1},
    {"meter", "metres", 1},
    {"meters", "metres", 1},
    {"mm", "metres", 1e-3},
    {"cm", "metres", 1e-2},
    {"km", "metres", 1e3},
    {"ft", "metres", 0.3048},
    {"feet", "metres", 0.3048},
    {"foot", "metres", 0.3048},
    {"in", "metres", 0.0254},
    {"m2", "square metres", 1},
    {"m²", "square metres", 1},
    {"cm2", "square metres", 1e-4},
    {"cm²", "square metres", 1e-4},
    {"°", "degrees", 1},
    {"deg", "degrees", 1},
    {"degree", "degrees", 1},
    {"degrees", "degrees", 1},
    {"rad", "degrees", 57.29577951308232},
    {"min", "minutes", 1},
    {"minute", "minutes", 1},
    {"minutes", "minutes", 1},
    {"h", "minutes", 60},
    {"hour", "minutes", 60},
    {"hours", "minutes", 60},
    {"s", "minutes", 1.0 / 60},
    {"h", "hours", 1},
    {"hour", "hours", 1},
    {"hours", "hours", 1},
    {"min", "hours", 1.0 / 60},
    {"minutes", "hours", 1.0 / 60},
    {"s", "seconds", 1},
    {"min", "seconds", 60},
    {"h", "seconds", 3600},
    {"W/m2", "W/m²", 1},
    {"W/m²", "W/m²", 1},
    {"kW/m2", "W/m²", 1e3},
    {"kW/m²", "W/m²", 1e3},
    {"W", "watts", 1},
    {"kW", "watts", 1e3},
    {"%", "", 1e-2},
    {"percent", "", 1e-2},
    {"%", "percent", 1},
    {"percent", "percent", 1},
    {"lx", "lux", 1},
    {"lux", "lux", 1},
    {"klx", "lux", 1e3},
    {"lm", "lumens", 1},
    {"klm", "lumens", 1e3},
    {"cd", "candelas", 1},
    {"kcd", "candelas", 1e3},
    {"cd/m2", "cd/m²", 1},
    {"cd/m²", "cd/m²", 1},
    {"kcd/m2", "cd/m²", 1e3},
    {"1/m", "1/m", 1},
    {"/m", "1/m", 1},
    {"/mm", "1/m", 1e3},
}};

std::string_view without_unit(std::string_view key) {
  const UnitSuffix* unit = suffix_of(key);
  if (unit) key.remove_suffix(unit->suffix.size());
  return key;
}

/// Lower case, with the underscores that our keys have.
std::string plain(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    c = c == '-' || c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // Rows of the table of Wagner & Fischer (1974): two rows back, one back, this one.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

std::string unit_of_key(std::string_view key) {
  const UnitSuffix* unit = suffix_of(key);
  return unit ? std::string(unit->name) : std::string();
}

std::optional<double> factor_to_unit(std::string_view word, std::string_view unit) {
  const auto found =
      std::find_if(written_units.begin(), written_units.end(),
                   [&](const WrittenUnit& of) { return of.word == word && of.unit == unit; });
  return found == written_units.end() ? std::nullopt : std::optional(found->factor);
}

bool is_plain_unit(std::string_view word) {
  return std::any_of(written_units.begin(), written_units.end(),
                     [&](const WrittenUnit& of) { return of.word == word && of.factor == 1; });
}

std::string key_hint(const std::string& unknown, const std::vector<std::string>& known) {
  const std::string word = plain(unknown);
  for (const auto& key : known) {
    if (suffix_of(key) && without_unit(key) == without_unit(word)) {
      return "did you mean '" + key + "'? Its unit is " + unit_of_key(key);
    }
  }
  // A third of the letters wrong is as far as a slip of the hand goes.
  constexpr std::size_t letters_per_slip = 3;
  int nearest = static_cast<int>(std::max<std::size_t>(1, word.size() / letters_per_slip)) + 1;
  const std::string* best = nullptr;
  for (const auto& key : known) {
    const int distance = std::min(edit_distance(word, key),
                                  edit_distance(without_unit(word), without_unit(key)) + 1);
    if (distance < nearest) {
      nearest = distance;
      best = &key;
    }
  }
  if (best) return "did you mean '" + *best + "'?";
  return known.empty() ? "" : "known here: " + quoted_list(known);
}

}  // namespace sunload
