// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/sky_dome.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/plan/far_ground.h"
#include "io/plan/period.h"
#include "io/plan/scene_build.h"
#include "io/plan/weather_albedo.h"

namespace sunload {

namespace {

/// The interval of a study of positions that covers an instant.
LitInterval position_at(const Study& study, const Site& site, UnixTime utc) {
  const LightSeries light = light_series(study, site);
  for (const auto& interval : light.intervals)
    if (utc >= interval.when.begin && utc < interval.when.end) return interval;
  throw InputError({}, "--time " + iso_utc(utc) + " is none of the study's positions",
                   "their time counts from " + iso_utc(light.intervals.front().when.begin) +
                       " to " + iso_utc(light.intervals.back().when.end),
                   "choose a time in between");
}

LitInterval light_at(const Study& study, const Site& site, UnixTime utc,
                     std::vector<std::string>& notes) {
  if (std::holds_alternative<PositionsPeriod>(study.period.kind))
    return position_at(study, site, utc);
  constexpr double moment_min = 1 / seconds_per_minute;  // short: the value of the instant
  Study moment = study;
  moment.period.kind = InstantsPeriod{{{calendar_from_utc(utc), true, true, 0}}, moment_min};
  const LightSeries light = light_series(moment, site);
  notes.insert(notes.end(), light.notes.begin(), light.notes.end());
  expect_albedos(study, light, notes);
  return light.intervals.front();
}

UnixTime instant(const std::string& text, const TimeZone& zone, std::vector<std::string>& notes) {
  ParsedTime time;
  try {
    time = parse_time(text);
  } catch (const InputError& error) {
    throw InputError({}, "--time: " + error.problems().front());
  }
  if (!time.has_time)
    throw InputError({}, "--time " + text + " has no time of day", "the sky of an instant is asked",
                     "write for example --time " + text + "T12:00");
  return utc_of(time, zone, notes);
}

std::string sky_words(const LightStudy& light) {
  switch (light.sky) {
    case SkyModel::uniform:
      return "uniform sky";
    case SkyModel::cie_overcast:
      return "CIE overcast sky";
    case SkyModel::cie_clear:
      return "CIE clear sky";
    case SkyModel::cie_general:
      return fmt::format("CIE general sky {}", light.sky_type);
    case SkyModel::perez:
      return "Perez all-weather sky";
    case SkyModel::preetham:
      return fmt::format("Preetham sky, turbidity {:g}", light.turbidity);
  }
  return {};
}

double share_of_sky(const SkyPatch& patch, const Horizon& hills) {
  if (hills.is_open()) return 1;
  const double low = std::sin(radians(patch.elevation_low_deg));
  const double high = std::sin(radians(patch.elevation_high_deg));
  const double turn = patch.azimuth_high_deg - patch.azimuth_low_deg;
  return open_share(hills, [&](double u, double v) -> Horizontal {
    return {patch.azimuth_low_deg + u * turn, degrees(std::asin(low + v * (high - low)))};
  });
}

}  // namespace

double SkyDome::radiance(Horizontal w) const {
  return hills.is_above(w) ? sky.radiance(enu_direction(w)) : ground_radiance;
}

double SkyDome::luminance(Horizontal w) const {
  return hills.is_above(w) ? sky.radiance(enu_direction(w)) * efficacy() : ground_luminance;
}

SkyDome sky_dome(const Study& study, const std::string& time) {
  const TimeZone zone(study.site.timezone);
  std::vector<std::string> notes;
  const UnixTime utc = instant(time, zone, notes);
  // The site may come from the scene's CRS, which only its reader knows.
  Site site = build_scene(study).site;
  site.north_deg = 0;  // axes of the dome: x east, y north
  const LitInterval light = light_at(study, site, utc, notes);
  const double albedo = FarGround(study).albedo(light);
  const bool has_place = !std::holds_alternative<PositionsPeriod>(study.period.kind);
  return {light,
          sky_of(light, study.light),
          site.horizon,
          albedo * light.mean.ghi / pi,
          albedo * source_means(light, Quantity::illuminance).ghi / pi,
          study.name + (has_place ? ", " + position_text(site) : ""),
          sky_words(study.light),
          iso_local(utc, zone),
          notes};
}

namespace {

/// `open`: share that hills leave free, where the sky has this radiance.
SkyRow row_of(const SkyDome& dome, Vec3 middle, double open, double radiance, double solid_angle,
              double projected) {
  const Horizontal at = horizontal(middle);
  return {at.azimuth_deg,
          at.elevation_deg,
          open * radiance + (1 - open) * dome.ground_radiance,
          solid_angle,
          projected,
          open * radiance * dome.efficacy() + (1 - open) * dome.ground_luminance};
}

}  // namespace

double SkyDome::efficacy() const {
  return light.of_the_sky.dhi > 0 ? efficacy_of(light).diffuse : 0;
}

std::vector<SkyRow> sky_rows(const SkyDome& dome, std::optional<Subdivision> subdivision) {
  std::vector<SkyRow> rows;
  if (!subdivision) {
    const SkyGrid grid;
    const auto open = open_shares(grid, dome.hills, Rotation());
    const auto radiance = grid.mean_radiance(dome.sky, dome.light.mean.dhi);
    for (int cell = 0; cell < grid.cell_count(); ++cell) {
      const auto c = static_cast<std::size_t>(cell);
      rows.push_back(row_of(dome, grid.direction(cell, 0.5, 0.5), open.empty() ? 1 : open[c],
                            radiance[c], grid.solid_angle(), grid.projected()[c]));
    }
    return rows;
  }
  const auto patches = sky_patches(*subdivision);
  const auto radiance = mean_radiance(patches, dome.sky);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    rows.push_back(row_of(dome, patches[p].direction, share_of_sky(patches[p], dome.hills),
                          radiance[p], patches[p].solid_angle, patches[p].projected));
  }
  return rows;
}

std::string sky_csv(const std::vector<SkyRow>& rows) {
  std::string text =
      "azimuth_deg,elevation_deg,radiance_w_m2_sr,solid_angle_sr,projected_solid_angle_sr,"
      "luminance_cd_m2\n";
  for (const auto& row : rows)
    text +=
        fmt::format("{:.6f},{:.6f},{:.8g},{:.8g},{:.8g},{:.8g}\n", row.azimuth_deg,
                    row.elevation_deg, row.radiance, row.solid_angle, row.projected, row.luminance);
  return text;
}

}  // namespace sunload
