// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensors against point receivers of the references: lamps, shadows, mirrors, skies seen
/// through openings, one diffuse reflection; and what sensors must not change.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "geo/sky/sky.h"
#include "solver/base/threads.h"
#include "tests/support/known_truth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using nlohmann::json;
using Polygon = std::vector<Vec3>;

SolverRules sensor_rules(int lines_per_realization) {
  return diffuse_rules(lines_per_realization, 0, 32);
}

/// A scene, and the sensors in it.
struct SensorStage : LampStage {
  std::vector<Sensor> sensors;

  SensorStage& add(const Polygon& p, int material) {
    for (std::size_t k = 2; k < p.size(); ++k) builder.triangle(p[0], p[k - 1], p[k], material);
    return *this;
  }
  SensorStage& at(Vec3 position, Vec3 normal) {
    sensors.push_back(sensor_at(position, normal));
    return *this;
  }
  BatchTally light(const IntervalLight& light, const SolverRules& rules) const {
    Scene scene = builder.scene();
    scene.sensors = sensors;
    return solve(scene, {light}, rules).tally;
  }
};

constexpr TruthCheck check{.fault_factor = 1.02};

/// Lines of a realization by which a form factor is known to some 0.1 %. Patches have as many.
int lines_for(double truth) {
  constexpr int least = 256, most = 1 << 16, hits = 256;
  int lines = least;
  while (lines < most && lines * truth < hits) lines *= 2;
  return lines;
}

// ---- form factors ----------------------------------------------------------------------

TEST(SensorFormFactors, ToPolygons) {
  int cases = 0;
  for (const auto& c : reference_cases("04_form_factors/closed_forms.json")) {
    const auto& g = c["geometry"];
    if (!g.contains("point") || !g.contains("P2")) continue;
    SensorStage stage;
    // Which side faces the point is not stated.
    stage.builder.sides(Sides::two);
    stage.add(polygon(g["P2"]), stage.lamp).at(point(g["point"]), point(g["normal"]));
    const double truth = number(c["F12"]);
    double largest = 1, nearest = 1e9;
    for (const Vec3 v : polygon(g["P2"])) {
      largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
      nearest = std::min(nearest, norm(v - point(g["point"])));
    }
    check(c["id"], of_sensor(stage.light(night, sensor_rules(lines_for(truth))), 0), truth,
          lift(largest) / nearest);
    ++cases;
  }
  EXPECT_GE(cases, 9);
}

/// A regular polygon of the disk's own area: its vertices lie outside, the middles of its edges
/// within, so that the form factor differs by less than the ring between them, ~ (π/n)²/2.
Polygon disk(Vec3 centre, double radius, int corners) {
  const double r = radius * std::sqrt(2 * pi / corners / std::sin(2 * pi / corners));
  Polygon p;
  for (int k = 0; k < corners; ++k)
    p.push_back(centre +
                Vec3{r * std::cos(2 * pi * k / corners), -r * std::sin(2 * pi * k / corners), 0});
  return p;
}

TEST(SensorFormFactors, ToDisks) {
  constexpr int corners = 64;
  int cases = 0;
  for (const auto& c : reference_cases("04_form_factors/closed_forms.json", "dA_to_parallel_")) {
    const auto& g = c["geometry"];
    if (!g.contains("r")) continue;
    const double offset = g.contains("offset") ? number(g["offset"]) : 0;
    SensorStage stage;
    stage.add(disk({offset, 0, number(g["h"])}, number(g["r"]), corners), stage.lamp)
        .at({0, 0, 0}, {0, 0, 1});
    const double truth = number(c["F12"]);
    check(c["id"], of_sensor(stage.light(night, sensor_rules(lines_for(truth) / 4)), 0), truth,
          truth * (pi / corners) * (pi / corners) + lift(4) / number(g["h"]), 1.05);
    ++cases;
  }
  EXPECT_GE(cases, 3);
}

