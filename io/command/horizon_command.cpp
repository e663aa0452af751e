// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/horizon_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "geo/base/check.h"
#include "geo/sun/site.h"
#include "io/base/exit_code.h"
#include "io/base/file_aside.h"
#include "io/base/file_text.h"
#include "io/base/standard_streams.h"
#include "io/plan/scene_build.h"
#include "io/plan/true_lengths.h"
#include "io/scene/raster/land_horizon.h"
#include "io/study/named_files.h"

namespace sunload {

namespace {

/// Where one stands, and how far the scene reaches from there.
struct Standpoint {
  Site site;
  double reach_m = 0;
};

Standpoint standpoint(const HorizonOptions& options) {
  if (options.study.empty() == options.at.empty())
    throw InputError({}, "sunload horizon needs a place", "it is that of a study, or --at",
                     "add --study STUDY.yaml or --at \"47.38 8.54\"");
  if (options.study.empty()) return {site_from_text(options.at), 0};
  const StudyFile file = read_study(options.study);
  expect_not_read(options.output, named_files(file));
  const BuiltScene built = build_scene(file.variants.front());
  expect_not_read(options.output, built.files);
  const Box box = bounding_box(built.scene.mesh.vertices);
  double reach = 0;
  for (const double x : {box.low.x, box.high.x})
    for (const double y : {box.low.y, box.high.y}) reach = std::max(reach, std::hypot(x, y));
  return {built.site, reach};
}

/// The raster's map tells where the site lies on it, and how north does there.
LandHorizon horizon_of(const HorizonOptions& options, const Site& site, LandView& view) {
  const double unit_m = options.unit_m.value_or(1);
  NoteCounter notes;
  const Raster raster =
      read_raster(options.land, unit_m, RasterValues::elevations, notes, "--unit-m");
  const std::string crs = options.crs.empty() ? raster.crs : options.crs;
  if (crs.empty())
    throw InputError({options.land}, "names no coordinate reference system",
                     "where the site lies on it is not known", "add --crs, e.g. EPSG:25832");
  for (const auto& note : notes.lines()) tell("note: " + note);
  view.place = map_position(crs, site.latitude_deg, site.longitude_deg, 0);
  view.grid_north_deg = site_from_crs(crs, view.place).north_deg;
  const std::string warning = true_lengths_warning(
      crs, view.place, site, {options.land},
      "heights are not, and hills would stand too low or too high, or elsewhere",
      "bring it onto a map that keeps lengths: gdalwarp -t_srs");
  if (!warning.empty()) tell("warning: " + warning);
  return land_horizon(options.land, raster, unit_m, view);
}

std::string csv(const HorizonOptions& options, const LandView& view, const LandHorizon& found) {
  std::string text = fmt::format(
      "# horizon of {}, {:g} m above land of {:.1f} m, by {}: land {:.0f} m to {:.0f} m away\n"
      "# distance_m: of what is the line; 0: nothing rises above the level of the eye\n"
      "azimuth_deg,elevation_deg,distance_m\n",
      options.study.empty() ? options.at : options.study, view.above_m, found.land_m, options.land,
      view.from_m, *std::max_element(found.looked_to_m.begin(), found.looked_to_m.end()));
  for (std::size_t k = 0; k < found.points.size(); ++k)
    text += fmt::format("{:g},{:.3f},{:.0f}\n", found.points[k].azimuth_deg,
                        found.points[k].elevation_deg, found.distance_m[k]);
  return text;
}

void tell_what_is_found(const LandView& view, const LandHorizon& found) {
  const auto highest =
      std::max_element(found.points.begin(), found.points.end(),
                       [](auto& a, auto& b) { return a.elevation_deg < b.elevation_deg; });
  const auto least = std::min_element(found.looked_to_m.begin(), found.looked_to_m.end());
  tell(fmt::format("highest {:.2f} deg at azimuth {:g}; the land reaches {:.1f} km at least",
                   highest->elevation_deg, highest->azimuth_deg, *least / 1000));
  // A hill of 1000 m that far away stands 1 deg above the level.
  constexpr double near_m = 50e3;
  if (*least < std::min(view.to_m, near_m))
    tell(fmt::format(
        "warning: towards azimuth {:g} the raster ends after {:.1f} km: hills beyond are not in "
        "it",
        found.points[static_cast<std::size_t>(least - found.looked_to_m.begin())].azimuth_deg,
        *least / 1000));
}

}  // namespace

int horizon(const HorizonOptions& options) {
  const Standpoint stand = standpoint(options);
  LandView view;
  view.above_m = options.above_m.value_or(view.above_m);
  view.from_m = options.from_m.value_or(stand.reach_m);
  view.to_m = options.to_m.value_or(view.to_m);
  view.step_deg = options.step_deg.value_or(view.step_deg);
  if (!(view.to_m > view.from_m))
    throw InputError({}, fmt::format("--to-m {:g}", view.to_m),
                     fmt::format("land begins {:g} m away", view.from_m),
                     "a greater one, or a smaller --from-m");
  const LandHorizon found = horizon_of(options, stand.site, view);
  const std::string text = csv(options, view, found);
  tell_what_is_found(view, found);
  if (options.output.empty())
    std::cout << text;
  else
    write_file(options.output, text);
  return exit_code::done;
}

}  // namespace sunload
