// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/init/study_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "geo/mesh/ground.h"
#include "geo/sun/weather.h"
#include "geo/time/time.h"
#include "io/base/data_folder.h"
#include "io/base/names.h"
#include "io/base/version.h"
#include "io/init/clear_days.h"
#include "io/init/measure_text.h"
#include "io/init/proposals.h"
#include "io/study/material_table.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

// Rows of a comment, so that a model of a thousand materials has a study that is read.
constexpr std::size_t most_listed = 12;

/// A scalar of YAML that nothing takes for something else.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') out += '\\';
    if (static_cast<unsigned char>(letter) < 0x20)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(letter));
    else
      out += letter;
  }
  return out + "\"";
}

/// Names in a comment: no line may end within.
std::string plain(std::string text) {
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < 0x20) letter = ' ';
  return text;
}

std::string path_from(const std::string& folder, const std::string& path) {
  return quoted(path_in_study(path, folder));
}

/// Signed degrees as people write them.
std::string place_words(const Site& site) {
  return fmt::format("{:.4f} {}, {:.4f} {}", std::abs(site.latitude_deg),
                     site.latitude_deg < 0 ? "south" : "north", std::abs(site.longitude_deg),
                     site.longitude_deg < 0 ? "west" : "east");
}

std::string head_text(const std::string& name, const InitRules& rules) {
  std::string text;
  if (const std::string data = data_folder(); !data.empty())
    text += fmt::format("# yaml-language-server: $schema={}/configs/study.schema.json\n", data);
  text += fmt::format(
      "# A study to begin with, of {}. Lines with {} are guesses, or need you.\n"
      "# All keys: docs/study-file.md; a wrong one is refused with its line and what to try.\n"
      "format: sunload-study-1\nname: {}\n\n",
      plain(fs::path(rules.model).filename().string()), mark, quoted(name));
  return text;
}

std::string zone_text(const InitRules& rules, const Findings& found) {
  if (!rules.zone.empty()) return quoted(rules.zone);
  if (!found.zone) return "UTC";
  return found.zone->away_m ? found.zone->name : quoted(found.zone->name);
}

std::string zone_comment(const InitRules& rules, const Findings& found) {
  if (!rules.zone.empty()) return {};
  if (!found.zone)
    return fmt::format(
        "# {} times are in UTC: no table of time zones is here; write e.g. "
        "Europe/Berlin\n",
        mark);
  if (!found.zone->away_m)
    return fmt::format(
        "# {} timezone: the weather's offset from UTC; its zone would know summer times\n", mark);
  return fmt::format(
      "# {} timezone: that of the nearest place in the table of zones, {:.0f} km away; borders are "
      "not known to it\n",
      mark, *found.zone->away_m / 1000);
}

/// What is known where no place is.
std::string no_site_text() {
  return fmt::format(
      "# {0} Neither file nor weather tells where this stands. Until you do, the sun stands where "
      "`period` puts it.\n"
      "# {0} With a place, use these two lines instead of period and light below:\n"
      "# site: {{latitude_deg: 52.0, longitude_deg: 4.36, timezone: Europe/Amsterdam, north_deg: "
      "0}}   # azimuth of +y\n"
      "# period: {{days: [{1}-03-21, {1}-06-21, {1}-12-21], step_min: 60}}\n"
      "# (or call init with --at \"52.0 4.36\", or with --crs EPSG:… where coordinates are of a "
      "map)\n\n",
      mark, calendar_from_utc(now()).year);
}

