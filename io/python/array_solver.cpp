// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/python/array_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <utility>

#include "geo/base/check.h"
#include "geo/mesh/mesh_prepare.h"
#include "solver/base/threads.h"
#include "solver/base/watch.h"
#include "solver/light/lit_period.h"
#include "solver/light/sun_block.h"
#include "solver/solver.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

namespace {

constexpr const char* object_name = "mesh";  // random numbers are addressed by it

/// Threads and cancellation are the process's: one solution at a time has them.
class Alone {
 public:
  Alone(int threads, std::function<bool()> is_stopped) {
    constexpr std::chrono::milliseconds patience{50};
    while (!lock_.try_lock_for(patience))
      if (is_stopped()) throw Interrupted("stopped on request");
    threads_before_ = chosen_thread_count();
    if (threads > 0) set_thread_count(threads);
    set_cancellation(std::move(is_stopped));
  }
  ~Alone() {
    set_cancellation({});
    set_thread_count(threads_before_);
  }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

 private:
  inline static std::timed_mutex only_one_;
  std::unique_lock<std::timed_mutex> lock_{only_one_, std::defer_lock};
  int threads_before_ = 0;
};

PolygonModel model_of(const ArrayScene& scene) {
  SUNLOAD_EXPECT(scene.material.size() == scene.triangles.size(), "one material per triangle");
  SUNLOAD_EXPECT(scene.sides.size() == scene.materials.size(), "sides of every material");
  const auto lies_in = [](std::int32_t index, std::size_t size) {
    return index >= 0 && static_cast<std::size_t>(index) < size;
  };
  PolygonModel model;
  model.source = "vertices and triangles";
  model.object_names = {object_name};
  model.object_kinds = {""};
  model.vertices = scene.vertices;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& corners = scene.triangles[t];
    for (const auto v : corners)
      SUNLOAD_EXPECT(lies_in(v, scene.vertices.size()), "vertex of a triangle");
    SUNLOAD_EXPECT(lies_in(scene.material[t], scene.materials.size()), "material of a triangle");
    // Not a floor, whatever its slope: floors would have no patches.
    model.add_triangle(corners[0], corners[1], corners[2],
                       {.object = ObjectId{0},
                        .surface = Surface::wall,
                        .sides = scene.sides[static_cast<std::size_t>(scene.material[t])]});
  }
  return model;
}

Scene scene_of(const ArrayScene& arrays) {
  Scene scene{.mesh = prepare(model_of(arrays), {.repair = Repair::none,
                                                 .ground = {},
                                                 .orientation = Orientation::keep,
                                                 .north_deg = 0})
                          .mesh,
              .materials = arrays.materials,
              .material = {}};
  SUNLOAD_EXPECT(scene.mesh.triangle_count() == arrays.triangles.size(),
                 "every triangle is kept as it is");
  for (const auto material : arrays.material) scene.material.push_back(MaterialId{material});
  expect_valid(scene);
  return scene;
}

/// The suns as intervals of a period.
class ArrayPeriod : public LitPeriod {
 public:
  ArrayPeriod(const ArrayLight& light, const SkyGrid& grid) : light_(light), grid_(grid) {
    if (light.subdivision) patches_.emplace(*light.subdivision, grid);
    const std::size_t expected = light.radiance.empty() ? 0 : light.suns.size() * sky_size();
    SUNLOAD_EXPECT(light.radiance.size() == expected, "radiances of every sky");
  }

  std::size_t intervals() const override { return light_.suns.size(); }
  bool is_dark(std::size_t k) const override { return !has_sun(k) && dhi(k) <= 0; }
  bool has_sun(std::size_t k) const override { return light_.suns[k].direction.z > 0; }
  Vec3 direction(std::size_t k) const override { return light_.suns[k].direction; }
  IntervalLight of(std::size_t k) const override;

 private:
  std::size_t sky_size() const {
    return patches_ ? patches_->patch_count() : static_cast<std::size_t>(grid_.cell_count());
  }
  std::span<const double> radiance(std::size_t k) const {
    return std::span(light_.radiance).subspan(k * sky_size(), sky_size());
  }
  double dhi(std::size_t k) const;
  std::vector<double> cells(std::size_t k) const;

  const ArrayLight& light_;
  const SkyGrid& grid_;
  std::optional<PatchSkies> patches_;
};

