// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// CityGML.
#include "io/scene/citygml/reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("citygml", [](std::string_view bytes) {
  read_and_prepare(bytes, "scene.gml", read_scene_citygml);
});

}  // namespace sunload::fuzz
