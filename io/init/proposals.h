// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials of the table that names and kinds suggest.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geo/mesh/mesh.h"

namespace sunload {

/// By a name of a material or an object in a file, whatever its case: "Facade_Brick_02" → brick.
/// Nothing where it tells nothing.
std::optional<std::string> proposed_for_name(std::string_view name);
/// By the type of a city object: "SolitaryVegetationObject" → crown. Nothing for buildings, whose
/// kinds of surface tell more.
std::optional<std::string> proposed_for_kind(std::string_view kind);
/// By the kind of surface.
std::string proposed_for_surface(Surface surface);

}  // namespace sunload
