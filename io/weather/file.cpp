// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather/file.h"

#include "io/weather/csv.h"
#include "io/weather/epw.h"
#include "io/weather/text.h"
#include "io/weather/tmy3.h"
#include "io/weather/wea.h"

namespace sunload {

WeatherFile read_weather_file(const std::string& path, std::optional<Stamp> stamp) {
  const WeatherText text(path);
  if (is_epw(text)) {
    if (stamp && *stamp != Stamp::end)
      throw InputError({path}, "light.stamp does not go with EPW",
                       "its hours name the end of their stretch", "remove light.stamp");
    return read_epw(text);
  }
  if (is_wea(text)) return read_wea(text, stamp);
  if (is_tmy3(text)) return read_tmy3(text, stamp);
  if (is_weather_csv(text)) return read_weather_csv(text, stamp);
  throw InputError({path, 1, 0}, "is no weather file that can be read",
                   "EPW begins with LOCATION, WEA with place, TMY3 has Date (MM/DD/YYYY) on its "
                   "second line, CSV columns named time and dni_w_m2, dhi_w_m2 or ghi_w_m2");
}

}  // namespace sunload