std::string site_text(const InitRules& rules, const Findings& found) {
  if (!found.site) return no_site_text();
  const Site& site = *found.site;
  std::string text = fmt::format("# {}: {}\n", place_words(site), plain(found.site_source));
  std::string keys;
  if (!rules.at.empty())
    keys += fmt::format("latitude_deg: {:.6f}, longitude_deg: {:.6f}, ", site.latitude_deg,
                        site.longitude_deg);
  if (!rules.crs.empty()) keys += fmt::format("crs: {}, ", quoted(rules.crs));
  if (found.is_at_station)
    text += fmt::format(
        "# {} the place is the weather station's: write latitude_deg and "
        "longitude_deg if the scene stands elsewhere\n",
        mark);
  if (found.crs.empty())
    text += fmt::format(
        "# {} north_deg: azimuth of the scene's +y axis, clockwise from true "
        "north; 0 is assumed\n",
        mark);
  constexpr double far_m = 50e3;
  if (found.station_away_m.value_or(0) > far_m)
    text += fmt::format("# {} the weather is of a station {:.0f} km from here\n", mark,
                        *found.station_away_m / 1000);
  text += zone_comment(rules, found);
  if (found.crs.empty()) keys += "north_deg: 0, ";
  return text + fmt::format("site: {{{}timezone: {}}}\n\n", keys, zone_text(rules, found));
}

std::string days_of(const Findings& found) {
  const auto& records = found.weather->records;
  const bool is_actual = years_of(records) == WeatherYears::actual;
  std::vector<std::string> days;
  for (const CivilTime& day : clear_days(records, found.weather_source))
    days.push_back(fmt::format("{}-{:02}-{:02}",
                               is_actual ? day.year : calendar_from_utc(now()).year, day.month,
                               day.day));
  std::sort(days.begin(), days.end());  // months of a typical year are of different years
  return fmt::format("{}", fmt::join(days, ", "));
}

std::string weather_text(const InitRules& rules, const Findings& found, const std::string& folder) {
  std::string text;
  if (!found.is_stamp_known)
    text += fmt::format(
        "# {} stamp: which instant of its interval a row's time is (start, middle, "
        "end)\n",
        mark);
  if (found.records_incomplete > 0)
    text += fmt::format("# {} {} records lack a value or a row: made of their neighbours\n", mark,
                        found.records_incomplete);
  const BelowZero& too_low = found.weather->too_low;
  if (too_low.count > 0)
    text += fmt::format("# {} {} values are too low (line {}, {}): made of their neighbours\n",
                        mark, too_low.count, too_low.line, too_low.first);
  const bool is_filled = found.records_incomplete > 0 || too_low.count > 0;
  return text + fmt::format("light: {{source: weather, weather: {}, {}{}sky: perez}}\n\n",
                            path_from(folder, rules.weather),
                            found.is_stamp_known ? "" : "stamp: end, ",
                            is_filled ? "missing: interpolate, " : "");
}

std::string period_text(const InitRules& rules, const Findings& found, const std::string& folder) {
  const int year = calendar_from_utc(now()).year;
  switch (first_period(found)) {
    case FirstPeriod::positions:
      return "# Morning, noon and afternoon of a spring day in the middle of Europe, and the light "
             "that it has.\n"
             "period:\n  positions:\n"
             "    - {azimuth_deg: 120, elevation_deg: 25, interval_min: 60}\n"
             "    - {azimuth_deg: 180, elevation_deg: 40, interval_min: 60}\n"
             "    - {azimuth_deg: 240, elevation_deg: 25, interval_min: 60}\n"
             "light: {source: fixed, dni_w_m2: 700, dhi_w_m2: 120}\n\n";
    case FirstPeriod::year:
      return fmt::format(
                 "# {} records of {}, each an interval of its own.\n"
                 "period: {{year_of: weather}}\n",
                 found.weather->records.size(), found.weather->format) +
             weather_text(rules, found, folder);
    case FirstPeriod::days:
      break;
  }
  if (found.weather)
    return fmt::format(
               "# Clear days of the weather. {} all of it, which takes longer than a first picture "
               "should: period: {{year_of: weather}}\n"
               "period: {{days: [{}], step_min: 60}}\n",
               mark, days_of(found)) +
           weather_text(rules, found, folder);
  return fmt::format(
      "# An equinox and both solstices, in civil time.\n"
      "period: {{days: [{0}-03-21, {0}-06-21, {0}-12-21], step_min: 60}}\n"
      "# Cloudless. With measured or typical weather (EPW, TMY3, WEA, CSV): source: weather, "
      "weather: FILE\n"
      "# {1} linke_turbidity: 2 in clear mountain air, 3 in Europe, 5 in haze\n"
      "light: {{source: clear_sky, linke_turbidity: 3, sky: perez}}\n\n",
      year, mark);
}

