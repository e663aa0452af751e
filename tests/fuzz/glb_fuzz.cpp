// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// glTF as one binary file.
#include "io/scene/mesh_files/gltf.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("glb", [](std::string_view bytes) {
  read_and_prepare(bytes, "scene.glb", read_scene_gltf);
});

}  // namespace sunload::fuzz