TEST(SensorFormFactors, SkyFromCanyonFloors) {
  int cases = 0;
  for (const auto& c : reference_cases("04_form_factors/closed_forms.json", "canyon_svf_floor_")) {
    const auto kind = c["kind"].get<std::string>();
    if (kind == "canyon_svf_floor_mean") continue;
    const auto& g = c["geometry"];
    const double W = number(g["W"]), H = number(g["H"]);
    const double x = kind == "canyon_svf_floor_centre" ? W / 2 : W * number(g["x_over_W"]);
    SensorStage stage;
    // Ends of a canyon of length 2L are seen within a share of about W·H / L².
    const double L = 50 * std::max(W, H);
    stage.add({{0, L, 0}, {0, -L, 0}, {0, -L, H}, {0, L, H}}, stage.black)
        .add({{W, -L, 0}, {W, L, 0}, {W, L, H}, {W, -L, H}}, stage.black)
        .add({{0, -L, 0}, {W, -L, 0}, {W, L, 0}, {0, L, 0}}, stage.black)
        .at({x, 0, 0}, {0, 0, 1});
    const double truth = number(c["F12"]);
    check(c["id"], of_sensor(stage.light(with_uniform_sky(night, 1), sensor_rules(1024)), 0), truth,
          W * H / (L * L) + 2 * lift(L) / std::min(H, x), 1.05);
    ++cases;
  }
  EXPECT_EQ(cases, 10);
}

// ---- lamps -----------------------------------------------------------------------------

/// Square of side s at height h, facing down, cut into pieces².
void add_square(SensorStage& stage, double s, double h, int material, Vec3 centre = {},
                int pieces = 1) {
  const double step = s / pieces;
  for (int i = 0; i < pieces; ++i)
    for (int j = 0; j < pieces; ++j) {
      const Vec3 p = centre + Vec3{i * step - s / 2, j * step - s / 2, h};
      stage.builder.quad(p, p + Vec3{0, step, 0}, p + Vec3{step, step, 0}, p + Vec3{step, 0, 0},
                         material);
    }
}

TEST(SensorLamps, SquareEmitters) {
  for (const auto& c : reference_cases("08_smits_jensen_style/cases.json", "emission_square"))
    for (std::size_t p = 0; p < c["points"].size(); ++p) {
      const double truth = number(c["irradiance"][p]), h = number(c["h"]);
      // Below a thousandth, a line in thousands counts: lamps so small are not gathered well.
      if (truth < 1e-3) continue;
      SensorStage stage;
      add_square(stage, number(c["s"]), h, stage.lamp);
      stage.at(point(c["points"][p]), {0, 0, 1});
      check(c["id"].get<std::string>() + " " + std::to_string(p),
            of_sensor(stage.light(night, sensor_rules(lines_for(truth))), 0), truth, lift(5) / h,
            truth < 0.01 ? 1.1 : 1.02);
    }
}

// Far beyond the scene: points are rounded to float there more coarsely than the lamp is.
TEST(SensorLamps, FarAwayByTheInverseSquare) {
  constexpr double side = 0.6;
  for (const double d : {10.0, 40.0, 100.0, 1000.0}) {
    SensorStage stage;
    add_square(stage, side, 0, stage.lamp);
    stage.at({0, 0, -d}, {0, 0, 1});
    // On the axis: the integral of cos^2 / (pi r^2) to second order in side / d. Lines, which
    // hardly ever meet so small a lamp, carry some 1e-5 of it.
    constexpr double by_lines = 1e-4;
    const double share = side / d, truth = share * share / pi * (1 - share * share / 3);
    check("at " + std::to_string(d) + " m", of_sensor(stage.light(night, sensor_rules(256)), 0),
          truth, truth * by_lines);
  }
}

TEST(SensorLamps, TilingMakesNoDifference) {
  for (const auto& c : reference_cases("08_smits_jensen_style/cases.json", "emission_tiling")) {
    SensorStage stage;
    add_square(stage, number(c["s"]), number(c["h"]), stage.lamp, {}, c["n"].get<int>());
    stage.at(point(c["point"]), {0, 0, 1});
    const double truth = number(c["irradiance"]);
    check(c["id"], of_sensor(stage.light(night, sensor_rules(lines_for(truth) / 2)), 0), truth,
          lift(1) / number(c["h"]));
  }
}

TEST(SensorLamps, ShadowsOfSquares) {
  for (const auto& c : reference_cases("08_smits_jensen_style/cases.json", "shadow_square")) {
    SensorStage stage;
    add_square(stage, number(c["s"]), number(c["h"]), stage.lamp);
    const auto& at = c["blocker_centre"];
    stage.builder.sides(Sides::two);
    add_square(stage, number(c["blocker_side"]), number(c["blocker_height"]), stage.black,
               {number(at[0]), number(at[1]), 0});
    stage.at(point(c["point"]), {0, 0, 1});
    const double truth = number(c["irradiance"]), open = number(c["unoccluded"]);
    const auto E = of_sensor(stage.light(night, sensor_rules(lines_for(open))), 0);
    const double bias = lift(4) / number(c["blocker_height"]);
    if (truth > 1e-9 && truth < open) {
      check(c["id"], E, truth, bias, 1.05);
    } else {
      EXPECT_TRUE(expect_mean(E, truth, bias)) << c["id"];
      // Planted fault: the other of all and nothing.
      EXPECT_FALSE(expect_mean(E, truth > 1e-9 ? 0 : open, bias)) << c["id"];
    }
  }
}

