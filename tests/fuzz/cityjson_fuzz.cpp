// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// CityJSON and CityJSONSeq.
#include "io/scene/cityjson/reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("cityjson", [](std::string_view bytes) {
  read_and_prepare(bytes, "scene.city.json", read_scene_cityjson);
});

}  // namespace sunload::fuzz
