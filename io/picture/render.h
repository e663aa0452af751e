// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures of a result: what falls on every patch in false colour, with legend.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/base/colour_map.h"
#include "io/picture/colour_scale.h"
#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// From where a scene is seen.
enum class View {
  overview,  ///< from above, from the sun's side and its afternoon
  sun,       ///< parallel, as the sun sees the scene at `time`
  top        ///< parallel, from above, north up
};

/// Central perspective, or rays that are parallel.
enum class Projection { perspective, parallel };

/// Whether thin lines part patches.
enum class MeshLines { none, patches };

/// of_values: by a palette; of_bands: red, green and blue light as what they are; of_surfaces and
/// of_materials: kinds, without any light (io/base/scene_colours.h).
enum class PictureColours { of_values, of_bands, of_surfaces, of_materials };
/// What is behind the scene: one light colour, or the clear sky with the sun of the interval by one
/// of the two models of geo/sky/sky_colour.h.
enum class SkyBackground { plain, first, second };

/// What a picture shows, from where, and in which colours.
struct RenderRules {
  /// A dataset [patch] or [time, patch]; empty: the light load, animated the irradiance.
  std::string quantity;
  std::string time;  ///< as in a study; empty: the brightest interval
  View view = View::overview;
  /// What the picture is of. Facades that look the same way are seen parallel, from before them;
  /// what stands farther in front is cut away. Objects, and facades that look several ways, are
  /// what the other cameras hold. Empty: buildings, not the ground about them.
  NamedParts parts;
  /// From a point to a point, as io/picture/viewpoint.h reads them. An eye alone is before a
  /// facade and looks where it does; what is looked at alone is seen as by the overview.
  std::string eye, look;
  /// Of the overview and of eye and look, perspective where left out; parallel pictures hold the
  /// whole scene. The cameras of the sun and from above are always parallel.
  std::optional<Projection> projection;
  int width = 1600, height = 1000;  ///< of the whole picture [pixels], 320 … 16384
  std::optional<double> largest;    ///< value of the last colour, in units of the quantity
  PictureColours colours = PictureColours::of_values;
  std::vector<std::string> same_scale;  ///< results that the last colour must do for, too
  Palette palette = Palette::false_colour;
  ColourScale scale = ColourScale::linear;  ///< logarithmic: three decades, of values alone
  std::optional<SkyBackground> sky;         ///< plain for totals, `second` for series
  MeshLines mesh = MeshLines::none;
  /// Colours run between corners; these have the means of the patches around them that turn by
  /// no more than the crease angle (20° where left out).
  bool interpolate = false;
  std::optional<double> crease_angle_deg;
};

/// Draws and writes a PNG. Of kinds of surface or of materials it needs no light: the legend has
/// their areas, and beside north stands the path of the sun over the period. Colours of bands show
/// white where all bands reach `largest`, of `power_load` as an eye would see the surfaces. Rays
/// are cast at 2 × 2 points of a pixel; colours are not shaded, so that every colour is one of the
/// legend's; thin lines part objects, materials and folds. Backs of one-sided surfaces are grey.
/// Throws InputError for a quantity, time, camera or size that the result does
/// not have, for a time that changes nothing, and where the camera would see nothing of the scene
/// or of what it is to show; MachineError where the picture cannot be written.
void render_png(const ResultReader& result, const RenderRules& rules, const std::string& path);

/// A picture for every interval, of the part of the period that is chosen, with the sun above the
/// horizon: `NAME-0001.png` … by the interval's place in the result (from 1), and `NAME.png`
/// with all of them as an animation (APNG). One scale does for all. Throws as above, and where no
/// sun is up.
void render_animation(const ResultReader& result, const RenderRules& rules,
                      const std::string& path);

}  // namespace sunload
