// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A result's light in each band, over the part of the period that is chosen.
#pragma once

#include <memory>
#include <vector>

#include "io/explain/result_scene.h"
#include "io/result/reader.h"
#include "solver/explain/attribution.h"

namespace sunload {

/// A reader for each band, of the same part of the period; of broadband light one.
std::vector<std::unique_ptr<const ResultReader>> readers_of_bands(const ResultReader& result);

/// Diffuse reflectance of the patches in each band; of broadband light once.
std::vector<std::vector<float>> reflectances_of_bands(const ResultScene& scene);

/// Share of every interval of the study that is chosen, whatever the series' steps; empty: the
/// whole period.
std::vector<double> chosen_part(const ResultReader& result, const LightSeries& light);

/// What patches send diffusely: as the result has it of the whole period, else ρ E and what shines.
SentLight sent_light(const ResultReader& result, const ResultScene& scene);

}  // namespace sunload
