// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Colours that stand for kinds: of surface and of material, wherever a scene is shown by them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/base/colour_map.h"

namespace sunload {

inline constexpr std::size_t surface_colour_count = 6;
/// Of the kind of surface with that number: other, wall, roof, ground, window, floor.
Colour surface_colour(std::size_t kind);

/// Materials of one scene that have colours of their own; more of them begin anew.
inline constexpr std::size_t material_colour_count = 21;
/// One of them. Colours that all eyes tell apart (Okabe & Ito 2008, Color Universal Design),
/// lightened; then darker ones of them.
Colour material_colour(std::size_t number);
/// Which of them each material of a scene has: by its name, so that it has the same in all variants
/// but where another one with the same claim comes or goes.
std::vector<std::size_t> material_colours(const std::vector<std::string>& names);

}  // namespace sunload
