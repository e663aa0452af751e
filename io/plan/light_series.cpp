// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/light_series.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "io/base/hash.h"
#include "io/plan/joined_intervals.h"
#include "io/plan/period.h"
#include "io/plan/weather_albedo.h"
#include "io/plan/weather_light.h"

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
const std::array<GaussPoint, 3> gauss{
    {{0.5 - std::sqrt(0.15), 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + std::sqrt(0.15), 5.0 / 18}}};

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

  /// Mean while the sun is up, hills or not.
  Irradiance mean_while_up(const SunInterval& when) const {
    return mean(when, {when.up_begin, when.up_end, when.up_s}, Horizon());
  }

  /// The suns that stand for an interval, each with its own DNI: a low one brings less.
  std::vector<SunSample> suns_of(const SunInterval& when) const {
    std::vector<double> dni;
    for (const Vec3 sun : when.sun_samples) {
      SunPosition at_sun = when.sun;
      at_sun.elevation_deg = degrees(std::asin(sun.z));
      dni.push_back(at(when.sun_time, at_sun).dni);
    }
    const double all = std::accumulate(dni.begin(), dni.end(), 0.0);
    if (all <= 0) return {};
    std::vector<SunSample> suns;
    for (std::size_t s = 0; s < dni.size(); ++s)
      suns.push_back({when.sun_samples[s], dni[s] / all, 1 / static_cast<double>(dni.size())});
    return suns;
  }

  /// Mean while no hill hides the sun.
  Irradiance mean_while_sunlit(const SunInterval& when) const {
    return mean(when, {when.sunlit_begin, when.sunlit_end, when.sunlit_s}, site_.horizon);
  }

 private:
  /// The hull of the part or parts of an interval with sun, and their length.
  struct WithSun {
    UnixTime begin, end;
    double length_s;
    double hull_s() const { return end - begin; }
  };

  /// Panels of Gauss' rule: more where light begins or ends at the horizon, and where there is
  /// night in between, whose bounds lie within panels.
  static int panels_of(const SunInterval& when, const WithSun& part) {
    constexpr int fewest_at_the_horizon = 3, times_finer_with_night = 32;
    constexpr double a_second = 1;
    if (part.length_s < part.hull_s() - a_second)
      return static_cast<int>(std::ceil(times_finer_with_night * part.hull_s() / panel_s));
    const auto panels = static_cast<int>(std::ceil(part.hull_s() / panel_s));
    const bool is_all = part.hull_s() >= when.length_s() - a_second;
    return is_all ? panels : std::max(panels, fewest_at_the_horizon);
  }

  Irradiance mean(const SunInterval& when, const WithSun& part, const Horizon& hills) const {
    if (when.length_s() <= one_sun_is_enough_s) return at(when.sun_time, when.sun);
    const int panels = panels_of(when, part);
    Irradiance sum;
    double lit = 0;
    for (int p = 0; p < panels; ++p)
      for (const auto& g : gauss) {
        const UnixTime t = part.begin + part.hull_s() * (p + g.at) / panels;
        const SunPosition sun = sun_(t);
        if (!hills.is_above({sun.azimuth_deg, sun.elevation_deg})) continue;
        const Irradiance now = at(t, sun);
        sum = {sum.dni + g.weight * now.dni, sum.dhi + g.weight * now.dhi,
               sum.ghi + g.weight * now.ghi};
        lit += g.weight;
      }
    return lit > 0 ? scaled(sum, 1 / lit) : Irradiance{};
  }

  const LightStudy& light_;
  const Site& site_;
  const SunEphemeris& sun_;
};

/// Means over the interval of light that is `lit` while the sun is up; what of it is direct
/// arrives only as long as no hill hides the sun, with the values of `direct`.
Irradiance over_interval(const SunInterval& when, const Irradiance& lit, const Irradiance& direct) {
  const Irradiance open = scaled(lit, when.up_s / when.length_s());
  if (when.sunlit_s == when.up_s) return open;
  const double share = when.sunlit_s / when.length_s();
  return {direct.dni * share, open.dhi, open.dhi + (direct.ghi - direct.dhi) * share};
}

/// Without sun above the horizon: the sky of a sun that stands on it.
double sky_zenith_deg(const SunInterval& when) {
  return std::clamp(90 - when.sun.elevation_deg, 0.0, 90.0);
}

