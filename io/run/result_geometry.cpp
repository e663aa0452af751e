// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/result_geometry.h"

#include "geo/base/units.h"
#include "io/plan/seasons_of_plan.h"
#include "io/plan/selection.h"
#include "io/plan/variant_mesh.h"

namespace sunload {

ResultGeometry result_geometry(const VariantPlan& plan, const Hierarchy& hierarchy) {
  const Scene& scene = plan.built.scene;
  const Mesh& mesh = scene.mesh;
  ResultGeometry g;
  g.vertices = hierarchy.vertices();
  for (std::size_t i = 0; i < hierarchy.patch_count(); ++i) {
    const Patch& patch = hierarchy.patches()[i];
    const auto t = static_cast<std::size_t>(patch.triangle);
    g.patch_vertices.push_back(patch.vertices);
    g.patch_area.push_back(hierarchy.area()[i]);
    g.patch_centroid.push_back(hierarchy.centroid(i));
    g.patch_normal.push_back(hierarchy.normal(i));
    g.patch_object.push_back(mesh.triangle_object[t].value);
    g.patch_facade.push_back(patch.side == 0 ? mesh.triangle_facade[t].value : -1);
    g.patch_material.push_back(scene.material[t].value);
    g.patch_input_triangle.push_back(patch.triangle);
    g.patch_surface.push_back(static_cast<std::uint8_t>(mesh.triangle_surface[t]));
    g.patch_side.push_back(patch.side);
  }
  g.input_triangle_vertices = mesh.triangles;
  g.object_name = mesh.object_names;
  for (const auto& m : scene.materials) g.material_name.push_back(m.name);
  for (const auto& f : mesh.facades) {
    g.facade_name.push_back(f.name);
    g.facade_area.push_back(f.area_m2);
    g.facade_azimuth_deg.push_back(wrapped_deg(f.azimuth_deg + plan.built.site.north_deg));
  }
  for (const auto& selection : plan.study.selections) {
    g.selection_name.push_back(selection.name);
    g.selected.push_back(selected_patches(selection, plan.built, hierarchy));
    double& area = g.selection_area.emplace_back(0);
    for (std::size_t i = 0; i < g.patch_area.size(); ++i)
      area += g.selected.back()[i] != 0 ? g.patch_area[i] : 0;
  }
  for (const auto& sensor : scene.sensors) {
    g.sensor_position.push_back(sensor.stands_at);
    g.sensor_normal.push_back(sensor.normal);
  }
  g.origin = mesh.origin;
  return g;
}

namespace {

/// Of a triangle, in every season of the period.
std::vector<const Material*> materials_of(const VariantPlan& plan, std::size_t triangle) {
  const auto seasons = materials_by_season(plan);
  std::vector<const Material*> materials;
  materials.reserve(seasons.size());
  for (const MaterialsOfScene& season : seasons) materials.push_back(&season.of(triangle));
  return materials;
}

const Material& material_of(const VariantPlan& plan, const Patch& patch) {
  return *materials_of(plan, static_cast<std::size_t>(patch.triangle)).front();
}

}  // namespace

bool sends_alike_in_all_seasons(const VariantPlan& plan) {
  for (std::size_t t = 0; t < plan.built.scene.mesh.triangles.size(); ++t) {
    const auto materials = materials_of(plan, t);
    for (const Material* material : materials)
      if (material->diffuse != materials.front()->diffuse ||
          material->diffuse_in_band != materials.front()->diffuse_in_band ||
          material->emission_w_m2 != materials.front()->emission_w_m2)
        return false;
  }
  return true;
}

std::vector<double> diffuse_reflectances(const VariantPlan& plan, const Hierarchy& hierarchy,
                                         std::optional<std::size_t> band) {
  std::vector<double> reflectance;
  for (const Patch& patch : hierarchy.patches()) {
    const Material& material = material_of(plan, patch);
    reflectance.push_back(band ? diffuse_in(material, *band) : material.diffuse);
  }
  return reflectance;
}

std::vector<double> emitted_exitances(const VariantPlan& plan, const Hierarchy& hierarchy) {
  std::vector<double> exitance;
  for (const Patch& patch : hierarchy.patches())
    exitance.push_back(material_of(plan, patch).emission_w_m2);
  return exitance;
}

namespace {

/// Means over some intervals; of one its own values.
class MeanLight {
 public:
  void add(const Irradiance& of, double length_s) {
    only_ = of;
    ++count_;
    sum_.dni += of.dni * length_s;
    sum_.dhi += of.dhi * length_s;
    sum_.ghi += of.ghi * length_s;
    length_s_ += length_s;
  }
  void put_into(std::vector<double>& dni, std::vector<double>& dhi,
                std::vector<double>& ghi) const {
    const bool is_one = count_ == 1;
    dni.push_back(is_one ? only_.dni : sum_.dni / length_s_);
    dhi.push_back(is_one ? only_.dhi : sum_.dhi / length_s_);
    ghi.push_back(is_one ? only_.ghi : sum_.ghi / length_s_);
  }

 private:
  Irradiance sum_{}, only_{};
  int count_ = 0;
  double length_s_ = 0;
};

/// Every interval as a step of its own.
std::vector<SeriesStep> intervals_as_steps(const VariantPlan& plan) {
  std::vector<SeriesStep> steps;
  for (std::size_t k = 0; k < plan.intervals(); ++k) {
    const SunInterval& when = plan.light.intervals[k].when;
    steps.push_back({{when.begin, when.end}, k, 1, k});
  }
  return steps;
}

}  // namespace

ResultTimes result_times(const VariantPlan& plan) {
  const Quantity quantity = plan.study.light.quantity;
  ResultTimes times;
  const auto of_intervals = study_seasons(plan.study, plan.light);
  bool are_whole = !of_intervals.empty();  // a step in several has none that is its own
  for (const SeriesStep& step : plan.steps.empty() ? intervals_as_steps(plan) : plan.steps) {
    const SunInterval& sun = plan.light.intervals[step.sun].when;
    times.time.push_back(sun.sun_time);
    times.bounds.push_back(step.bounds);
    times.sun_azimuth_deg.push_back(sun.sun.azimuth_deg);
    times.sun_elevation_deg.push_back(sun.sun.elevation_deg);
    times.sun_direction.push_back(sun.direction);
    MeanLight mean, lux;
    for (std::size_t k = step.first; k < step.end(); ++k) {
      const LitInterval& interval = plan.light.intervals[k];
      mean.add(interval.mean, interval.when.length_s());
      if (quantity == Quantity::illuminance)
        lux.add(source_means(interval, quantity), interval.when.length_s());
    }
    if (!of_intervals.empty()) {
      times.study_seasons.push_back(of_intervals[step.first]);
      for (std::size_t k = step.first; k < step.end(); ++k)
        are_whole = are_whole && of_intervals[k] == of_intervals[step.first];
    }
    mean.put_into(times.dni, times.dhi, times.ghi);
    if (quantity == Quantity::illuminance)
      lux.put_into(times.direct_illuminance, times.diffuse_illuminance, times.global_illuminance);
  }
  if (!are_whole)
    times.study_seasons.clear();
  else
    for (const SeasonStudy& season : plan.study.seasons) times.season_names.push_back(season.name);
  return times;
}

}  // namespace sunload
