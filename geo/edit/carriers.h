// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which bodies carry dormers, chimneys and what else belongs to them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geo/edit/objects.h"
#include "geo/mesh/families.h"

namespace sunload {

/// What sits on what, of the chosen objects.
struct Carriers {
  /// Of each object the body that it sits on, and is lifted with; bodies have none.
  std::vector<std::optional<std::size_t>> of;
  /// Bodies that another one covers (cellars, lower storeys): they stay, that one is raised.
  ChosenObjects is_covered;
};
/// What belongs to a building without surfaces sits on the nearest of its parts in plan; of several
/// at one place on the smallest. Parts of buildings are bodies, as is what belongs to nothing that
/// is chosen: these sit on nothing, but for parts that stand on the roofs of other chosen bodies of
/// their building (towers of lifts, dormers), or up to 1 m in them, by more than half of the lower
/// edges of their walls: on that which has most of these.
/// `from_m`: what is no higher above its foot carries no part.
Carriers carriers_of(const FamilyTree& tree, const PolygonModel& model, const ChosenObjects& chosen,
                     std::optional<double> from_m = {});

}  // namespace sunload
