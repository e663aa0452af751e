// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small CityGML files, piece by piece.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/support/scene_text.h"

namespace sunload::test {

/// A whole file; `first` comes before its members.
inline std::string city_gml(const std::string& members, const std::string& first = {},
                            const std::string& version = "2.0") {
  const std::string base = "http://www.opengis.net/citygml/";
  return R"(<?xml version="1.0" encoding="UTF-8"?>)"
         "\n<core:CityModel xmlns:core=\"" +
         base + version + R"(" xmlns:gml="http://www.opengis.net/gml" xmlns:bldg=")" + base +
         "building/" + version + R"(" xmlns:xlink="http://www.w3.org/1999/xlink">)" + "\n" + first +
         members + "\n</core:CityModel>\n";
}

inline std::string member(const std::string& object) {
  return "<core:cityObjectMember>" + object + "</core:cityObjectMember>\n";
}

inline std::string element(const std::string& name, const std::string& inside,
                           const std::string& attributes = {}) {
  return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + inside + "</" + name +
         ">";
}

inline std::string envelope(const std::string& srs) {
  return "<gml:boundedBy><gml:Envelope srsName=\"" + srs +
         "\" srsDimension=\"3\"><gml:lowerCorner>0 0 0</gml:lowerCorner></gml:Envelope>"
         "</gml:boundedBy>\n";
}

inline std::string ring(const std::string& positions) {
  return "<gml:LinearRing><gml:posList>" + positions + "</gml:posList></gml:LinearRing>";
}

/// `holes` are lists of positions, too.
inline std::string polygon(const std::string& positions, const std::string& id = {},
                           const std::vector<std::string>& holes = {}) {
  std::string inside = element("gml:exterior", ring(positions));
  for (const auto& hole : holes) inside += element("gml:interior", ring(hole));
  return element("gml:Polygon", inside, id.empty() ? "" : "gml:id=\"" + id + "\"");
}

inline std::string surface_members(const std::vector<std::string>& polygons) {
  std::string all;
  for (const auto& each : polygons) all += element("gml:surfaceMember", each);
  return all;
}

inline std::string multi_surface(const std::vector<std::string>& polygons) {
  return element("gml:MultiSurface", surface_members(polygons));
}

inline std::string link(const std::string& property, const std::string& id) {
  return "<" + property + " xlink:href=\"#" + id + "\"/>";
}

/// Closed lists of positions of a box, outward: floor, roof, south, east, north, west.
inline std::vector<std::string> box_faces(double x, double y, double z, double width, double depth,
                                          double height) {
  const auto p = [&](int i, int j, int k) {
    return std::to_string(x + i * width) + " " + std::to_string(y + j * depth) + " " +
           std::to_string(z + k * height) + " ";
  };
  const auto face = [&](const std::string& a, const std::string& b, const std::string& c,
                        const std::string& d) { return a + b + c + d + a; };
  return {face(p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)),
          face(p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)),
          face(p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)),
          face(p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)),
          face(p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1)),
          face(p(0, 1, 0), p(0, 0, 0), p(0, 0, 1), p(0, 1, 1))};
}

inline std::string solid(const std::vector<std::string>& polygons) {
  return element("gml:Solid", element("gml:exterior",
                                      element("gml:CompositeSurface", surface_members(polygons))));
}

inline std::string box_solid(double x, double y, double z, double width, double depth,
                             double height) {
  std::vector<std::string> polygons;
  for (const auto& face : box_faces(x, y, z, width, depth, height))
    polygons.push_back(polygon(face));
  return solid(polygons);
}

inline std::string building(const std::string& id, const std::string& inside) {
  return member(element("bldg:Building", inside, id.empty() ? "" : "gml:id=\"" + id + "\""));
}

inline const std::string triangle = "0 0 0 1 0 0 0 1 0 0 0 0";
inline const std::string other_triangle = "0 0 5 1 0 5 0 1 5 0 0 5";

/// A model of polygons without holes as CityGML of LoD2, its kinds of surface as semantics.
inline std::string city_gml_of(const PolygonModel& model, const std::string& srs) {
  const auto type_of = [](Surface surface) -> std::string {
    return surface == Surface::wall    ? "WallSurface"
           : surface == Surface::roof  ? "RoofSurface"
           : surface == Surface::floor ? "GroundSurface"
                                       : "";
  };
  std::vector<std::string> boundaries(model.object_names.size()), own(model.object_names.size());
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    std::string positions;
    for (std::int64_t k = 0; k <= ring_size(model, p, 0); ++k) {
      const Vec3 at = corner(model, p, 0, k % ring_size(model, p, 0));
      std::array<char, 100> line{};
      std::snprintf(line.data(), line.size(), "%.17g %.17g %.17g ", at.x, at.y, at.z);
      positions += line.data();
    }
    const auto object = model.facts[p].object.index();
    const auto type = type_of(model.facts[p].surface);
    if (type.empty())
      own[object] += element("gml:surfaceMember", polygon(positions));
    else
      boundaries[object] += element(
          "bldg:boundedBy", element("bldg:" + type, element("bldg:lod2MultiSurface",
                                                            multi_surface({polygon(positions)}))));
  }
  std::string members;
  for (std::size_t o = 0; o < model.object_names.size(); ++o) {
    const auto surface =
        own[o].empty() ? std::string()
                       : element("bldg:lod2MultiSurface", element("gml:MultiSurface", own[o]));
    members += member(element("bldg:" + model.object_kinds[o], boundaries[o] + surface,
                              "gml:id=\"" + model.object_names[o] + "\""));
  }
  return city_gml(members, envelope(srs));
}

inline std::vector<Surface> surfaces_of(const PolygonModel& model) {
  std::vector<Surface> kinds;
  for (const auto& facts : model.facts) kinds.push_back(facts.surface);
  return kinds;
}

}  // namespace sunload::test
