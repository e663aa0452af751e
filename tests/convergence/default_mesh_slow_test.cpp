// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh that a study without `mesh` gets shows the light where people look: on 95 % of the area
/// of walls, and of the ground within 10 m of walls, the light load varies inside of patches by
/// less than a quarter of its mean.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "io/plan/interval_lights.h"
#include "solver/base/rng.h"
#include "solver/base/sampling.h"
#include "solver/base/threads.h"
#include "solver/surface/ray_caster.h"
#include "tests/support/paths.h"
#include "tests/support/real_models.h"
#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

constexpr std::size_t patches_looked_at = 2000, points_per_patch = 48, sky_directions = 64;
constexpr double near_wall_m = 10;
/// Of what surfaces receive that is seen beside the sky: the mean load, sent on by this share.
constexpr double seen_reflectance = 0.2;

/// Every sun of the period and all of its sky, without the mesh pilot.
class TrueLight {
 public:
  explicit TrueLight(const VariantPlan& plan)
      : caster_(plan.built.scene.mesh, plan.isa, screens(plan.built.scene)) {
    const auto suns = suns_of(plan, grid_);
    sky_.assign(static_cast<std::size_t>(grid_.cell_count()), 0);
    for (const auto& sun : suns) {
      if (sun.has_sun() && sun.dni > 0) suns_.push_back({sun.direction, sun.dni * sun.length_s});
      for (std::size_t c = 0; c < sun.sky.size(); ++c) sky_[c] += pi * sun.sky[c] * sun.length_s;
      ground_ += sun.ground_exitance * sun.length_s;
    }
  }

  /// Mean and standard deviation of the light load over points of a patch [J m-2].
  std::pair<double, double> over(const Hierarchy& mesh, std::size_t patch) const {
    const Vec3 n = mesh.normal(patch), a = mesh.corner(patch, 0);
    const Tangents axes = tangents(n);
    const RandomWords seeds = random_words({.seed = 77, .element = mesh.key()[patch]});
    const RandomWords of_directions = random_words({.seed = 78, .element = mesh.key()[patch]});
    double sum = 0, squares = 0;
    for (std::uint32_t p = 0; p < points_per_patch; ++p) {
      const auto at = sample_triangle(scrambled_sobol(p, 0, seeds), scrambled_sobol(p, 1, seeds));
      const Vec3 x = a * at.w0 + mesh.corner(patch, 1) * at.w1 + mesh.corner(patch, 2) * at.w2 +
                     n * caster_.offset_m();
      double H = 0;
      for (const auto& sun : suns_) {
        const double cos_theta = dot(n, sun.direction);
        if (cos_theta > 0 && caster_.first_hit(x, sun.direction).left_scene())
          H += sun.exposure * cos_theta;
      }
      for (std::uint32_t d = 0; d < sky_directions; ++d) {
        const Vec3 local = sample_cosine(scrambled_sobol(d, 0, of_directions),
                                         scrambled_sobol(d, 1, of_directions));
        const Vec3 w = axes.tangent * local.x + axes.bitangent * local.y + n * local.z;
        const bool is_open = caster_.first_hit(x, w).left_scene();
        const double beyond = w.z > 0 ? sky_[static_cast<std::size_t>(grid_.cell(w))] : ground_;
        H += (is_open ? beyond : seen_reflectance * open_load()) / sky_directions;
      }
      sum += H;
      squares += H * H;
    }
    const double mean = sum / points_per_patch;
    return {mean, std::sqrt(std::max(0.0, squares / points_per_patch - mean * mean))};
  }

 private:
  /// What the open plain receives of the suns, as a scale.
  double open_load() const {
    double load = 0;
    for (const auto& sun : suns_) load += sun.exposure * std::max(0.0, sun.direction.z);
    return load / 2;
  }

  SkyGrid grid_;
  RayCaster caster_;
  std::vector<PeriodSun> suns_;
  std::vector<double> sky_;
  double ground_ = 0;
};

double to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0;
  return norm(a + ab * t - p);
}

bool is_wall(const Mesh& mesh, std::size_t t) {
  return mesh.triangle_surface[t] == Surface::wall || mesh.triangle_surface[t] == Surface::window;
}

/// Land: what files call so, and what is level in sheets that have no names for it.
bool is_land(const Mesh& mesh, std::size_t t) {
  return mesh.triangle_surface[t] == Surface::ground ||
         (mesh.triangle_surface[t] == Surface::other && mesh.normal(t, true).z > 0.9);
}

/// By edges of walls: the foot of a wall is one of them.
bool is_near_a_wall(const Mesh& mesh, Vec3 p) {
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (is_wall(mesh, t))
      for (int k = 0; k < 3; ++k)
        if (to_segment(p, mesh.corner(t, k), mesh.corner(t, (k + 1) % 3)) <= near_wall_m)
          return true;
  return false;
}

/// Patches by their area, each as often as its share of the whole.
template <class Take>
std::vector<std::size_t> by_area(const Hierarchy& mesh, const Take& take) {
  std::vector<std::size_t> patches;
  std::vector<double> area;
  double all = 0;
  for (std::size_t i = 0; i < mesh.patch_count(); ++i)
    if (take(i)) {
      patches.push_back(i);
      area.push_back(all += mesh.area()[i]);
    }
  std::vector<std::size_t> chosen;
  if (patches.empty()) return chosen;
  for (std::size_t s = 0; s < patches_looked_at; ++s) {
    const double at = (static_cast<double>(s) + 0.5) / patches_looked_at * all;
    const auto place = std::lower_bound(area.begin(), area.end() - 1, at) - area.begin();
    chosen.push_back(patches[static_cast<std::size_t>(place)]);
  }
  return chosen;
}

