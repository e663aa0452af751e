// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials that studies may name without defining them: reflectances from the literature.
///
/// Values are shares of sunlight, broadband over the solar spectrum (0.3 … 3 µm). Where a source
/// gives a range the value is its middle. All reflect diffusely unless a row says otherwise:
/// the sheen of metals and water is not modelled by them. A colour that is seen says little of
/// these values, since half of sunlight is infrared.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/study/study.h"

namespace sunload {

/// One row: the range of a reflectance in its source, and what else the material does with light.
struct TabledMaterial {
  const char* name;
  double low, high;  ///< diffuse reflectance that the source gives; equal where it is one value
  const char* what;
  const char* source;
  double mirror = 0;
  double transmittance = 0;     ///< of one surface: a crown's skin is crossed twice
  double refractive_index = 0;  ///< of panes
  double absorption_per_m = 0;  ///< of panes
  int panes = 1;
  Sides sides = Sides::one;

  /// Middle of the range, as the decimal number that a study would have.
  double diffuse() const { return std::round((low + high) / 2 * 1e4) / 1e4; }
};

/// In alphabetical order of the names.
std::span<const TabledMaterial> material_table();

/// The row of that name as a study would write it; nothing where the table has none.
std::optional<MaterialStudy> tabled_material(std::string_view name);

std::vector<std::string> tabled_names();

/// docs/materials.md.
std::string material_page();

/// One material a line, for `sunload materials`.
std::string material_listing();

/// By angle of incidence what share of light each material reflects, into whatever direction
/// (directional-hemispherical reflectance), and where it differs from 0, what it lets pass.
std::string angle_listing();

}  // namespace sunload
