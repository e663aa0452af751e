// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Plan data in formats that are no text.
#pragma once

#include <string>

namespace sunload::test {

/// Writes the features of a GeoJSON file by another driver of GDAL; false where that fails.
bool write_plan(const std::string& geojson, const std::string& driver, const std::string& path);

}  // namespace sunload::test
