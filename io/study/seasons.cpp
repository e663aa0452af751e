// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Section `seasons` of a study, and what materials are in them.
#include <algorithm>
#include <charconv>
#include <set>
#include <tuple>

#include "io/base/key_names.h"
#include "io/study/sections.h"

namespace sunload {

namespace {

/// Whether a time lies before that day.
bool is_before(const CivilTime& time, const SeasonDate& date) {
  const int year = date.year.value_or(time.year);
  return std::tuple(time.year, time.month, time.day) < std::tuple(year, date.month, date.day);
}

bool goes_over_new_year(const SeasonStudy& season) {
  return !season.first.year && std::pair(season.end_date.month, season.end_date.day) <
                                   std::pair(season.first.month, season.first.day);
}

}  // namespace

bool is_in(const SeasonStudy& season, const CivilTime& time) {
  if (!season.months.empty())
    return std::find(season.months.begin(), season.months.end(), time.month) != season.months.end();
  const bool has_begun = !is_before(time, season.first),
             has_ended = !is_before(time, season.end_date);
  return goes_over_new_year(season) ? has_begun || !has_ended : has_begun && !has_ended;
}

namespace study_sections {

namespace {

constexpr int months_of_a_year = 12;
constexpr std::size_t most_seasons = 31;
constexpr int leap_year = 2000;  // in which every date of any year exists
const std::string what_to_write =
    "[11-01, 04-15] is from 1 November to 14 April of every year, [2026-01-10, 2026-01-25] a "
    "stretch of one, [12, 1, 2] whole months";

std::optional<int> month_of(const std::string& text) {
  int month = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), month);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? std::optional(month) : std::nullopt;
}

/// `11-01` or `2026-11-01`. Throws InputError.
SeasonDate date_of(const std::string& text) {
  const bool is_of_every_year = std::count(text.begin(), text.end(), '-') == 1;
  const ParsedTime time =
      parse_time(is_of_every_year ? std::to_string(leap_year) + "-" + text : text);
  if (time.has_time)
    throw InputError({}, "'" + text + "' has a time of day", "seasons begin and end at midnight");
  return {is_of_every_year ? std::nullopt : std::optional(time.civil.year), time.civil.month,
          time.civil.day};
}

void read_dates(YamlMap& map, const std::vector<PlacedText>& texts, SeasonStudy& season) {
  for (const auto& [date, text] :
       {std::pair{&season.first, &texts[0]}, {&season.end_date, &texts[1]}})
    try {
      *date = date_of(text->text);
    } catch (const InputError&) {
      return map.problem(season.name, "'" + text->text + "' is no date of a season",
                         "or there is no such day", what_to_write);
    }
  const auto place = [](const SeasonDate& d) {
    return std::tuple(d.year.value_or(0), d.month, d.day);
  };
  if (season.first.year.has_value() != season.end_date.year.has_value())
    map.problem(season.name, "has one date with a year and one without", "", what_to_write);
  else if (place(season.first) == place(season.end_date) ||
           (season.first.year && place(season.end_date) < place(season.first)))
    map.problem(season.name, "ends where it begins, or before",
                "the second date is the first day that is no more of it", what_to_write);
}

SeasonStudy read_season(YamlMap& map, const std::string& name) {
  const std::vector<PlacedText> texts = map.texts(name);
  SeasonStudy season;
  season.name = name;
  season.where = map.where(name);
  for (const PlacedText& text : texts)
    if (const auto month = month_of(text.text)) season.months.push_back(*month);
  const auto is_a_month = [](int m) { return m >= 1 && m <= months_of_a_year; };
  if (!season.months.empty() && season.months.size() == texts.size()) {
    if (!std::all_of(season.months.begin(), season.months.end(), is_a_month))
      map.problem(name, "has a month that is none", "they are 1 to 12", what_to_write);
  } else if (season.months.empty() && texts.size() == 2) {
    read_dates(map, texts, season);
  } else {
    season.months.clear();
    map.problem(name, "is neither two dates nor a list of months", "", what_to_write);
  }
  return season;
}

}  // namespace

std::vector<SeasonStudy> read_seasons(YamlMap& root) {
  std::vector<SeasonStudy> seasons;
  root.section("seasons", [&](YamlMap& map) {
    for (const auto& name : map.other_keys()) seasons.push_back(read_season(map, name));
    if (seasons.size() > most_seasons)
      root.problem("seasons", "has more than " + std::to_string(most_seasons),
                   "results have a bit for each", "write fewer");
  });
  return seasons;
}

std::vector<SeasonMaterial> read_season_materials(YamlMap& material) {
  std::vector<SeasonMaterial> seasons;
  material.section("seasons", [&](YamlMap& map) {
    for (const auto& season : map.other_keys())
      if (auto other = map.text(season))
        seasons.push_back({season, std::move(*other), map.where(season)});
  });
  return seasons;
}

std::vector<std::string> used_seasons(const Study& study) {
  std::vector<std::string> used;
  for (const MaterialStudy& material : study.scene.materials)
    for (const SeasonMaterial& in : material.seasons) used.push_back(in.season);
  for (const SeasonAlbedo& in : study.light.far_ground_seasons) used.push_back(in.season);
  return used;
}

namespace {

void leave_out_absent_seasons(Study& study) {
  const auto is_absent = [&](const auto& in) {
    return std::none_of(study.seasons.begin(), study.seasons.end(),
                        [&](const SeasonStudy& season) { return season.name == in.season; });
  };
  for (MaterialStudy& material : study.scene.materials) std::erase_if(material.seasons, is_absent);
  std::erase_if(study.light.far_ground_seasons, is_absent);
}

}  // namespace

void settle_seasons(YamlMap& root, Study& study, const std::set<std::string>& names) {
  const auto expect_known = [&](const std::string& season, const Where& where) {
    if (names.contains(season)) return;
    root.reading().problem(where, "'" + season + "' is no season of the study", "",
                           names.empty() ? "write seasons: {" + season + ": [11-01, 04-15]}"
                                         : key_hint(season, {names.begin(), names.end()}));
  };
  for (const MaterialStudy& material : study.scene.materials)
    for (const SeasonMaterial& in : material.seasons) expect_known(in.season, in.where);
  for (const SeasonAlbedo& in : study.light.far_ground_seasons) expect_known(in.season, in.where);
  leave_out_absent_seasons(study);
  if (!used_seasons(study).empty() && std::holds_alternative<PositionsPeriod>(study.period.kind))
    root.reading().problem(study.period.where, "positions have no seasons",
                           "suns that are put somewhere have no date",
                           "write days, or leave the seasons of materials and far ground away");
}

void warn_of_unused_seasons(YamlReading& reading, const std::vector<Study>& variants) {
  std::set<std::string> used;
  for (const Study& study : variants)
    for (const std::string& season : used_seasons(study)) used.insert(season);
  for (const Study& study : variants)
    for (const SeasonStudy& season : study.seasons)
      if (!used.contains(season.name))
        reading.warn(season.where, "season '" + season.name + "' changes nothing",
                     "no material of the study is another one in it",
                     "write scene.materials: {NAME: {seasons: {" + season.name + ": OTHER}}}");
}

}  // namespace study_sections

}  // namespace sunload
