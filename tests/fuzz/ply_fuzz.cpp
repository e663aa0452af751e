// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// PLY, text and binary.
#include "io/scene/mesh_files/ply.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("ply", [](std::string_view bytes) {
  read_and_prepare(bytes, "scene.ply", read_scene_ply);
});

}  // namespace sunload::fuzz
