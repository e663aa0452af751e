// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which series a study stores, and how.
#pragma once

#include <string>
#include <vector>

#include "io/batch/batch_tally.h"
#include "io/study/study.h"

namespace sunload {

/// Series of patches and sensors that the study does not want in its result.
std::vector<std::string> unwanted_series(const OutputStudy& output);

/// What batches hold of the series.
StoredSeries stored_series(const Study& study);

}  // namespace sunload
