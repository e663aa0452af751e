// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Closed solids of real city models: volume and areas of the prepared mesh beside a computation
// on the polygons of the raw JSON that shares no code with readers or preparation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "geo/mesh/mesh_prepare.h"
#include "io/scene/file.h"
#include "tests/support/real_models.h"

namespace sunload {
namespace {

using nlohmann::json;
using Point = std::array<double, 3>;

constexpr double accuracy = 1e-6;  // of volumes and areas: the promise

/// What is known of one body: volume [m3], areas [m2], and how far its polygons are from planes.
struct Body {
  double volume = 0, area = 0, wall = 0, roof = 0;
  double slack_m3 = 0;  ///< what the choice of diagonals in polygons that are not flat can change
  double slack_m2 = 0;
  bool has_kinds = false;  ///< the file says what wall and roof are
};
using CityBodies = std::map<std::string, Body>;

Point minus(Point a, Point b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point times(Point a, Point b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double inner(Point a, Point b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Half the sum of cross products of a closed line (Newell), about its own first point.
Point area_vector(const std::vector<Point>& ring) {
  Point sum{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point c = times(minus(ring[i], ring[0]), minus(ring[(i + 1) % ring.size()], ring[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k] / 2;
  }
  return sum;
}

/// A document of CityJSON, or a line of a sequence with its header's transform.
class Document {
 public:
  Document(const json& text, const json& header) : text_(text) {
    const auto transform = header.value("transform", json::object());
    scale_ = transform.value("scale", std::vector<double>{1, 1, 1});
    translate_ = transform.value("translate", std::vector<double>{0, 0, 0});
  }

  /// The solids of an object in its finest level of detail that are closed in the file.
  void add_bodies(CityBodies& bodies) const {
    for (const auto& [id, object] : text_.at("CityObjects").items()) {
      const auto geometries = object.value("geometry", json::array());
      const auto level = [](const json& g) {
        const auto lod = g.value("lod", json("0"));
        return lod.is_string() ? std::stod(lod.get<std::string>()) : lod.get<double>();
      };
      double finest = -1;
      for (const auto& g : geometries) finest = std::max(finest, level(g));
      std::size_t of_finest = 0, solid = 0;
      for (std::size_t g = 0; g < geometries.size(); ++g) {
        if (level(geometries[g]) != finest) continue;
        ++of_finest;
        if (geometries[g].value("type", "") == "Solid") solid = g + 1;
      }
      // One solid and nothing else: the object's mesh is that solid.
      if (of_finest == 1 && solid > 0 && is_closed(geometries[solid - 1]))
        bodies[id] = body_of(geometries[solid - 1]);
    }
  }

 private:
  Point vertex(const json& index) const {
    const auto& v = text_.at("vertices").at(index.get<std::size_t>());
    return {v[0].get<double>() * scale_[0] + translate_[0],
            v[1].get<double>() * scale_[1] + translate_[1],
            v[2].get<double>() * scale_[2] + translate_[2]};
  }

  /// Every edge, by the place of its ends, is walked once each way.
  bool is_closed(const json& solid) const {
    std::map<std::pair<Point, Point>, int> walked;
    for (const auto& shell : solid.at("boundaries"))
      for (const auto& surface : shell)
        for (const auto& ring : surface)
          for (std::size_t i = 0; i < ring.size(); ++i) {
            const Point a = vertex(ring[i]), b = vertex(ring[(i + 1) % ring.size()]);
            if (a != b) ++walked[{a, b}];
          }
    return std::all_of(walked.begin(), walked.end(), [&](const auto& entry) {
      const auto back = walked.find({entry.first.second, entry.first.first});
      return entry.second == 1 && back != walked.end() && back->second == 1;
    });
  }

  static std::string kind_of(const json& solid, std::size_t shell, std::size_t surface) {
    const auto semantics = solid.value("semantics", json::object());
    const auto values = semantics.value("values", json());
    if (!values.is_array() || shell >= values.size() || !values[shell].is_array() ||
        surface >= values[shell].size() || !values[shell][surface].is_number())
      return {};
    return semantics.at("surfaces").at(values[shell][surface].get<std::size_t>()).at("type");
  }

  Body body_of(const json& solid) const {
    Body body;
    body.has_kinds = true;
    const Point about = vertex(solid.at("boundaries")[0][0][0][0]);
    const auto& shells = solid.at("boundaries");
    for (std::size_t s = 0; s < shells.size(); ++s) {
      double volume = 0;
      for (std::size_t f = 0; f < shells[s].size(); ++f) {
        const auto [area, share] = add_surface(shells[s][f], about, body);
        volume += share;
        const auto kind = kind_of(solid, s, f);
        if (kind == "WallSurface") body.wall += area;
        if (kind == "RoofSurface") body.roof += area;
        if (kind.empty()) body.has_kinds = false;
      }
      // Inner shells are hollow, however they are wound.
      body.volume += (s == 0 ? 1 : -1) * std::abs(volume);
    }
    return body;
  }

  /// Area of a polygon with holes, and its share of the volume by the divergence theorem.
  std::pair<double, double> add_surface(const json& rings, Point about, Body& body) const {
    Point vector{};
    std::vector<Point> corners;
    for (const auto& ring : rings) {
      std::vector<Point> points;
      for (const auto& index : ring) points.push_back(minus(vertex(index), about));
      const Point part = area_vector(points);
      for (std::size_t k = 0; k < 3; ++k) vector[k] += part[k];
      corners.insert(corners.end(), points.begin(), points.end());
    }
    const double area = std::sqrt(inner(vector, vector));
    Point middle{};
    for (const auto& p : corners)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / static_cast<double>(corners.size());
    double offset = 0, around = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (area > 0)
        offset = std::max(offset, std::abs(inner(minus(corners[i], middle), vector)) / area);
      const Point side = minus(corners[(i + 1) % corners.size()], corners[i]);
      around += std::sqrt(inner(side, side));
    }
    // Whatever the diagonals, the surface stays within `offset` of the plane; triangles that lean
    // by it add at most its product with the lengths of the edges.
    if (corners.size() > 3) {
      body.slack_m3 += 2 * offset * area;
      body.slack_m2 += offset * around;
    }
    body.area += area;
    return {area, inner(middle, vector) / 3};
  }

  const json& text_;
  std::vector<double> scale_, translate_;
};

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

CityBodies bodies_of_file(const std::filesystem::path& path) {
  CityBodies bodies;
  if (path.extension() != ".jsonl") {
    const auto document = json::parse(text_of(path));
    Document(document, document).add_bodies(bodies);
    return bodies;
  }
  std::istringstream lines(text_of(path));
  json header;
  for (std::string line; std::getline(lines, line);) {
    const auto document = json::parse(line);
    if (header.is_null()) header = document;
    Document(document, header).add_bodies(bodies);
  }
  return bodies;
}

/// The same of the prepared mesh.
CityBodies bodies_of_mesh(const Mesh& mesh) {
  CityBodies bodies;
  std::map<std::int32_t, Vec3> about;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto object = mesh.triangle_object[t];
    const Vec3 origin = about.try_emplace(object.value, mesh.corner(t, 0)).first->second;
    auto& body = bodies[mesh.object_names[object.index()]];
    const double area = mesh.area_m2(t);
    body.volume += dot(mesh.corner(t, 0) - origin, mesh.area_vector2(t)) / 6;
    body.area += area;
    if (mesh.triangle_surface[t] == Surface::wall) body.wall += area;
    if (mesh.triangle_surface[t] == Surface::roof) body.roof += area;
  }
  return bodies;
}

/// What was compared, and what did not agree.
struct Comparison {
  std::size_t bodies = 0, flat = 0, volumes_within = 0, areas_within = 0;
  std::vector<std::string> wrong;

  void add(const std::string& name, const Body& raw, const Body& mesh) {
    ++bodies;
    if (raw.slack_m3 <= accuracy * raw.volume) ++flat;
    volumes_within += std::abs(mesh.volume - raw.volume) <= accuracy * raw.volume;
    areas_within += std::abs(mesh.area - raw.area) <= accuracy * raw.area;
    check(name + ": volume", raw.volume, mesh.volume, raw.slack_m3);
    check(name + ": area", raw.area, mesh.area, raw.slack_m2);
    if (!raw.has_kinds) return;
    check(name + ": walls", raw.wall, mesh.wall, raw.slack_m2);
    check(name + ": roofs", raw.roof, mesh.roof, raw.slack_m2);
  }

 private:
  void check(const std::string& what, double raw, double mesh, double slack) {
    if (std::abs(mesh - raw) <= accuracy * raw + slack) return;
    std::ostringstream text;
    text.precision(10);
    text << what << " " << raw << " in the file, " << mesh << " in the mesh, slack " << slack;
    wrong.push_back(text.str());
  }
};

Comparison compared(const CityBodies& raw, const Mesh& mesh) {
  const auto prepared = bodies_of_mesh(mesh);
  Comparison comparison;
  for (const auto& [name, body] : raw) {
    const auto found = prepared.find(name);
    if (found != prepared.end()) comparison.add(name, body, found->second);
  }
  return comparison;
}

std::vector<std::filesystem::path> city_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(test::shared_path("data/city"))) {
    const auto name = entry.path().filename().string();
    if (name.ends_with(".city.json") || name.ends_with(".city.jsonl"))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(CitySolids, VolumesAndAreasAreThoseOfThePolygons) {
  SUNLOAD_NEEDS_MODEL("data/city");
  std::size_t bodies = 0;
  for (const auto& file : city_files()) {
    const auto raw = bodies_of_file(file);
    if (raw.empty()) continue;
    const auto prepared = prepare(read_scene_file(file.string(), {}), {});
    const auto comparison = compared(raw, prepared.mesh);
    bodies += comparison.bodies;
    std::printf(
        "%-44s %4zu closed solids compared of %4zu, %4zu of flat polygons; within 1e-6: volume "
        "%4zu, area %4zu\n",
        file.filename().c_str(), comparison.bodies, raw.size(), comparison.flat,
        comparison.volumes_within, comparison.areas_within);
    for (const auto& wrong : comparison.wrong) ADD_FAILURE() << file.filename() << " " << wrong;
  }
  EXPECT_GT(bodies, 200u) << "the folder has more";
}

// The twin: a triangle less, or one that is turned over, does not pass.
TEST(CitySolids, APlantedFaultIsRefused) {
  SUNLOAD_NEEDS_MODEL("data/city");
  const auto file = test::shared_path("data/city/lod2_100_buildings_v11_epsg3068.city.json");
  const auto raw = bodies_of_file(file);
  auto mesh = prepare(read_scene_file(file, {}), {}).mesh;
  ASSERT_TRUE(compared(raw, mesh).wrong.empty());
  const auto is_roof_of_solid = [&](std::size_t t) {
    const auto found = raw.find(mesh.object_names[mesh.triangle_object[t].index()]);
    return mesh.triangle_surface[t] == Surface::roof && found != raw.end() &&
           found->second.has_kinds;
  };
  std::size_t roof = 0;
  while (roof < mesh.triangle_count() && !is_roof_of_solid(roof)) ++roof;
  ASSERT_LT(roof, mesh.triangle_count());
  mesh.triangle_surface[roof] = Surface::wall;
  EXPECT_EQ(compared(raw, mesh).wrong.size(), 2u) << "walls and roofs";
  mesh.triangle_surface[roof] = Surface::roof;
  std::swap(mesh.triangles[roof][0], mesh.triangles[roof][1]);
  EXPECT_EQ(compared(raw, mesh).wrong.size(), 1u) << "volume";
  mesh.triangles[roof] = {0, 0, 0};
  EXPECT_EQ(compared(raw, mesh).wrong.size(), 3u) << "volume, area and roofs";
}

}  // namespace
}  // namespace sunload
