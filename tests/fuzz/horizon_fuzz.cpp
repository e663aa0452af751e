// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Horizon lines.
#include "io/weather/horizon_csv.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("horizon", [](std::string_view bytes) {
  read_horizon_csv(file_of(bytes, "horizon.csv"));
});

}  // namespace sunload::fuzz
