// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/raster/footprint_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "geo/base/check.h"

namespace sunload {

namespace {

using Names = std::vector<std::string_view>;
// Not New York's heightroof or Portland's avg_height, which are in feet: who names it sees to the
// unit.
const Names heights{
    "height", "height_m", "building_height", "bldg_height", "measuredheight", "b_hoogte", "hoogte",
    "hoehe",  "hoehe_m",  "hauteur",         "vyska",       "altura",         "altezza",  "h"};
const Names storeys{"building:levels", "building_levels", "storeys",     "stories", "levels",
                    "num_floors",      "num_story",       "num_stories", "floors",  "etages",
                    "geschosse",       "podlazi",         "plantas",     "piani"};
const Names bases{"base_height", "base_m", "ground_height", "ground_elevation"};
// Of OpenStreetMap: where a part of a building begins above the ground.
const Names lower_ends{"min_height"}, lower_levels{"building:min_level", "min_level"};
const Names names{"id", "gml_id", "osm_id", "fid", "egid", "ref", "name"};

}  // namespace

FootprintTable::FootprintTable(const std::string& path, OGRLayerH layer, FootprintRules rules,
                               double unit_m, NoteCounter& notes)
    : path_(path), rules_(std::move(rules)), notes_(notes), columns_(path, layer, unit_m) {
  height_ = columns_.found(rules_.height, rules_.storeys.empty() ? heights : Names{},
                           "heights of footprints", notes_);
  storeys_ = columns_.found(rules_.storeys, storeys, "storeys of footprints", notes_);
  base_ = columns_.found(rules_.base, rules_.terrain.empty() ? bases : Names{},
                         "feet of footprints", notes_);
  name_ = columns_.found(rules_.name, names, "names of footprints", notes_);
  lower_end_ = columns_.usual(lower_ends);
  lower_level_ = columns_.usual(lower_levels);
  if (height_ >= 0 || storeys_ >= 0 || rules_.default_height_m) return;
  throw InputError(
      {path_}, "no column of heights is known", columns_.in_words(),
      "name one: footprints: {height: COLUMN} or {storeys: COLUMN} (of sunload init --height or "
      "--storeys), or give {default_height_m: …} for all");
}

std::string FootprintTable::name_of(OGRFeatureH feature) const {
  if (std::string name = columns_.text(feature, name_); !name.empty()) return name;
  return fmt::format("building_{}", gdal::OGR_F_GetFID(feature) + 1);
}

std::optional<double> FootprintTable::known_height_m(OGRFeatureH feature) {
  if (const auto height = columns_.length_m(feature, height_); height && *height > 0)
    return *height;
  if (const auto count = columns_.number(feature, storeys_); count && *count > 0)
    return *count * rules_.storey_m;
  if (rules_.default_height_m) ++of_default_height_;
  return rules_.default_height_m;
}

std::optional<double> FootprintTable::height_m(OGRFeatureH feature, const std::string& name) {
  columns_.look_anew();
  const auto height = known_height_m(feature);
  if (height) return height;
  const std::string& unread = columns_.last_unread();
  is_any_unread_ |= !unread.empty();
  without_height_.add(unread.empty() ? name : fmt::format("{}: '{}'", name, unread));
  return {};
}

double FootprintTable::lower_end_m(OGRFeatureH feature, double height_m, const std::string& name) {
  auto begins_m = columns_.length_m(feature, lower_end_);
  if (!begins_m)
    if (const auto levels = columns_.number(feature, lower_level_))
      begins_m = *levels * rules_.storey_m;
  if (!begins_m || !(*begins_m > 0)) return 0;
  if (*begins_m < height_m) {
    ++raised_;
    return *begins_m;
  }
  upside_down_.add(fmt::format("{} from {:g} to {:g} m", name, *begins_m, height_m));
  return 0;
}

std::optional<double> FootprintTable::foot_m(OGRFeatureH feature) {
  return columns_.length_m(feature, base_);
}

void FootprintTable::refuse_without_height(std::size_t others) const {
  if (without_height_.count() == 0) return;
  throw InputError(
      {path_},
      fmt::format("{} of {} footprints have no height above 0 ({})", without_height_.count(),
                  without_height_.count() + others, without_height_.text()),
      is_any_unread_ ? "what is written there is no number, nor one with m, ft or '"
                     : "neither a height nor storeys above 0 are written there",
      "footprints: {default_height_m: …} gives them one");
}

void FootprintTable::note(std::size_t all) const {
  if (of_default_height_ > 0)
    notes_.say(fmt::format("{} of {} footprints have no height above 0 and are {:g} m high",
                           of_default_height_, all, *rules_.default_height_m));
  if (columns_.unread() > 0)
    notes_.say(
        fmt::format("{} values of heights, storeys or feet are no numbers, such as '{}': "
                    "they count as not written",
                    columns_.unread(), columns_.first_unread()));
  if (raised_ > 0)
    notes_.say(
        fmt::format("{} of {} footprints begin above the ground, by min_height or "
                    "building:min_level",
                    raised_, all));
  if (storeys_ >= 0) notes_.say(fmt::format("a storey is {:g} m high", rules_.storey_m));
}

std::string FootprintTable::warning(std::size_t all) const {
  if (upside_down_.count() == 0) return {};
  return message({path_},
                 fmt::format("{} of {} footprints begin no lower than they end, by min_height or "
                             "building:min_level ({})",
                             upside_down_.count(), all, upside_down_.text()),
                 "they are drawn from their feet on",
                 "correct them, or take them away in scene.edit");
}

}  // namespace sunload
