// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Nothing leaks out of closed buildings that touch each other, far from the origin of their
/// coordinates: a hundred million rays from inside.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "geo/base/units.h"
#include "solver/base/rng.h"
#include "solver/base/threads.h"
#include "solver/surface/ray_caster.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double allowed_rate = 1e-7;  // what the references demand
constexpr std::size_t rays_demanded = 100'000'000;

/// Turned about the vertical, as streets are.
Vec3 turned(Vec3 p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

/// Closed boxes side by side, of whole and broken sizes; each shares its walls' planes with
/// its neighbours and towers above some of them.
struct Town {
  explicit Town(Vec3 place) {
    constexpr int rows = 16;
    ModelBuilder builder("town.obj");
    double y = 0;
    for (int j = 0; j < rows; ++j) {
      const double depth = 7 + 0.37 * (j % 5);
      double x = 0;
      for (int i = 0; i < rows; ++i) {
        const double width = 5 + 0.913 * (i % 4), height = 4 + 2.771 * ((i * 7 + j * 3) % 6);
        builder.object("house").box({x, y, 0}, {x + width, y + depth, height});
        houses.push_back({{x, y, 0}, {x + width, y + depth, height}});
        x += width;
      }
      y += depth;
    }
    builder.moved([&](Vec3 p) { return turned(p, angle) + place; });
    prepared = builder.prepared();
    shift = place - prepared.mesh.origin;
  }
  /// From a house's own frame to that of the mesh.
  Vec3 in_mesh(Vec3 p) const { return turned(p, angle) + shift; }

  struct House {
    Vec3 low, high;
  };
  static constexpr double angle = 0.3;
  std::vector<House> houses;
  PreparedMesh prepared;
  Vec3 shift;
};

/// Uniform numbers of a ray, by address.
struct Draw {
  explicit Draw(std::uint64_t ray) {
    for (std::uint32_t block = 0; block < 3; ++block) {
      const RandomWords words = random_words({.element = ray, .block = block});
      for (std::size_t k = 0; k < 4; ++k) x[4 * block + k] = words[k] / 4294967296.0;
    }
  }
  double x[12];
};

double between(double a, double b, double u) { return a + (b - a) * u; }

/// A point within a house, a way off its walls so that it is inside in floats too.
Vec3 within(const Town::House& h, const double* u) {
  constexpr double margin = 0.05;
  return {between(h.low.x + margin, h.high.x - margin, u[0]),
          between(h.low.y + margin, h.high.y - margin, u[1]),
          between(h.low.z + margin, h.high.z - margin, u[2])};
}

/// A point on one of its twelve edges.
Vec3 on_edge(const Town::House& h, const double* u) {
  const auto edge = static_cast<unsigned>(u[0] * 12);
  const auto end = [&](unsigned bit) { return edge >> bit & 1u ? 1.0 : 0.0; };
  const double s = end(0), t = end(1);
  const double share[3][3] = {{u[1], s, t}, {s, u[1], t}, {s, t, u[1]}};
  const double* at = share[edge / 4];
  return {between(h.low.x, h.high.x, at[0]), between(h.low.y, h.high.y, at[1]),
          between(h.low.z, h.high.z, at[2])};
}

Vec3 any_direction(const double* u) {
  const double z = 2 * u[0] - 1, s = std::sqrt(std::max(0.0, 1 - z * z));
  return {s * std::cos(2 * pi * u[1]), s * std::sin(2 * pi * u[1]), z};
}

/// Distance at which a ray from inside leaves the house (unit direction).
double way_out(const Town::House& h, Vec3 o, Vec3 w) {
  const auto along = [](double low, double high, double at, double step) {
    return step == 0 ? 1e300 : ((step > 0 ? high : low) - at) / step;
  };
  return std::min({along(h.low.x, h.high.x, o.x, w.x), along(h.low.y, h.high.y, o.y, w.y),
                   along(h.low.z, h.high.z, o.z, w.z)});
}

struct Leaks {
  std::size_t rays = 0;
  std::size_t left_scene = 0;  ///< met nothing at all
  std::size_t left_house = 0;  ///< went on beyond a wall of the house that it began in
};

/// Rays from inside the houses; every second one aims at an edge, where leaks would be.
Leaks leaks(const Town& town, std::size_t rays) {
  const RayCaster caster(town.prepared.mesh);
  constexpr std::size_t chunk = 1 << 14;
  const std::size_t packets = (rays + packet_size - 1) / packet_size;
  std::vector<Leaks> counts((packets + chunk - 1) / chunk);
  parallel_chunks(packets, chunk, [&](std::size_t begin, std::size_t end) {
    Leaks& count = counts[begin / chunk];
    for (std::size_t p = begin; p < end; ++p) {
      Packet origins, directions;
      double out[packet_size];
      for (std::size_t r = 0; r < packet_size; ++r) {
        const Draw draw(p * packet_size + r);
        const auto& house =
            town.houses[static_cast<std::size_t>(draw.x[0] * double(town.houses.size()))];
        const Vec3 o = within(house, draw.x + 1);
        const Vec3 w =
            r % 2 ? any_direction(draw.x + 4) : normalized(on_edge(house, draw.x + 6) - o);
        put(origins, r, town.in_mesh(o));
        put(directions, r, turned(w, Town::angle));
        out[r] = way_out(house, o, w);
      }
      const auto hits = caster.first_hits(origins, directions, 0xffff);
      for (std::size_t r = 0; r < packet_size; ++r) {
        ++count.rays;
        // Coordinates of floats, seen along a grazing ray: far below what a wall is apart.
        constexpr double rounding_m = 0.02;
        if (hits.triangle[r] < 0)
          ++count.left_scene;
        else if (static_cast<double>(hits.distance[r]) > out[r] + rounding_m)
          ++count.left_house;
      }
    }
  });
  Leaks sum;
  for (const auto& count : counts) {
    sum.rays += count.rays;
    sum.left_scene += count.left_scene;
    sum.left_house += count.left_house;
  }
  return sum;
}

struct Place {
  const char* name;
  Vec3 at;
};
// Amsterdam in RD New, Bern in LV95: metres of national grids.
const Place places[] = {{"local origin", {0, 0, 0}},
                        {"RD New", {121687.42, 487315.87, 1.53}},
                        {"LV95", {2600072.37, 1199748.91, 540.2}}};

TEST(Town, NothingLeaksOutOfItsHouses) {
  Leaks all;
  for (const auto& place : places) {
    const Town town(place.at);
    EXPECT_EQ(town.prepared.report.closed_bodies, town.houses.size()) << place.name;
    EXPECT_EQ(town.prepared.report.open_edges, 0u) << place.name;
    const Leaks count = leaks(town, rays_demanded / 3 + packet_size);
    std::cout << place.name << ": " << town.prepared.mesh.triangle_count() << " triangles of "
              << town.houses.size() << " houses; of " << count.rays << " rays " << count.left_scene
              << " left the scene, " << count.left_house << " their house\n";
    all.rays += count.rays;
    all.left_scene += count.left_scene;
    all.left_house += count.left_house;
  }
  ASSERT_GE(all.rays, rays_demanded);
  const double allowed = allowed_rate * static_cast<double>(all.rays);
  EXPECT_LT(static_cast<double>(all.left_scene), allowed);
  EXPECT_LT(static_cast<double>(all.left_house), allowed);
}

TEST(Town, AHoleLeaks) {
  Town town(places[2].at);
  // Planted fault: one triangle of a roof is missing.
  Mesh& mesh = town.prepared.mesh;
  std::size_t roof = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.area_vector2(t).z > mesh.area_vector2(roof).z) roof = t;
  mesh.triangles[roof][2] = mesh.triangles[roof][1];
  const Leaks count = leaks(town, 1'000'000);
  std::cout << "with a hole: of " << count.rays << " rays " << count.left_scene << " left\n";
  EXPECT_GT(static_cast<double>(count.left_scene),
            100 * allowed_rate * static_cast<double>(count.rays));
}

}  // namespace
}  // namespace sunload::test
