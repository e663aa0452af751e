// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/sun_and_sky.h"

#include <fmt/format.h>

#include <iostream>

#include "io/base/exit_code.h"
#include "io/base/output_target.h"
#include "io/base/standard_streams.h"
#include "io/picture/picture.h"
#include "io/picture/sun_diagram.h"
#include "io/plan/scene_build.h"
#include "io/study/named_files.h"

namespace sunload {

int print_sun(const std::string& path, const std::string& picture) {
  const StudyFile file = read_study(path);
  expect_not_read(picture, named_files(file));
  expect_picture_name(picture);
  tell_warnings(file.warnings);
  const Study& study = file.variants.front();
  // The site may come from the scene's CRS, which only its reader knows.
  const BuiltScene built = build_scene(study);
  expect_not_read(picture, built.files);
  const Site& site = built.site;
  const LightSeries light = light_series(study, site);
  tell_warnings(light.notes);
  if (!picture.empty()) {
    draw_sun_diagram(study, site, light, picture);
    return exit_code::done;
  }
  std::cout << "time,azimuth_deg,elevation_deg,dni_w_m2,dhi_w_m2,ghi_w_m2\n";
  for (const auto& i : light.intervals)
    std::cout << fmt::format("{},{:.6f},{:.6f},{:.4f},{:.4f},{:.4f}\n", iso_utc(i.when.sun_time),
                             i.when.sun.azimuth_deg, i.when.sun.elevation_deg, i.mean.dni,
                             i.mean.dhi, i.mean.ghi);
  return exit_code::done;
}

int print_sky(const std::string& path, const SkyOptions& options) {
  const StudyFile file = read_study(path);
  expect_not_read(options.picture, named_files(file));
  expect_picture_name(options.picture);
  tell_warnings(file.warnings);
  const SkyDome dome = sky_dome(file.variants.front(), options.time);
  tell_warnings(dome.notes);
  if (options.picture.empty()) {
    std::cout << sky_csv(sky_rows(dome, options.subdivision));
  } else {
    draw_sky(dome, options.rules, options.picture);
  }
  return exit_code::done;
}

}  // namespace sunload