TEST(SensorLamps, InMirrors) {
  for (const char* kind : {"one_infinite_mirror", "corner_two_mirrors", "finite_mirror"})
    for (const auto& c : reference_cases("05_radiosity/mirrors.json", kind)) {
      SensorStage stage;
      const int mirror = stage.builder.material({"m", 0, number(c["mirror_reflectance"]), 0});
      const std::string id = c["id"];
      const bool finite = c.contains("mirror_rect_y"), corner = id.starts_with("corner");
      const double most = 20;  // holds every image in it
      const double y0 = finite ? number(c["mirror_rect_y"][0]) : corner ? 0 : -most;
      const double y1 = finite ? number(c["mirror_rect_y"][1]) : most;
      const double z0 = finite ? number(c["mirror_rect_z"][0]) : 0;
      const double z1 = finite ? number(c["mirror_rect_z"][1]) : most;
      stage.builder.quad({0, y0, z0}, {0, y1, z0}, {0, y1, z1}, {0, y0, z1}, mirror);
      if (corner)
        stage.builder.quad({most, 0, 0}, {0, 0, 0}, {0, 0, most}, {most, 0, most}, mirror);
      stage.add(polygon(c["emitter"]), stage.lamp).at(point(c["point"]), {0, 0, 1});
      const double truth = number(c["H_total"]), direct = number(c["H_direct"]);
      const auto E = of_sensor(stage.light(night, sensor_rules(1 << 13)), 0);
      const double bias = lift(most) / number(c["emitter"][0][2]);
      // Planted fault: the mirror forgotten, or 2 % where it shows nothing.
      check(id, E, truth, bias, truth > direct ? direct / truth : 1.02);
    }
}

// ---- the sun by mirrors, reflected light -------------------------------------------------

TEST(SensorSun, MirroredOntoTheGround) {
  for (const auto& c : reference_cases("05_radiosity/mirrors.json", "sun_on_mirror")) {
    SensorStage stage;
    const double w = number(c["w"]), z0 = number(c["z0"]), z1 = z0 + number(c["h"]);
    const int mirror = stage.builder.material({"m", 0, number(c["mirror_reflectance"]), 0});
    stage.builder.quad({0, 0, z0}, {0, w, z0}, {0, w, z1}, {0, 0, z1}, mirror);
    Vec3 middle;
    for (const auto& v : c["parallelogram"]) middle = middle + point(v) / 4;
    const Vec3 corner = point(c["parallelogram"][2]);
    stage.at(middle, {0, 0, 1}).at(corner + (corner - middle) * 0.01, {0, 0, 1});
    const double azimuth = radians(number(c["sun_azimuth_deg"]));
    const double elevation = radians(number(c["sun_elevation_deg"]));
    const Vec3 sun{std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                   std::sin(elevation)};
    SolverRules rules = sensor_rules(1);
    rules.direct_samples = rules.realizations;
    const auto tally = stage.light(one_second(sun, number(c["DNI"])), rules);
    const auto mirrored = tally.sensors.exposure[static_cast<std::size_t>(Part::mirror)];
    const double truth = number(c["extra_horizontal_irradiance"]);
    EXPECT_NEAR(mirrored[0], truth, float_rounding * truth) << c["id"];
    EXPECT_EQ(mirrored[1], 0) << c["id"];  // outside of the beam
    // A point and a sun without size: nothing is random.
    for (const double E : of_sensor(tally, 0)) EXPECT_EQ(E, of_sensor(tally, 0)[0]) << c["id"];
  }
}

/// The sun between a high mirror and a low one, seen by both.
struct BetweenMirrors : SensorStage {
  double elevation = radians(50), dni = 800, rho;

