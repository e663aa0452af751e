// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The built-in scenes, one function each; `scene_builtin.h` is the entry for users.
#pragma once

#include "geo/mesh/mesh.h"

namespace sunload::builtin {

/// The facade of house 3 of the street.
enum class House3 { brick, glazed };

/// Four houses in ordinary closed rows on both sides of a street that runs
/// east, as in the historic test scene. house_1 and house_3 stand north of it
/// (fronts to the south), house_2 and house_4 south; house_4 is opposite
/// house_3. The same ground plan and eaves in both variants of house 3.
///
/// Every object is a closed body of its own. Bodies never touch: joints of
/// 5 mm between the plates of the ground, 5 cm between neighbouring houses.
PolygonModel street(House3 house_3);

/// Five towers on a plaza; the front-left one (south-west, tower_1) is clad
/// with mirror glass, all other surfaces are diffuse only.
PolygonModel skyscrapers();

/// A box on a square plane of the side `plane`, its middle at the origin.
struct BoxOnPlane {
  double width = 10, depth = 10, height = 10, plane = 60;
};
PolygonModel box_on_plane(const BoxOnPlane& size);

/// A street that runs east between two plain rows: height and width of the
/// canyon, and its length.
struct Canyon {
  double height = 15, width = 15, length = 150;
};
PolygonModel canyon(const Canyon& size);

/// A closed room with a lamp in its ceiling that sends light downward only.
/// The outside of its shell is `floor`: no patches.
struct Room {
  double width = 5, depth = 4, height = 2.8;
};
PolygonModel room(const Room& size);

/// A street that runs east: windows of mirror reflectance 0.85 in the left
/// (north) building, a plain lower building on the right.
PolygonModel windows();

/// A black cylinder and two boxes of low reflectance on a plane.
struct Cylinder {
  double radius = 2, height = 5;
};
PolygonModel cylinder(const Cylinder& size);

/// Gable houses of many sizes in rows, each on a plot of its own: about so many triangles, 48 a
/// house. Every house and every plot (a plate with a shaft for its house) is a closed body;
/// house_1, plot_1 stand at the origin, rows run east.
PolygonModel city(double triangles);

// The Global Illumination Test Scenes of Smits and Jensen (2000), University of
// Utah, as the historic system used them. Sizes in metres and watts are ours.

/// One square emitter beside a 10 × 10 tiling of it, symmetric about x = 0.
PolygonModel emission();
/// Eight long tilted boxes between one emitter and a plane.
PolygonModel shadow();
/// An emitter above a shield of its size, and a copy of both ten times smaller
/// below; 99 % of the power comes from the large one.
PolygonModel large_extent();
/// An emitter below a plane; a cube on the plane is reached after three
/// diffuse reflections at the least.
PolygonModel complex_paths();
/// Cubes sunk into and lifted off a plane by 1 % of their height, one on its
/// corner, and a slender wedge.
PolygonModel geometric_accuracy();

}  // namespace sunload::builtin
