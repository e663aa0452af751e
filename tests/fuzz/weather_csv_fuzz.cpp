// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Weather as plain CSV; what the other formats are told by, too.
#include "io/weather/csv.h"
#include "io/weather/file.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("weather_csv", [](std::string_view bytes) {
  const auto path = file_of(bytes, "weather.csv");
  read_weather_file(path, Stamp::end);
  read_weather_csv(WeatherText(path), Stamp::start);
});

}  // namespace sunload::fuzz
