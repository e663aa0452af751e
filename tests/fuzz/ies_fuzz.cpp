// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Photometry of luminaires.
#include "io/scene/ies_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("ies", [](std::string_view bytes) {
  read_ies_file(file_of(bytes, "lamp.ies"));
});

}  // namespace sunload::fuzz
