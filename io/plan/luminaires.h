// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Luminaires of a study as the scene has them.
#pragma once

#include <string>
#include <vector>

#include "geo/mesh/mesh.h"
#include "io/study/study.h"
#include "solver/surface/luminaire.h"

namespace sunload {

/// In the mesh's frame; rows as their luminaires. Reads each photometry once. Throws InputError for
/// files that are none and rows that are too long; `warnings`: what stands far from the scene.
Luminaires place_luminaires(const std::vector<LuminaireStudy>& studies, const Mesh& mesh,
                            const Box& bounds, std::vector<std::string>& warnings);

}  // namespace sunload
