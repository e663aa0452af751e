// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Form factors by lines against closed forms: polygons, points, infinite strips.
///
/// A receiver sees an emitter of exitance 1: its irradiance is the form factor.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/known_truth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Polygon = std::vector<Vec3>;
using nlohmann::json;

constexpr const char* closed_forms = "04_form_factors/closed_forms.json";
constexpr const char* triangle_pairs = "04_form_factors/triangle_pairs.json";

/// Adds a polygon as a fan of triangles, each cut into pieces² congruent ones.
std::size_t add(SceneBuilder& builder, const Polygon& p, int material, int pieces = 1) {
  for (std::size_t k = 2; k < p.size(); ++k) {
    const Vec3 x = (p[k - 1] - p[0]) / pieces, y = (p[k] - p[0]) / pieces;
    for (int i = 0; i < pieces; ++i)
      for (int j = 0; i + j < pieces; ++j) {
        const Vec3 a = p[0] + x * i + y * j;
        builder.triangle(a, a + x, a + y, material);
        if (i + j + 1 < pieces) builder.triangle(a + x, a + x + y, a + y, material);
      }
  }
  return (p.size() - 2) * static_cast<std::size_t>(pieces * pieces);
}

/// Receivers are cut, so that their lines are stratified and all others have few.
constexpr int receiver_pieces = 4;

SolverRules rules_of(int lines_per_realization) {
  return diffuse_rules(lines_per_realization, 0, 32);
}

struct Stage : LampStage {
  int mirror = builder.material({"mirror", 0, 1, 0});
};

/// Mean irradiance per realization of the triangles of the first `triangles`.
std::vector<double> received(const Stage& stage, int lines, std::size_t triangles,
                             const IntervalLight& light = night) {
  const auto solved = solve(stage.builder.scene(), {light}, rules_of(lines));
  return solved.means([&](std::size_t i) {
    return static_cast<std::size_t>(solved.patches[i].triangle) < triangles;
  });
}

std::vector<double> form_factor(const Polygon& from, const Polygon& to, int lines) {
  Stage stage;
  const auto pieces = add(stage.builder.object("from"), from, stage.black, receiver_pieces);
  add(stage.builder.object("to"), to, stage.lamp);
  return received(stage, lines, pieces);
}

double largest_coordinate(const Polygon& a, const Polygon& b) {
  double largest = 0;
  for (const auto* p : {&a, &b})
    for (const Vec3 v : *p)
      largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest;
}

/// Smallest distance of p to a polygon, from a lattice of points on it.
double distance(Vec3 p, const Polygon& q) {
  constexpr int lattice = 40;
  double nearest = 1e300;
  for (std::size_t k = 2; k < q.size(); ++k)
    for (int i = 0; i <= lattice; ++i)
      for (int j = 0; i + j <= lattice; ++j)
        nearest = std::min(nearest, norm(q[0] + (q[k - 1] - q[0]) * (double(i) / lattice) +
                                         (q[k] - q[0]) * (double(j) / lattice) - p));
  return nearest;
}

/// Moving the start up by δ turns what is seen at a distance d by δ / d; where both touch it
/// uncovers at most a rim of width δ.
double lift_bias(const Polygon& from, const Polygon& to) {
  double rim = 0, nearest = 1e300;
  Vec3 twice_area;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Vec3 a = from[k], b = from[(k + 1) % from.size()];
    rim += norm(b - a);
    twice_area += cross(a - from[0], b - from[0]);
    for (const Vec3 v : to) nearest = std::min(nearest, distance(v, from));
    nearest = std::min(nearest, distance(a, to));
  }
  return lift(largest_coordinate(from, to)) * std::min(rim / (norm(twice_area) / 2), 1 / nearest);
}

constexpr TruthCheck check{.fault_factor = 1.02, .standard_error = 0.002};

/// Lines per piece and realization, enough for some 0.2 % of a form factor: about 40 hits.
int lines_for(double truth) {
  constexpr int least = 128, most = 2048, hits = 40;
  int lines = least;
  while (lines < most && lines * truth < hits) lines *= 2;
  return lines;
}

TEST(FormFactors, OfPolygonPairs) {
  int cases = 0;
  for (const auto& c : reference_cases(closed_forms)) {
    const auto& g = c["geometry"];
    if (!g.contains("P1") || !g.contains("P2")) continue;
    const Polygon a = polygon(g["P1"]), b = polygon(g["P2"]);
    const double truth = number(c["F12"]);
    check(c["id"], form_factor(a, b, lines_for(truth)), truth, lift_bias(a, b));
    ++cases;
  }
  EXPECT_GE(cases, 17);
}

