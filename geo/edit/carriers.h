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

/// Of each chosen object the chosen body that it sits on. Parts of buildings are bodies, and what
/// belongs to nothing that is chosen: they have none. What belongs to a building without surfaces
/// sits on the nearest of its parts in plan; of several at one place on the smallest.
std::vector<std::optional<std::size_t>> carriers_of(const FamilyTree& tree,
                                                    const std::vector<ObjectExtent>& extents,
                                                    const ChosenObjects& chosen);

}  // namespace sunload
