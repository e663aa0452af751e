// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Days of sun on a plane against reference 06: energies and hours of a clear day by the
/// ephemeris, energies of a day of fixed declination in closed form.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

constexpr double one_hour_s = 3600, hour_min = 60;
constexpr double demanded_error = 0.005;  // of the truth, as a standard error

/// A square of 1 m² that faces that way; it receives on its front alone.
Scene plane(double tilt_deg, double azimuth_deg) {
  const Vec3 normal = enu_direction({azimuth_deg, 90 - tilt_deg});
  const Tangents axes = tangents(normal);
  SceneBuilder builder;
  const Vec3 x = axes.tangent, y = axes.bitangent, o{};
  builder.quad(o, x, x + y, y, builder.material({"black", 0, 0, 0}));
  return builder.scene();
}

SolverRules day_rules() {
  SolverRules rules = test_rules();
  rules.lines_per_patch = rules.realizations;
  rules.direct_samples = rules.realizations;
  rules.bounces = 0;
  return rules;
}

/// Energy of all intervals [Wh m-2] per realization, and hours of sun in front of the plane.
struct Day {
  std::vector<double> energy;
  double hours_in_front = 0;
};
Day day_on(const Scene& scene, const std::vector<IntervalLight>& suns) {
  const Solved solved = solve(scene, suns, day_rules());
  Day day{solved.means([](std::size_t) { return true; }), solved.tally.sunlit_s[0] / one_hour_s};
  for (auto& e : day.energy) e /= one_hour_s;
  return day;
}

void expect_day(const std::string& id, const Day& day, double truth, double bias,
                const Day& turned) {
  const Verdict verdict = expect_mean(day.energy, truth, bias);
  std::cout << id << ": " << verdict.text << "\n";
  EXPECT_TRUE(verdict) << id << ": " << verdict.text;
  EXPECT_LE(verdict.standard_error, demanded_error * truth) << id;
  EXPECT_FALSE(expect_mean(turned.energy, truth, bias))
      << id << ": planted fault unnoticed: " << expect_mean(turned.energy, truth, bias).text;
}

/// The day of a row in that zone of whole hours whose midnight is nearest the row's window.
std::string day_study(const Row& row, double step_min) {
  const int offset = static_cast<int>(std::round(-number(row, "window_start_utc_h")));
  return fmt::format(
      "format: sunload-study-1\nname: clear_day\n"
      "site: {{latitude_deg: {}, longitude_deg: {}, timezone: \"{}{:02}:00\"}}\n"
      "period: {{days: [{}], step_min: {}}}\nsun: {{refraction: none}}\n"
      "light: {{source: fixed, dni_w_m2: {}, dhi_w_m2: 0, far_ground_albedo: 0}}\n"
      "scene: {{builtin: {{name: box_on_plane}}}}\n",
      row.at("lat_deg"), row.at("lon_deg_east"), offset < 0 ? "-" : "+", std::abs(offset),
      row.at("date"), step_min, row.at("DNI"));
}

TEST(ClearDay, EnergyAndHoursOnAPlane) {
  constexpr double step_min = 10;
  const auto rows = read_csv("06_direct_sun/clear_day_energy.csv");
  ASSERT_GE(rows.size(), 9u);
  for (const auto& row : rows) {
    const std::string id = row.at("id");
    const VariantPlan plan = plan_of(day_study(row, step_min));
    const auto suns = suns_of(plan, SkyGrid());
    const double tilt = number(row, "tilt_deg"), azimuth = number(row, "surface_azimuth_deg");
    const Day day = day_on(plane(tilt, azimuth), suns);
    const double truth = number(row, "energy_Wh_m2");
    // What the reference says of steps of ten minutes.
    constexpr double step_error = 1e-3;
    // Planted fault: a plane that is tilted 2° otherwise and turned by 2°.
    expect_day(id, day, truth, step_error * truth, day_on(plane(tilt - 2, azimuth + 2), suns));
    double up_s = 0;
    for (const auto& sun : suns) up_s += sun.sunlit_s;
    // The sun's rise and set divide an interval; the front of a plane takes whole parts.
    EXPECT_NEAR(up_s / one_hour_s, number(row, "hours_sun_up"), 2 / hour_min) << id;
    EXPECT_NEAR(day.hours_in_front, number(row, "hours_sun_in_front"), step_min / hour_min) << id;
  }
}

/// Sun of an hour angle [rad], constant declination.
Vec3 sun_at(double latitude, double declination, double hour_angle) {
  const double s = std::sin(declination), c = std::cos(declination);
  return {-c * std::sin(hour_angle),
          s * std::cos(latitude) - c * std::sin(latitude) * std::cos(hour_angle),
          s * std::sin(latitude) + c * std::cos(latitude) * std::cos(hour_angle)};
}

/// A day in steps; of a step at sunrise or sunset the sun's part counts, at its own middle.
std::vector<IntervalLight> day_of(double latitude, double declination, int steps) {
  const double cosine = -std::tan(latitude) * std::tan(declination);
  const double sunset = std::acos(std::clamp(cosine, -1.0, 1.0));
  std::vector<IntervalLight> suns;
  for (int k = 0; k < steps; ++k) {
    const double step = 2 * pi / steps;
    const double begin = std::max(k * step - pi, -sunset);
    const double end = std::min((k + 1) * step - pi, sunset);
    if (end <= begin) continue;
    IntervalLight light = one_second(sun_at(latitude, declination, (begin + end) / 2), 1);
    light.number = static_cast<std::uint32_t>(k);
    light.length_s = light.sunlit_s = 24 * one_hour_s * (end - begin) / (2 * pi);
    suns.push_back(light);
  }
  return suns;
}

TEST(FixedDeclination, EnergyIsTheClosedForm) {
  const auto rows = read_csv("06_direct_sun/fixed_declination_day.csv");
  ASSERT_GE(rows.size(), 6u);
  for (const auto& row : rows) {
    const double latitude = radians(number(row, "lat_deg"));
    const double declination = radians(number(row, "declination_deg"));
    const double tilt = number(row, "tilt_towards_equator_deg");
    const double truth = number(row, "energy_Wh_m2_per_unit_DNI");
    constexpr int steps = 24 * 6;
    const auto suns = day_of(latitude, declination, steps);
    const Day day = day_on(plane(tilt, 180), suns);
    // Middles of steps of ten minutes: step² / 24 of the curvature, at most 1 over 24 hours; and
    // where the sun comes to the plane's front or leaves it, an eighth of step times change.
    const double step = 2 * pi / steps, hours = 24.0 / steps;
    const double bias = step * step + hours * step / 4;
    // Planted fault: the obliquity's half a degree less.
    const auto wrong = day_of(latitude, declination + radians(declination < 0 ? 0.5 : -0.5), steps);
    Day other = day_on(plane(tilt, 180), wrong);
    // On the equator at equinox half a degree is of second order.
    if (declination == 0) other = day_on(plane(tilt, 180), day_of(radians(5), 0, steps));
    expect_day(row.at("id"), day, truth, bias, other);
  }
}

}  // namespace
}  // namespace sunload::test