double ArrayPeriod::dhi(std::size_t k) const {
  if (light_.radiance.empty()) return light_.suns[k].dhi;
  if (patches_) return patches_->horizontal_irradiance(radiance(k));
  double sum = 0;
  for (std::size_t cell = 0; cell < sky_size(); ++cell)
    sum += radiance(k)[cell] * grid_.projected()[cell];
  return sum;
}

std::vector<double> ArrayPeriod::cells(std::size_t k) const {
  if (!light_.radiance.empty()) {
    const auto given = radiance(k);
    return patches_ ? patches_->on_grid(given) : std::vector(given.begin(), given.end());
  }
  const ArrayLight::Sun& sun = light_.suns[k];
  SkyInput sky = light_.sky;
  sky.dhi = sun.dhi;
  sky.dni = has_sun(k) ? sun.dni : 0;
  sky.sun_zenith_deg = std::clamp(90 - sun.elevation_deg, 0.0, 90.0);
  sky.sun_direction = sun.direction;
  return grid_.mean_radiance(relative_sky(sky), sun.dhi);
}

IntervalLight ArrayPeriod::of(std::size_t k) const {
  const ArrayLight::Sun& sun = light_.suns[k];
  IntervalLight light;
  light.number = static_cast<std::uint32_t>(k);
  light.direction = sun.direction;
  light.dni = has_sun(k) ? sun.dni : 0;
  light.dhi = dhi(k);
  const double ghi = light.dni * std::max(0.0, sun.direction.z) + light.dhi;
  light.ground_exitance = light_.far_ground_albedo * ghi;
  light.length_s = sun.hours * seconds_per_hour;
  light.sunlit_s = has_sun(k) ? light.length_s : 0;
  if (light.dhi > 0) light.sky = cells(k);
  return light;
}

const std::vector<std::vector<double>>& realizations_of(const BatchTally& tally, std::size_t part) {
  return static_cast<Part>(part) == Part::total ? tally.exposure_realization
                                                : tally.part_realization[part];
}

/// What the tally of all suns tells, in the units of results.
ArrayResult result_of(BatchTally tally) {
  ArrayResult result;
  for (std::size_t p = 0; p < part_count; ++p) {
    result.irradiance[p] = std::move(tally.irradiance[p]);
    for (const double joules : tally.exposure[p])
      result.light_load.mean[p].push_back(joules * (1 / joules_per_kwh));
    if (realizations_of(tally, p).empty()) continue;
    std::vector<double>& errors = result.light_load.standard_error[p];
    std::vector<double> values;
    for (std::size_t i = 0; i < tally.exposure[p].size(); ++i) {
      values.clear();
      for (const auto& row : realizations_of(tally, p))
        values.push_back(row[i] * (1 / joules_per_kwh));
      errors.push_back(mean_error(values).standard_error);
    }
  }
  result.irradiance_se = std::move(tally.irradiance_se);
  for (const double seconds : tally.sunlit_s)
    result.sun_hours.push_back(seconds * (1 / seconds_per_hour));
  return result;
}

}  // namespace

ArrayResult solve_arrays(const ArrayScene& arrays, const ArrayLight& light, const ArrayRules& rules,
                         std::function<bool()> is_stopped) {
  const Alone alone(rules.threads, std::move(is_stopped));
  const Scene scene = scene_of(arrays);
  const SplitRules split{.max_edge_m = rules.max_edge_m};
  Watch watch;
  const auto traced = trace_scene(scene, split, rules.solver, watch);
  const ArrayPeriod period(light, traced->grid);
  const auto transport = transport_of(*traced, period, watch);
  const auto batch_suns = static_cast<std::size_t>(batch_suns_for(period.intervals()));
  BatchTally all = empty_tally(tally_shape(*traced, period.intervals()));
  for (std::size_t first = 0; first < period.intervals(); first += batch_suns) {
    std::vector<IntervalLight> batch(std::min(batch_suns, period.intervals() - first));
    parallel_for(batch.size(), [&](std::size_t k) { batch[k] = period.of(first + k); });
    BatchTally tally = std::move(solve(*transport, batch, watch).bands.front());
    round_realizations(tally);
    put_stretch(tally, first, all);
  }
  ArrayResult result = result_of(std::move(all));
  result.mesh = traced->mesh;
  result.origin = scene.mesh.origin;
  if (transport->reduction()) result.reduction = *transport->reduction();
  return result;
}

}  // namespace sunload
