// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the light of a place comes from, patch by patch: a file that `render` and `export` take.
#pragma once

#include <string>

#include "io/explain/result_scene.h"
#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// Throws InputError for a path that does not end in .h5.
void expect_map_name(const std::string& path);

/// What every square metre of a patch adds to the mean load of the place, and takes from it
/// (solver/explain/attribution.h, Among::patches): the datasets of `place_map_schema`. Times their
/// areas, an object's patches add up to its row of the explanation, of the same lines. Throws
/// InputError as `explained` does, MachineError where the file cannot be written.
void write_place_map(const ResultReader& result, const ResultScene& scene, const NamedParts& parts,
                     const std::string& path);

}  // namespace sunload
