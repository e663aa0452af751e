// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What of two results can be compared, where it counts, and what a reader must know of it.
#pragma once

#include <string>
#include <vector>

#include "io/result/common_area.h"
#include "io/result/reader.h"

namespace sunload {

/// Throws InputError that lists what there is, unless both results have a total `dataset` per
/// patch, of the chosen part of the period and in the same unit.
void expect_comparable(const ResultReader& base, const ResultReader& variant,
                       const std::string& dataset);

/// Of a measure the patches that it is measured at; else all of them.
CountedPatches counted_patches(const ResultReader& base, const ResultReader& variant,
                               const std::string& dataset);

/// Whether it is a load of which a share is wrong where meshes differ (io/result/mesh_error).
bool has_mesh_error(const std::string& dataset);

/// That periods, versions, reflections, north or rules of measures differ.
std::vector<std::string> notes_on(const ResultReader& base, const ResultReader& variant,
                                  const std::string& dataset);

}  // namespace sunload
