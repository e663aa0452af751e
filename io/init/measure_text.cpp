// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/init/measure_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "geo/base/check.h"
#include "geo/time/time.h"
#include "io/base/version.h"
#include "io/init/study_text.h"
#include "io/measure/rules.h"

namespace sunload {

namespace {

/// What is measured where nothing else is said.
enum class Measured { facades, ground, roofs };

/// A rule as it is begun with.
struct Offer {
  std::string_view rule;
  Measured where;
  /// Keys that have no default: {0} is the year. With a remark they are guesses.
  std::string_view keys = {}, remark = {};
};

constexpr std::array<Offer, 12> offers{{
    {"en_17037", Measured::facades, "least_elevation_deg: 13",
     "13 degrees are the Czech Republic's: table A.6 of EN 17037 has those of your capital"},
    {"csn_73_4301", Measured::facades},
    {"bre_209_vsc", Measured::facades},
    {"bre_209_probable_sun", Measured::facades},
    {"bre_209_garden", Measured::ground},
    {"sun_hours", Measured::facades, "date: {0}-12-21, least_h: 1",
     "the day, and the hours that you ask for"},
    {"bright_sun", Measured::facades},
    {"light_hours", Measured::facades, "above_w_m2: 200", "the threshold"},
    {"glint_hours", Measured::ground, "above_w_m2: 100, most_h: 1", "the threshold, and the hours"},
    {"daylight_factor", Measured::facades},
    {"peak_light", Measured::facades},
    {"roof_potential", Measured::roofs},
}};

const Offer* offer_of(std::string_view rule) {
  const auto found = std::find_if(offers.begin(), offers.end(),
                                  [&](const Offer& offer) { return offer.rule == rule; });
  return found == offers.end() ? nullptr : &*found;
}

/// Letters and digits alone, small.
std::string bare(std::string_view word) {
  std::string letters;
  for (const char letter : word)
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return letters;
}

double area_of(const Findings& found, Surface surface) {
  return found.area[static_cast<std::size_t>(surface)];
}

/// The key `of`; none where the scene has nothing of that kind: then all of it is measured.
std::string of_text(Measured where, const Findings& found) {
  switch (where) {
    case Measured::facades:
      return area_of(found, Surface::wall) > 0 ? ", of: {facade: \"*\"}" : "";
    case Measured::ground:
      return ", of: {surface: ground}";
    case Measured::roofs:
      return area_of(found, Surface::roof) > 0 ? ", of: {surface: roof}" : "";
  }
  return "";
}

bool needs_year(const MeasureRule& rule) { return rule.spans != MeasureRule::Spans::any_period; }

}  // namespace

std::vector<std::string> offered_rules() {
  std::vector<std::string> words;
  words.reserve(offers.size());
  for (const Offer& offer : offers) words.emplace_back(offer.rule);
  return words;
}

std::vector<std::string> rules_of_words(const std::vector<std::string>& words) {
  std::vector<std::string> rules;
  for (const auto& word : words) {
    const auto offer = std::find_if(offers.begin(), offers.end(),
                                    [&](const Offer& o) { return bare(o.rule) == bare(word); });
    if (offer == offers.end())
      throw InputError({}, "--rule " + word, "no such rule",
                       fmt::format("write one of: {}", fmt::join(offered_rules(), ", ")));
    const std::string rule(offer->rule);
    if (std::find(rules.begin(), rules.end(), rule) == rules.end()) rules.push_back(rule);
  }
  return rules;
}

void expect_measurable(const std::vector<std::string>& rules, const Findings& found) {
  for (const auto& word : rules) {
    const MeasureRule& rule = *find_measure_rule(word);
    if (rule.needs == MeasureRule::Needs::sun_path && !found.site)
      throw InputError(
          {}, "--rule " + word,
          "its sun is that of a day, and neither the model nor weather tells the place",
          "add --at \"52.0 4.36\", or --crs EPSG:… where coordinates are of a map");
    if (needs_year(rule) && !(found.weather && found.site))
      throw InputError({}, "--rule " + word, "it counts a year of weather, and none is given",
                       fmt::format("sunload init MODEL WEATHER --rule {}", word));
  }
}

bool is_year_needed(const std::vector<std::string>& rules) {
  return std::any_of(rules.begin(), rules.end(),
                     [](const auto& word) { return needs_year(*find_measure_rule(word)); });
}

std::string watched_series(const std::vector<std::string>& rules) {
  std::vector<std::string> parts;
  for (const auto& word : rules) {
    const MeasureRule& rule = *find_measure_rule(word);
    const bool is_new = std::find(parts.begin(), parts.end(), rule.light) == parts.end();
    if (rule.needs == MeasureRule::Needs::series && rule.light != "total" && is_new)
      parts.push_back(rule.light);
  }
  std::string text;
  for (const auto& part : parts) text += ", " + part;
  return text;
}

std::string measure_text(const std::vector<std::string>& rules, const Findings& found) {
  if (rules.empty()) return {};
  std::string text =
      "# Rules of planning (docs/measures.md); `sunload info RESULT --measures` has the verdicts.\n"
      "measures:\n";
  const int year = calendar_from_utc(now()).year;
  for (const auto& word : rules) {
    const Offer& offer = *offer_of(word);
    const std::string keys = fmt::format(fmt::runtime(offer.keys), year);
    if (!offer.remark.empty()) text += fmt::format("  # {} {}\n", mark, offer.remark);
    text += fmt::format("  {0}: {{rule: {0}{1}{2}{3}}}\n", word, keys.empty() ? "" : ", ", keys,
                        of_text(offer.where, found));
  }
  return text + "\n";
}

}  // namespace sunload