/// Kinds and areas that were found, as a comment.
std::string found_text(const Findings& found) {
  std::string text = fmt::format(
      "# {} polygons, {} objects; {:.4g} x {:.4g} x {:.4g} m about ({:.8g}, {:.8g}, "
      "{:.4g})\n",
      found.polygons, found.objects, found.size.x, found.size.y, found.size.z, found.middle.x,
      found.middle.y, found.middle.z);
  std::string areas;
  for (std::size_t s = 0; s < surface_names.size(); ++s)
    if (found.area[s] > 0)
      areas +=
          fmt::format("{} {} {:.0f} m2", areas.empty() ? "" : ",", surface_names[s], found.area[s]);
  text += "# surfaces:" + areas + "\n";
  std::string kinds;
  for (const auto& [kind, count] : found.kinds)
    kinds += fmt::format("{} {} {}", kinds.empty() ? "" : ",", count, plain(kind));
  if (!kinds.empty()) text += "# objects:" + kinds + "\n";
  constexpr double wide_m = 20e3, small_m = 1;
  const double most = std::max({found.size.x, found.size.y, found.size.z});
  if (most > wide_m || most < small_m)
    text += fmt::format(
        "# {} {:.4g} m wide: if the file's unit is no metre, write e.g. unit_m: "
        "0.001 (millimetres)\n",
        mark, most);
  constexpr double grid_m = 1e5;  // where models are drawn about their own origin, none is so far
  if (found.crs.empty() && std::max(std::abs(found.middle.x), std::abs(found.middle.y)) > grid_m)
    text += fmt::format(
        "# {} coordinates are like those of a map: site: {{crs: EPSG:…}} gives place "
        "and north\n",
        mark);
  return text;
}

std::string file_text(const InitRules& rules, const std::string& folder) {
  const bool is_plain = rules.terrain.empty() && rules.canopy.empty() && rules.height.empty() &&
                        rules.storeys.empty() && rules.up.empty() && rules.unit_m == 1;
  if (is_plain) return fmt::format("  files: [{}]\n", path_from(folder, rules.model));
  std::string text = fmt::format("  files:\n    - file: {}\n", path_from(folder, rules.model));
  if (rules.is_up_guessed)
    text += fmt::format(
        "      # {} up: y, by what looks like ground; up: z where the model lies as it should\n",
        mark);
  if (!rules.terrain.empty())
    text += fmt::format("      terrain: {}\n", path_from(folder, rules.terrain));
  if (!rules.canopy.empty())
    text += fmt::format("      canopy: {}\n", path_from(folder, rules.canopy));
  if (!rules.height.empty() || !rules.storeys.empty()) {
    const std::string height = rules.height.empty() ? "" : "height: " + quoted(rules.height),
                      storeys = rules.storeys.empty() ? "" : "storeys: " + quoted(rules.storeys);
    text += fmt::format("      footprints: {{{}{}{}}}\n", height,
                        height.empty() || storeys.empty() ? "" : ", ", storeys);
  }
  if (!rules.up.empty()) text += fmt::format("      up: {}\n", rules.up);
  if (rules.is_unit_of_crs)
    text += fmt::format("      # {} unit_m of the CRS; 1 where the file has metres all the same\n",
                        mark);
  if (rules.unit_m != 1) text += fmt::format("      unit_m: {:.10g}\n", rules.unit_m);
  return text;
}

std::string land_text(const InitRules& rules) {
  if (rules.land.empty()) return {};
  std::string names;
  for (const auto& name : rules.land) names += (names.empty() ? "" : ", ") + quoted(name);
  return fmt::format(
      "  # {} land: houses are sunk into it, what lies below is covered; take the line out where\n"
      "  # it is no terrain\n  land: [{}]\n",
      mark, names);
}