  explicit BetweenMirrors(double reflectance) : rho(reflectance) {
    const int mirror = builder.material({"m", 0, rho, 0});
    builder.quad({-50, 10, 0}, {50, 10, 0}, {50, 10, 30}, {-50, 10, 30}, mirror);
    builder.quad({50, -8, 0}, {-50, -8, 0}, {-50, -8, 6}, {50, -8, 6}, mirror);
    at({1, -6, 2.01}, {0, 0, 1});
  }
  double by_mirrors() const {
    const double azimuth = radians(190);
    const Vec3 sun{std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                   std::sin(elevation)};
    SolverRules rules = sensor_rules(1);
    rules.direct_samples = rules.realizations;
    const auto tally = light(one_second(sun, dni), rules);
    return tally.sensors.exposure[static_cast<std::size_t>(Part::mirror)][0];
  }
  /// Once by the high mirror, and once more by the low one.
  double truth() const { return dni * std::sin(elevation) * (rho + rho * rho); }
};

// Of glass that reflects 10 % the second is 1 %.
TEST(SensorSun, ReflectedTwiceByFaintMirrors) {
  for (const double rho : {0.1, 0.15, 0.5}) {
    const BetweenMirrors stage(rho);
    EXPECT_NEAR(stage.by_mirrors(), stage.truth(), float_rounding * stage.truth()) << rho;
  }
}

// A glass bay far away reflects the sun from pane to pane in more ways than patches have beams for;
// of a round tower more panes face it.
TEST(SensorSun, ReflectedTwiceWhereManyMirrorsMakeManyBeams) {
  constexpr int panes = 64, of_tower = 260;
  for (const bool is_bay : {true, false}) {
    BetweenMirrors stage(0.5);
    const int mirror = stage.builder.material({"glass", 0, stage.rho, 0});
    const auto on_arc = [&](int k, double z) {
      const double angle = is_bay ? pi * k / panes : -2 * pi * k / of_tower;
      return Vec3{300 + 10 * std::cos(angle), 10 * std::sin(angle), z};
    };
    for (int k = 0; k < (is_bay ? panes : of_tower); ++k)
      stage.builder.quad(on_arc(k, 0), on_arc(k, 60), on_arc(k + 1, 60), on_arc(k + 1, 0), mirror);
    EXPECT_NEAR(stage.by_mirrors(), stage.truth(), float_rounding * stage.truth()) << is_bay;
  }
}

TEST(SensorReflection, FromALitRectangle) {
  const auto name = "07_cie171_bestest/cie171_style.json";
  for (const auto& c : reference_cases(name, "diffuse_reflection")) {
    const auto& r = c["rectangle"];
    SensorStage stage;
    const int grey = stage.builder.material({"grey", number(c["rho"]), 0, 0});
    const double x0 = number(r[0]), y0 = number(r[1]), x1 = number(r[2]), y1 = number(r[3]);
    stage.builder.quad({x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}, grey);
    stage.at(point(c["points"][0]), point(c["normals"][0]));
    SolverRules rules = sensor_rules(1 << 11);
    rules.bounces = 1;
    const auto sun = one_second({0, 0, 1}, number(c["E"]));
    check(c["id"], of_sensor(stage.light(sun, rules), 0), number(c["irradiance"][0]), 0);
  }
}

// Bounces: a sensor follows light exactly as far as the patches do. In a room of reflectance
// rho whose walls all emit M, every receiver gets M (1 + rho + … + rho^n).
TEST(SensorReflection, CountsTheSameBouncesAsPatches) {
  for (const int bounces : {0, 1, 3}) {
    SensorStage stage;
    constexpr double rho = 0.6;
    const int wall = stage.builder.material({"wall", rho, 0, 1});
    stage.builder.box({0, 0, 0}, {2, 1, 3}, wall, SceneBuilder::Facing::inward);
    stage.at({1, 0.5, 1.5}, {1, 2, 3}).at({0.3, 0.2, 0}, {0, 0, 1});
    SolverRules rules = sensor_rules(256);
    rules.bounces = bounces;
    const auto tally = stage.light(night, rules);
    const double truth = (1 - std::pow(rho, bounces + 1)) / (1 - rho);
    const double one_more = truth + std::pow(rho, bounces + 1);
    for (std::size_t s = 0; s < 2; ++s) {
      const Verdict verdict = expect_mean(of_sensor(tally, s), truth);
      EXPECT_TRUE(verdict) << bounces << " bounces: " << verdict.text;
      EXPECT_FALSE(expect_mean(of_sensor(tally, s), one_more)) << "planted fault: one bounce more";
    }
  }
}

// ---- skies through openings (after CIE 171) ----------------------------------------------

