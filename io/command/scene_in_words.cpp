// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/scene_in_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geo/mesh/intersections.h"
#include "geo/mesh/surface_kind.h"
#include "io/base/first_of_many.h"

namespace sunload {
namespace {

std::string counts_text(const PrepareReport& r) {
  std::string text = fmt::format(
      "  read      {} polygons ({} with holes), {} vertices\n"
      "  repaired  {} vertices welded, {} triangles turned, {} fronts with a back made two-sided, "
      "{} T-joints split\n"
      "  dropped   {} degenerate, {} duplicate, {} polygons not triangulable\n"
      "  doubtful  {} polygons not planar, {} crossing themselves, {} bodies without consistent "
      "fronts\n"
      "  bodies    {} closed ({:.6g} m3), {} with their fronts inward, {} open sheets; {} open "
      "edges, {} non-manifold edges\n"
      "  floors    {} triangles touch the ground: they cast shadows, are no patches\n"
      "  shape     the thinnest triangle is {:.4g} times as long as high\n",
      r.polygons_read, r.polygons_with_holes, r.vertices_read, r.vertices_welded,
      r.triangles_flipped, r.sheets_merged, r.t_joints_split, r.degenerates_dropped,
      r.duplicates_dropped, r.polygons_untriangulated, r.polygons_nonplanar, r.polygons_crossing,
      r.unorientable, r.closed_bodies, r.volume_m3, r.inside_out_bodies, r.open_sheets,
      r.open_edges, r.nonmanifold_edges, r.floors, r.worst_aspect);
  if (r.bodies_parted > 0)
    text +=
        fmt::format("  parted    {} bodies from others of one object that share faces with them\n",
                    r.bodies_parted);
  text += "  area     ";
  for (std::size_t s = 0; s < surface_names.size(); ++s)
    if (r.area_m2[s] > 0) text += fmt::format(" {} {:.6g} m2", surface_names[s], r.area_m2[s]);
  text += "\n";
  std::string covered;
  for (std::size_t s = 0; s < surface_names.size(); ++s)
    if (r.covered_m2[s] > 0)
      covered += fmt::format(" {} {:.6g} m2", surface_names[s], r.covered_m2[s]);
  if (!covered.empty())
    text += "  covered  " + covered +
            ": inside of bodies, against other surfaces or below land; no patches\n";
  if (r.dark_backs_m2 > 0)
    text += fmt::format(
        "  backs     {:.6g} m2 of faces with two sides look into houses: they are no patches\n",
        r.dark_backs_m2);
  return text;
}

/// "+0.12", "-0.30", and 0.00 without a sign.
std::string signed_text(double metres) {
  const double cm = std::round(metres * 100);
  return cm == 0 ? "0.00" : fmt::format("{:+.2f}", cm / 100);
}

std::string gaps_text(const std::vector<FootGap>& gaps, std::size_t most) {
  FirstOfMany names(most);
  for (const FootGap& gap : gaps)
    names.add(fmt::format("{} {} m", gap.object, signed_text(gap.gap_m)));
  return names.text();
}

/// How the land goes on beyond the outermost feet, by the largest slope there (a tangent).
std::string beyond_text(double steepest) {
  constexpr double worth_telling = 0.005;
  if (steepest < worth_telling) return "level beyond the outermost";
  return fmt::format("beyond the outermost by their slope ({:.0f} % at most)", 100 * steepest);
}

/// How the ground was made, and how far bodies are above it or below.
std::string ground_text(const GroundReport& g) {
  constexpr std::size_t most = 10;
  std::string text = "  ground    ";
  if (g.made_m2 == 0)
    text += "none made";
  else if (g.is_level)
    text +=
        fmt::format("{:.6g} m2, level at {:.2f} m{}", g.made_m2, g.low_m,
                    g.surface == GroundSurface::feet && g.standing > 0 ? " as all feet are" : "");
  else
    text += fmt::format("{:.6g} m2 through the feet, from {:.2f} to {:.2f} m, {}", g.made_m2,
                        g.low_m, g.high_m, beyond_text(g.steepest_beyond));
  if (g.terrain_m2 > 0)
    text += fmt::format("; the model's own terrain goes first, {:.6g} m2", g.terrain_m2);
  text += fmt::format("\n  feet      {} bodies stand on it, {} on other bodies", g.standing,
                      g.on_others);
  if (g.standing > 0)
    text +=
        fmt::format("; above it (below: -) by {} {} {} {} {} m (least, 5 %, median, 95 %, most)",
                    signed_text(g.gap_m[0]), signed_text(g.gap_m[1]), signed_text(g.gap_m[2]),
                    signed_text(g.gap_m[3]), signed_text(g.gap_m[4]));
  if (g.drawn > 0)
    text +=
        fmt::format("\n            walls of {} are drawn down to the terrain, by {:.2f} m at most",
                    g.drawn, g.longest_drawn_m);
  if (!g.worst.empty() && std::abs(g.worst.front().gap_m) > touching_m)
    text += "\n            farthest: " + gaps_text(g.worst, most);
  if (!g.hovering.empty())
    text +=
        fmt::format("\n            {} hover (-: are buried), too far from the feet beside them: {}",
                    g.hovering.size(), gaps_text(g.hovering, most));
  return text + "\n";
}

std::string intersections_text(const Mesh& mesh) {
  const Intersections found = find_intersections(mesh);
  std::string text = fmt::format(
      "  meeting   {} pairs of triangles cut and {} cover each other ({} of both between objects), "
      "{} of {} triangles",
      found.cutting, found.covering, found.between_objects, found.triangles, mesh.triangle_count());
  if (found.pairs() > 0) {
    const Vec3 p = mesh.corner(found.first[0], 0) + mesh.origin;
    const auto name = [&](std::size_t t) {
      return mesh.object_names[mesh.triangle_object[t].index()];
    };
    text += fmt::format("; first {} and {} near ({:.10g}, {:.10g}, {:.10g})", name(found.first[0]),
                        name(found.first[1]), p.x, p.y, p.z);
  }
  return text + "\n";
}

/// What float can resolve at the scene's largest coordinate (a float has 24 bits).
std::string extent_text(const Mesh& mesh, const Box& bounds) {
  double largest = 0;
  for (const double c :
       {bounds.low.x, bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z})
    largest = std::max(largest, std::abs(c));
  const Vec3 size = bounds.high - bounds.low;
  return fmt::format(
      "  extent    {:.6g} x {:.6g} x {:.6g} m, local origin at ({:.10g}, {:.10g}, {:.10g}); "
      "rays resolve {:.2g} mm\n",
      size.x, size.y, size.z, mesh.origin.x, mesh.origin.y, mesh.origin.z,
      1000 * largest * 0x1p-24);
}

/// Shares of light from the normal, and what decides at other angles.
std::string shares_text(const Material& m) {
  const SmoothShares smooth = smooth_shares(m, 1);
  std::string text = fmt::format("diffuse {:.3f}  mirror {:.3f}", m.diffuse, smooth.mirror);
  if (m.glossy > 0)
    text += fmt::format("  glossy {:.3f} (exponent {:g})", m.glossy, m.glossy_exponent);
  if (m.transmittance > 0) text += fmt::format("  passes {:.3f}", m.transmittance);
  if (const auto* metal = std::get_if<Metal>(&m.smooth)) {
    text += fmt::format("  metal n {:g} k {:g}", metal->refractive_index,
                        metal->extinction_coefficient);
  } else if (const auto* panes = std::get_if<Panes>(&m.smooth)) {
    text += fmt::format("  transmits {:.3f}  {} x {:g} mm of n {:g}", smooth.transmitted,
                        panes->count, 1000 * panes->thickness_m, panes->refractive_index);
    if (panes->absorption_per_m > 0) text += fmt::format(", K {:g} /m", panes->absorption_per_m);
  } else if (const auto* glass = std::get_if<ClearGlass>(&m.smooth)) {
    text += fmt::format("  transmits {:.3f}  clear glass of {:g}", smooth.transmitted,
                        glass->normal_transmittance);
  }
  return text;
}

std::string materials_text(const Scene& scene) {
  std::vector<double> area(scene.materials.size(), 0);
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t)
    area[scene.material[t].index()] += scene.mesh.area_m2(t);
  std::string text;
  for (std::size_t m = 0; m < area.size(); ++m) {
    const Material& material = scene.materials[m];
    text += fmt::format("  {:<24} {}", material.name, shares_text(material));
    if (material.emission_w_m2 > 0)
      text += fmt::format("  emits {:.4g} W/m2", material.emission_w_m2);
    text += fmt::format("  {:.6g} m2\n", area[m]);
  }
  return text;
}

std::string rules_text(const std::vector<RuleUse>& rules) {
  std::string text;
  for (const RuleUse& use : rules) {
    text +=
        fmt::format("  rule      {}  {} triangles, {:.6g} m2", use.rule, use.given, use.given_m2);
    if (use.given < use.matched)
      text += fmt::format("  ({} more have it from elsewhere)", use.matched - use.given);
    text += "\n";
  }
  return text;
}

std::string parallel_sources_text(const ParallelSources& sources) {
  if (sources.exitance.empty()) return {};
  double area = 0, power = 0;
  for (std::size_t t = 0; t < sources.exitance.size(); ++t) {
    const double own = sources.mesh.area_m2(t);
    area += own;
    power += own * sources.exitance[t];
  }
  return fmt::format("  parallel  {} triangles of {:.6g} m2 send {:.6g} W along their normals\n",
                     sources.exitance.size(), area, power);
}

std::string luminaires_text(const Luminaires& luminaires) {
  if (!luminaires.any()) return {};
  return fmt::format("  luminaires {} send {:.6g} lm\n", luminaires.all.size(), luminaires.flux());
}

}  // namespace

std::string scene_in_words(const BuiltScene& built, bool with_intersections) {
  const Mesh& mesh = built.scene.mesh;
  std::string text = counts_text(built.report) + extent_text(mesh, built.report.bounds);
  if (with_intersections) text += intersections_text(mesh);
  if (built.report.ground) text += ground_text(*built.report.ground);
  for (const auto& note : built.notes) text += "  note      " + note + "\n";
  return text;
}

std::string materials_in_words(const BuiltScene& built) {
  const Scene& scene = built.scene;
  return materials_text(scene) + rules_text(built.rules) +
         parallel_sources_text(scene.parallel_sources) + luminaires_text(scene.luminaires);
}

}  // namespace sunload