std::string ground_text(const Findings& found) {
  if (found.is_city_format)
    return fmt::format(  // as it was looked at
        "  # The ground that buildings stand on goes through their feet and beyond them.\n"
        "  ground: {{margin_m: {:.0f}, material: paving}}\n",
        GroundRules{}.margin_m);
  if (found.has_ground || found.is_raster)
    return "  # The file has its own ground.\n  ground: none\n";
  constexpr double percent = 100;
  if (found.foot_share > 0)
    return fmt::format(
        "  # {} ground: faces at the model's foot, {:.0f} % of its plan, are taken for it; if they "
        "are not, e.g. ground: {{margin_m: 30}}\n"
        "  ground: none\n",
        mark, percent * found.foot_share);
  return fmt::format(
      "  # {} ground: a plane below the model; `ground: none` leaves it out\n"
      "  ground: {{margin_m: {:.0f}, material: paving}}\n",
      mark, std::clamp(std::ceil(std::max(found.size.x, found.size.y) / 4), 1.0, 50.0));
}

/// Materials of the file that are known, as a comment.
std::string known_materials(const Findings& found) {
  std::string told;
  std::size_t count = 0;
  for (const auto& [material, area_m2] : found.materials) {
    if (!material.diffuse && !tabled_material(material.name)) continue;
    if (++count > most_listed) continue;
    told +=
        fmt::format("  #   {}: {}, {:.0f} m2\n", plain(material.name),
                    material.diffuse ? fmt::format("diffuse {:.3f} in the file", *material.diffuse)
                                     : "of the table",
                    area_m2);
  }
  if (told.empty()) return {};
  if (count > most_listed) told += fmt::format("  #   … {} in all\n", count);
  return "  # Materials that need no rule (one that names them with `was` goes before):\n" + told;
}

/// A proposed rule of scene.assign, and what is said of it.
struct Rule {
  std::string what, remark;
  bool is_active = true;
};

std::vector<Rule> proposed_rules(const Findings& found) {
  std::vector<Rule> rules;
  for (std::size_t s = 0; s < surface_names.size(); ++s) {
    const auto surface = static_cast<Surface>(s);
    if (found.undetermined[s] <= 0 || surface == Surface::floor) continue;
    // A rule by kind would take what the file says from the rest of that kind.
    const bool is_mixed = found.undetermined[s] < 0.999 * found.area[s];
    rules.push_back(
        {fmt::format("surface: {}, material: {}", surface_names[s], proposed_for_surface(surface)),
         fmt::format("{:.0f} m2{}", found.undetermined[s],
                     is_mixed ? " without a material; the rule would be for all of the kind" : ""),
         !is_mixed});
  }
  for (const auto& [kind, count] : found.kinds)
    if (const auto proposed = proposed_for_kind(kind))
      rules.push_back({fmt::format("type: {}, material: {}", quoted(kind), *proposed),
                       fmt::format("{} objects", count)});
  for (const auto& [material, area_m2] : found.materials) {
    if (material.diffuse || material.name.empty() || tabled_material(material.name)) continue;
    if (const auto proposed = proposed_for_name(material.name))
      rules.push_back({fmt::format("was: {}, material: {}", quoted(material.name), *proposed),
                       fmt::format("{:.0f} m2, by its name", area_m2)});
  }
  return rules;
}

std::string assign_text(const Findings& found) {
  std::string rules;
  bool has_active = false;
  std::size_t place = 0;
  for (const Rule& rule : proposed_rules(found)) {
    if (rule.is_active && found.idle_rules.contains(place++)) continue;
    has_active |= rule.is_active;
    rules +=
        fmt::format("    {}- {{{}}}   # {}\n", rule.is_active ? "" : "# ", rule.what, rule.remark);
  }
  std::string known = known_materials(found);
  if (rules.empty()) return known;
  return known +
         fmt::format(
             "  # {} materials of the table (sunload materials) by guess; of rules that "
             "match a face the last holds,\n  # those that name objects go before\n",
             mark) +
         (has_active ? "  assign:\n" : "  # assign:\n") + rules;
}