/// The sky of a case, by a horizontal irradiance of 100: values are then per cent.
IntervalLight percent_sky(const json& c) {
  const std::string word = c["sky"];
  const double azimuth = radians(number(c["sun_azimuth_deg"]));
  const double zenith = radians(number(c["sun_zenith_deg"]));
  SkyInput input;
  input.dhi = 100;
  input.sun_zenith_deg = number(c["sun_zenith_deg"]);
  input.sun_direction = {std::sin(azimuth) * std::sin(zenith), std::cos(azimuth) * std::sin(zenith),
                         std::cos(zenith)};
  input.model = word == "uniform"    ? SkyModel::uniform
                : word == "overcast" ? SkyModel::cie_overcast
                : word == "kittler"  ? SkyModel::cie_clear
                                     : SkyModel::cie_general;
  if (input.model == SkyModel::cie_general) input.cie_type = std::stoi(word.substr(3));
  IntervalLight light = night;
  light.dhi = input.dhi;
  light.sky = SkyGrid().mean_radiance(Sky(input), input.dhi);
  return light;
}

/// Wall or ceiling with a rectangular hole: the plane is spanned by x and y from `corner`,
/// fronts to cross(x, y).
void add_with_hole(SensorStage& stage, Vec3 corner, Vec3 x, Vec3 y, double x0, double x1, double y0,
                   double y1, double width, double height) {
  const auto part = [&](double a, double b, double c, double d) {
    if (b > a && d > c)
      stage.builder.quad(corner + x * a + y * c, corner + x * b + y * c, corner + x * b + y * d,
                         corner + x * a + y * d, stage.black);
  };
  part(0, width, 0, y0);
  part(0, width, y1, height);
  part(0, x0, y0, y1);
  part(x1, width, y0, y1);
}

/// Walls and floor of the room, but for the ceiling or the east wall.
void add_room(SensorStage& stage, bool roof_opening, double side) {
  auto& b = stage.builder;
  b.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, stage.black);
  b.quad({0, 0, 0}, {0, 0, 3}, {4, 0, 3}, {4, 0, 0}, stage.black);
  b.quad({0, 4, 0}, {4, 4, 0}, {4, 4, 3}, {0, 4, 3}, stage.black);
  b.quad({0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3}, stage.black);
  if (roof_opening) {
    b.quad({4, 0, 0}, {4, 0, 3}, {4, 4, 3}, {4, 4, 0}, stage.black);
    add_with_hole(stage, {0, 0, 3}, {0, 1, 0}, {1, 0, 0}, 2 - side / 2, 2 + side / 2, 2 - side / 2,
                  2 + side / 2, 4, 4);
  } else {
    b.quad({0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3}, stage.black);
    add_with_hole(stage, {4, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1, 2, 1, 3, 3, 4);
  }
}

/// What the reference asks of a solver that samples: 1 % and 0.02 points. Of this, sky cells
/// of 2.2° that an edge cuts take their share, which no standard error shows.
double demanded(double percent) { return 0.01 * percent + 0.02; }

void check_percent(const std::string& id, const std::vector<double>& values, double truth) {
  const Verdict verdict = expect_mean(values, truth, demanded(truth));
  std::cout << id << ": " << verdict.text << "\n";
  EXPECT_TRUE(verdict) << id << ": " << verdict.text;
  // Planted fault: the cosine of a sky that is 5 % and 0.1 points brighter.
  EXPECT_FALSE(expect_mean(values, 1.05 * truth + 0.1, demanded(truth))) << id;
}

TEST(SensorSky, ThroughARoofOpening) {
  const auto name = "07_cie171_bestest/cie171_style.json";
  int cases = 0;
  for (const auto& c : reference_cases(name, "roof_")) {
    const std::string id = c["id"];
    SensorStage stage;
    add_room(stage, true, id.starts_with("roof_1") ? 1 : 4);
    for (const auto& p : c["points"]) stage.at(point(p), point(c["normal"]));
    const auto tally = stage.light(percent_sky(c), sensor_rules(2048));
    for (std::size_t s = 0; s < stage.sensors.size(); ++s)
      check_percent(id + " " + std::to_string(s), of_sensor(tally, s),
                    number(c["sky_component_percent"][s]));
    ++cases;
  }
  EXPECT_EQ(cases, 9);
}

