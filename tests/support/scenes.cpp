// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"

#include <array>
#include <map>

namespace sunload::test {

int SceneBuilder::material(const Material& material) {
  scene_.materials.push_back(material);
  return static_cast<int>(scene_.materials.size()) - 1;
}

SceneBuilder& SceneBuilder::object(const std::string& name) {
  object_ = make_id<ObjectId>(scene_.mesh.object_names.size());
  scene_.mesh.object_names.push_back(name);
  scene_.mesh.object_kinds.emplace_back();
  return *this;
}

SceneBuilder& SceneBuilder::sides(Sides sides) {
  sides_ = sides;
  return *this;
}

SceneBuilder& SceneBuilder::triangle(Vec3 a, Vec3 b, Vec3 c, int material) {
  Mesh& mesh = scene_.mesh;
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Vec3 p : {a, b, c}) mesh.vertices.push_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangle_object.push_back(object_);
  mesh.triangle_material.push_back(MaterialId::none());
  mesh.triangle_facade.push_back(FacadeId::none());
  mesh.triangle_surface.push_back(Surface::other);
  mesh.triangle_sides.push_back(sides_);
  scene_.material.push_back({material});
  return *this;
}

SceneBuilder& SceneBuilder::quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, int material) {
  return triangle(a, b, c, material).triangle(a, c, d, material);
}

SceneBuilder& SceneBuilder::box(Vec3 l, Vec3 h, int material, Facing facing) {
  const std::array<Vec3, 8> p{Vec3{l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z},
                              {l.x, h.y, l.z},     {l.x, l.y, h.z}, {h.x, l.y, h.z},
                              {h.x, h.y, h.z},     {l.x, h.y, h.z}};
  constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {3, 0, 4, 7}}};
  for (const auto& f : faces) {
    if (facing == Facing::outward) quad(p[f[0]], p[f[1]], p[f[2]], p[f[3]], material);
    if (facing == Facing::inward) quad(p[f[3]], p[f[2]], p[f[1]], p[f[0]], material);
  }
  return *this;
}

Scene inward_sphere(int subdivisions, std::vector<Material> materials,
                    const std::function<int(Vec3)>& material_of) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> v{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<int, 3>> faces{
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  const auto at = [&](int i) { return normalized(v[static_cast<std::size_t>(i)]); };
  for (int s = 0; s < subdivisions; ++s) {
    std::vector<std::array<int, 3>> finer;
    for (const auto& f : faces) {
      const int base = static_cast<int>(v.size());
      for (const auto& [i, j] : {std::pair{f[0], f[1]}, {f[1], f[2]}, {f[2], f[0]}})
        v.push_back(normalized(at(i) + at(j)));
      finer.push_back({f[0], base, base + 2});
      finer.push_back({base, f[1], base + 1});
      finer.push_back({base + 2, base + 1, f[2]});
      finer.push_back({base, base + 1, base + 2});
    }
    faces = finer;
  }
  SceneBuilder builder;
  for (const auto& m : materials) builder.material(m);
  for (const auto& f : faces) {
    const Vec3 a = at(f[0]), b = at(f[1]), c = at(f[2]);
    builder.triangle(a, c, b, material_of((a + b + c) / 3));
  }
  return builder.scene();
}

void add_parallel_source(Scene& scene, Vec3 p, Vec3 x, Vec3 y, double exitance) {
  Mesh& mesh = scene.parallel_sources.mesh;
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Vec3 corner : {p, p + x, p + x + y, p + y}) mesh.vertices.push_back(corner);
  for (const std::array<std::int32_t, 3> t : {std::array{0, 1, 2}, {0, 2, 3}}) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    scene.parallel_sources.exitance.push_back(exitance);
  }
}

Sensor sensor_at(Vec3 position, Vec3 normal) {
  return {position, normalized(normal), key_of_place(position, normal)};
}

IntervalLight one_second(Vec3 sun_direction, double dni) {
  IntervalLight light;
  light.direction = normalized(sun_direction);
  light.dni = dni;
  light.length_s = 1;
  light.sunlit_s = light.direction.z > 0 ? 1 : 0;
  return light;
}

IntervalLight with_uniform_sky(IntervalLight light, double dhi, const SkyGrid& grid) {
  light.dhi = dhi;
  light.sky.assign(static_cast<std::size_t>(grid.cell_count()), dhi / pi);
  return light;
}

