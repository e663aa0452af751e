// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensors: points with a normal that receive light and do not disturb the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

struct Sensor {
  Vec3 position;          ///< m, relative to the mesh's origin; rays start `ray_offset_m` off it
  Vec3 normal{0, 0, 1};   ///< unit: light is received from the hemisphere about it
  std::uint64_t key = 0;  ///< stable address of its random numbers
  Vec3 stands_at = {};    ///< as the study says; `position` may be beside it: `clear_of_surfaces`
};

/// Key of a sensor or luminaire from where it stands (absolute, so that variants share it) and
/// where it looks: others of a study make no difference to it.
std::uint64_t key_of_place(Vec3 absolute_position, Vec3 normal);

/// Keeps the positions of sensors as `stands_at`, and puts them where rays that start off them by
/// the ray offset along the normal see right. Off surfaces on which they stand: one that looks
/// along a floor, a wall or a roof would lie in it else, and rays meet it or not as they are
/// rounded. A one-sided surface is left by its front, unless the sensor looks into it; a sheet by
/// the side that it looks to. Elsewhere the offset is taken back, so that they see from where they
/// stand.
void clear_of_surfaces(const Mesh& mesh, std::vector<Sensor>& sensors);

}  // namespace sunload
