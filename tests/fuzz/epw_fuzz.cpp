// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// EnergyPlus weather.
#include "io/weather/epw.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("epw", [](std::string_view bytes) {
  read_epw(WeatherText(file_of(bytes, "weather.epw")));
});

}  // namespace sunload::fuzz
