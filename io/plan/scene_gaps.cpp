// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/scene_gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "geo/base/check.h"
#include "geo/mesh/ground.h"
#include "geo/mesh/plan_triangles.h"
#include "io/base/first_of_many.h"

namespace sunload {
namespace {

/// The first of those above the ground by more than `floating_m`, of `count` in all.
std::string names_of(const std::vector<FootGap>& gaps, std::size_t count) {
  constexpr std::size_t most = 10;
  FirstOfMany names(most);
  for (const FootGap& gap : gaps)
    if (gap.gap_m > floating_m) names.add(fmt::format("{} by {:.2f} m", gap.object, gap.gap_m));
  names.add_unnamed(count - names.count());
  return names.text();
}

void warn_of_gaps_to(const GroundReport& ground, const Study& study, BuiltScene& built) {
  if (ground.floating > 0)
    built.warnings.push_back(message(
        study.scene.where,
        fmt::format("{} of {} bodies stand more than {} m above the ground ({})", ground.floating,
                    ground.standing, floating_m, names_of(ground.worst, ground.floating)),
        "sun and sky pass below their walls",
        ground.surface == GroundSurface::level
            ? "scene.ground: {surface: feet} goes through the feet"
            : "the terrain of the model lies there"));
  if (!ground.drawn_far.empty())
    built.warnings.push_back(message(
        study.scene.where,
        fmt::format("walls of {} bodies are drawn down to the terrain by more than {} m ({})",
                    ground.drawn_far.size(), floating_m,
                    names_of(ground.drawn_far, ground.drawn_far.size())),
        "right for houses; under a bridge or a sign no light passes",
        "scene.ground: none leaves walls as they are"));
}

/// Of a place above the land beneath it [m]; below 0 where all land there is higher; nothing where
/// there is none.
std::optional<double> height_above(const PlanTriangles& land, Vec3 place) {
  constexpr double touching_m = 1e-3;
  std::optional<double> below, above;
  land.visit_heights(place.x, place.y, [&](std::size_t, double z) {
    const double height = place.z - z;
    std::optional<double>& nearest = height >= -touching_m ? below : above;
    if (!nearest || std::abs(height) < std::abs(*nearest)) nearest = height;
  });
  return below ? below : above;
}

/// Least and largest gap below a foot.
struct GapRange {
  double least_m = infinity, most_m = -infinity;
};

GapRange gaps_below(const Foot& foot, const PlanTriangles& land) {
  GapRange range;
  for (const auto& [from, to] : foot.edges)
    for (const Vec3 place : {from, (from + to) / 2, to})
      if (const auto gap = height_above(land, place)) {
        range.least_m = std::min(range.least_m, *gap);
        range.most_m = std::max(range.most_m, *gap);
      }
  return range;
}

/// The largest gap first, of objects of several bodies each.
std::vector<FootGap> gaps_to_land(const BuiltScene& built, SceneKind kind) {
  const Mesh& mesh = built.scene.mesh;
  std::vector<FootGap> gaps;
  const PlanTriangles land(mesh, land_triangles(mesh));
  if (land.empty()) return gaps;
  for (const Foot& foot : find_feet(mesh, built.bodies, kind)) {
    const std::string& name = mesh.object_names[foot.object.index()];
    const Box& box = built.bodies.bodies[static_cast<std::size_t>(foot.body)].box;
    const bool is_put_there =
        built.placed.contains(name) && box.high.z - box.low.z >= highest_step_m;
    const bool may_stand = foot.stance == Stance::ground ||
                           (foot.stance == Stance::hovering && is_put_there);  // no balconies
    if (!may_stand) continue;
    const auto [least_m, most_m] = gaps_below(foot, land);
    if (most_m > floating_m && (least_m <= highest_step_m || is_put_there))
      gaps.push_back({name, most_m});
  }
  std::stable_sort(gaps.begin(), gaps.end(),
                   [](const FootGap& a, const FootGap& b) { return a.gap_m > b.gap_m; });
  return gaps;
}

}  // namespace

void warn_of_gaps(const Study& study, SceneKind kind, BuiltScene& built) {
  if (built.report.ground) return warn_of_gaps_to(*built.report.ground, study, built);
  if (study.scene.ground) return;
  const auto gaps = gaps_to_land(built, kind);
  if (gaps.empty()) return;
  built.warnings.push_back(
      message(study.scene.where,
              fmt::format("{} bodies stand more than {} m above the land of the model ({})",
                          gaps.size(), floating_m, names_of(gaps, gaps.size())),
              "sun and sky pass below their walls",
              "scene.ground: {surface: feet, margin_m: 0} draws the walls down to the land; "
              "scene.ground: none says that they are meant so"));
}

}  // namespace sunload
