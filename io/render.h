/// Pictures of a result: what falls on every patch in false colour, with legend.
#pragma once

#include <optional>
#include <string>

#include "geo/vec.h"
#include "io/colour_map.h"
#include "io/result_file.h"

namespace sunload {

enum class View {
  overview,  ///< perspective from above, from the sun's side and its afternoon
  sun,       ///< parallel, as the sun sees the scene at `time`
  top        ///< parallel, from above, north up
};

enum class MeshLines { none, patches };

/// of_values: by a palette; of_bands: red, green and blue light as what they are.
enum class PictureColours { of_values, of_bands };

struct RenderRules {
  std::string quantity = "light_load";  ///< a dataset [patch] or [time, patch]
  std::string time;                     ///< as in a study; empty: the brightest interval
  View view = View::overview;
  /// Perspective from a point to a point of the scene, in the coordinates of
  /// the study (absolute); replaces `view`. Both or none.
  std::optional<Vec3> eye, look;
  int width = 1600, height = 1000;  ///< of the whole picture [pixels], 320 … 16384
  std::optional<double> largest;    ///< value of the last colour, in units of the quantity
  PictureColours colours = PictureColours::of_values;
  Palette palette = Palette::false_colour;
  MeshLines mesh = MeshLines::none;
};

/// Draws and writes a PNG. Colours of bands show white where all bands reach `largest`, of
/// `power_load` as an eye would see the surfaces. Rays are cast at 2 × 2 points of a pixel; colours
/// are not shaded, so that every colour is one of the legend's; thin lines part
/// objects, materials and folds. Backs of one-sided surfaces are grey.
/// Throws InputError for a quantity, time, camera or size that the result does
/// not have, MachineError where the picture cannot be written.
void render_png(const ResultReader& result, const RenderRules& rules, const std::string& path);

}  // namespace sunload
