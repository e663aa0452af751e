// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "tests/support/scenes.h"

namespace sunload::test {

struct CourtMaterials {
  Material ground{"ground", 0.25};
  Material wall{"wall", 0.45};
  Material glass{"glass", 0.1, 0.7};
  Material lamp{"lamp", 0.3, 0, 25};
  std::optional<Material> tower = {}, screen = {};  ///< absent: as the wall
};

/// A court with a mirror wall, a tower, a lamp, and a two-sided screen: everything that light can
/// do in one scene of 16 m.
inline Scene court(const CourtMaterials& of = {}) {
  using Facing = SceneBuilder::Facing;
  SceneBuilder builder;
  const int ground = builder.material(of.ground), wall = builder.material(of.wall),
            glass = builder.material(of.glass), lamp = builder.material(of.lamp),
            tower = of.tower ? builder.material(*of.tower) : wall,
            screen = of.screen ? builder.material(*of.screen) : wall;
  builder.object("ground").quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, ground);
  builder.object("house").box({-6, 3, 0.01}, {6, 6, 5}, wall, Facing::outward);
  builder.object("glass").quad({-5, 2.99, 0.5}, {5, 2.99, 0.5}, {5, 2.99, 4.5}, {-5, 2.99, 4.5},
                               glass);
  builder.object("tower").box({-6, -5, 0.01}, {-3, -2, 8}, tower, Facing::outward);
  builder.object("lamp").quad({3, -4, 3}, {3, -3, 3}, {4, -3, 3}, {4, -4, 3}, lamp);
  builder.sides(Sides::two)
      .object("screen")
      .quad({5, -8, 0.2}, {8, -8, 0.2}, {8, -8, 3}, {5, -8, 3}, screen);
  return builder.scene();
}

/// The same with every reflectance changed.
inline Scene court_changed(double (*change)(double)) {
  CourtMaterials of;
  for (Material* material : {&of.ground, &of.wall, &of.glass, &of.lamp})
    material->diffuse = change(material->diffuse);
  return court(of);
}

}  // namespace sunload::test
