/// What a result holds, for people on one screen and for machines per patch.
#pragma once

#include <string>

#include "io/result_file.h"

namespace sunload {

/// One screen: study, period, accuracy, least, mean and largest irradiance and
/// light load with their ratios ("lighting analysis"), facades, energy ledger.
/// Irradiance is that of the brightest interval of the period (largest GHI).
std::string info_text(const ResultReader& result);

/// The energy ledger of the whole period [kWh]: in, out, residual with its standard error.
std::string energy_text(const ResultReader& result);

/// One line per patch, header first: index, object, facade, surface, material,
/// side, area, centroid and normal in the scene frame (add the attribute
/// `origin` for absolute coordinates), light load with its standard error and
/// parts, sun hours, power load. Empty where the result lacks a value.
std::string patches_csv(const ResultReader& result);

}  // namespace sunload
