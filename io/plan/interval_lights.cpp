// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/interval_lights.h"

#include "geo/sky/horizon.h"
#include "io/plan/light_colour.h"
#include "solver/base/threads.h"

namespace sunload {

IntervalLights::IntervalLights(const Study& study, const Site& site, const SkyGrid& grid)
    : light_(study.light),
      far_ground_(study),
      disk_(study.sun.disk),
      bands_(study.solver.bands),
      grid_(grid),
      open_share_(open_shares(grid, site.horizon, scene_from_enu(site))) {}

/// Cells of the sky behind hills, which shine as the far ground does.
void IntervalLights::put_hills(std::vector<double>& sky, double ground_exitance) const {
  sky.resize(open_share_.size(), 0);
  for (std::size_t cell = 0; cell < open_share_.size(); ++cell)
    sky[cell] = open_share_[cell] * sky[cell] + (1 - open_share_[cell]) * ground_exitance / pi;
}

namespace {

void add(double share, const std::vector<double>& values, std::vector<double>& sum) {
  if (sum.size() < values.size()) sum.resize(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) sum[i] += share * values[i];
}

}  // namespace

/// What is linear in the light, as the mean over time of that of the parts.
IntervalLight IntervalLights::of_parts(const LitInterval& interval, std::size_t number) const {
  IntervalLight sum;
  for (const LitInterval& part : interval.parts()) {
    const double share = part.when.length_s() / interval.when.length_s();
    const IntervalLight light = of(part, number);
    sum.dni += share * light.dni;
    sum.dhi += share * light.dhi;
    sum.ground_exitance += share * light.ground_exitance;
    add(share, light.sky, sum.sky);
    sum.bands.resize(light.bands.size());
    for (std::size_t band = 0; band < light.bands.size(); ++band) {
      sum.bands[band].dni += share * light.bands[band].dni;
      sum.bands[band].ground_exitance += share * light.bands[band].ground_exitance;
      add(share, light.bands[band].sky, sum.bands[band].sky);
    }
  }
  return sum;
}

IntervalLight IntervalLights::of(const LitInterval& interval, std::size_t number) const {
  const SunInterval& when = interval.when;
  IntervalLight sun = interval.joined ? of_parts(interval, number) : IntervalLight();
  sun.number = static_cast<std::uint32_t>(number);
  sun.direction = when.direction;
  sun.sun_samples = interval.sun_samples;
  sun.direct_suns = interval.direct_suns;
  sun.length_s = when.length_s();
  sun.sunlit_s = when.sunlit_s;
  sun.disk_half_angle = disk_half_angle(disk_, when.sun.distance_au);
  if (interval.joined) return sun;
  const Irradiance source = source_means(interval, light_.quantity);
  sun.dni = source.dni;
  sun.dhi = source.dhi;
  sun.ground_exitance = far_ground_.albedo(interval) * source.ghi;
  if (source.dhi > 0) sun.sky = grid_.mean_radiance(relative_sky_of(interval, light_), source.dhi);
  if (bands_ == Bands::rgb) sun.bands = light_in_bands(sun, source, interval, light_, grid_);
  if (!open_share_.empty() && sun.ground_exitance + source.dhi > 0) {
    put_hills(sun.sky, sun.ground_exitance);
    for (auto& band : sun.bands) put_hills(band.sky, band.ground_exitance);
  }
  return sun;
}

std::vector<IntervalLight> IntervalLights::of(const LightSeries& series, std::size_t first,
                                              std::size_t count) const {
  std::vector<IntervalLight> suns(count);
  parallel_for(count, [&](std::size_t k) { suns[k] = of(series.intervals[first + k], first + k); });
  return suns;
}

std::vector<IntervalLight> IntervalLights::of(const LightSeries& series) const {
  return of(series, 0, series.intervals.size());
}

}  // namespace sunload
