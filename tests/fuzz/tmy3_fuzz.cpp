// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// TMY3 weather.
#include "io/weather/tmy3.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("tmy3", [](std::string_view bytes) {
  read_tmy3(WeatherText(file_of(bytes, "weather.csv")), std::nullopt);
});

}  // namespace sunload::fuzz
