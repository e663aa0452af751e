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

/// Of each chosen object the chosen body that it sits on. What belongs to a building without
/// surfaces sits on the nearest of its parts in plan; of several at one place on the smallest.
/// Parts of buildings are bodies, as is what belongs to nothing that is chosen: these have none,
/// but for parts that stand on the roof of another chosen part of their building (towers of lifts,
/// dormers), by more than half of the lower edges of their walls.
std::vector<std::optional<std::size_t>> carriers_of(const FamilyTree& tree,
                                                    const PolygonModel& model,
                                                    const ChosenObjects& chosen);

}  // namespace sunload