TEST(FormFactors, OfTrianglePairs) {
  for (const auto& c : reference_cases(triangle_pairs)) {
    // The smaller triangle receives: of its lines more arrive (reciprocity has its own test).
    const bool forth = number(c["A1"]) <= number(c["A2"]);
    const Polygon from = polygon(c[forth ? "P1" : "P2"]), to = polygon(c[forth ? "P2" : "P1"]);
    const double truth = number(c[forth ? "F12" : "F21"]), bias = lift_bias(from, to);
    // Half the pieces of a rectangle.
    const auto F = form_factor(from, to, 2 * lines_for(truth));
    check(c["id"], F, truth, bias);
  }
}

/// A small square about p, seen from its front n.
Polygon small_square(Vec3 p, Vec3 n, double edge) {
  const Tangents axes = tangents(normalized(n));
  const Vec3 x = axes.tangent * (edge / 2), y = axes.bitangent * (edge / 2);
  return {p - x - y, p + x - y, p + x + y, p - x + y};
}

// A point stands for a square of 1 % of its distance d to the emitter: the mean over the
// square is off by at most the form factor's second derivative (of order 1/d²) times edge².
TEST(FormFactors, OfPointsToPolygons) {
  constexpr double edge_by_distance = 0.01;
  int cases = 0;
  for (const auto& c : reference_cases(closed_forms)) {
    const auto& g = c["geometry"];
    if (!g.contains("point") || !g.contains("P2")) continue;
    const Vec3 p = point(g["point"]);
    const Polygon to = polygon(g["P2"]);
    const double d = distance(p, to);
    const Polygon from = small_square(p, point(g["normal"]), edge_by_distance * d);
    Stage stage;
    const auto pieces = add(stage.builder.object("from"), from, stage.black, receiver_pieces);
    // Which side faces the point is not stated.
    add(stage.builder.sides(Sides::two).object("to"), to, stage.lamp);
    const double truth = number(c["F12"]);
    check(c["id"], received(stage, lines_for(truth), pieces), truth,
          edge_by_distance * edge_by_distance + lift(largest_coordinate(from, to)) / d);
    ++cases;
  }
  EXPECT_GE(cases, 9);
}

/// Perfect mirrors at y = 0 and y = 1 over a rectangle of x and z: what lies between them
/// is infinitely long. Lines that leave the rectangle must not come back.
void mirror_ends(Stage& stage, double x0, double x1, double z0, double z1) {
  stage.builder.object("mirrors");
  stage.builder.quad({x0, 0, z0}, {x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, stage.mirror);
  stage.builder.quad({x0, 1, z0}, {x1, 1, z0}, {x1, 1, z1}, {x0, 1, z1}, stage.mirror);
}

/// Strip from p to q in the plane y = 0, its front to the left of that way (seen with x to
/// the right and z up).
Polygon strip(Vec3 p, Vec3 q) {
  const Vec3 y{0, 1, 0};
  return {p, q, q + y, p + y};
}

void check_strips(const json& c, const Polygon& from, const Polygon& to) {
  Stage stage;
  const auto pieces = add(stage.builder.object("from"), from, stage.black, receiver_pieces);
  add(stage.builder.object("to"), to, stage.lamp);
  Vec3 low = from[0], high = from[0];
  for (const auto* p : {&from, &to})
    for (const Vec3 v : *p) {
      low = {std::min(low.x, v.x), 0, std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), 0, std::max(high.z, v.z)};
    }
  mirror_ends(stage, low.x, high.x, low.z, high.z);
  const double truth = number(c["F12"]);
  check(c["id"], received(stage, lines_for(truth), pieces), truth, lift_bias(from, to));
}

TEST(FormFactors, OfInfiniteStrips) {
  for (const auto& c : reference_cases(closed_forms)) {
    const auto& g = c["geometry"];
    if (c["kind"] == "infinite_parallel_strips") {
      const double w = number(g["width"]), h = number(g["gap"]);
      check_strips(c, strip({0, 0, 0}, {w, 0, 0}), strip({w, 0, h}, {0, 0, h}));
    } else if (c["kind"] == "infinite_perpendicular_strips") {
      check_strips(c, strip({0, 0, 0}, {number(g["width1"]), 0, 0}),
                   strip({0, 0, number(g["width2"])}, {0, 0, 0}));
    } else if (c["kind"] == "infinite_wedge_equal_widths") {
      const double a = radians(number(g["angle_deg"]));
      check_strips(c, strip({0, 0, 0}, {1, 0, 0}), strip({std::cos(a), 0, std::sin(a)}, {0, 0, 0}));
    }
  }
}