/// What to say where noon by the site's clocks is hours from noon by the sun: a zone or longitude
/// of somewhere else. Empty for UTC, which is asked for everywhere.
std::string clock_warning(const std::string& timezone, const Site& site, UnixTime when) {
  if (timezone == "UTC" || timezone == "Z" || timezone.ends_with("/UTC")) return {};
  constexpr double near_pole_deg = 89;  // whose longitude tells no time
  if (std::abs(site.latitude_deg) > near_pole_deg) return {};
  // The widest true gap is 3.1 h: China keeps the time of Beijing as far as 73.5 degrees east.
  constexpr double widest_gap_h = 3.5, hours_per_day = 24;
  const TimeZone zone(timezone);
  const double clock_h = zone.standard_offset_s(zone.civil_from_utc(when).year) / seconds_per_hour;
  const double gap_h =
      std::remainder(clock_h - site.longitude_deg / degrees_of_sun_per_hour, hours_per_day);
  if (std::abs(gap_h) <= widest_gap_h) return {};
  return fmt::format(
      "clocks of {} are {:.1f} h {} the sun at longitude {:.2f}; are site.timezone and longitude "
      "right (east is positive)?",
      timezone, std::abs(gap_h), gap_h > 0 ? "ahead of" : "behind", site.longitude_deg);
}

