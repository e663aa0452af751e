// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Weather of Daysim and Radiance.
#include "io/weather/wea.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("wea", [](std::string_view bytes) {
  read_wea(WeatherText(file_of(bytes, "weather.wea")), std::nullopt);
});

}  // namespace sunload::fuzz
