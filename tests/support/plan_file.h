// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of maps in formats that are no text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sunload::test {

/// Writes the features of a GeoJSON file by another driver of GDAL; false where that fails.
bool write_plan(const std::string& geojson, const std::string& driver, const std::string& path);

/// Runs a statement on a database of plans (GeoPackage); false where that fails.
bool change_plan(const std::string& path, const std::string& sql);

/// Gives a raster a mask of its own, a byte for each cell: 0 where there is no data; false where
/// that fails.
bool write_mask(const std::string& raster, std::vector<std::uint8_t> is_valid);

}  // namespace sunload::test
