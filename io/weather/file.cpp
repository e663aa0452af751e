// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather/file.h"

#include "io/base/file_text.h"
#include "io/base/names.h"
#include "io/weather/csv.h"
#include "io/weather/epw.h"
#include "io/weather/text.h"
#include "io/weather/tmy3.h"
#include "io/weather/wea.h"

namespace sunload {

namespace {

/// Tables and JSON of the European Commission's PVGIS, of a typical year or of hours.
bool is_of_pvgis(const WeatherText& text) {
  const std::string_view first = trimmed(text.line(1));
  return first.starts_with("Latitude (decimal degrees):") ||
         (first.starts_with("{\"inputs\"") && first.find("decimal degree") != first.npos);
}

WeatherFile read_by_format(const WeatherText& text, std::optional<Stamp> stamp) {
  if (is_epw(text)) {
    if (stamp && *stamp != Stamp::end)
      throw InputError({text.path()}, "light.stamp does not go with EPW",
                       "its hours name the end of their stretch", "remove light.stamp");
    return read_epw(text);
  }
  if (is_wea(text)) return read_wea(text, stamp);
  if (is_tmy3(text)) return read_tmy3(text, stamp);
  if (is_weather_csv(text)) return read_weather_csv(text, stamp);
  if (is_of_pvgis(text))
    throw InputError({text.path(), 1, 0}, "is of PVGIS in a form that is not read",
                     "columns and stamps of its own", "let PVGIS write its typical year as EPW");
  throw InputError({text.path(), 1, 0}, "is no weather file that can be read",
                   "EPW begins with LOCATION, WEA with place, TMY3 has Date (MM/DD/YYYY) on its "
                   "second line, CSV columns named time and dni_w_m2, dhi_w_m2 or ghi_w_m2");
}

/// Station names of many files are in Latin-1; reports, results and studies are in UTF-8.
void make_name_plain(WeatherFile& file) {
  if (!file.place) return;
  std::string& name = file.place->name;
  const std::string utf8 = utf8_text(name), plain = clean_name(name);
  if (utf8 != name)
    file.notes.push_back("the station's name is not in UTF-8, read as Windows-1252 (Latin-1): '" +
                         plain + "'");
  if (plain != utf8)
    file.notes.push_back("the station's name has control characters, which are written out: '" +
                         plain + "'");
  name = plain;
}

}  // namespace

WeatherFile read_weather_file(const std::string& path, std::optional<Stamp> stamp) {
  WeatherFile file = read_by_format(WeatherText(path), stamp);
  make_name_plain(file);
  return file;
}

}  // namespace sunload