TEST(SensorSky, ThroughAFacadeOpeningUnderOverhangAndBehindMask) {
  const auto name = "07_cie171_bestest/cie171_style.json";
  int cases = 0;
  for (const char* kind : {"facade", "overhang", "vertical_mask"})
    for (const auto& c : reference_cases(name, kind)) {
      const std::string id = c["id"];
      SensorStage stage;
      add_room(stage, false, 0);
      constexpr double far = 200;  // stands for infinitely wide
      stage.builder.sides(Sides::two);
      if (id.starts_with("overhang"))
        stage.builder.quad({4, -far, 2}, {5, -far, 2}, {5, far, 2}, {4, far, 2}, stage.black);
      if (id.starts_with("vertical"))
        stage.builder.quad({9, -far, 0}, {9, far, 0}, {9, far, 4}, {9, -far, 4}, stage.black);
      for (std::size_t s = 0; s < c["points"].size(); ++s)
        stage.at(point(c["points"][s]), point(c["normals"][s]));
      const auto tally = stage.light(percent_sky(c), sensor_rules(2048));
      for (std::size_t s = 0; s < stage.sensors.size(); ++s)
        check_percent(id + " " + std::to_string(s), of_sensor(tally, s),
                      number(c["sky_component_percent"][s]));
      ++cases;
    }
  EXPECT_EQ(cases, 10);
}

TEST(SensorSky, FarGroundThroughAFacadeOpening) {
  const auto name = "07_cie171_bestest/cie171_style.json";
  for (const auto& c : reference_cases(name, "ground_reflected")) {
    SensorStage stage;
    add_room(stage, false, 0);
    stage.at(point(c["points"][0]), point(c["normals"][0]));
    IntervalLight light = night;
    light.dhi = 100;  // not dark
    light.ground_exitance = number(c["ground_reflectance"]) * 100;
    const auto E = of_sensor(stage.light(light, sensor_rules(1 << 12)), 0);
    check(c["id"], E, number(c["external_component_percent"][0]), lift(4));
  }
}

// ---- what sensors are and are not ----------------------------------------------------------

