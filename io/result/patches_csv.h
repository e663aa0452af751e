// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Patches of a result as a table.
#pragma once

#include <string>

#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// One line per patch, header first: index, object, facade, surface, material,
/// side, area, centroid and normal in the scene frame (add the attribute
/// `origin` for absolute coordinates), light load with its standard error and
/// parts, sun hours, power load, then all else that the result tells of every patch (sky view
/// factor, largest irradiance, reflectance, measures); of a comparison the loads of base and
/// variant, their difference and its standard error; of a map of a place what patches give and
/// take. Empty where the result lacks a value. `parts`: patches of these facades and objects alone.
std::string patches_csv(const ResultReader& result, const NamedParts& parts = {});

}  // namespace sunload
