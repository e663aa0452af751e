// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a result holds, for people on one screen and for machines per patch.
#pragma once

#include <string>

#include "io/result/reader.h"

namespace sunload {

/// One screen: study, period, accuracy, least, mean and largest irradiance and
/// light load with their ratios ("lighting analysis"), facades, energy ledger.
/// Irradiance is that of the brightest interval of the period (largest GHI).
std::string info_text(const ResultReader& result);

}  // namespace sunload
