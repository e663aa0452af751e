// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/sensor.h"

#include <bit>
#include <optional>
#include <utility>

#include "geo/base/keys.h"
#include "geo/mesh/box_tree.h"
#include "solver/base/rng.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

std::uint64_t key_of_place(Vec3 absolute_position, Vec3 normal) {
  std::uint64_t key = 0x73656e736f72;  // "sensor": apart from the keys of patches
  for (const Vec3& v : {absolute_position, normal})
    for (const double x : {v.x, v.y, v.z}) key = mixed(key, std::bit_cast<std::uint64_t>(x + 0.0));
  return key;
}

namespace {

/// Nearer than so many offsets a surface is one on which a sensor stands.
constexpr double near_offsets = 2;
/// Rays of a sensor start this share of the offset around it, in the plane that it faces
/// (SunSampler).
constexpr double spread = 0.75;
/// Cosine to the front of a one-sided surface below which a sensor looks into it: who measures in a
/// room writes the wall's inward normal, and who tilts a sensor on a roof does not mean the attic.
constexpr double looks_into = -0.9;
/// Of surfaces that meet under two degrees: a step leaves their cosine of what is lacking.
constexpr int most_steps = 4096;

/// The point of a triangle that is nearest to p.
/// Reference: Ericson (2005), Real-Time Collision Detection, section 5.1.5.
Vec3 nearest_point(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a;
  const double d1 = dot(ab, p - a), d2 = dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = dot(ab, p - b), d4 = dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double d5 = dot(ab, p - c), d6 = dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  if (of_a <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = of_a + of_b + of_c;
  return a + ab * (of_b / sum) + ac * (of_c / sum);
}

double distance(const Mesh& mesh, std::size_t t, Vec3 p) {
  return norm(p - nearest_point(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
}

/// Triangles on which each sensor stands; not those without area, which no ray meets.
std::vector<std::vector<std::size_t>> stood_on(const Mesh& mesh, const std::vector<Sensor>& sensors,
                                               double reach) {
  std::vector<Box> places;
  places.reserve(sensors.size());
  for (const Sensor& sensor : sensors) places.push_back({sensor.position, sensor.position});
  const BoxTree tree(std::move(places));
  std::vector<std::vector<std::size_t>> triangles(sensors.size());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!(norm(mesh.area_vector2(t)) > 0)) continue;
    const Box box = box_of(mesh, t);
    tree.visit_meeting(widened(box, reach), [&](std::size_t s) {
      if (distance(mesh, t, sensors[s].position) < reach) triangles[s].push_back(t);
    });
  }
  return triangles;
}

/// The side of a triangle that a sensor on it sees from, as a normal.
Vec3 seen_side(const Mesh& mesh, std::size_t t, Vec3 sensor_normal) {
  const Vec3 front = mesh.normal(t);
  const double cosine = dot(front, sensor_normal);
  const bool by_front = mesh.triangle_sides[t] == Sides::two ? cosine >= 0 : cosine > looks_into;
  return by_front ? front : -front;
}

/// How far off its place a sensor sees from, so that no ray meets what it stands on. Nothing where
/// surfaces leave no room, such as two back to back.
std::optional<Vec3> lift(const Mesh& mesh, const std::vector<std::size_t>& surfaces,
                         const Sensor& sensor, double offset) {
  Vec3 lift = sensor.normal * offset;
  for (int step = 0; step < most_steps; ++step) {
    bool is_clear = true;
    for (const std::size_t t : surfaces) {
      const Vec3 side = seen_side(mesh, t, sensor.normal);
      const double sine = norm(cross(side, sensor.normal));
      const double wanted = offset * (1 + spread * sine), enough = wanted * (1 - 1e-3);
      const Vec3 from = sensor.position + lift;
      const double height = dot(side, from - mesh.corner(t, 0));
      if (height >= enough || distance(mesh, t, from) >= enough) continue;
      lift = lift + side * (wanted - height);
      is_clear = false;
    }
    if (is_clear) return lift;
  }
  return {};
}

}  // namespace

void clear_of_surfaces(const Mesh& mesh, std::vector<Sensor>& sensors) {
  const double offset = ray_offset_m(mesh);
  const auto surfaces = stood_on(mesh, sensors, near_offsets * offset);
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    Sensor& sensor = sensors[s];
    sensor.stands_at = sensor.position;
    const Vec3 along_normal = sensor.normal * offset;
    const Vec3 from = surfaces[s].empty()
                          ? Vec3{}
                          : lift(mesh, surfaces[s], sensor, offset).value_or(along_normal);
    sensor.position = sensor.position + (from - along_normal);
  }
}

}  // namespace sunload
