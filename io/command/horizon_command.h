// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// `sunload horizon`: the line of far hills of a site, from an elevation model.
#pragma once

#include <optional>
#include <string>

namespace sunload {

struct HorizonOptions {
  std::string land;                ///< raster
  std::string study;               ///< whose site it is; empty: `at`
  std::string at;                  ///< position in words (site_from_text)
  std::string crs;                 ///< of a raster that names none
  std::optional<double> unit_m;    ///< of its coordinates and heights; default: 1
  std::optional<double> above_m;   ///< of the eye; default: 2
  std::optional<double> from_m;    ///< default: as far as the study's scene reaches, or 0
  std::optional<double> to_m;      ///< default: 50 km
  std::optional<double> step_deg;  ///< default: 1
  std::string output;              ///< file; empty: stdout
};
/// Writes a table that `site.horizon` reads, and tells on the standard error how far the land
/// reaches. Throws InputError.
int horizon(const HorizonOptions& options);

}  // namespace sunload
