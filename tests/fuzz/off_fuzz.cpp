// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// OFF.
#include "io/scene/mesh_files/off.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("off", [](std::string_view bytes) {
  read_and_prepare(bytes, "scene.off", read_scene_off);
});

}  // namespace sunload::fuzz
