// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// ESRI ASCII rasters, through GDAL.
#include "io/scene/raster/raster_scene.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("raster_ascii", [](std::string_view bytes) {
  read_and_prepare(bytes, "scene.asc", read_scene_raster);
});

}  // namespace sunload::fuzz