/// A wall on a floor, and the sun: something of every kind of light.
SensorStage yard() {
  SensorStage stage;
  const int grey = stage.builder.material({"grey", 0.4, 0, 0});
  const int pane = stage.builder.material({"pane", 0.1, 0.7, 0});
  stage.builder.quad({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, grey);
  stage.builder.box({1, 1, 0}, {3, 3, 4}, pane, SceneBuilder::Facing::outward);
  stage.builder.quad({-3, -3, 3}, {-3, -2, 3}, {-2, -2, 3}, {-2, -3, 3}, stage.lamp);
  return stage;
}

IntervalLight noon() { return with_uniform_sky(one_second({0.3, -0.6, 0.7}, 800), 100); }

TEST(Sensors, OpenFieldIsGlobalHorizontalIrradiance) {
  SensorStage stage;
  stage.builder.triangle({1000, 1000, -1}, {1001, 1000, -1}, {1000, 1001, -1}, stage.black);
  stage.at({0, 0, 1}, {0, 0, 1}).at({0, 0, 1}, {0, -1, 0}).at({0, 0, 1}, {0, 0, -2});
  IntervalLight light = noon();
  const double ghi = light.dni * light.direction.z + light.dhi;
  light.ground_exitance = 0.2 * ghi;
  const SolverRules rules = sensor_rules(256);
  Scene scene = stage.builder.scene();
  scene.sensors = stage.sensors;
  Watch watch;
  const auto traced = trace_scene(scene, SplitRules{}, rules, watch);
  const auto tally =
      sunload::solve(*transport_of(*traced), std::vector{light}, watch).bands.front();
  const auto& ends = traced->sensors.lines.pooled.ends;
  EXPECT_EQ(ends[0].sky, 1.0f);
  EXPECT_EQ(ends[2].sky, 0.0f);
  for (const double E : of_sensor(tally, 0)) EXPECT_NEAR(E, ghi, float_rounding * ghi);
  check("wall", of_sensor(tally, 1),
        -light.dni * light.direction.y + light.dhi / 2 + light.ground_exitance / 2, 0);
  for (const double E : of_sensor(tally, 2))
    EXPECT_NEAR(E, light.ground_exitance, float_rounding * ghi);
  EXPECT_EQ(tally.sensors.sunlit_s, (std::vector<double>{1, 1, 0}));
}

TEST(Sensors, LeaveEveryPatchAsItWas) {
  const SensorStage without = yard();
  SensorStage with = yard();
  with.at({0, 0, 1}, {0, 0, 1}).at({0, 0, 0}, {0, 0, 1}).at({2, 0.99, 1}, {0, -1, 0});
  for (const auto errors : {Errors::totals, Errors::instants}) {
    SolverRules rules = test_rules();
    rules.errors = errors;
    const auto a = without.light(noon(), rules), b = with.light(noon(), rules);
    for (std::size_t p = 0; p < part_count; ++p) EXPECT_EQ(a.irradiance[p], b.irradiance[p]);
    EXPECT_EQ(a.irradiance_se, b.irradiance_se);
    EXPECT_EQ(a.exposure_realization, b.exposure_realization);
    EXPECT_EQ(a.sunlit_s, b.sunlit_s);
    EXPECT_EQ(a.ledger[0].terms, b.ledger[0].terms);
  }
}

TEST(Sensors, HaveBitsOfTheirOwnWhateverElseThereIs) {
  SensorStage one = yard(), many = yard();
  const Vec3 place{-1, 0.5, 1}, look{0.5, 0.5, 1};
  one.at(place, look);
  many.at({0, 0, 1}, {0, 0, 1}).at(place, look);
  const SolverRules rules = test_rules();
  const auto a = one.light(noon(), rules);
  const int threads = thread_count();
  set_thread_count(3);
  const auto b = many.light(noon(), rules);
  set_thread_count(threads);
  EXPECT_EQ(of_sensor(a, 0), of_sensor(b, 1));
  EXPECT_EQ(a.sensors.irradiance[0][0], b.sensors.irradiance[0][1]);
  EXPECT_NE(of_sensor(b, 0), of_sensor(b, 1));
}

TEST(Sensors, OnASurfaceSeeItsHemisphereAndWithinABodyItsBacks) {
  SensorStage stage;
  stage.builder.box({-2, -2, 0}, {2, 2, 3}, stage.black, SceneBuilder::Facing::outward);
  stage.at({0.5, 0.25, 3}, {0, 0, 1}).at({0, 0, 1.5}, {0, 0, 1});
  Scene scene = stage.builder.scene();
  scene.sensors = stage.sensors;
  Watch watch;
  const auto traced = trace_scene(scene, SplitRules{}, sensor_rules(64), watch);
  const auto& ends = traced->sensors.lines.pooled.ends;
  EXPECT_EQ(ends[0].sky, 1.0f);
  EXPECT_EQ(ends[0].fate.backs, 0.0f);
  EXPECT_EQ(ends[1].sky, 0.0f);
  EXPECT_EQ(ends[1].fate.backs, 1.0f);
}

// Where a large receiver is lit alike everywhere, a sensor on it gets what its patches get, part
// by part; and its errors per instant are those of its totals.
TEST(Sensors, AgreeWithPatchesPartByPart) {
  SensorStage open;
  const int wall = open.builder.material({"wall", 0.5, 0, 0});
  open.builder.quad({0, 0, 0}, {0.02, 0, 0}, {0.02, 0.02, 0}, {0, 0.02, 0}, wall);
  open.builder.quad({-3, 2, 0}, {3, 2, 0}, {3, 2, 4}, {-3, 2, 4}, wall);
  open.at({0.01, 0.01, 0}, {0, 0, 1});
  SolverRules rules = sensor_rules(1024);
  rules.bounces = 2;
  rules.errors = Errors::instants;
  const auto tally = open.light(noon(), rules);
  std::vector<double> difference, faulty;
  for (std::size_t r = 0; r < tally.exposure_realization.size(); ++r) {
    const double patches =
        (tally.exposure_realization[r][0] + tally.exposure_realization[r][1]) / 2;
    difference.push_back(tally.sensors.exposure_realization[r][0] - patches);
    faulty.push_back(tally.sensors.exposure_realization[r][0] - 1.02 * patches);
  }
  // The patch is 0.02 m wide, 2 m from the wall: it is lit alike within 1e-4.
  const double bias = 1e-4 * tally.exposure[0][0];
  EXPECT_TRUE(expect_mean(difference, 0, bias));
  EXPECT_FALSE(expect_mean(faulty, 0, bias));
  double parts = 0;
  for (std::size_t p = 1; p < part_count; ++p)
    if (!tally.sensors.exposure[p].empty()) parts += tally.sensors.exposure[p][0];
  EXPECT_NEAR(parts, tally.sensors.exposure[0][0], float_rounding * parts);
  const double of_totals = mean_error(of_sensor(tally, 0)).standard_error;
  EXPECT_NEAR(static_cast<double>(tally.sensors.irradiance_se[0]), of_totals, 1e-2 * of_totals);
}

// The edge of a shadow under a sun with a disk: half of it is seen from the edge's middle.
TEST(Sensors, SeeAPartOfTheSunsDisk) {
  SensorStage stage;
  stage.builder.sides(Sides::two);
  stage.builder.quad({0, -50, 10}, {50, -50, 10}, {50, 50, 10}, {0, 50, 10}, stage.black);
  stage.at({0, 0, 0}, {0, 0, 1}).at({-1, 0, 0}, {0, 0, 1}).at({1, 0, 0}, {0, 0, 1});
  IntervalLight light = one_second({0, 0, 1}, 1000);
  light.disk_half_angle = radians(0.2666);
  SolverRules rules = sensor_rules(1);
  rules.direct_samples = rules.realizations * 64;
  const auto tally = stage.light(light, rules);
  check("half", of_sensor(tally, 0), 500, 0);
  for (const double E : of_sensor(tally, 1)) EXPECT_NEAR(E, 1000, 0.01);
  for (const double E : of_sensor(tally, 2)) EXPECT_EQ(E, 0);
}

/// A screen of transmittance 0.3 five metres up, and another one a metre above.
SensorStage under_screens() {
  SensorStage stage;
  Material crown{"crown"};
  crown.transmittance = 0.3;
  const int screen = stage.builder.material(crown);
  stage.builder.sides(Sides::two);
  stage.builder.quad({-9, -9, 5}, {9, -9, 5}, {9, 9, 5}, {-9, 9, 5}, screen);
  stage.builder.quad({5, -9, 6}, {9, -9, 6}, {9, 9, 6}, {5, 9, 6}, screen);
  return stage;
}

// All rays of a point to the sun are one, which chance would let pass or not: each brings what
// passes. The sun's straight way through (0, 0, 5) is that of two triangles of one screen.
TEST(Sensors, SeeTheSunThroughScreensWithoutChance) {
  for (const double disk : {0.0, 0.2666}) {
    SensorStage stage = under_screens();
    stage.at({1, 2, 0.5}, {0, 0, 1}).at({7, 0, 0}, {0, 0, 1}).at({1000, 2, 0.5}, {0, 0, 1});
    IntervalLight sun = one_second({0.1, 0.2, 1}, 1000);
    sun.disk_half_angle = radians(disk);
    SolverRules rules = sensor_rules(1);
    rules.direct_samples = rules.realizations;
    const auto tally = stage.light(sun, rules);
    const double E = 1000 / std::sqrt(1.05);
    for (std::size_t s = 0; s < 3; ++s) {
      const double truth = E * std::array{0.3, 0.3 * 0.3, 1.0}[s];
      for (const double of_realization : of_sensor(tally, s))
        EXPECT_NEAR(of_realization, truth, 1e-5 * E) << s;
      EXPECT_NEAR(tally.sensors.sunlit_s[s], truth / E, 1e-6);
    }
  }
}

TEST(Sensors, CrossAScreenOnceWhereItsTrianglesMeet) {
  SensorStage stage = under_screens();
  stage.at({0, 0, 0}, {0, 0, 1}).at({2, 2, 0}, {0, 0, 1}).at({7, 7, 0}, {0, 0, 1});
  SolverRules rules = sensor_rules(1);
  rules.direct_samples = rules.realizations;
  const auto tally = stage.light(one_second({0, 0, 1}, 1000), rules);
  for (std::size_t s = 0; s < 3; ++s)
    for (const double E : of_sensor(tally, s)) EXPECT_NEAR(E, s < 2 ? 300 : 90, 0.01) << s;
}

// Behind clouds nothing but the share of the sun's time is told.
TEST(Sensors, SeeACloudedSunThroughScreens) {
  SensorStage stage = under_screens();
  stage.at({1, 2, 0.5}, {0, 0, 1}).at({1000, 2, 0.5}, {0, 0, 1});
  const auto tally = stage.light(one_second({0.1, 0.2, 1}, 0), sensor_rules(1));
  EXPECT_NEAR(tally.sensors.sunlit_s[0], 0.3, 1e-6);
  EXPECT_NEAR(tally.sensors.sunlit_s[1], 1, 1e-6);
}

}  // namespace
}  // namespace sunload::test
