// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/edit/objects.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include "geo/base/check.h"
#include "geo/mesh/box_tree.h"

namespace sunload {

namespace {

/// Calls `visit` with every place of `ring_vertex` that belongs to the polygon.
template <class Visit>
void each_corner(const PolygonModel& model, std::size_t polygon, const Visit& visit) {
  for (auto r = model.polygon_ring[polygon]; r < model.polygon_ring[polygon + 1]; ++r)
    for (auto k = model.ring_begin[static_cast<std::size_t>(r)];
         k < model.ring_begin[static_cast<std::size_t>(r) + 1]; ++k)
      visit(static_cast<std::size_t>(k));
}

Vec3 vertex(const PolygonModel& model, std::size_t place) {
  return model.vertices[static_cast<std::size_t>(model.ring_vertex[place])];
}

/// The families of the objects that stay, by their new numbers; what belonged to others belongs to
/// nothing.
Families renumbered_families(const Families& families, const std::vector<ObjectId>& renumbered) {
  const auto now = [&](Owner owner) {
    if (owner.object.exists()) owner.object = renumbered[owner.object.index()];
    return owner;
  };
  Families rest;
  for (std::size_t o = 0; o < families.of_object.size(); ++o)
    if (renumbered[o].exists()) rest.of_object.push_back(now(families.of_object[o]));
  rest.bare = families.bare;
  for (BareObject& bare : rest.bare) bare.owner = now(bare.owner);
  return rest;
}

}  // namespace

LooseFace face_of(const PolygonModel& model, std::size_t polygon) {
  LooseFace face{{}, model.facts[polygon]};
  for (auto r = model.polygon_ring[polygon]; r < model.polygon_ring[polygon + 1]; ++r) {
    auto& ring = face.rings.emplace_back();
    for (auto k = model.ring_begin[static_cast<std::size_t>(r)];
         k < model.ring_begin[static_cast<std::size_t>(r) + 1]; ++k)
      ring.push_back(vertex(model, static_cast<std::size_t>(k)));
  }
  return face;
}

std::vector<LooseFace> faces_of(const PolygonModel& model, ObjectId object) {
  std::vector<LooseFace> faces;
  for (std::size_t p = 0; p < model.polygon_count(); ++p)
    if (model.facts[p].object == object) faces.push_back(face_of(model, p));
  return faces;
}

Vec3 area_vector2(const LooseFace& face) {
  Vec3 sum;
  if (face.rings.empty()) return sum;
  const auto& ring = face.rings.front();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return sum;
}

double distance_in_plan(const ObjectExtent& extent, Point2 place) {
  const auto beyond = [](double x, double low, double high) {
    return std::max({low - x, x - high, 0.0});
  };
  return std::hypot(beyond(place.u, extent.box.low.x, extent.box.high.x),
                    beyond(place.v, extent.box.low.y, extent.box.high.y));
}

std::vector<ObjectExtent> extents_of(const PolygonModel& model) {
  std::vector<ObjectExtent> extents(model.object_names.size());
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    Box& box = extents[model.facts[p].object.index()].box;
    each_corner(model, p, [&](std::size_t place) { include(box, vertex(model, place)); });
  }
  return extents;
}

std::vector<ObjectExtent> extents_of(const Mesh& mesh) {
  std::vector<ObjectExtent> extents(mesh.object_names.size());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (const auto v : mesh.triangles[t])
      include(extents[mesh.triangle_object[t].index()].box,
              mesh.origin + mesh.vertices[static_cast<std::size_t>(v)]);
  return extents;
}

ObjectExtent extent_of_all(const std::vector<ObjectExtent>& extents) {
  ObjectExtent all;
  for (const auto& extent : extents) {
    if (extent.is_empty()) continue;
    include(all.box, extent.box.low);
    include(all.box, extent.box.high);
  }
  return all;
}

PolygonModel without_objects(const PolygonModel& model, const ChosenObjects& chosen) {
  SUNLOAD_EXPECT(chosen.size() == model.object_names.size(), "one flag per object");
  PolygonModel rest;
  rest.materials = model.materials;
  rest.source = model.source;
  rest.crs = model.crs;
  rest.is_city_format = model.is_city_format;
  rest.notes = model.notes;
  std::vector<ObjectId> renumbered(chosen.size(), ObjectId::none());
  for (std::size_t o = 0; o < chosen.size(); ++o) {
    if (chosen[o] != 0) continue;
    renumbered[o] = make_id<ObjectId>(rest.object_names.size());
    rest.object_names.push_back(model.object_names[o]);
    rest.object_kinds.push_back(o < model.object_kinds.size() ? model.object_kinds[o] : "");
  }
  rest.families = renumbered_families(model.families, renumbered);
  std::vector<std::int32_t> moved(model.vertices.size(), -1);
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    auto facts = model.facts[p];
    facts.object = renumbered[facts.object.index()];
    if (!facts.object.exists()) continue;
    std::vector<std::vector<std::int32_t>> rings;
    for (auto r = model.polygon_ring[p]; r < model.polygon_ring[p + 1]; ++r) {
      auto& ring = rings.emplace_back();
      for (auto k = model.ring_begin[static_cast<std::size_t>(r)];
           k < model.ring_begin[static_cast<std::size_t>(r) + 1]; ++k) {
        const auto v = static_cast<std::size_t>(model.ring_vertex[static_cast<std::size_t>(k)]);
        if (moved[v] < 0) {
          moved[v] = static_cast<std::int32_t>(rest.vertices.size());
          rest.vertices.push_back(model.vertices[v]);
        }
        ring.push_back(moved[v]);
      }
    }
    rest.add_polygon(rings, facts);
  }
  return rest;
}

void displace_objects(PolygonModel& model, const ChosenObjects& chosen,
                      const std::function<Vec3(Vec3)>& place) {
  SUNLOAD_EXPECT(chosen.size() == model.object_names.size(), "one flag per object");
  std::unordered_map<std::int32_t, std::int32_t> moved;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    if (chosen[model.facts[p].object.index()] == 0) continue;
    each_corner(model, p, [&](std::size_t at) {
      auto& v = model.ring_vertex[at];
      const auto next = static_cast<std::int32_t>(model.vertices.size());
      const auto [found, is_new] = moved.try_emplace(v, next);
      if (is_new) model.vertices.push_back(place(model.vertices[static_cast<std::size_t>(v)]));
      v = found->second;
    });
  }
}

}  // namespace sunload
