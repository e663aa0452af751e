#include "io/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/check.h"
#include "geo/units.h"
#include "io/render_bands.h"
#include "io/render_frame.h"
#include "io/render_scene.h"
#include "io/result_time.h"
#include "io/shown_quantity.h"

namespace sunload {
namespace {

constexpr int least_pixels = 320, most_pixels = 16384;
// A field of view as of a 50 mm lens on 35 mm film shows shapes undistorted;
// a street seen from within needs a wider one.
constexpr double overview_field_deg = 27, walker_field_deg = 60;
// Elevation of the overview: roofs and walls are both well seen.
constexpr double overview_elevation_deg = 35;
// The afternoon side of the sun's side: 45° west of it.
constexpr double overview_west_deg = 45;

/// Azimuth, clockwise from true north, of the scene's +y axis: the turn between
/// the sun's azimuth and its direction in the scene, at the lowest sun.
double scene_north_deg(const ResultReader& result) {
  const auto direction = result.doubles("sun_direction"), azimuth = result.doubles("sun_azimuth");
  std::size_t lowest = 0;
  for (std::size_t i = 0; i < azimuth.size(); ++i)
    if (std::abs(direction[3 * i + 2]) < std::abs(direction[3 * lowest + 2])) lowest = i;
  const Vec3 sun{direction.at(3 * lowest), direction.at(3 * lowest + 1), 0};
  return norm(sun) == 0 ? 0 : azimuth[lowest] - horizontal(sun).azimuth_deg;
}

/// Unit vector of the scene towards a compass direction.
Vec3 scene_direction(Horizontal compass, double north_deg) {
  return enu_direction({compass.azimuth_deg - north_deg, compass.elevation_deg});
}

Vec3 overview_direction(const ResultReader& result, double north_deg) {
  const auto azimuth = result.doubles("sun_azimuth"), ghi = result.doubles("ghi");
  double northward = 0;
  for (std::size_t i = 0; i < azimuth.size(); ++i)
    northward += ghi[i] * std::cos(radians(azimuth[i]));
  constexpr double north_deg_of_compass = 0, south_deg_of_compass = 180;
  const double azimuth_deg = northward > 0 ? north_deg_of_compass - overview_west_deg
                                           : south_deg_of_compass + overview_west_deg;
  return scene_direction({azimuth_deg, overview_elevation_deg}, north_deg);
}

Camera free_camera(const ResultReader& result, const RenderRules& rules, PictureArea area) {
  if (!rules.eye || !rules.look)
    throw InputError({}, "a free camera needs both --eye and --look", "one is missing");
  const Vec3 origin = scene_origin(result);
  const Vec3 eye = *rules.eye - origin, look = *rules.look - origin;
  if (!(norm(eye - look) > 0))
    throw InputError({}, "--eye and --look are the same point", "there is no direction to look in");
  return Camera::perspective(eye, look, walker_field_deg, area.width, area.height);
}

Camera sun_camera(const ResultReader& result, const PatchScene& scene, std::size_t interval,
                  PictureArea area) {
  const auto sun = result.row("sun_direction", interval);
  if (sun.at(2) <= 0)
    throw InputError({}, "the sun is below the horizon", interval_in_words(result, interval),
                     "choose another --time");
  return Camera::parallel(scene.focus_points(), {sun[0], sun[1], sun[2]}, {0, 0, 1}, area.width,
                          area.height);
}

Camera chosen_camera(const ResultReader& result, const RenderRules& rules, const PatchScene& scene,
                     const ShownQuantity& what, double north_deg, PictureArea area) {
  if (rules.eye || rules.look) return free_camera(result, rules, area);
  switch (rules.view) {
    case View::sun:
      return sun_camera(result, scene, what.interval, area);
    case View::top:
      return Camera::parallel(scene.focus_points(), {0, 0, 1}, scene_direction({0, 0}, north_deg),
                              area.width, area.height);
    case View::overview:
      break;
  }
  return Camera::fitted(scene.focus_points(), overview_direction(result, north_deg),
                        overview_field_deg, area.width, area.height);
}

void expect_possible_size(const RenderRules& rules) {
  for (const int pixels : {rules.width, rules.height})
    if (pixels < least_pixels || pixels > most_pixels)
      throw InputError(
          {}, fmt::format("--size {}x{}", rules.width, rules.height),
          fmt::format("width and height must lie in [{}, {}]", least_pixels, most_pixels));
}

std::string title(const ResultReader& result) {
  const auto study = result.text_attribute("study");
  return fmt::format("{} — {}", study.empty() ? result.text_attribute("title") : study,
                     result.text_attribute("variant"));
}

}  // namespace

void render_png(const ResultReader& result, const RenderRules& rules, const std::string& path) {
  expect_possible_size(rules);
  const ShownQuantity what = shown_quantity(result, rules.quantity, rules.time);
  const PatchScene scene(result);
  const double north_deg = scene_north_deg(result);
  Picture picture(rules.width, rules.height);
  const PictureArea area = scene_area(picture);
  const Camera camera = chosen_camera(result, rules, scene, what, north_deg, area);
  PatchColours colours{what.values, scale_end(rules.largest, what.values, scene.area()),
                       rules.palette, rules.mesh};
  const bool in_rgb = rules.colours == PictureColours::of_bands;
  if (in_rgb) {
    auto bands = colours_of_bands(result, rules.quantity, rules.time, rules.largest, scene.area());
    colours.own = std::move(bands.of_patches);
    colours.largest = bands.white;
  }

  const RayCaster caster(scene.mesh());
  picture.paint(area.x, area.y, area.width,
                drawn_pixels(scene, caster, camera, area.width, area.height, colours));
  draw_title(picture, title(result) + band_title(result),
             what.name + ", " + what.when +
                 (in_rgb ? fmt::format(", in colour, white: {:.4g} {}", colours.largest, what.units)
                         : ""));
  const bool is_exceeded = std::any_of(what.values.begin(), what.values.end(),
                                       [&](double value) { return value > colours.largest; });
  if (!in_rgb)
    draw_legend(picture, {what.units, colours.largest, rules.palette,
                          is_exceeded ? Legend::Above::marked : Legend::Above::nothing});
  draw_north(picture, camera.image_direction(scene_direction({0, 0}, north_deg)));
  picture.save(path);
}

}  // namespace sunload
