// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// STL, text and binary.
#include "io/scene/mesh_files/stl.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("stl", [](std::string_view bytes) {
  read_and_prepare(bytes, "scene.stl", read_scene_stl);
});

}  // namespace sunload::fuzz
