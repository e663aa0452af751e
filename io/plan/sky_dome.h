// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sky over a study at one instant, as a table or as a picture (`sunload sky`).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/sky/horizon.h"
#include "geo/sky/sky.h"
#include "geo/sky/sky_colour.h"
#include "geo/sky/sky_subdivision.h"
#include "io/plan/light_series.h"

namespace sunload {

/// Axes: x east, y north.
struct SkyDome {
  LitInterval light;  ///< of that instant
  Sky sky;
  Horizon hills;
  double ground_radiance = 0;      ///< of the far ground and the hills [W m-2 sr-1]
  double ground_luminance = 0;     ///< of the same, which sun and sky light [cd m-2]
  std::string place, model, when;  ///< in words
  std::vector<std::string> notes;  ///< what the user should know of time and light

  /// Radiance of sky or hills [W m-2 sr-1] in a direction above the horizon.
  double radiance(Horizontal w) const;
  double luminance(Horizontal w) const;  ///< of the same [cd m-2]
  /// Lumens per watt of the sky's light; 0 where it has none.
  double efficacy() const;
};

/// Sky of a study's first variant at `time`, written as in a study: civil time of the site
/// unless it has an offset. Weather and models as for an instant of the study; a study of
/// positions is asked for the time that stands for one of them. Throws InputError.
SkyDome sky_dome(const Study& study, const std::string& time);

/// One patch of the sky.
struct SkyRow {
  double azimuth_deg = 0, elevation_deg = 0;  ///< of the middle
  double radiance = 0;                        ///< mean over the patch [W m-2 sr-1]
  double solid_angle = 0;                     ///< [sr]
  double projected = 0;  ///< ∫ sin(elevation) dω [sr]: times the radiance it is irradiance
  double luminance = 0;  ///< by the efficacy of what shines or lights it [cd m-2]
};
/// Patches of a subdivision, or without one the 64 × 64 equal cells that the solver uses.
/// Hills count by the share of a patch that they fill.
std::vector<SkyRow> sky_rows(const SkyDome& dome, std::optional<Subdivision> subdivision);
/// Columns `azimuth_deg,elevation_deg,radiance_w_m2_sr,solid_angle_sr,projected_solid_angle_sr,
/// luminance_cd_m2`.
std::string sky_csv(const std::vector<SkyRow>& rows);

/// luminance: false colour [kcd m-2], by Perez's luminous efficacy of the diffuse light (of hills:
/// of what lights them).
/// colour: as the eye sees it, by the models of Holubář (2007), for clear skies.
enum class SkyPicture { luminance, colour };
/// What a picture of the sky shows.
struct SkyPictureRules {
  SkyPicture kind = SkyPicture::luminance;
  SkyColourModel model = SkyColourModel::second;
};
/// Fisheye dome, zenith angle proportional to the distance from the centre, with the axes of
/// io/picture/dome_chart.h. A ring marks the sun where it is above the horizon, hidden or not.
void draw_sky(const SkyDome& dome, const SkyPictureRules& rules, const std::string& path);

}  // namespace sunload
