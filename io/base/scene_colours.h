// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Colours that stand for kinds: of surface and of material, wherever a scene is shown by them.
#pragma once

#include <cstddef>

#include "io/base/colour_map.h"

namespace sunload {

inline constexpr std::size_t surface_colour_count = 6;
/// Of the kind of surface with that number: other, wall, roof, ground, window, floor.
Colour surface_colour(std::size_t kind);

/// Materials of one scene that have colours of their own; more of them begin anew.
inline constexpr std::size_t material_colour_count = 21;
/// Of the material with that number in its scene. Colours that all eyes tell apart (Okabe & Ito
/// 2008, Color Universal Design), lightened; then darker ones of them.
Colour material_colour(std::size_t material);

}  // namespace sunload
