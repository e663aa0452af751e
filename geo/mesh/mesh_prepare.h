// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Polygons as read → triangles fit for ray casting.
///
/// Steps, in this order (each in a file of its own):
///
/// 1. **Check.** Every coordinate is finite, and no scene is wider than
///    `largest_extent_m`.
/// 2. **Local origin.** (0, 0, 0) where no used coordinate exceeds
///    `near_origin_m`, or `near_origin_extents` times what the scene measures; else the bounding
///    box's centre in x and y and its lowest z, rounded to whole metres (of smaller scenes to a
///    power of two), so that the subtraction is exact to the last bit of the file's coordinates.
///    All that follows is relative to it: rays resolve a share of the largest coordinate.
/// 3. **Weld** (geo/mesh/weld). `none`: equal points; else points within
///    `weld_tolerance_m`, or 1e-6 of the scene's diagonal where that is less.
/// 4. **Triangulate** (geo/mesh/triangulate).
/// 5. **T-joints** (geo/mesh/t_joints, not for `none`): corners that lie on an open edge
///    of their own object split it; all of them (`all`), or where that closes a body.
/// 6. **Duplicates** (geo/mesh/mesh_clean, not for `none`): triangles of one object
///    with the same three corners become one, but faces that two bodies have in common
///    and that look the same way for both (geo/mesh/shared_faces). A front and a back in the same
///    place are a two-sided sheet, unless the object closes with one of them.
/// 7. **Orient** (geo/mesh/orient; `none` and `keep` change no winding): closed bodies are
///    turned outward, cavities with the body around them; open sheets keep the
///    winding of the larger part of their area, but for panes that look into the wall that they
///    lie on (geo/mesh/sheets_on_walls).
/// 8. **Kind of surface** (geo/mesh/surface_kind) where the reader left `other`.
/// 9. **Degenerates** (geo/mesh/mesh_clean): triangles whose height is at most
///    `least_height_ratio` of their longest edge are dropped, after step 7 so
///    that a triangle without area does not open a body; `none` refuses them.
/// 10. **Facades** (geo/mesh/facade), **ground** (geo/mesh/ground), report.
///
/// Equal input gives equal bits: no order depends on addresses or on hashing.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geo/mesh/facade.h"
#include "geo/mesh/ground.h"
#include "geo/mesh/looks_down.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"
#include "geo/mesh/sheets_on_walls.h"
#include "geo/mesh/sunk_walls.h"

namespace sunload {

/// none: only triangulate and weld equal points. safe (default): weld within a
/// tolerance, split T-joints that close bodies, drop degenerates and duplicates, orient. all: all
/// T-joints.
enum class Repair { none, safe, all };

/// outward: closed bodies are lit outside. keep: the winding of the file, for rooms lit inside.
enum class Orientation { outward, keep };

/// How far a model is repaired, and what it gets.
struct PrepareRules {
  Repair repair = Repair::safe;
  std::optional<GroundRules> ground;
  Orientation orientation = Orientation::outward;
  std::vector<Vec3> beside = {};  ///< points of sensors and lamps: part of what the scene measures
  double north_deg = 0;  ///< azimuth of scene +y: only names facades by their true direction
};

inline constexpr double near_origin_m = 1000;     ///< such scenes keep their coordinates
inline constexpr double near_origin_extents = 8;  ///< and so do these: rays resolve 1e-6 of them
inline constexpr double largest_extent_m = 1e6;   ///< floats of the ray caster resolve 6 cm there
inline constexpr double weld_tolerance_m = 1e-4;  ///< a tenth of the usual 1 mm of CityJSON files
inline constexpr double weld_tolerance_ratio = 1e-6;  ///< of the scene's diagonal: small models
inline constexpr double least_height_ratio = 1e-6;    ///< 10 µm on 10 m: below float resolution

/// Counts of everything that was read, changed, dropped or left open. Nothing
/// is repaired without a count here.
struct PrepareReport {
  std::size_t polygons_read = 0, polygons_with_holes = 0;
  std::size_t vertices_read = 0, vertices_welded = 0;
  std::size_t polygons_nonplanar = 0;       ///< triangulated in projection, hence folded
  std::size_t polygons_crossing = 0;        ///< rings cross themselves or each other: even-odd area
  std::size_t polygons_untriangulated = 0;  ///< dropped
  std::size_t degenerates_dropped = 0, duplicates_dropped = 0;
  std::size_t sheets_merged = 0;  ///< front and back in the same place: now one two-sided triangle
  std::size_t t_joints_split = 0;
  std::size_t bodies_parted = 0;  ///< from others of their object, with which they share faces
  std::size_t triangles_flipped = 0;
  std::size_t closed_bodies = 0, open_sheets = 0;
  std::size_t inside_out_bodies = 0;  ///< left so (`none` or `keep` only)
  std::size_t unorientable = 0;       ///< bodies with edges that no orientation satisfies
  std::size_t open_edges = 0, nonmanifold_edges = 0;
  LooksDown looks_down;    ///< open surfaces, which keep the file's fronts
  SunkWalls sunk;          ///< below sheets that are no land
  TurnedSheets turned;     ///< panes that looked into their walls
  std::size_t floors = 0;  ///< triangles that touch the ground: cast shadows, are no patches
  std::array<double, surface_names.size()> area_m2{};     ///< per surface kind
  std::array<double, surface_names.size()> covered_m2{};  ///< of it: no light can reach it
  double dark_backs_m2 = 0;            ///< of two-sided faces, inside of houses: no patches
  std::optional<GroundReport> ground;  ///< where one was asked for
  double volume_m3 = 0;                ///< of all closed bodies
  double worst_aspect = 0;             ///< longest edge / shortest height of a triangle
  Box bounds;                          ///< relative to the mesh's origin, ground plate included
  std::vector<std::string> warnings;   ///< ready to print, each states its consequence
};

/// A mesh that is fit for rays, with what later steps need of its preparation.
struct PreparedMesh {
  Mesh mesh;
  PrepareReport report;
  Bodies bodies;  ///< of the triangles of `mesh`; ground and walls drawn down to it are none
  std::vector<std::uint8_t> seals;  ///< of the ground: see GroundMade
  std::vector<FoundFacade> facades;
};

/// Throws InputError where the model is empty or nothing of it is left, where a
/// coordinate is not finite or too large, under `none`, where triangles
/// have no area, and, under `all`, where the edges of too many of them overlap.
PreparedMesh prepare(const PolygonModel& model, const PrepareRules& rules);

/// The triangles of a model as its file has them.
struct PlainTriangles {
  Mesh mesh;                          ///< without facades; kinds of surface as read
  std::vector<std::string> warnings;  ///< of what was left out, or has another shape; as in reports
};

/// Steps 1 to 4 with the rules of `none`, for files that only hold triangles. What has no area is
/// left out with a warning, or refused where `repair` is `none`. Throws as `prepare` does.
PlainTriangles plain_triangles(const PolygonModel& model, Repair repair);

/// Areas, bounds, floors and slivers of the report, anew after triangles were divided.
void measure(const Mesh& mesh, PrepareReport& report);

}  // namespace sunload
