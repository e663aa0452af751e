// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/scenes.h"

namespace sunload::test {

/// A court with a mirror wall, a tower, a lamp, and a two-sided screen: everything that light can
/// do in one scene of 16 m. `change` is applied to every reflectance.
inline Scene court(double (*change)(double) = [](double rho) { return rho; }) {
  using Facing = SceneBuilder::Facing;
  SceneBuilder builder;
  const int ground = builder.material({"ground", change(0.25), 0, 0});
  const int wall = builder.material({"wall", change(0.45), 0, 0});
  const int glass = builder.material({"glass", change(0.1), 0.7, 0});
  const int lamp = builder.material({"lamp", change(0.3), 0, 25});
  builder.object("ground").quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, ground);
  builder.object("house").box({-6, 3, 0.01}, {6, 6, 5}, wall, Facing::outward);
  builder.object("glass").quad({-5, 2.99, 0.5}, {5, 2.99, 0.5}, {5, 2.99, 4.5}, {-5, 2.99, 4.5},
                               glass);
  builder.object("tower").box({-6, -5, 0.01}, {-3, -2, 8}, wall, Facing::outward);
  builder.object("lamp").quad({3, -4, 3}, {3, -3, 3}, {4, -3, 3}, {4, -4, 3}, lamp);
  builder.sides(Sides::two)
      .object("screen")
      .quad({5, -8, 0.2}, {8, -8, 0.2}, {8, -8, 3}, {5, -8, 3}, wall);
  return builder.scene();
}

}  // namespace sunload::test
