// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/mesh_prepare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "geo/base/check.h"
#include "geo/mesh/box_tree.h"
#include "geo/mesh/facade.h"
#include "geo/mesh/mesh_clean.h"
#include "geo/mesh/orient.h"
#include "geo/mesh/shared_faces.h"
#include "geo/mesh/surface_kind.h"
#include "geo/mesh/t_joints.h"
#include "geo/mesh/triangulate.h"
#include "geo/mesh/weld.h"

namespace sunload {

namespace {

// `half_edge` counts three per triangle in 32 bits.
constexpr std::size_t most_triangles = 0xffffffff / 3;

/// Corners on slanting edges, written in whole millimetres, lie beside them by so many tolerances
/// of welding; none is moved, and what closes a body is no accident.
constexpr double rounded_per_weld = 10;

bool is_finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

double largest_component(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

std::string text_of(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.3g", value);
  return buffer.data();
}

/// "1 triangle", "2 triangles".
std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

void check_model(const PolygonModel& model) {
  if (model.polygon_count() == 0) {
    throw InputError({model.source}, "the scene has no polygons", "there is nothing to light",
                     "does the file hold faces, and not only points or lines?");
  }
  std::size_t count = 0, first = 0;
  for (std::size_t v = model.vertices.size(); v-- > 0;) {
    if (is_finite(model.vertices[v])) continue;
    ++count;
    first = v;
  }
  if (count > 0) {
    throw InputError({model.source},
                     counted(count, "vertex coordinate") + " not finite, first at vertex " +
                         std::to_string(first + 1),
                     "positions must be finite numbers", "mend or export the file again");
  }
  if (model.ring_vertex.size() > most_triangles) {
    throw InputError({model.source}, counted(model.ring_vertex.size(), "polygon corner"),
                     "at most " + std::to_string(most_triangles) + " are supported",
                     "divide the scene");
  }
  for (const auto v : model.ring_vertex) {
    SUNLOAD_EXPECT(v >= 0 && static_cast<std::size_t>(v) < model.vertices.size(),
                   "a reader made a ring with vertex " + std::to_string(v));
  }
  for (const auto& facts : model.facts) {
    SUNLOAD_EXPECT(facts.object.exists() && facts.object.index() < model.object_names.size(),
                   "a reader made a polygon without object");
  }
}

std::vector<std::uint8_t> used_vertices(const PolygonModel& model) {
  std::vector<std::uint8_t> is_used(model.vertices.size(), 0);
  for (const auto v : model.ring_vertex) is_used[static_cast<std::size_t>(v)] = 1;
  return is_used;
}

struct Placement {
  Vec3 origin;
  double diagonal = 0;
};

/// Whole metres, and of scenes smaller than a metre the power of two below their extent: numbers of
/// which there are no finer bits than those of coordinates beside them.
double origin_step(double extent) {
  return extent < 1 && extent > 0 ? std::exp2(std::floor(std::log2(extent))) : 1;
}

Placement place(const PolygonModel& model, const std::vector<std::uint8_t>& is_used,
                const std::vector<Vec3>& beside) {
  Box box;
  for (std::size_t v = 0; v < is_used.size(); ++v) {
    if (!is_used[v]) continue;
    const Vec3 p = model.vertices[v];
    include(box, p);
  }
  const double extent = largest_component(box.high - box.low);
  if (!(extent <= largest_extent_m)) {
    throw InputError({model.source}, "the scene is " + text_of(extent) + " m wide",
                     "at most " + text_of(largest_extent_m) + " m are supported",
                     "is scene.unit_m right, or is one vertex far away?");
  }
  Placement placement;
  placement.diagonal = norm(box.high - box.low);
  const double farthest = std::max(largest_component(box.low), largest_component(box.high));
  Box all = box;
  for (const Vec3 p : beside) include(all, p);
  const double extent_of_all = largest_component(all.high - all.low);
  if (farthest > near_origin_m || farthest > near_origin_extents * extent_of_all) {
    const double step = origin_step(extent);
    const auto rounded = [&](double x) { return std::round(x / step) * step + 0.0; };  // no -0
    // Halves first: the sum of two finite numbers may not be finite.
    placement.origin = {rounded(box.low.x / 2 + box.high.x / 2),
                        rounded(box.low.y / 2 + box.high.y / 2), rounded(box.low.z)};
  }
  return placement;
}

double weld_tolerance(Repair repair, double diagonal) {
  if (repair == Repair::none) return 0;
  return std::min(weld_tolerance_m, weld_tolerance_ratio * diagonal);
}

/// Steps 2 to 4: local coordinates, welding, triangles.
Mesh triangles_of(const PolygonModel& model, const PrepareRules& rules, const Placement& placement,
                  const std::vector<std::uint8_t>& is_used, PrepareReport& report) {
  std::vector<Vec3> local(model.vertices.size());
  for (std::size_t v = 0; v < local.size(); ++v) {
    if (is_used[v]) local[v] = model.vertices[v] - placement.origin;
  }
  auto welded = weld(local, is_used, weld_tolerance(rules.repair, placement.diagonal));
  report.vertices_welded = welded.merged;

  Mesh mesh;
  mesh.origin = placement.origin;
  mesh.vertices = std::move(welded.vertices);
  mesh.object_names = model.object_names;
  mesh.object_kinds = model.object_kinds;
  mesh.object_kinds.resize(mesh.object_names.size());
  mesh.families = model.families;
  mesh.file_materials = model.materials;
  const auto counts = triangulate(model, welded.new_index, mesh);
  report.polygons_with_holes = counts.with_holes;
  report.polygons_nonplanar = counts.nonplanar;
  report.polygons_crossing = counts.crossing;
  report.polygons_untriangulated = counts.untriangulated;
  report.degenerates_dropped = counts.collapsed;
  return mesh;
}

/// Step 6. Per triangle that is left 1 where a front and a back were in the same place.
std::vector<std::uint8_t> drop_copies(Mesh& mesh, PrepareReport& report) {
  std::vector<std::size_t> place = first_in_place(mesh);
  report.bodies_parted = part_bodies_that_share_faces(mesh, place);
  if (report.bodies_parted > 0) place = first_in_place(mesh);
  Duplicates duplicates = drop_duplicates(mesh, place);
  report.duplicates_dropped = duplicates.dropped;
  return std::move(duplicates.faced_both_ways);
}

/// On a slope the underside of a body is higher than its lowest point.
void take_floors(Mesh& mesh, const std::vector<Foot>& feet) {
  for (const Foot& foot : feet)
    for (const auto t : foot.floors)
      if (foot.stance == Stance::ground && mesh.triangle_surface[t] == Surface::other)
        mesh.triangle_surface[t] = Surface::floor;
}

/// Steps 5 to 8: T-joints, twins, windings, feet, kinds of surface.
std::vector<Foot> settle(Mesh& mesh, const PrepareRules& rules, const PolygonModel& model,
                         double tolerance, PrepareReport& report, Bodies& bodies) {
  std::vector<std::uint8_t> faced_both_ways(mesh.triangle_count(), 0);
  if (rules.repair != Repair::none) {
    report.t_joints_split =
        rules.repair == Repair::all
            ? split_t_joints(mesh, tolerance, model.source)
            : split_t_joints(mesh, rounded_per_weld * tolerance, model.source, TJoints::that_close);
    faced_both_ways = drop_copies(mesh, report);
  }
  const bool may_turn = rules.repair != Repair::none && rules.orientation == Orientation::outward;
  bodies = orient(mesh, faced_both_ways, may_turn ? Winding::turn : Winding::keep);
  if (may_turn) report.turned = turn_sheets_on_walls(mesh, bodies);
  report.triangles_flipped = bodies.triangles_flipped;
  report.inside_out_bodies = bodies.inside_out;
  report.unorientable = bodies.unorientable;
  report.open_edges = bodies.open_edges;
  report.nonmanifold_edges = bodies.nonmanifold_edges;
  for (const auto& body : bodies.bodies) {
    if (body.is_inner) continue;
    ++(body.is_closed ? report.closed_bodies : report.open_sheets);
    if (!body.is_inside_out) report.volume_m3 += body.volume;
  }
  for (std::size_t t = 0; t < faced_both_ways.size(); ++t) {
    if (!faced_both_ways[t] || bodies.triangle_body[t] >= 0) continue;
    mesh.triangle_sides[t] = Sides::two;
    ++report.sheets_merged;
  }
  const auto kind = model.is_city_format ? SceneKind::city : SceneKind::plain;
  // What stands on another body has an underside, whatever the ground is.
  const bool asks_for_feet = rules.ground.has_value() || kind == SceneKind::city;
  auto feet = asks_for_feet ? find_feet(mesh, bodies, kind) : std::vector<Foot>{};
  const Standing standing = standing_on(mesh, bodies, feet, rules.ground);
  if (rules.orientation == Orientation::outward)
    report.looks_down = find_looking_down(mesh, bodies, kind);
  decide_surfaces(mesh, bodies, kind, standing);
  report.sunk = find_sunk_walls(mesh, bodies);
  if (!standing.on_ground.empty()) take_floors(mesh, feet);
  if (!rules.ground) feet.clear();
  return feet;
}

InputError nothing_left(const std::string& source, const PrepareReport& report) {
  const std::size_t crossing = report.polygons_untriangulated;
  const std::string what = "nothing is left of the scene";
  if (crossing == 0)
    return {{source},
            what,
            "all " + counted(report.polygons_read, "polygon") + " are without area",
            "are scene.unit_m and the file's coordinates right?"};
  return {{source},
          what,
          std::to_string(crossing) + " of " + counted(report.polygons_read, "polygon") +
              " cross themselves more often than can be triangulated, others are without area",
          "are the corners of its faces in order?"};
}

/// Triangles have new numbers.
void keep_bodies(const std::vector<std::uint8_t>& keep, Bodies& bodies, std::vector<Foot>& feet) {
  std::vector<std::size_t> new_index(keep.size());
  std::size_t kept = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    new_index[t] = kept;
    if (keep[t]) bodies.triangle_body[kept++] = bodies.triangle_body[t];
  }
  bodies.triangle_body.resize(kept);
  for (Foot& foot : feet) {
    std::erase_if(foot.floors, [&](std::size_t t) { return !keep[t]; });
    for (std::size_t& t : foot.floors) t = new_index[t];
    for (std::size_t& t : foot.walls) t = keep[t] ? new_index[t] : no_wall;
  }
}

/// Walls drawn down come after the triangles of their object.
void order_by_object(PreparedMesh& prepared) {
  Mesh& mesh = prepared.mesh;
  std::vector<std::size_t> order(mesh.triangle_count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return mesh.triangle_object[a].value < mesh.triangle_object[b].value;
  });
  const auto sort = [&](auto& list) {
    if (list.empty()) return;
    auto old = std::move(list);
    list.clear();
    for (const auto t : order) list.push_back(old[t]);
  };
  sort(mesh.triangles);
  sort(mesh.triangle_object);
  sort(mesh.triangle_material);
  sort(mesh.triangle_facade);
  sort(mesh.triangle_surface);
  sort(mesh.triangle_sides);
  sort(mesh.triangle_covered);
  sort(prepared.bodies.triangle_body);
  sort(prepared.seals);
}

/// Step 9. Returns per triangle that there was 1 where it stays.
std::vector<std::uint8_t> drop_degenerates(Mesh& mesh, double height_ratio, Repair repair,
                                           const std::string& source, PrepareReport& report) {
  auto keep = with_area(mesh, height_ratio);
  report.degenerates_dropped +=
      static_cast<std::size_t>(std::count(keep.begin(), keep.end(), std::uint8_t{0}));
  if (repair == Repair::none && report.degenerates_dropped > 0) {
    throw InputError({source}, counted(report.degenerates_dropped, "polygon") + " without area",
                     "irradiance is light per area", "set scene.repair: safe");
  }
  keep_triangles(mesh, keep);
  if (mesh.triangle_count() == 0) throw nothing_left(source, report);
  drop_unused_vertices(mesh);
  return keep;
}

/// Less is not worth a word [m2].
constexpr double least_sunk_m2 = 1;

void add_warnings(PrepareReport& r, Orientation orientation) {
  const auto warn = [&](const std::string& what, std::size_t count,
                        const std::string& consequence) {
    if (count > 0) r.warnings.push_back(what + ": " + std::to_string(count) + "; " + consequence);
  };
  warn("non-planar polygons", r.polygons_nonplanar,
       "triangulated in projection, so folded along edges that the file does not state");
  warn("polygons with crossing rings", r.polygons_crossing,
       "filled by the even-odd rule, so area and shape may differ from what was meant");
  warn("polygons that could not be triangulated", r.polygons_untriangulated,
       "left out, so light passes through the gap");
  warn("polygons and triangles without area", r.degenerates_dropped,
       "dropped without effect on light");
  warn("duplicate triangles", r.duplicates_dropped, "dropped, so that each place is lit once");
  warn("triangles with a back of their own", r.sheets_merged,
       "made two-sided, so front and back are separate patches");
  warn("triangles turned over", r.triangles_flipped,
       "their body was inside out or its faces disagreed, so their lit side has changed; "
       "scene.orient: keep leaves them, for rooms lit inside");
  if (r.turned.triangles > 0)
    r.warnings.push_back(text_of(r.turned.area_m2) +
                         " m2 of sheets looked into the wall or roof that they lie on (most of " +
                         r.turned.largest +
                         "): they are turned over; turn their faces in the file, or scene.orient: "
                         "keep leaves them");
  if (orientation == Orientation::outward)
    warn("closed bodies inside out", r.inside_out_bodies,
         "left so, hence their outside absorbs all light; set scene.repair: safe");
  warn("bodies without consistent fronts", r.unorientable,
       "left as in the file, hence light that meets a back is absorbed");
  warn("edges with more than two triangles", r.nonmanifold_edges,
       "bodies with an odd number there count as open");
  warn("open edges", r.open_edges,
       "bodies with such edges are not closed: they keep the file's fronts and have no volume");
  if (r.looks_down.objects > 0)
    r.warnings.push_back(counted(r.looks_down.objects, "object") +
                         " with open surfaces that look down (" + text_of(r.looks_down.area_m2) +
                         " m2, the largest: " + r.looks_down.largest +
                         "): light from above meets their backs, which absorb it unless their "
                         "material has sides: two; turn their faces in the file");
  if (r.sunk.area_m2 >= least_sunk_m2)
    r.warnings.push_back(text_of(r.sunk.area_m2) + " m2 of walls go on below the open surface of " +
                         r.sunk.sheet + " (most of " + r.sunk.wall +
                         "): they are lit from beneath, and facades have them in their means" +
                         (r.sunk.sheet == r.sunk.wall
                              ? "; if it is the terrain, make it an object of its own and name it "
                                "in scene.land"
                              : "; if it is the terrain, scene.land: [" + r.sunk.sheet +
                                    "] says so, and what lies below is cut off"));
}

}  // namespace