/// Diffuse irradiance whose illuminance is this by the efficacy that follows from it and the DNI.
/// Efficacy jumps between classes of skies: where no irradiance fits, that of the jump.
double dhi_of(double illuminance_lx, LitInterval interval) {
  constexpr int halvings = 60;          // to the last digit of a double
  constexpr double least_lm_per_w = 1;  // far below any daylight's
  double low = 0, high = illuminance_lx / least_lm_per_w;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    interval.of_the_sky.dhi = middle;
    (middle * efficacy_of(interval).diffuse < illuminance_lx ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Puts the sky's own luminance in place of the diffuse light while the sun is up, at the
/// representative sun. Watts follow by the efficacy of the clear sky that the source has, or where
/// it has none by that of the sky itself.
void make_sky_absolute(LitInterval& interval, const LightStudy& light) {
  constexpr double kilo = 1000;
  const double sun_zenith_deg = sky_zenith_deg(interval.when);
  const double zenith_kcd = light.zenith_luminance_cd_m2
                                ? *light.zenith_luminance_cd_m2 / kilo
                                : preetham_zenith_luminance_kcd(light.turbidity, sun_zenith_deg);
  const double lux = kilo * illuminance_klx({.model = light.sky,
                                             .sun_zenith_deg = sun_zenith_deg,
                                             .cie_type = light.sky_type,
                                             .turbidity = light.turbidity},
                                            zenith_kcd);
  Irradiance& sky = interval.of_the_sky;
  const bool is_fixed = light.source == LightSource::fixed;
  LitInterval by_itself = interval;
  if (is_fixed) by_itself.of_the_sky.dhi = dhi_of(lux, interval);
  interval.lm_per_w = efficacy_of(by_itself);
  if (is_fixed && lux > 0) interval.lm_per_w->diffuse = lux / by_itself.of_the_sky.dhi;
  const double dhi = lux / interval.lm_per_w->diffuse;
  sky.ghi += dhi - sky.dhi;
  sky.dhi = dhi;
}

LitInterval fixed_light(const SunInterval& when, const LightStudy& light) {
  const bool is_absolute = light.sky_scale == SkyScale::absolute;
  const double sin_elevation = sine_of_sun(when);
  const double dhi = is_absolute ? 0 : light.dhi_w_m2;
  LitInterval interval{when, {}, {light.dni_w_m2, dhi, light.dni_w_m2 * sin_elevation + dhi}};
  if (is_absolute && when.up_s > 0) make_sky_absolute(interval, light);
  interval.mean = over_interval(when, interval.of_the_sky, interval.of_the_sky);
  return interval;
}

/// How far UT1 may be from UTC behind the table. Leap seconds keep it below 0.9 s until 2035 (CGPM
/// resolution 4 of 2022); from then on days of up to a millisecond too much or too little add up.
double hour_angle_doubt_deg(UnixTime utc) {
  constexpr double largest_s = 0.9, s_per_day = 1e-3, day_s = 86400, deg_per_s = 360 / day_s;
  const UnixTime last_leap = utc_from_calendar({.year = 2035, .month = 1, .day = 1});
  return deg_per_s * (largest_s + s_per_day * std::max(0.0, utc - last_leap) / day_s);
}

/// `series` has the notes of its times so far: a clock may have skipped all of them.
InputError without_intervals(const Study& study, const LightSeries& series) {
  return {study.period.where, "period has no intervals",
          fmt::format("{}", fmt::join(series.notes, "; "))};
}

SunPath path_of(const std::vector<PeriodStep>& steps, const Study& study, const Site& site,
                LightSeries& series) {
  if (steps.empty()) throw without_intervals(study, series);
  if (study.sun.ut1_utc == Ut1::table && !ut1_table_covers(steps.back().end)) {
    constexpr double worth_telling_deg = 0.01;
    if (const double doubt_deg = hour_angle_doubt_deg(steps.back().end);
        doubt_deg > worth_telling_deg)
      series.notes.push_back(fmt::format(
          "part of the period lies behind the table of UT1-UTC, which ends at {}; UT1 = UTC is "
          "taken there, and the Earth may have turned by {:.2f} degrees less or more by then",
          iso_utc(ut1_table_end()), doubt_deg));
  }
  if (const auto note = clock_warning(study.site.timezone, site, steps.front().begin);
      !note.empty())
    series.notes.push_back(note);
  return sun_path(steps, site, study.sun.refraction, study.sun.ut1_utc,
                  {study.solver.sun_samples_per_interval});
}

SunPath dated_path(const Study& study, const Site& site, LightSeries& series) {
  const auto steps = period_steps(study.period, TimeZone(study.site.timezone));
  series.notes.insert(series.notes.end(), steps.notes.begin(), steps.notes.end());
  return path_of(steps.steps, study, site, series);
}

/// Light as the weather says it; hills take their share of the beam. The sky's shape follows from
/// DNI while the sun is up, which cannot exceed the sun's own.
LitInterval measured_light(const SunInterval& when, const WeatherMean& mean) {
  const Irradiance& open = mean.open;
  LitInterval interval{when, open, {0, open.dhi, open.ghi}};
  if (when.up_s <= 0) return interval;
  // The sky while the sun is up: nearly all of the diffuse light falls then, too.
  interval.of_the_sky = scaled(open, when.length_s() / when.up_s);
  interval.of_the_sky.dni =
      std::min(interval.of_the_sky.dni, extraterrestrial(when.sun.distance_au));
  if (when.sunlit_s < when.up_s) interval.mean = mean.past_hills;
  return interval;
}

void put_albedos(const DayAlbedos& albedos, LightSeries& series) {
  for (std::size_t i = 0; i < albedos.of_interval.size(); ++i)
    series.intervals[i].albedo = albedos.of_interval[i];
  series.days = albedos.days;
  series.days_without_albedo = albedos.filled;
}

void add_weather(const Study& study, const Site& site, LightSeries& series) {
  StudyWeather weather(study, site);
  const SunPath path = std::holds_alternative<WeatherPeriod>(study.period.kind)
                           ? path_of(weather.own_steps(), study, site, series)
                           : dated_path(study, site, series);
  const auto means = weather.means(path);
  for (std::size_t i = 0; i < path.size(); ++i)
    series.intervals.push_back(measured_light(path[i], means[i]));
  if (asks_for_albedos(study)) put_albedos(weather.albedos(path), series);
  series.weather = weather.words();
  series.notes.insert(series.notes.end(), weather.warnings().begin(), weather.warnings().end());
  series.weather_sha256 = sha256_of_file(study.light.weather);
}

}  // namespace

bool is_dark(const LitInterval& interval) {
  const bool has_sun = interval.when.sunlit_s > 0 && interval.when.direction.z > 0;
  return !has_sun && interval.mean.dhi <= 0;
}

bool meet(const TimeSpan& first, const TimeSpan& second) {
  constexpr double instant_s = 1e-3;
  return std::abs(second[0] - first[1]) <= instant_s;
}

std::vector<TimeSpan> LightSeries::spans() const {
  std::vector<TimeSpan> spans;
  spans.reserve(intervals.size());
  for (const LitInterval& interval : intervals)
    spans.push_back({interval.when.begin, interval.when.end});
  return spans;
}

bool LightSeries::any_joined() const {
  return std::ranges::any_of(
      intervals, [](const LitInterval& interval) { return interval.joined != nullptr; });
}

std::size_t LightSeries::lit_count(std::size_t begin, std::size_t end) const {
  return static_cast<std::size_t>(
      std::count_if(intervals.begin() + static_cast<std::ptrdiff_t>(begin),
                    intervals.begin() + static_cast<std::ptrdiff_t>(end),
                    [](const LitInterval& interval) { return !is_dark(interval); }));
}

std::span<const LitInterval> LitInterval::parts() const {
  return joined ? std::span(*joined) : std::span<const LitInterval>();
}

std::size_t LitInterval::suns() const {
  return std::max<std::size_t>({when.sun_samples.size(), direct_suns.size(), 1});
}

std::size_t LightSeries::sun_samples() const {
  std::size_t count = 0;
  for (const LitInterval& interval : intervals)
    if (interval.when.sunlit_s > 0) count += interval.suns();
  return count;
}

std::vector<Vec3> LightSeries::direct_suns() const {
  std::vector<Vec3> suns;
  for (const LitInterval& interval : intervals)
    for (const SunSample& sun : interval.direct_suns) suns.push_back(sun.direction);
  return suns;
}

std::size_t LightSeries::parts() const {
  std::size_t count = 0;
  for (const LitInterval& interval : intervals)
    count += std::max<std::size_t>(interval.parts().size(), 1);
  return count;
}

std::size_t LightSeries::lit_parts() const {
  std::size_t count = 0;
  for (const LitInterval& interval : intervals)
    if (!is_dark(interval)) count += std::max<std::size_t>(interval.parts().size(), 1);
  return count;
}

std::size_t LightSeries::suns_of_mirrors() const {
  std::size_t count = 0;
  for (const LitInterval& interval : intervals)
    if (interval.when.sunlit_s > 0)
      count += interval.joined ? interval.sun_samples.size() : interval.suns();
  return count;
}

namespace {

/// Instants whose interval has sun that they do not stand for.
void note_dark_instants(LightSeries& series) {
  const auto count = std::ranges::count_if(series.intervals, [](const LitInterval& interval) {
    return interval.when.sunlit_s == 0 && interval.when.up_s > 0 &&
           interval.when.sun.elevation_deg <= 0;
  });
  if (count > 0)
    series.notes.push_back(fmt::format(
        "{} instants have the sun below the horizon though it is up during part of their interval: "
        "no direct light comes then; steps (days, from, to, step_min) put the sun where it shines",
        count));
}

/// Nobody who writes days of 24 hours as steps means that the sun stands still from morning to
/// evening.
void note_long_intervals(LightSeries& series, bool has_dni_of_each_sun) {
  constexpr double longest_s = 3 * seconds_per_hour;
  double most_s = 0;
  for (const LitInterval& interval : series.intervals) {
    const auto suns = static_cast<double>(has_dni_of_each_sun ? interval.suns() : 1);
    most_s = std::max(most_s, interval.when.sunlit_s / suns);
  }
  if (most_s <= longest_s) return;
  series.notes.push_back(fmt::format(
      "one {} stands for up to {:.3g} h of sun: direct light may be off by tens of per cent; for "
      "values of days or months write a period.step_min of 60 or less, with output: {{series_step: "
      "day}}",
      has_dni_of_each_sun ? "sun" : "DNI", most_s / seconds_per_hour));
}

/// Suns of an interval of which nobody knows what each brings.
void share_alike(LightSeries& series) {
  for (LitInterval& interval : series.intervals) {
    const auto& suns = interval.when.sun_samples;
    if (suns.empty() || !interval.sun_samples.empty()) continue;
    const double share = 1 / static_cast<double>(suns.size());
    for (const Vec3 sun : suns) interval.sun_samples.push_back({sun, share, share});
  }
}

LightSeries series_of(const Study& study, const Site& site) {
  LightSeries series;
  if (study.light.source == LightSource::weather) {
    add_weather(study, site, series);
    return series;
  }
  const auto* positions = std::get_if<PositionsPeriod>(&study.period.kind);
  series.times_are_synthetic = positions != nullptr;
  const SunPath path =
      positions ? positions_path(*positions, site) : dated_path(study, site, series);
  if (path.empty()) throw without_intervals(study, series);
  if (study.light.source == LightSource::fixed || positions) {
    for (const auto& when : path) series.intervals.push_back(fixed_light(when, study.light));
    return series;
  }
  const SunEphemeris sun(path.front().begin, path.back().end, site, study.sun.refraction,
                         study.sun.ut1_utc, standard_air(site.elevation_m));
  const ClearSky sky(study.light, site, sun);
  for (const auto& when : path) {
    LitInterval interval{when, {}, {}};
    if (when.up_s > 0) {
      interval.of_the_sky = sky.mean_while_up(when);
      interval.sun_samples = sky.suns_of(when);
      if (study.light.sky_scale == SkyScale::absolute) make_sky_absolute(interval, study.light);
      interval.mean = over_interval(when, interval.of_the_sky,
                                    when.sunlit_s == when.up_s ? interval.of_the_sky
                                    : when.sunlit_s > 0        ? sky.mean_while_sunlit(when)
                                                               : Irradiance{});
    }
    series.intervals.push_back(interval);
  }
  return series;
}

}  // namespace

LightSeries light_series(const Study& study, const Site& site) {
  LightSeries series = series_of(study, site);
  share_alike(series);
  if (std::holds_alternative<InstantsPeriod>(study.period.kind))
    note_dark_instants(series);
  else if (!series.times_are_synthetic)
    note_long_intervals(series, study.light.source != LightSource::weather);
  join_short_intervals(study, series);
  return series;
}

LuminousEfficacy efficacy_of(const LitInterval& interval) {
  // Water vapour changes the efficacy by some per cent; 2 cm is a usual value in temperate
  // summers, and what Radiance's gendaylit assumes.
  constexpr double water_cm = 2;
  if (interval.lm_per_w) return *interval.lm_per_w;
  const Irradiance& sky = interval.of_the_sky;
  const double zenith_deg = sky_zenith_deg(interval.when);
  return luminous_efficacy(
      sky_condition(sky.dni, sky.dhi, zenith_deg, extraterrestrial(interval.when.sun.distance_au)),
      zenith_deg, water_cm);
}

Irradiance source_means(const LitInterval& interval, Quantity quantity) {
  if (interval.joined) {
    Irradiance sum;
    for (const LitInterval& part : interval.parts()) {
      const double share = part.when.length_s() / interval.when.length_s();
      const Irradiance of_part = scaled(source_means(part, quantity), share);
      sum = {sum.dni + of_part.dni, sum.dhi + of_part.dhi, sum.ghi + of_part.ghi};
    }
    return sum;
  }
  const Irradiance& mean = interval.mean;
  const bool is_nothing = mean.dni <= 0 && mean.dhi <= 0;
  if (quantity == Quantity::irradiance || is_nothing) return mean;
  const LuminousEfficacy lm_per_w = efficacy_of(interval);
  const double diffuse = mean.dhi * lm_per_w.diffuse;
  // Weather whose GHI is below its DHI has no beam.
  return {mean.dni * lm_per_w.beam, diffuse,
          std::max(0.0, mean.ghi - mean.dhi) * lm_per_w.beam + diffuse};
}

namespace {

SkyInput sky_input(const LitInterval& interval, const LightStudy& light) {
  const SunInterval& when = interval.when;
  return {.model = light.sky,
          .dhi = interval.of_the_sky.dhi,
          .dni = interval.of_the_sky.dni,
          .extraterrestrial_normal = extraterrestrial(when.sun.distance_au),
          .sun_zenith_deg = sky_zenith_deg(when),
          .sun_direction = when.direction,
          .cie_type = light.sky_type,
          .turbidity = light.turbidity};
}

}  // namespace

Sky sky_of(const LitInterval& interval, const LightStudy& light) {
  return Sky(sky_input(interval, light));
}

RelativeSky relative_sky_of(const LitInterval& interval, const LightStudy& light) {
  return relative_sky(sky_input(interval, light));
}

}  // namespace sunload
