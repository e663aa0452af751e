// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bands in batch files and results: names of arrays, and which band a reader is shown.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/light/band.h"

namespace sunload {

/// Before the names of a batch's arrays: one empty prefix for broadband light, else `red/`, ….
std::vector<std::string> band_prefixes(Bands bands);

/// `red/irradiance` → band 0 of `irradiance`; names without prefix have no band.
struct BandArray {
  std::optional<std::size_t> band;
  std::string name;
};
BandArray band_array(const std::string& name);

/// Number of a band by its name. Throws InputError that lists the names.
std::size_t band_by_name(const std::string& name);

/// Values of the bands ([rows, n] each) as a result has them: [rows, band, n]. A single one stays.
std::vector<double> side_by_side(std::vector<std::vector<double>> bands, std::size_t rows);

}  // namespace sunload
