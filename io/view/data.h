// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One result as the viewer's page reads it (scripts/viewer/data.js): a JSON
/// head and blocks of deflated bytes in base64.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/result/reader.h"
#include "io/view/blocks.h"
#include "io/view/two_results.h"

namespace sunload {

/// Geometry and all quantities per patch as floats, series as halves scaled by
/// a power of two (11 bits: three digits). Every `step`-th interval of a series
/// is taken. Appends to `blocks`, which the JSON names by number.
/// Throws InputError where the file lacks what a result must have.
nlohmann::json view_data(const ResultReader& result, std::size_t step, ViewBlocks& blocks);

/// The same of what two results have in common.
nlohmann::json view_data(const TwoResults& two, ViewBlocks& blocks);

/// The series that the viewer shows at an instant: irradiance, or illuminance; empty if none.
std::string viewed_series(const ResultReader& result);

}  // namespace sunload
