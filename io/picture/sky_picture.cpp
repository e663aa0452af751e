// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the sky dome.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "io/picture/dome_chart.h"
#include "io/picture/render_frame.h"
#include "io/plan/sky_dome.h"

namespace sunload {

namespace {

constexpr int dome_width = 1200, dome_height = 1100;
constexpr double legend_width = 150;
constexpr Colour hills_in_colour{0.20, 0.22, 0.18};
constexpr double candelas_per_kilocandela = 1000;

void paint_dome(Picture& picture, const DomeChart& chart,
                const std::function<Colour(Horizontal)>& colour) {
  const auto left = static_cast<int>(chart.centre().x - chart.radius()) - 1;
  const auto top = static_cast<int>(chart.centre().y - chart.radius()) - 1;
  const int size = static_cast<int>(2 * chart.radius()) + 3;
  const auto columns = static_cast<std::size_t>(size);
  std::vector<Colour> pixels(columns * columns, Colour{1, 1, 1});
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const auto place = chart.place({left + column + 0.5, top + row + 0.5});
      if (place)
        pixels[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] =
            colour(*place);
    }
  picture.paint(left, top, size, pixels);
}

/// End of the scale: what nearly all of the sky stays below, so that the glow around the sun
/// does not make the rest dark [kcd m-2].
double scale_end(const SkyDome& dome) {
  constexpr double share = 0.98;
  std::vector<double> values;
  for (const auto& row : sky_rows(dome, {}))
    values.push_back(row.luminance / candelas_per_kilocandela);
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

void paint_luminance(Picture& picture, const DomeChart& chart, const SkyDome& dome) {
  const double end = scale_end(dome);
  const double largest = end > 0 ? rounded_up(end) : 1;
  paint_dome(picture, chart, [&](Horizontal w) {
    return map_colour(Palette::false_colour,
                      dome.luminance(w) / candelas_per_kilocandela / largest);
  });
  draw_legend(picture, {"kcd/m²", largest, Palette::false_colour, Legend::Above::marked});
}

void paint_colour(Picture& picture, const DomeChart& chart, const SkyDome& dome,
                  SkyColourModel model) {
  const Vec3 sun = dome.light.when.direction;
  paint_dome(picture, chart, [&](Horizontal w) {
    if (!dome.hills.is_above(w)) return hills_in_colour;
    // As their author saw them when he chose the reddenings: values of the display, not light.
    const Rgb c = sky_colour(model, enu_direction(w), sun, picture_gain);
    return Colour{c.red, c.green, c.blue};
  });
}

void mark_sun(Picture& picture, const DomeChart& chart, const SunPosition& sun) {
  if (sun.elevation_deg < 0) return;
  constexpr double beyond_disc_deg = 6;  // the disc of sky_colour ends at 4
  const PicturePoint p = chart.at({sun.azimuth_deg, sun.elevation_deg});
  const double radius = beyond_disc_deg / 90 * chart.radius();
  picture.draw_circle(p, radius, 3, {1, 1, 1});
  picture.draw_circle(p, radius, 1.2, ink);
}

}  // namespace

void draw_sky(const SkyDome& dome, const SkyPictureRules& rules, const std::string& path) {
  Picture picture(dome_width, dome_height);
  const bool is_luminance = rules.kind == SkyPicture::luminance;
  const DomeChart chart(picture, DomeProjection::equidistant, is_luminance ? legend_width : 0);
  if (is_luminance) {
    paint_luminance(picture, chart, dome);
  } else {
    paint_colour(picture, chart, dome, rules.model);
  }
  chart.draw_grid(picture, {0.5, 0.5, 0.52});
  chart.draw_line(picture, dome.hills, ink);
  const SunPosition& sun = dome.light.when.sun;
  mark_sun(picture, chart, sun);
  draw_title(
      picture,
      fmt::format("Sky {}: {} ({})", is_luminance ? "luminance" : "colour", dome.when, dome.place),
      fmt::format("{}; sun (ring): azimuth {:.2f}°, elevation {:.2f}°; DNI {:.3g}, DHI {:.3g} "
                  "W/m²; equidistant, {}",
                  is_luminance ? dome.model : "clear sky", sun.azimuth_deg, sun.elevation_deg,
                  dome.light.mean.dni, dome.light.mean.dhi, dome_convention));
  picture.save(path);
}

}  // namespace sunload
