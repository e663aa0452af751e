// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// VRML97, VRML 1.0 and Inventor, also packed by gzip, through Coin.
#include "io/scene/vrml/reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

static const Registered target("vrml", [](std::string_view bytes) {
  static const auto neighbour = file_of(
      "#VRML V2.0 utf8\n"
      "PROTO Far [ field SFFloat a 1 ] { Shape { geometry Sphere { radius IS a } } }\n"
      "Shape { geometry Box { } }\n",
      "far.wrl");
  read_and_prepare(bytes, "scene.wrl", read_scene_vrml);
});

}  // namespace sunload::fuzz
