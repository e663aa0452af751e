// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Houses made higher: walls extended at one height, all above it lifted whole.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "geo/edit/objects.h"

namespace sunload {

/// What is thinner hangs on the body (balconies, eaves) and is no roof of its own.
inline constexpr double thinnest_body_m = 1;

/// Height [m, absolute] from which a body is lifted by default: the lowest point of its roofs,
/// which are the faces named so, else those that lean, have nothing of the object above and at
/// least `thinnest_body_m` of it below. What hangs under a roof's rim counts as part of it.
/// Nothing where no face is a roof.
std::optional<double> eaves_of(const std::vector<LooseFace>& faces);

/// Where an object was cut and what came of it.
struct RaisedObject {
  double cut_m = 0;             ///< height that walls are extended at, absolute
  double level_m = 0;           ///< corners at and above are lifted: `cut_m` less rounding of files
  std::size_t windows_cut = 0;  ///< faces of kind window that become higher
  std::string refusal, reason;  ///< what cannot be done, and why; empty: it is done
  bool is_lifted = false;
  double outline_m = 0;  ///< of what is lifted, in plan
  double bare_m = 0;     ///< of that, where no wall went across the cut
  double added_m = 0;    ///< of that, where walls were added (raised_outline.h)
};

/// Lifts all corners of an object at and above `cut_m` (absent: the eaves) by `by_m`; the lower
/// ones stay. Corners keep their neighbours: closed bodies stay closed, upright walls plane. Where
/// the outline of what rises had no wall, as between terraced houses, it gets upright ones of the
/// kind and material of the object's others, from the old to the new height. Changes nothing where
/// it refuses: no roof, a roof that reaches down to the foot, a cut through a roof, or, with `by_m`
/// below 0, walls that would vanish.
RaisedObject raise_object(PolygonModel& model, ObjectId object, double by_m,
                          std::optional<double> cut_m);

/// Lifts what sits on a raised body (dormers, chimneys): all of it that is at or above the body's
/// `level_m`, extended like walls below; what cannot be extended so is lifted or left whole, by its
/// middle. False where none of it is lifted.
bool lift_with(PolygonModel& model, ObjectId object, const RaisedObject& body, double by_m);

}  // namespace sunload
