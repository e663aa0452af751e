// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ.
#include "io/scene/mesh_files/obj.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("obj", [](std::string_view bytes) {
  read_and_prepare(bytes, "scene.obj", read_scene_obj);
});

}  // namespace sunload::fuzz
