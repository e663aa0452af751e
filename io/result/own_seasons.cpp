// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/own_seasons.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "geo/base/check.h"
#include "io/result/reader.h"

namespace sunload {

bool OwnSeasons::has(const std::string& name) const {
  return std::find(names.begin(), names.end(), flag_word(name)) != names.end();
}

bool OwnSeasons::holds(const std::string& name, UnixTime time) const {
  const auto flag = std::find(names.begin(), names.end(), flag_word(name)) - names.begin();
  const auto after =
      std::upper_bound(intervals.begin(), intervals.end(), time,
                       [](UnixTime t, const TimeSpan& interval) { return t < interval[0]; });
  if (after == intervals.begin()) return false;
  return (flags[static_cast<std::size_t>(after - intervals.begin()) - 1] >> flag & 1) != 0;
}

OwnSeasons own_seasons(const ResultReader& result) {
  OwnSeasons own;
  const std::string dataset = "study_seasons";
  if (!result.has(dataset)) return own;
  std::istringstream words(result.text_attribute(dataset, "flag_meanings"));
  for (std::string word; words >> word;) own.names.push_back(word);
  own.flags = result.integers(dataset);
  const auto bounds = result.doubles("time_bounds");
  for (std::size_t k = 0; 2 * k + 1 < bounds.size(); ++k)
    own.intervals.push_back({bounds[2 * k], bounds[2 * k + 1]});
  constexpr std::size_t bits = 31;
  if (own.flags.size() != own.intervals.size() || own.names.size() > bits)
    throw InputError({result.path()}, dataset + " is not as results have it",
                     "it has one number per interval, and a bit for each of its names",
                     "run the study again");
  return own;
}

std::string flag_word(std::string name) {
  for (char& c : name) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!is_plain && std::string_view("_-.+@").find(c) == std::string_view::npos) c = '_';
  }
  return name;
}

}  // namespace sunload