void measure(const Mesh& mesh, PrepareReport& report) {
  report.area_m2 = report.covered_m2 = {};
  report.floors = 0;
  report.worst_aspect = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto surface = static_cast<std::size_t>(mesh.triangle_surface[t]);
    const double area = mesh.area_m2(t);
    report.area_m2[surface] += area;
    if (mesh.is_covered(t)) report.covered_m2[surface] += area;
    report.worst_aspect = std::max(report.worst_aspect, aspect(mesh, t));
    if (mesh.triangle_surface[t] == Surface::floor) ++report.floors;
  }
  report.bounds = bounding_box(mesh.vertices);
}

PlainTriangles plain_triangles(const PolygonModel& model, Repair repair) {
  check_model(model);
  const auto is_used = used_vertices(model);
  PrepareRules rules;
  rules.repair = Repair::none;
  PrepareReport report;
  report.polygons_read = model.polygon_count();
  PlainTriangles result;
  result.mesh = triangles_of(model, rules, place(model, is_used, {}), is_used, report);
  drop_degenerates(result.mesh, 0, repair, model.source, report);
  add_warnings(report, rules.orientation);
  result.warnings = std::move(report.warnings);
  return result;
}

PreparedMesh prepare(const PolygonModel& model, const PrepareRules& rules) {
  check_model(model);
  const auto is_used = used_vertices(model);
  const auto placement = place(model, is_used, rules.beside);

  PreparedMesh result;
  Mesh& mesh = result.mesh;
  PrepareReport& report = result.report;
  report.polygons_read = model.polygon_count();
  report.vertices_read = model.vertices.size();
  mesh = triangles_of(model, rules, placement, is_used, report);
  auto feet = settle(mesh, rules, model, weld_tolerance(rules.repair, placement.diagonal), report,
                     result.bodies);
  const double height_ratio = rules.repair == Repair::none ? 0 : least_height_ratio;
  const auto keep = drop_degenerates(mesh, height_ratio, rules.repair, model.source, report);
  if (mesh.triangle_count() < keep.size()) keep_bodies(keep, result.bodies, feet);
  result.facades = find_facades(mesh, rules.north_deg);
  if (rules.ground) {
    auto made = add_ground(mesh, feet, *rules.ground);
    report.ground = std::move(made.report);
    result.seals = std::move(made.seals);
    result.bodies.triangle_body.resize(mesh.triangle_count(), -1);
    if (report.ground->drawn > 0 || !result.seals.empty()) order_by_object(result);
  }
  measure(mesh, report);
  add_warnings(report, rules.orientation);
  return result;
}

}  // namespace sunload
