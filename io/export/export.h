// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Results in the formats of other programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/colour_map.h"
#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// What was asked for; what is left out is empty.
struct ExportRules {
  std::string format;              ///< a word of `export_formats`
  std::string quantity;            ///< a dataset [patch] or [time, patch]; csv also "series"
  std::string time;                ///< as in a study; empty: the brightest interval
  std::optional<Palette> palette;  ///< false colour where left out
  std::optional<double> largest;   ///< value of the last colour, in units of the quantity
  /// Colours of corners instead of patches: the area-weighted mean of the patches around the
  /// corner that turn by no more than the crease angle (20° where left out).
  bool interpolate = false;
  std::optional<double> crease_angle_deg;
  bool light_map = false;  ///< glb: colours in a texture, not of vertices
  std::string of;          ///< csv: rows of what: patch (where left out), facade, object, sensor
  NamedParts parts;        ///< csv, gpkg, energyplus: of these alone
  std::string model;  ///< cityjson: the study's own model, which gets its values back; empty: none
};

/// The word of form factors, which are of a scene and not of its light: io/factors.
inline constexpr std::string_view form_factors_word = "form-factors";

/// csv, vtk, …, form-factors: words for `--to`.
std::vector<std::string> export_formats();

/// Writes a result to a file that appears when it is complete; an empty `path` is the standard
/// output, for formats of text. Patches keep their order; positions are those of the result:
/// metres relative to the origin, which every file names. z is up, in glTF and VRML y.
/// Throws InputError for a format, quantity, time or option that does not fit, MachineError
/// where the file cannot be written.
void export_result(const ResultReader& result, const ExportRules& rules, const std::string& path);

}  // namespace sunload