std::vector<IntervalLight> three_suns() {
  std::vector<IntervalLight> light;
  for (const Vec3 w : {Vec3{0.5, -0.7, 0.4}, Vec3{0, -0.6, 0.8}, Vec3{-0.8, -0.3, 0.3}}) {
    auto sun = with_uniform_sky(one_second(w, 700), 90);
    sun.ground_exitance = 0.2 * (700 * sun.direction.z + 90);
    light.push_back(sun);
  }
  return light;
}

std::vector<IntervalLight> numbered_suns() {
  auto light = three_suns();
  for (std::size_t k = 0; k < light.size(); ++k) light[k].number = static_cast<std::uint32_t>(k);
  return light;
}

Scene lamp_room(Change change) {
  SceneBuilder builder;
  const int wall = builder.material({"wall", change(0.6), 0, 0});
  builder.object("room").box({0, 0, 0}, {4, 3, 2.5}, wall, SceneBuilder::Facing::inward);
  builder.object("lamp").quad({1, 1, 2.4}, {1, 2, 2.4}, {2, 2, 2.4}, {2, 1, 2.4},
                              builder.material({"lamp", change(0.4), 0, 50}));
  builder.sides(Sides::two).object("screen").quad({3, 0, 0}, {3, 3, 0}, {3, 3, 2}, {3, 0, 2}, wall);
  return builder.scene();
}

std::vector<double> Solved::means(const std::function<bool(std::size_t)>& chosen) const {
  std::vector<double> means;
  for (const auto& exposure : tally.exposure_realization) {
    double power = 0, total = 0;
    for (std::size_t i = 0; i < area.size(); ++i)
      if (chosen(i)) {
        power += area[i] * exposure[i];
        total += area[i];
      }
    means.push_back(power / total);
  }
  return means;
}

std::vector<double> Solved::of_patch(std::size_t patch) const {
  return means([&](std::size_t i) { return i == patch; });
}

std::vector<double> of_sensor(const BatchTally& tally, std::size_t sensor) {
  std::vector<double> values;
  for (const auto& row : tally.sensors.exposure_realization) values.push_back(row[sensor]);
  return values;
}

std::vector<double> Solved::ledger(const std::function<double(const Ledger&)>& quantity) const {
  std::vector<double> values;
  for (const auto& ledger : tally.ledger_realization) values.push_back(quantity(ledger));
  return values;
}

SolverRules test_rules() {
  SolverRules rules;
  rules.realizations = 16;
  rules.lines_per_patch = 16 * 64;
  rules.direct_samples = 64;
  rules.unshot = 0;
  rules.unfollowed = Unfollowed::leave;  // tests say how many bounces there are
  return rules;
}

namespace {

std::vector<Solved> solved_bands(const Scene& scene, const std::vector<IntervalLight>& light,
                                 const SolverRules& rules, const SplitRules& split) {
  Watch watch;
  const auto traced = trace_scene(scene, split, rules, watch);
  const auto transport = transport_of(*traced);
  sunload::Solved batch = sunload::solve(*transport, light, watch);
  WorkDone work = traced->work;
  work += transport->work();
  work += batch.work;
  std::vector<Solved> bands;
  for (auto& tally : batch.bands) {
    Solved solved;
    solved.area = traced->hierarchy().area();
    solved.patches = traced->hierarchy().patches();
    for (std::size_t i = 0; i < solved.patches.size(); ++i)
      solved.corners.push_back({traced->hierarchy().corner(i, 0), traced->hierarchy().corner(i, 1),
                                traced->hierarchy().corner(i, 2)});
    solved.tally = std::move(tally);
    solved.sky_view = sky_view_factors(traced->patches.lines.pooled);
    solved.sky_view_se = sky_view_errors(traced->patches.lines);
    solved.bounces = traced->bounces;
    solved.work = work;
    bands.push_back(std::move(solved));
  }
  return bands;
}

}  // namespace

Solved solve(const Scene& scene, const std::vector<IntervalLight>& light, const SolverRules& rules,
             const SplitRules& split) {
  return solved_bands(scene, light, rules, split).front();
}

std::vector<Solved> solve_bands(const Scene& scene, const std::vector<IntervalLight>& light,
                                SolverRules rules, const SplitRules& split) {
  rules.bands = Bands::rgb;
  return solved_bands(scene, light, rules, split);
}

IntervalLight in_bands(IntervalLight light, BandShares sun, BandShares sky) {
  light.bands.clear();
  for (std::size_t b = 0; b < band_count; ++b) {
    light.bands.push_back({light.dni * sun[b], light.ground_exitance * sky[b], light.sky});
    for (auto& radiance : light.bands[b].sky) radiance *= sky[b];
  }
  return light;
}

}  // namespace sunload::test