// Sky view of street canyons, mean over the floor, at its centre and at a point.
TEST(FormFactors, OfTheSkyFromCanyonFloors) {
  int cases = 0;
  for (const auto& c : reference_cases(closed_forms)) {
    const auto kind = c["kind"].get<std::string>();
    if (kind.rfind("canyon_svf_", 0) != 0) continue;
    const auto& g = c["geometry"];
    const double W = number(g["W"]), H = number(g["H"]);
    Stage stage;
    Polygon from = strip({0, 0, 0}, {W, 0, 0});
    double bias = lift_bias(from, {});
    if (kind != "canyon_svf_floor_mean") {
      const double x = kind == "canyon_svf_floor_centre" ? W / 2 : W * number(g["x_over_W"]);
      // The nearest edge of the sky is at least H away.
      constexpr double edge_by_height = 0.01;
      from = small_square({x, 0.5, 0}, {0, 0, 1}, edge_by_height * H);
      bias = edge_by_height * edge_by_height + lift(std::max({W, H, 1.0})) / std::min(H, x);
    }
    const auto pieces = add(stage.builder.object("floor"), from, stage.black, receiver_pieces);
    add(stage.builder.object("walls"), strip({0, 0, H}, {0, 0, 0}), stage.black);
    add(stage.builder, strip({W, 0, 0}, {W, 0, H}), stage.black);
    mirror_ends(stage, 0, W, 0, H);
    const double truth = number(c["F12"]);
    check(c["id"], received(stage, lines_for(truth), pieces, with_uniform_sky(night, 1)), truth,
          bias);
    ++cases;
  }
  EXPECT_EQ(cases, 15);
}

/// Links of patch i.
std::vector<LinkTable::Link> links_of(const LineSet& lines, std::size_t i) {
  const auto& block = lines.patches.blocks[i / LinkTable::rows_per_block];
  LinkTable::Reader read(block);
  std::vector<LinkTable::Link> links;
  for (std::size_t row = 0; row <= i % LinkTable::rows_per_block; ++row) {
    links.resize(read.next_row());
    for (auto& link : links) link = read.next();
  }
  return links;
}

/// Share of the lines of patch i that meet patch j.
double share(const LineSet& lines, std::size_t i, std::size_t j) {
  double sum = 0;
  for (const auto& link : links_of(lines, i))
    if (link.target == j) sum += static_cast<double>(link.weight);
  return sum;
}

Scene room() {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {2, 1, 3}, builder.material({"m", 0.5, 0, 0}),
              SceneBuilder::Facing::inward);
  return builder.scene();
}

TEST(FormFactors, AreReciprocal) {
  const Scene scene = room();
  Watch watch;
  const auto traced = trace_scene(scene, SplitRules{}, rules_of(4096), watch);
  const auto& area = traced->hierarchy().area();
  int pairs = 0, wrong_found = 0;
  for (std::size_t i = 0; i < area.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      std::vector<double> difference, faulty;
      for (const auto& lines : traced->patches.lines.realizations) {
        difference.push_back(area[i] * share(lines, i, j) - area[j] * share(lines, j, i));
        faulty.push_back(area[j] * share(lines, i, j) - area[i] * share(lines, j, i));
      }
      const Verdict verdict = expect_mean(difference, 0);
      EXPECT_TRUE(verdict) << i << " " << j << ": " << verdict.text;
      const bool differ = std::abs(area[i] - area[j]) > 0.1 * area[i] &&
                          share(traced->patches.lines.pooled, i, j) > 0;
      pairs += differ;
      wrong_found += differ && !expect_mean(faulty, 0);  // planted: the area of the wrong patch
    }
  EXPECT_GT(pairs, 20);
  EXPECT_EQ(wrong_found, pairs);
}

// Every line of a closed room ends in it: shares of a power of two of lines are exact.
TEST(FormFactors, RowsOfAClosedRoomSumToOneExactly) {
  const Scene scene = room();
  Watch watch;
  const auto traced = trace_scene(scene, {.max_edge_m = 0.3}, rules_of(64), watch);
  ASSERT_GT(traced->hierarchy().patch_count(), LinkTable::rows_per_block / 2);
  for (const LineSet* lines :
       {&traced->patches.lines.pooled, &traced->patches.lines.realizations[5]})
    for (std::size_t i = 0; i < traced->hierarchy().patch_count(); ++i) {
      double sum = 0;
      for (const auto& link : links_of(*lines, i)) sum += static_cast<double>(link.weight);
      ASSERT_EQ(sum, 1.0) << i;
      ASSERT_EQ(lines->ends[i].fate.escaped, 0.0f);
      ASSERT_EQ(lines->ends[i].fate.backs, 0.0f);
    }
}

}  // namespace
}  // namespace sunload::test