std::string scene_text(const InitRules& rules, const Findings& found, const std::string& folder) {
  const std::string excess =
      found.has_excess ? fmt::format(
                             "  # {} colours of the file reflect more than arrives: made smaller\n"
                             "  vrml_excess: scale\n",
                             mark)
                       : "";
  std::string columns;
  for (const auto& note : found.footprint_notes)
    columns += fmt::format("  # {} {} (keys: footprints, terrain)\n", mark, note);
  return found_text(found) + "scene:\n" + columns + file_text(rules, folder) + excess +
         land_text(rules) + ground_text(found) + assign_text(found) + "\n";
}

std::string cost_text(const InitRules& rules, const FirstPicture& picture, const Findings& found) {
  std::string text = fmt::format(
      "# Coarse and quick, for a first picture; `sunload info` tells its error. For results: a "
      "shorter edge,\n"
      "# the line `oracle: none` left out (the mesh is refined where light varies), and 256 lines "
      "or more.\n"
      "mesh: {{max_edge_m: {:g}, oracle: none}}\n"
      "solver: {{lines_per_patch: 64, direct_samples: 8, realizations: 8}}\n",
      picture.max_edge_m);
  if (first_period(found) == FirstPeriod::year)
    text += fmt::format(
        "# Of every hour the sum alone: parts are in the totals. Nine bits: 0.1 % of a value.\n"
        "output: {{series: [total{}], significant_bits: 9}}\n",
        watched_series(rules.measures));
  return text + "\n";
}

std::string variants_text(const Findings& found) {
  const bool has_walls = found.area[static_cast<std::size_t>(Surface::wall)] > 0;
  const char* surface = has_walls ? "wall" : "roof";
  return fmt::format(
      "# What would change if it were built differently? Take the # away; "
      "`sunload compare STUDY bright` tells.\n"
      "# variants:\n"
      "#   - {{name: baseline}}\n"
      "#   - {{name: bright, scene: {{assign: [{{surface: {}, material: paint_white}}]}}}}\n",
      surface);
}

}  // namespace

FirstPeriod first_period(const Findings& found) {
  if (found.weather && found.site && !found.is_year_too_long) return FirstPeriod::year;
  return found.site ? FirstPeriod::days : FirstPeriod::positions;
}

std::string study_text(const std::string& name, const InitRules& rules, const Findings& found,
                       const FirstPicture& picture, const std::string& folder) {
  return head_text(name, rules) + site_text(rules, found) + period_text(rules, found, folder) +
         scene_text(rules, found, folder) + measure_text(rules.measures, found) +
         cost_text(rules, picture, found) + variants_text(found);
}

std::string path_in_study(const std::string& path, const std::string& folder) {
  std::error_code unknown;
  const fs::path relative = fs::relative(path, folder, unknown);
  std::string written =
      unknown || relative.empty() ? fs::absolute(path).string() : relative.string();
  if (utf8_text(written) != written)
    throw InputError({path, 0, 0}, "its name is not in UTF-8",
                     "a study is text in UTF-8 and cannot name it",
                     "rename the file, or the folder on the way to it");
  return written;
}

std::string study_name(const std::string& path) {
  std::string name = fs::path(path).filename().string();
  for (const char* ending :
       {".city.json", ".city.jsonl", ".wrl.gz", ".gml.gz", ".citygml.gz", ".xml.gz"})
    if (name.ends_with(ending)) name.resize(name.size() - std::string(ending).size());
  if (name == fs::path(path).filename().string()) name = fs::path(path).stem().string();
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '-' && letter != '.')
      letter = '_';
  while (!name.empty() && name.front() == '.') name.erase(0, 1);
  return name.empty() ? "first" : name;
}

}  // namespace sunload