struct Variation {
  double of_mean = 0;      ///< 95 % quantile by area, share of the mean of all of them
  double of_own_mean = 0;  ///< the same, each by its own mean
};

Variation variation(const TrueLight& light, const Hierarchy& mesh,
                    const std::vector<std::size_t>& patches) {
  std::vector<double> spread(patches.size()), own(patches.size()), load(patches.size());
  parallel_for(
      patches.size(),
      [&](std::size_t i) {
        const auto [mean, deviation] = light.over(mesh, patches[i]);
        load[i] = mean;
        spread[i] = deviation;
        own[i] = mean > 0 ? deviation / mean : 0;
      },
      8);
  double mean = 0;
  for (const double l : load) mean += l / static_cast<double>(load.size());
  const auto quantile = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() * 95 / 100];
  };
  return {quantile(spread) / mean, quantile(own)};
}

struct Measured {
  Variation walls, ground;
  std::size_t patches = 0;
};

Measured measured(const std::string& scene, const std::string& site,
                  const std::string& mesh_section, const char* date = "2026-06-21") {
  const VariantPlan plan = plan_of(
      "format: sunload-study-1\nname: model\nsite: {" + site + "}\nperiod: {days: [" + date +
      "], step_min: 60}\nlight: {source: clear_sky}\n" + mesh_section + "scene: {" + scene + "}\n");
  Watch watch;
  const VariantMesh made = make_mesh(plan, watch);
  const Hierarchy& mesh = *made.mesh;
  const Mesh& triangles = plan.built.scene.mesh;
  const auto triangle = [&](std::size_t patch) {
    return static_cast<std::size_t>(mesh.patches()[patch].triangle);
  };
  const TrueLight light(plan);
  Measured m;
  m.patches = mesh.patch_count();
  m.walls = variation(
      light, mesh, by_area(mesh, [&](std::size_t i) { return is_wall(triangles, triangle(i)); }));
  // Open land is most of many scenes: nearness by plan boxes first would be the mesh's own way.
  std::vector<std::uint8_t> is_near(mesh.patch_count(), 0);
  parallel_for(
      mesh.patch_count(),
      [&](std::size_t i) {
        is_near[i] = is_land(triangles, triangle(i)) && is_near_a_wall(triangles, mesh.centroid(i));
      },
      64);
  m.ground = variation(light, mesh, by_area(mesh, [&](std::size_t i) { return is_near[i] != 0; }));
  std::cout << "  " << m.patches << " patches from " << made.report.patches_before
            << "; 95 % of walls within " << 100 * m.walls.of_mean << " % of their mean ("
            << 100 * m.walls.of_own_mean << " % of each patch's own), of ground near walls "
            << 100 * m.ground.of_mean << " % (" << 100 * m.ground.of_own_mean << " %)\n";
  return m;
}

struct Model {
  const char* name;
  std::string scene, site;
};

std::vector<Model> models() {
  const std::string data = shared_folder() + "/data/";
  const std::string dutch = "latitude_deg: 52, longitude_deg: 4.4, timezone: Europe/Amsterdam";
  return {
      {"3DBAG tile, CityJSONSeq",
       "files: [" + data + "city/3dbag_tile_5870_v11.city.jsonl], lod: highest",
       "timezone: Europe/Amsterdam"},
      {"100 buildings, CityJSON",
       "files: [" + data + "city/lod2_100_buildings_v11_epsg3068.city.json]",
       "timezone: Europe/Berlin"},
      {"sixteen houses of Rotterdam, CityJSON",
       "files: [" + data + "city/rotterdam_subset_v20.city.json]", dutch},
      {"Euromast, CityJSON", "files: [" + data + "city/euromast_v10.city.json]",
       "timezone: Europe/Amsterdam"},
      {"castle, VRML",
       "files: [" + data +
           "vrml/castle/castle/old/vrml_2/castle.wrl], ground: {margin_m: 50}, "
           "vrml_excess: scale",
       dutch},
      {"three storeys, glTF",
       "files: [" + data + "meshes/trimesh_no_indices_3storybuilding.glb], ground: {margin_m: 50}",
       dutch},
      {"built-in street", "builtin: {name: street}", dutch},
      {"box on a sheet, OBJ", "files: [" + data + "city/dtcc_box_sharp_f26.obj]", dutch},
  };
}

TEST(DefaultMesh, ShowsTheLightOnWallsAndAboutThemInEveryModel) {
  SUNLOAD_NEEDS_MODEL("data");
  for (const Model& model : models()) {
    std::cout << model.name << "\n";
    const Measured m = measured(model.scene, model.site, "");
    EXPECT_LT(m.walls.of_mean, 0.25) << model.name;
    EXPECT_LT(m.ground.of_mean, 0.25) << model.name;
  }
}

/// The measure is one: without refinement it refuses.
TEST(DefaultMesh, IsMeasuredByWhatRefusesAMeshWithoutRefinement) {
  SUNLOAD_NEEDS_MODEL("data");
  const Model model = models()[1];
  const Measured m = measured(model.scene, model.site, "mesh: {oracle: none}\n");
  EXPECT_GT(m.walls.of_mean, 0.25);
  EXPECT_GT(m.ground.of_mean, 0.25);
}

}  // namespace
}  // namespace sunload::test
