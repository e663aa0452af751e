// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a result holds, for people on one screen and for machines per patch.
#pragma once

#include <string>

#include "io/result/group_table.h"
#include "io/result/reader.h"

namespace sunload {

/// One screen: study, period, accuracy, least, mean and largest irradiance and
/// light load with their ratios ("lighting analysis"), facades, energy ledger.
/// Irradiance is that of the brightest interval of the period (largest GHI).
std::string info_text(const ResultReader& result);

/// A table of facades, objects or sensors for people, in the order of the file.
std::string group_table_text(const ResultReader& result, const GroupTable& table);
/// The same for machines: study, variant and one object per row; null where a value is not known.
std::string group_table_json(const ResultReader& result, const GroupTable& table);

}  // namespace sunload
