// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/sensor.h"

#include <bit>

#include "geo/base/keys.h"
#include "solver/base/rng.h"

namespace sunload {

std::uint64_t key_of_place(Vec3 absolute_position, Vec3 normal) {
  std::uint64_t key = 0x73656e736f72;  // "sensor": apart from the keys of patches
  for (const Vec3& v : {absolute_position, normal})
    for (const double x : {v.x, v.y, v.z}) key = mixed(key, std::bit_cast<std::uint64_t>(x + 0.0));
  return key;
}

}  // namespace sunload
