#include "io/light_series.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/period.h"
#include "solver/parallel.h"

namespace sunload {

namespace {

/// Intervals up to this length take the clear sky of their representative sun.
constexpr double one_sun_is_enough_s = 15 * seconds_per_minute;
/// Longer ones are integrated in panels of at most this length …
constexpr double panel_s = seconds_per_hour;
/// … by the three-point Gauss–Legendre rule (Abramowitz & Stegun 1964, table 25.4).
struct GaussPoint {
  double at, weight;
};
const std::array<GaussPoint, 3> gauss{{{0.5 - std::sqrt(0.15), 5.0 / 18},
                                       {0.5, 8.0 / 18},
                                       {0.5 + std::sqrt(0.15), 5.0 / 18}}};

Irradiance scaled(const Irradiance& i, double factor) {
  return {i.dni * factor, i.dhi * factor, i.ghi * factor};
}

/// Clear sky of one site and model at any instant.
class ClearSky {
 public:
  ClearSky(const LightStudy& light, const Site& site, const SunEphemeris& sun)
      : light_(light), site_(site), sun_(sun) {}

  Irradiance at(UnixTime utc, const SunPosition& sun) const {
    return clear_sky(light_.model,
                     {.elevation_deg = sun.elevation_deg,
                      .elevation_m = site_.elevation_m,
                      .linke_turbidity = light_.linke_turbidity.at(calendar_from_utc(utc)),
                      .extraterrestrial_normal = extraterrestrial(sun.distance_au)});
  }

  /// Mean over the sunlit part of an interval.
  Irradiance mean_while_sunlit(const SunInterval& when) const {
    if (when.length_s() <= one_sun_is_enough_s) return at(when.sun_time, when.sun);
    const double hull = when.sunlit_end - when.sunlit_begin;
    const auto panels = static_cast<int>(std::ceil(hull / panel_s));
    Irradiance sum;
    double lit = 0;
    for (int p = 0; p < panels; ++p)
      for (const auto& g : gauss) {
        const UnixTime t = when.sunlit_begin + hull * (p + g.at) / panels;
        const SunPosition sun = sun_(t);
        if (sun.elevation_deg <= 0) continue;
        const Irradiance now = at(t, sun);
        sum = {sum.dni + g.weight * now.dni, sum.dhi + g.weight * now.dhi,
               sum.ghi + g.weight * now.ghi};
        lit += g.weight;
      }
    return lit > 0 ? scaled(sum, 1 / lit) : Irradiance{};
  }

 private:
  const LightStudy& light_;
  const Site& site_;
  const SunEphemeris& sun_;
};

LitInterval fixed_light(const SunInterval& when, const LightStudy& light) {
  const double share = when.sunlit_s / when.length_s();
  const double sin_elevation = std::max(0.0, std::sin(radians(when.sun.elevation_deg)));
  const Irradiance lit{light.dni_w_m2, light.dhi_w_m2,
                       light.dni_w_m2 * sin_elevation + light.dhi_w_m2};
  return {when, scaled(lit, share), lit};
}

SunPath dated_path(const Study& study, const Site& site, LightSeries& series) {
  const auto steps = period_steps(study.period, TimeZone(study.site.timezone));
  series.notes = steps.notes;
  if (study.sun.ut1_utc == Ut1::table && !steps.steps.empty() &&
      !(ut1_table_covers(steps.steps.front().begin) && ut1_table_covers(steps.steps.back().end)))
    series.notes.push_back(
        "part of the period lies outside of the table of UT1-UTC; UT1 = UTC is taken there "
        "(moves the sun's azimuth by at most 0.004 degrees)");
  return sun_path(steps.steps, site, study.sun.refraction, study.sun.ut1_utc);
}

}  // namespace

std::size_t LightSeries::lit_count() const {
  return static_cast<std::size_t>(
      std::count_if(intervals.begin(), intervals.end(),
                    [](const LitInterval& i) { return i.when.sunlit_s > 0; }));
}

LightSeries light_series(const Study& study, const Site& site) {
  LightSeries series;
  const auto* positions = std::get_if<PositionsPeriod>(&study.period.kind);
  series.times_are_synthetic = positions != nullptr;
  const SunPath path = positions ? positions_path(*positions, scene_from_enu(site))
                                 : dated_path(study, site, series);
  if (path.empty()) throw InputError(study.period.where, "period has no intervals");
  if (study.light.source == LightSource::fixed || positions) {
    for (const auto& when : path) series.intervals.push_back(fixed_light(when, study.light));
    return series;
  }
  const SunEphemeris sun(path.front().begin, path.back().end, site, study.sun.refraction,
                         study.sun.ut1_utc, Air{standard_pressure(site.elevation_m)});
  const ClearSky sky(study.light, site, sun);
  for (const auto& when : path) {
    LitInterval interval{when, {}, {}};
    if (when.sunlit_s > 0) {
      interval.of_the_sky = sky.mean_while_sunlit(when);
      interval.mean = scaled(interval.of_the_sky, when.sunlit_s / when.length_s());
    }
    series.intervals.push_back(interval);
  }
  return series;
}

SunLight sun_light(const LitInterval& interval, std::uint32_t number, const LightStudy& light,
                   const SkyGrid& grid) {
  const SunInterval& when = interval.when;
  SunLight sun;
  sun.number = number;
  sun.direction = when.direction;
  sun.dni = interval.mean.dni;
  sun.dhi = interval.mean.dhi;
  sun.ground_exitance = light.far_ground_albedo * interval.mean.ghi;
  sun.length_s = when.length_s();
  sun.sunlit_s = when.sunlit_s;
  if (interval.mean.dhi <= 0) return sun;
  const double zenith_deg = std::clamp(90 - when.sun.elevation_deg, 0.0, 90.0);
  const Sky sky({.model = light.sky,
                 .dhi = interval.of_the_sky.dhi,
                 .dni = interval.of_the_sky.dni,
                 .extraterrestrial_normal = extraterrestrial(when.sun.distance_au),
                 .sun_zenith_deg = zenith_deg,
                 .sun_direction = when.direction,
                 .cie_type = light.sky_type,
                 .turbidity = light.turbidity});
  sun.sky = grid.mean_radiance(sky, interval.mean.dhi);
  return sun;
}

}  // namespace sunload
