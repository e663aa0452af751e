// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "geo/base/check.h"
#include "geo/base/pattern.h"
#include "geo/mesh/mesh.h"
#include "io/base/version.h"
#include "io/export/cityjson.h"
#include "io/export/format.h"
#include "io/export/surface_values.h"

namespace sunload {
namespace {

using nlohmann::json;

// Vertices are whole numbers of this [m]: a hundredth of what surveys resolve.
constexpr double grid_m = 1e-4;

/// The object of triangles that bear no patch (floors): of those before and after it in the file,
/// the one that it shares most corners with.
std::vector<std::int32_t> triangle_objects(const ResultReader& result,
                                           const ResultPatches& patches) {
  const auto corners = result.integers("input_triangle_vertices");
  const auto of_patch = result.integers("patch_input_triangle");
  std::vector<std::int32_t> object(corners.size() / 3, -1);
  std::vector<std::pair<std::int32_t, std::int32_t>> touches;  // vertex, object
  for (std::size_t p = 0; p < of_patch.size(); ++p)
    object[static_cast<std::size_t>(of_patch[p])] = patches.object[p];
  for (std::size_t t = 0; t < object.size(); ++t)
    for (std::size_t k = 0; k < 3 && object[t] >= 0; ++k)
      touches.emplace_back(corners[3 * t + k], object[t]);
  std::sort(touches.begin(), touches.end());
  std::vector<std::int32_t> after(object.size(), -1);
  for (std::size_t t = object.size(), next = object.size(); t-- > 0;) {
    if (object[t] >= 0) next = t;
    after[t] = next < object.size() ? object[next] : -1;
  }
  std::int32_t before = -1;
  for (std::size_t t = 0; t < object.size(); ++t) {
    if (object[t] >= 0) {
      before = object[t];
      continue;
    }
    const auto shared = [&](std::int32_t candidate) {
      std::size_t count = 0;
      for (std::size_t k = 0; k < 3; ++k)
        count += std::binary_search(touches.begin(), touches.end(),
                                    std::pair(corners[3 * t + k], candidate));
      return count;
    };
    if (shared(before) + shared(after[t]) > 0)
      object[t] = shared(before) >= shared(after[t]) ? before : after[t];
  }
  return object;
}

/// One object as it is put together.
struct CityObject {
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::int32_t> patch;   ///< of a face, -1: a floor
  std::vector<std::size_t> patches;  ///< fronts
  std::set<Surface> kinds;
};

std::vector<CityObject> city_objects(const ResultReader& result, const ResultPatches& patches) {
  const auto surface = result.integers("patch_surface"), side = result.integers("patch_side"),
             triangle = result.integers("patch_input_triangle"),
             corners = result.integers("input_triangle_vertices");
  std::vector<CityObject> objects(patches.object_names.size());
  std::vector<char> is_covered(corners.size() / 3, 0);
  for (std::size_t p = 0; p < patches.corners.size(); ++p) {
    is_covered[static_cast<std::size_t>(triangle[p])] = 1;
    if (side[p] != 0) continue;  // the twin of a two-sided surface has the same place
    auto& object = objects[static_cast<std::size_t>(patches.object[p])];
    object.faces.push_back(patches.corners[p]);
    object.patch.push_back(static_cast<std::int32_t>(p));
    object.patches.push_back(p);
    object.kinds.insert(static_cast<Surface>(surface[p]));
  }
  const auto of_triangle = triangle_objects(result, patches);
  for (std::size_t t = 0; t < is_covered.size(); ++t) {
    if (is_covered[t] || of_triangle[t] < 0) continue;
    auto& object = objects[static_cast<std::size_t>(of_triangle[t])];
    object.faces.push_back({corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]});
    object.patch.push_back(-1);
  }
  return objects;
}

/// Buildings have no ground and transport squares have nothing else (CityJSON 2.0.1, 3.3).
std::string object_type(const std::set<Surface>& kinds) {
  const bool has_ground = kinds.contains(Surface::ground);
  if (has_ground && kinds.size() == 1) return "TransportSquare";
  const bool is_built = kinds.contains(Surface::wall) || kinds.contains(Surface::roof) ||
                        kinds.contains(Surface::window);
  return is_built && !has_ground ? "Building" : "GenericCityObject";
}

json geometry(const CityObject& object, const ResultPatches& patches,
              const std::vector<std::int32_t>& surface, const SurfaceValues& values) {
  json boundaries = json::array(), surfaces = json::array(), places = json::array();
  for (std::size_t f = 0; f < object.faces.size(); ++f) {
    const auto& face = object.faces[f];
    boundaries.push_back({{face[0], face[1], face[2]}});
    places.push_back(surfaces.size());
    if (object.patch[f] < 0) {
      surfaces.push_back({{"type", "GroundSurface"}});
      continue;
    }
    const auto p = static_cast<std::size_t>(object.patch[f]);
    json one{{"type", surface_type(static_cast<Surface>(surface[p]), patches.normal[p])}};
    for (const auto& [name, value] : values.of({p})) one[name] = value;
    surfaces.push_back(std::move(one));
  }
  return {{"type", "MultiSurface"},
          {"lod", "2"},
          {"boundaries", std::move(boundaries)},
          {"semantics", {{"surfaces", std::move(surfaces)}, {"values", std::move(places)}}}};
}

std::int64_t rounded(double metres) { return std::llround(metres / grid_m); }

json vertices(const ResultPatches& patches) {
  json list = json::array();
  for (const Vec3 v : patches.vertices) list.push_back({rounded(v.x), rounded(v.y), rounded(v.z)});
  return list;
}

/// Of the result, and where one quantity is asked for with what it is and when.
std::string title(const ResultReader& result, const ExportRules& rules) {
  const std::string whole = result.text_attribute("title");
  if (!rules.quantity.empty() || !rules.time.empty())
    return whole + "; " + export_caption(result, export_quantity(result, rules));
  return result.chosen().any() ? whole + "; " + result.chosen().words() : whole;
}

json metadata(const ResultReader& result, const ResultPatches& patches, const ExportRules& rules) {
  const Box box = bounding_box(patches.vertices);
  const double unit_m = crs_unit_m(result);
  const Vec3 low = (box.low + patches.origin) / unit_m, high = (box.high + patches.origin) / unit_m;
  json about{{"title", title(result, rules)},
             {"geographicalExtent", {low.x, low.y, low.z, high.x, high.y, high.z}}};
  if (const auto crs = reference_system(result.text_attribute("crs")); !crs.empty())
    about["referenceSystem"] = crs;
  return about;
}

void write_patches(const ResultReader& result, const ExportRules& rules,
                   const ExportTarget& target) {
  const ResultPatches patches(result);
  const SurfaceValues values(result, rules);
  const auto surface = result.integers("patch_surface");
  // In the unit of the map that is named.
  const double unit_m = crs_unit_m(result), step = grid_m / unit_m;
  const Vec3 origin = patches.origin / unit_m;
  json city{
      {"type", "CityJSON"},
      {"version", "2.0"},
      {"metadata", metadata(result, patches, rules)},
      {"transform", {{"scale", {step, step, step}}, {"translate", {origin.x, origin.y, origin.z}}}},
      {"CityObjects", json::object()},
      {"vertices", vertices(patches)}};
  const auto objects = city_objects(result, patches);
  for (std::size_t k = 0; k < objects.size(); ++k) {
    if (objects[k].patches.empty()) continue;
    json attributes = json::object();
    for (const auto& [name, value] : values.of(objects[k].patches)) attributes[name] = value;
    city["CityObjects"][patches.object_names[k]] = {
        {"type", object_type(objects[k].kinds)},
        {"attributes", std::move(attributes)},
        {"geometry", json::array({geometry(objects[k], patches, surface, values)})}};
  }
  target.stream << city.dump(-1, ' ', false, json::error_handler_t::replace) << "\n";
}

}  // namespace

std::string surface_type(Surface kind, Vec3 normal) {
  switch (kind) {
    case Surface::wall:
      return "WallSurface";
    case Surface::roof:
      return "RoofSurface";
    case Surface::ground:
      return "TrafficArea";
    case Surface::window:
      return "Window";
    case Surface::floor:
      return "GroundSurface";
    case Surface::other:
      break;
  }
  return normal.z < 0 ? "OuterCeilingSurface" : "OuterFloorSurface";
}

std::string reference_system(const std::string& crs) {
  static const Pattern epsg(".*EPSG.*?([0-9]+)", Pattern::Letters::of_any_case);
  const auto found = epsg.whole(crs);
  return found ? "https://www.opengis.net/def/crs/EPSG/0/" + (*found)[1].text : std::string();
}

void export_cityjson(const ResultReader& result, const ExportRules& rules,
                     const ExportTarget& target) {
  rules.model.empty() ? write_patches(result, rules, target)
                      : write_model_with_values(result, rules, target);
}

}  // namespace sunload
