// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small scenes made of triangles, and one solve of them.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "solver/solver.h"

namespace sunload::test {

/// Builds a scene triangle by triangle; every call of `object` begins a new one.
class SceneBuilder {
 public:
  SceneBuilder() { object("object"); }
  int material(const Material& material);
  SceneBuilder& object(const std::string& name);
  SceneBuilder& triangle(Vec3 a, Vec3 b, Vec3 c, int material);
  /// Counter-clockwise seen from the front.
  SceneBuilder& quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, int material);
  /// Axis-aligned box; fronts outward, or inward (a room).
  enum class Facing { outward, inward };
  SceneBuilder& box(Vec3 low, Vec3 high, int material, Facing facing);
  /// The next triangles are two-sided.
  SceneBuilder& sides(Sides sides);
  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
  ObjectId object_;
  Sides sides_ = Sides::one;
};

/// A faceted sphere (subdivided icosahedron) with fronts inward; `material_of`
/// chooses by the facet's centre.
Scene inward_sphere(int subdivisions, std::vector<Material> materials,
                    const std::function<int(Vec3)>& material_of);

/// Adds a parallel source: from the corner p with edges x and y; light leaves along x × y.
void add_parallel_source(Scene& scene, Vec3 p, Vec3 x, Vec3 y, double exitance);
/// `normal` of any length.
Sensor sensor_at(Vec3 position, Vec3 normal);

/// One second of light, so that exposures are irradiances.
IntervalLight one_second(Vec3 sun_direction, double dni);
/// Adds a uniform sky of that horizontal irradiance.
IntervalLight with_uniform_sky(IntervalLight light, double dhi, const SkyGrid& grid = SkyGrid());

/// Suns of different heights, each under a uniform sky and over a far ground of albedo 0.2.
std::vector<IntervalLight> three_suns();
/// The same, each with random numbers of its own.
std::vector<IntervalLight> numbered_suns();

/// What a test may do to reflectances on purpose.
using Change = double (*)(double);
inline double as_it_is(double rho) { return rho; }
inline double squared(double rho) { return rho * rho; }

/// A closed room with a lamp below its ceiling and a screen.
Scene lamp_room(Change change);
/// Neither sun nor sky.
inline const IntervalLight night = one_second({0, 0, -1}, 0);

struct Solved {
  std::vector<double> area;
  std::vector<Patch> patches;
  std::vector<std::array<Vec3, 3>> corners;  ///< of patches
  BatchTally tally;
  std::vector<double> sky_view, sky_view_se;
  int bounces = 0;
  WorkDone work;
  /// Area-weighted mean irradiance over the chosen patches, per realization.
  std::vector<double> means(const std::function<bool(std::size_t)>& chosen) const;
  std::vector<double> of_patch(std::size_t patch) const;
  /// A ledger quantity per realization.
  std::vector<double> ledger(const std::function<double(const Ledger&)>& quantity) const;
};

/// Irradiance of a sensor per realization.
std::vector<double> of_sensor(const BatchTally& tally, std::size_t sensor);

/// Chooses all patches.
inline bool everywhere(std::size_t /*patch*/) { return true; }

/// Solves one batch; the defaults suit tests: 16 realizations, errors of totals.
SolverRules test_rules();
Solved solve(const Scene& scene, const std::vector<IntervalLight>& light, const SolverRules& rules,
             const SplitRules& split = {});
/// The same in red, green and blue; every sun has its light in bands.
std::vector<Solved> solve_bands(const Scene& scene, const std::vector<IntervalLight>& light,
                                SolverRules rules, const SplitRules& split = {});
/// The same light in every band, but for the sun's and the sky's colour (of mean 1).
IntervalLight in_bands(IntervalLight light, BandShares sun = {1, 1, 1}, BandShares sky = {1, 1, 1});

}  // namespace sunload::test
