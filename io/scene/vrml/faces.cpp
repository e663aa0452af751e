// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/vrml/faces.h"

#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodes/SoNodes.h>
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace sunload {

using coin::affine;
using coin::as;
using coin::vec;

namespace {

constexpr double extruded_at_least = 2e5;  ///< points of all Extrusions: seconds in Coin …
constexpr double extruded_per_byte = 0.3;  ///< … and of large files

void turn_faces(ShapeFaces& shape) {
  for (auto& face : shape.faces) std::reverse(face.begin(), face.end());
}

/// The points of the faces; few of a table that many shapes share, where they use few.
void take_points(const SoMFVec3f& field, ShapeFaces& shape) {
  std::size_t corners = 0;
  for (const auto& face : shape.faces) corners += face.size();
  if (corners >= static_cast<std::size_t>(field.getNum())) {
    for (int i = 0; i < field.getNum(); ++i) shape.points.push_back(vec(field[i]));
    return;
  }
  std::unordered_map<std::int32_t, std::int32_t> place;
  for (auto& face : shape.faces) {
    for (auto& corner : face) {
      const auto [entry, is_new] =
          place.try_emplace(corner, static_cast<std::int32_t>(shape.points.size()));
      if (is_new) shape.points.push_back(vec(field[corner]));
      corner = entry->second;
    }
  }
}

/// Triangles as Coin makes them, in the frame of the shape.
ShapeFaces triangles_of(SoNode* node) {
  ShapeFaces shape;
  SoCallbackAction action;
  action.addTriangleCallback(
      SoShape::getClassTypeId(),
      [](void* data, SoCallbackAction* from, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
         const SoPrimitiveVertex* c) {
        auto& faces = *static_cast<ShapeFaces*>(data);
        const auto first = static_cast<std::int32_t>(faces.points.size());
        const Affine here = affine(from->getModelMatrix());
        for (const auto* v : {a, b, c}) faces.points.push_back(here(vec(v->getPoint())));
        faces.faces.push_back({first, first + 1, first + 2});
      },
      &shape);
  action.apply(node);
  return shape;
}

/// Faces that are strips become triangles; every other one runs the other way around.
void cut_strips(ShapeFaces& shape) {
  std::vector<std::vector<std::int32_t>> triangles;
  for (const auto& strip : shape.faces) {
    for (std::size_t i = 0; i + 2 < strip.size(); ++i)
      triangles.push_back({strip[i], strip[i + 1 + i % 2], strip[i + 2 - i % 2]});
  }
  shape.faces = std::move(triangles);
  shape.face_material.clear();
}

const SoMFVec3f* coordinates_of(SoVertexShape& set, const VrmlFaces::Hints& hints) {
  auto* own = as<SoVertexProperty>(set.vertexProperty.getValue());
  if (own != nullptr && own->vertex.getNum() > 0) return &own->vertex;
  return hints.coordinates == nullptr ? nullptr : &hints.coordinates->point;
}

}  // namespace

VrmlFaces::VrmlFaces(NoteCounter& notes, const VrmlFiles& files, PlaceOf place_of)
    : notes_(notes), files_(files), place_of_(std::move(place_of)) {}

void VrmlFaces::refuse(const SoNode& node, const std::string& what, const std::string& why) const {
  throw InputError(place_of_(node), what, why);
}

std::optional<ShapeFaces> VrmlFaces::of_vrml97(SoNode* node) {
  if (auto* box = as<SoVRMLBox>(node)) return vrml_box(vec(box->size.getValue()));
  if (auto* sphere = as<SoVRMLSphere>(node)) return vrml_sphere(sphere->radius.getValue());
  if (auto* cone = as<SoVRMLCone>(node)) {
    return vrml_cone(cone->bottomRadius.getValue(), cone->height.getValue(),
                     {cone->side.getValue() != 0, cone->bottom.getValue() != 0});
  }
  if (auto* c = as<SoVRMLCylinder>(node)) {
    return vrml_cylinder(
        c->radius.getValue(), c->height.getValue(),
        {c->side.getValue() != 0, c->bottom.getValue() != 0, c->top.getValue() != 0});
  }
  if (auto* set = as<SoVRMLIndexedFaceSet>(node)) return face_set(*set);
  if (auto* grid = as<SoVRMLElevationGrid>(node)) return elevation_grid(*grid);
  if (auto* extrusion = as<SoVRMLExtrusion>(node)) {
    extruded_ += static_cast<double>(extrusion->crossSection.getNum()) * extrusion->spine.getNum();
    if (extruded_ > extruded_at_least + extruded_per_byte * static_cast<double>(files_.bytes()))
      refuse(*node, "Extrusions have too many points", "too many for the size of the file");
    auto shape = triangles_of(extrusion);
    shape.is_two_sided = extrusion->solid.getValue() == 0;
    return shape;
  }
  notes_.count(std::string(node->getTypeId().getName().getString()) +
               " shapes left out: they have no surface");
  return std::nullopt;
}

ShapeFaces VrmlFaces::face_set(SoVRMLIndexedFaceSet& node) {
  auto* coordinates = as<SoVRMLCoordinate>(node.coord.getValue());
  ShapeFaces shape;
  add_faces(node, node.coordIndex, coordinates == nullptr ? 0 : coordinates->point.getNum(), shape);
  if (coordinates != nullptr) take_points(coordinates->point, shape);
  if (node.color.getValue() != nullptr) notes_.count("colours per face or vertex ignored");
  if (node.ccw.getValue() == 0) turn_faces(shape);
  shape.is_two_sided = node.solid.getValue() == 0;
  return shape;
}

/// Faces by lists of indices, each closed by −1, into a table of `count` points.
void VrmlFaces::add_faces(const SoNode& node, const SoMFInt32& indices, std::int32_t count,
                          ShapeFaces& shape) {
  std::vector<std::int32_t> face;
  std::int32_t number = 0;
  const auto finish = [&] {
    if (face.size() >= 3) {
      shape.faces.push_back(face);
      shape.face_material.push_back(number);
    } else if (!face.empty()) {
      notes_.count("faces of fewer than 3 corners left out");
    }
    ++number;
    face.clear();
  };
  for (int i = 0; i < indices.getNum(); ++i) {
    const std::int32_t index = indices[i];
    if (index == -1) {
      finish();
    } else if (index < 0 || index >= count) {
      refuse(node, fmt::format("coordIndex {} is out of range", index),
             fmt::format("{} points are there, counted from 0", count));
    } else {
      face.push_back(index);
    }
  }
  finish();
}

ShapeFaces VrmlFaces::elevation_grid(SoVRMLElevationGrid& node) {
  const std::int32_t nx = node.xDimension.getValue(), nz = node.zDimension.getValue();
  if (nx < 0 || nz < 0 || static_cast<std::int64_t>(nx) * nz != node.height.getNum()) {
    refuse(node, "ElevationGrid has another number of heights",
           fmt::format("{} × {} points, {} heights", nx, nz, node.height.getNum()));
  }
  std::vector<double> heights;
  for (int i = 0; i < node.height.getNum(); ++i) heights.push_back(node.height[i]);
  auto shape =
      vrml_elevation_grid(heights, {nx, nz, node.xSpacing.getValue(), node.zSpacing.getValue()});
  if (node.ccw.getValue() == 0) turn_faces(shape);
  shape.is_two_sided = node.solid.getValue() == 0;
  return shape;
}

std::optional<ShapeFaces> VrmlFaces::of_inventor(SoNode* node, const Hints& hints) {
  if (auto* cube = as<SoCube>(node))
    return vrml_box({cube->width.getValue(), cube->height.getValue(), cube->depth.getValue()});
  if (auto* sphere = as<SoSphere>(node)) return vrml_sphere(sphere->radius.getValue());
  if (auto* cone = as<SoCone>(node)) {
    return vrml_cone(cone->bottomRadius.getValue(), cone->height.getValue(),
                     {cone->hasPart(SoCone::SIDES) != 0, cone->hasPart(SoCone::BOTTOM) != 0});
  }
  if (auto* c = as<SoCylinder>(node)) {
    return vrml_cylinder(c->radius.getValue(), c->height.getValue(),
                         {c->hasPart(SoCylinder::SIDES) != 0, c->hasPart(SoCylinder::BOTTOM) != 0,
                          c->hasPart(SoCylinder::TOP) != 0});
  }
  ShapeFaces shape;
  if (auto* set = as<SoVertexShape>(node)) {
    const auto* coordinates = coordinates_of(*set, hints);
    const std::int32_t count = coordinates == nullptr ? 0 : coordinates->getNum();
    add_vertex_shape(node, count, shape);
    if (coordinates != nullptr) take_points(*coordinates, shape);
  }
  if (shape.faces.empty()) {
    notes_.count(std::string(node->getTypeId().getName().getString()) +
                 " shapes left out: no faces are read of them");
  }
  if (hints.is_clockwise) turn_faces(shape);
  shape.is_two_sided = !hints.is_solid;
  return shape;
}

/// Open Inventor's sets of faces, strips and meshes. They are not left to Coin, which does not
/// ask whether the points are there.
void VrmlFaces::add_vertex_shape(SoNode* node, std::int32_t count, ShapeFaces& shape) {
  if (auto* set = as<SoIndexedFaceSet>(node)) {
    add_faces(*node, set->coordIndex, count, shape);
  } else if (auto* strips = as<SoIndexedTriangleStripSet>(node)) {
    add_faces(*node, strips->coordIndex, count, shape);
    cut_strips(shape);
  } else if (auto* faces = as<SoFaceSet>(node)) {
    add_rows(*node, faces->numVertices, faces->startIndex.getValue(), count, shape);
  } else if (auto* strip_set = as<SoTriangleStripSet>(node)) {
    add_rows(*node, strip_set->numVertices, strip_set->startIndex.getValue(), count, shape);
    cut_strips(shape);
  } else if (auto* mesh = as<SoQuadMesh>(node)) {
    add_mesh(*mesh, count, shape);
  }
}

/// Faces by their numbers of corners, which lie one after another; −1: all that are left.
void VrmlFaces::add_rows(const SoNode& node, const SoMFInt32& lengths, std::int32_t first,
                         std::int32_t count, ShapeFaces& shape) {
  for (int row = 0; row < lengths.getNum(); ++row) {
    const std::int32_t length = lengths[row] == -1 ? count - first : lengths[row];
    if (first < 0 || first > count || length < 0 || length > count - first) {
      refuse(node, fmt::format("a face of {} corners has no points", lengths[row]),
             fmt::format("{} points are there, it begins with the one of number {}", count, first));
    }
    if (length >= 3) {
      auto& face = shape.faces.emplace_back();
      for (std::int32_t k = 0; k < length; ++k) face.push_back(first + k);
    } else {
      notes_.count("faces of fewer than 3 corners left out");
    }
    first += length;
  }
}

void VrmlFaces::add_mesh(const SoQuadMesh& node, std::int32_t count, ShapeFaces& shape) {
  const std::int32_t first = node.startIndex.getValue();
  const std::int32_t columns = node.verticesPerRow.getValue();
  const std::int32_t rows = node.verticesPerColumn.getValue();
  if (first < 0 || first > count || columns < 1 || rows < 1 ||
      static_cast<std::int64_t>(columns) * rows > count - first) {
    refuse(node, fmt::format("a mesh of {} × {} points has no points", columns, rows),
           fmt::format("{} points are there, it begins with the one of number {}", count, first));
  }
  for (std::int32_t r = 0; r + 1 < rows; ++r) {
    for (std::int32_t c = 0; c + 1 < columns; ++c) {
      const std::int32_t a = first + r * columns + c, b = a + columns;
      shape.faces.push_back({a, b, b + 1});
      shape.faces.push_back({a, b + 1, a + 1});
    }
  }
}

}  // namespace sunload
