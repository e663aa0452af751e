// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Whole houses of a closed row, from the parts in `builtin_houses.h`.
#pragma once

#include <string>
#include <vector>

#include "geo/builtin/houses.h"

namespace sunload::builtin {

/// Shape of the roof over the whole depth of a house.
enum class Roof { gable, mansard };
/// What the front has at street level: windows of flats, or shop windows.
enum class GroundFloor { flats, shops };

/// A tenement house; lengths in metres.
struct House {
  std::string name;
  Placement placement;
  double width, depth;
  std::vector<double> storeys;  ///< heights, from the ground floor
  int axes;                     ///< windows of a storey of the front
  int rear_axes;
  Roof roof = Roof::gable;
  double ridge = 5;  ///< above the eaves
  GroundFloor ground_floor = GroundFloor::flats;
  WindowKind window{};
  std::vector<int> balcony_axes{};  ///< on every storey but the lowest
  int door_axis = 0;
  int dormers = 0, roof_windows = 0, chimneys = 2, gable_axes = 0;

  double eaves() const {
    double sum = 0;
    for (const double height : storeys) sum += height;
    return sum;
  }
};

/// The end of a house that has no neighbour: its gable gets windows.
enum class FreeGable { low_x, high_x };

/// A tenement house as an object of its own.
void add_house(Builder& builder, const House& house, const HouseFinishes& finishes, FreeGable free);

/// An office house of the same ground plan and eaves: glass from floor to
/// floor towards the street, large panes at the rear, a flat roof.
struct OfficeFinishes {
  Finish metal, glass, deck;
};
void add_glazed_house(Builder& builder, const House& house, const HouseFinishes& finishes,
                      const OfficeFinishes& office, FreeGable free);

}  // namespace sunload::builtin
