// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sensor points.
#include "io/scene/sensor_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("sensors", [](std::string_view bytes) {
  read_sensor_file(file_of(bytes, "grid.pts"));
});

}  // namespace sunload::fuzz
