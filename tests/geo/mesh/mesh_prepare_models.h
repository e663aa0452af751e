// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small polygon models for the tests of mesh preparation.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "geo/mesh/mesh_prepare.h"

namespace sunload::test {

/// The same ring walked the other way: its face looks the other way.
inline std::vector<Vec3> reversed(std::vector<Vec3> ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

class ModelBuilder {
 public:
  explicit ModelBuilder(std::string source = "test.obj") { model_.source = std::move(source); }

  /// Begins a new object; polygons added from now on belong to it.
  ModelBuilder& object(const std::string& name, const std::string& kind = "") {
    model_.object_names.push_back(name);
    model_.object_kinds.push_back(kind);
    return *this;
  }
  /// Kind of surface and sides of the polygons added from now on.
  ModelBuilder& with(Surface surface, Sides sides = Sides::one) {
    surface_ = surface;
    sides_ = sides;
    return *this;
  }
  ModelBuilder& city() {
    model_.is_city_format = true;
    return *this;
  }
  /// Each ring gets vertices of its own, as a soup of faces would.
  ModelBuilder& polygon(const std::vector<std::vector<Vec3>>& rings) {
    std::vector<std::vector<std::int32_t>> indices;
    for (const auto& ring : rings) {
      auto& list = indices.emplace_back();
      for (const auto& p : ring) {
        list.push_back(static_cast<std::int32_t>(model_.vertices.size()));
        model_.vertices.push_back(p);
      }
    }
    PolygonModel::Facts facts;
    facts.object = make_id<ObjectId>(model_.object_names.size() - 1);
    facts.surface = surface_;
    facts.sides = sides_;
    model_.add_polygon(indices, facts);
    return *this;
  }
  ModelBuilder& ring(std::vector<Vec3> points) { return polygon({std::move(points)}); }

  /// Six quads, outward.
  ModelBuilder& box(Vec3 a, Vec3 b) {
    for (const auto& face : box_faces(a, b)) ring(face);
    return *this;
  }
  /// The same without the bottom; `apart`: by so much the top lies above the walls.
  ModelBuilder& walls_and_roof(Vec3 a, Vec3 b, double apart = 0) {
    const auto faces = box_faces(a, b);
    for (std::size_t k = 2; k < faces.size(); ++k) ring(faces[k]);
    return ring(box_faces(a, b + Vec3{0, 0, apart})[1]);
  }
  /// bottom, top, south (y low), north, west (x low), east.
  static std::vector<std::vector<Vec3>> box_faces(Vec3 a, Vec3 b) {
    return {{{a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}},
            {{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}},
            {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}},
            {{a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}},
            {{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}},
            {{b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}}};
  }
  /// Applies `f` to all vertices so far.
  ModelBuilder& moved(const std::function<Vec3(Vec3)>& f) {
    for (auto& p : model_.vertices) p = f(p);
    return *this;
  }
  PolygonModel& model() { return model_; }
  PreparedMesh prepared(const PrepareRules& rules = {}) const { return prepare(model_, rules); }

 private:
  PolygonModel model_;
  Surface surface_ = Surface::other;
  Sides sides_ = Sides::one;
};

inline double area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) sum += mesh.area_m2(t);
  return sum;
}

/// Signed volume of all triangles together.
inline double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    sum += dot(mesh.corner(t, 0) - mesh.corner(0, 0), mesh.area_vector2(t)) / 6;
  }
  return sum;
}

inline double area_of(const PreparedMesh& p, Surface surface) {
  return p.report.area_m2[static_cast<std::size_t>(surface)];
}

}  // namespace sunload::test
