// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensors: points with a normal that receive light and do not disturb the scene.
#pragma once

#include <cstdint>

#include "geo/base/vec.h"

namespace sunload {

struct Sensor {
  Vec3 position;          ///< m, relative to the mesh's origin
  Vec3 normal{0, 0, 1};   ///< unit: light is received from the hemisphere about it
  std::uint64_t key = 0;  ///< stable address of its random numbers
};

/// Key of a sensor or luminaire from where it stands (absolute, so that variants share it) and
/// where it looks: others of a study make no difference to it.
std::uint64_t key_of_place(Vec3 absolute_position, Vec3 normal);

}  // namespace sunload
