// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Material libraries of OBJ.
#include "io/scene/base/from_file.h"
#include "io/scene/mesh_files/mtl.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("mtl", [](std::string_view bytes) {
  NoteCounter notes;
  read_material_library(file_of(bytes, "scene.mtl"), notes);
  notes.lines();
});

}  // namespace sunload::fuzz
