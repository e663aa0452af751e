// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What scene readers deliver, and the triangle mesh that light is computed on.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geo/base/ids.h"
#include "geo/base/vec.h"
#include "geo/mesh/families.h"

namespace sunload {

/// Kind of a surface. A floor touches the ground or another body: it casts shadows and has no
/// patches.
enum class Surface : std::uint8_t { other, wall, roof, ground, window, floor };
inline constexpr std::array<const char*, 6> surface_names{"other",  "wall",   "roof",
                                                          "ground", "window", "floor"};

/// Values belong to the front side (counter-clockwise); `two` makes twin patches.
enum class Sides : std::uint8_t { one, two };

/// A material as a scene file states it; what it leaves open the study decides.
struct FileMaterial {
  std::string name;
  std::optional<double> diffuse;  ///< reflectance [0, 1]
  std::optional<double> mirror;   ///< reflectance [0, 1]
  double emitted_power_w = 0;     ///< shared by area among all triangles of the material
  bool glows = false;             ///< emits, with a power that the file does not tell
  bool is_reference = false;      ///< just a name, which study or table of materials define
  /// `diffuse` in red, green and blue, of which it is the mean; absent: grey.
  std::optional<std::array<double, 3>> diffuse_rgb = {};
  std::string source = {};     ///< file that it is of, for messages; empty: not told
  bool may_be_scaled = false;  ///< shares above 1 are usual in its format

  /// Takes a colour as diffuse reflectance. False where its mean is no share, which leaves it open;
  /// a colour of which a component alone is no share is taken as grey.
  bool set_diffuse(const std::array<double, 3>& rgb);
};

/// Polygons with holes, as read: the common output of all scene readers.
///
/// Flat arrays: polygon p has the rings polygon_ring[p] … polygon_ring[p+1]-1,
/// the first of them outer (counter-clockwise seen from its front), ring r the
/// vertices ring_vertex[ring_begin[r] … ring_begin[r+1]-1]. Coordinates are
/// metres, z up, absolute (national grids keep their millions of metres).
struct PolygonModel {
  /// What a reader knows of one polygon.
  struct Facts {
    ObjectId object;
    MaterialId material = MaterialId::none();  ///< into `materials`
    Surface surface = Surface::other;          ///< `other` is decided by preparation from the slope
    Sides sides = Sides::one;
  };

  std::vector<Vec3> vertices;
  std::vector<std::int32_t> ring_vertex;
  std::vector<std::int64_t> ring_begin{0};
  std::vector<std::int64_t> polygon_ring{0};
  std::vector<Facts> facts;  ///< one per polygon

  std::vector<std::string> object_names;  ///< unique
  std::vector<std::string> object_kinds;  ///< CityJSON type or empty
  Families families;
  std::vector<FileMaterial> materials;

  std::string source;                 ///< file name for messages
  std::vector<std::string> files;     ///< that were read for it, with those that they draw in
  std::string crs;                    ///< e.g. "EPSG:28992", empty if the file names none
  bool is_city_format = false;        ///< gets a ground plate by default
  std::vector<std::string> notes;     ///< one line each: what was counted, tolerated or left out
  std::vector<std::string> warnings;  ///< likewise: what is lost that was meant to be there

  std::size_t polygon_count() const { return facts.size(); }
  /// Appends a polygon; `rings` hold vertex indices, outer ring first.
  void add_polygon(const std::vector<std::vector<std::int32_t>>& rings, Facts polygon_facts);
  /// Appends a polygon of one ring without heap traffic for the caller.
  void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c, Facts polygon_facts);
};

/// A connected coplanar wall region of one object.
struct Facade {
  std::string name;  ///< `<object>/<compass point>_<number>`, e.g. house_3/north_1
  ObjectId object;
  double area_m2 = 0;
  double azimuth_deg = 0;  ///< of its outward normal, in the scene frame (0 = +y)
};

/// Prepared triangles: repaired, oriented, relative to a local origin.
///
/// Triangles are ordered by object, then as prepared: the order of the result
/// file. Normals point to the front (outside of closed bodies).
struct Mesh {
  std::vector<Vec3> vertices;  ///< m, relative to `origin`
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<ObjectId> triangle_object;
  std::vector<MaterialId> triangle_material;  ///< into `file_materials`, or none
  std::vector<FacadeId> triangle_facade;      ///< or none
  std::vector<Surface> triangle_surface;
  std::vector<Sides> triangle_sides;
  /// 1: lies inside a body or against another surface, so that no light reaches its fronts. Empty
  /// where nothing is covered.
  std::vector<std::uint8_t> triangle_covered;

  std::vector<std::string> object_names;
  std::vector<std::string> object_kinds;
  Families families;
  std::vector<FileMaterial> file_materials;
  std::vector<Facade> facades;
  Vec3 origin;  ///< absolute position of the local origin

  std::size_t triangle_count() const { return triangles.size(); }
  bool is_covered(std::size_t triangle) const {
    return !triangle_covered.empty() && triangle_covered[triangle] != 0;
  }
  /// Floors and covered triangles cast shadows and are no patches.
  bool bears_patches(std::size_t triangle) const {
    return triangle_surface[triangle] != Surface::floor && !is_covered(triangle);
  }
  Vec3 corner(std::size_t triangle, int k) const {
    return vertices[static_cast<std::size_t>(triangles[triangle][static_cast<std::size_t>(k)])];
  }
  std::array<Vec3, 3> corners(std::size_t triangle) const {
    return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
  }
  /// Twice the area vector: cross product of two edges, along the front normal.
  Vec3 area_vector2(std::size_t triangle) const {
    const Vec3 a = corner(triangle, 0);
    return cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
  }
  double area_m2(std::size_t triangle) const { return norm(area_vector2(triangle)) / 2; }
  /// Unit normal of a side.
  Vec3 normal(std::size_t triangle, bool front = true) const {
    const Vec3 n = normalized(area_vector2(triangle));
    return front ? n : -n;
  }
  /// The point whose barycentric weights of corners 1 and 2 are u and v.
  Vec3 point(std::size_t triangle, double u, double v) const {
    return corner(triangle, 0) * (1 - u - v) + corner(triangle, 1) * u + corner(triangle, 2) * v;
  }
};

/// An axis-parallel box [m]; a new one holds nothing, with `low` above `high`.
struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
};
/// The smallest box about the points.
Box bounding_box(const std::vector<Vec3>& points);

}  // namespace sunload
