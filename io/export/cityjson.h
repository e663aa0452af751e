// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The two ways of CityJSON export: the patches, or the study's own model with values.
#pragma once

#include <string>

#include "geo/base/vec.h"
#include "geo/mesh/mesh.h"
#include "io/export/format.h"

namespace sunload {

/// The type of a semantic surface that our reader takes for that kind of surface.
std::string surface_type(Surface kind, Vec3 normal);

/// "https://www.opengis.net/def/crs/EPSG/0/7415" of a CRS that names an EPSG code; else empty.
std::string reference_system(const std::string& crs);

/// The model as it is, with the values of the patches as attributes of the semantic surfaces and
/// city objects that they were cut from. Throws InputError where the model has none of the objects.
void write_model_with_values(const ResultReader& result, const ExportRules& rules,
                             const ExportTarget& target);

}  // namespace sunload
