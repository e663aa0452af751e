// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/cityjson/templates.h"

#include <algorithm>
#include <array>
#include <limits>

namespace sunload {

namespace {

using nlohmann::json;

/// Instances let a small file ask for any amount of memory: corners of polygons that they may
/// make, as such and per byte of the file (an instance takes more than 100 bytes, so that
/// large files may use templates of some 800 corners throughout). 8 million corners of small
/// polygons take 0.4 GB, and as much again while tables grow.
constexpr std::size_t corners_at_least = 1'000'000;
constexpr std::size_t corners_per_byte = 8;

/// Row-major 3×4 part of a transformation matrix.
struct Affine {
  std::array<double, 12> m{};

  Vec3 operator()(Vec3 p) const {
    return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
            m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
            m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
  }
  /// Mirrors turn the winding of polygons.
  bool is_mirror() const {
    return dot({m[0], m[1], m[2]}, cross({m[4], m[5], m[6]}, {m[8], m[9], m[10]})) < 0;
  }
};

Affine affine_of(const json& instance, const GeometryPlace& place) {
  const auto matrix = numbers<16>(find_member(instance, "transformationMatrix"));
  if (!matrix) place.fail("has no transformationMatrix of 16 numbers");
  const auto& m = *matrix;
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
    place.fail("has a transformationMatrix whose last row is not 0 0 0 1",
               "it is to be listed row by row");
  }
  Affine affine;
  std::copy_n(m.begin(), affine.m.size(), affine.m.begin());
  return affine;
}

/// The vertex of the document that an instance stands on.
Vec3 reference_point(const json& instance, const CityVertices& vertices,
                     const GeometryPlace& place) {
  const auto* boundaries = find_member(instance, "boundaries");
  if (boundaries == nullptr || !boundaries->is_array() || boundaries->size() != 1 ||
      !(*boundaries)[0].is_number_unsigned() ||
      (*boundaries)[0].get<std::size_t>() >= vertices.size()) {
    place.fail("has no reference point", "boundaries must be one index into vertices");
  }
  return vertices.position((*boundaries)[0].get<std::size_t>(), place);
}

/// Appends the rings and polygons of `shape`, whose vertices begin at `first_vertex` of `target`.
void append_polygons(const PolygonModel& shape, std::int32_t first_vertex, bool is_mirrored,
                     PolygonModel::Facts facts, PolygonModel& target) {
  const auto first_corner = static_cast<std::int64_t>(target.ring_vertex.size());
  const auto first_ring = static_cast<std::int64_t>(target.ring_begin.size()) - 1;
  for (const auto vertex : shape.ring_vertex) target.ring_vertex.push_back(first_vertex + vertex);
  for (std::size_t r = 1; r < shape.ring_begin.size(); ++r) {
    target.ring_begin.push_back(first_corner + shape.ring_begin[r]);
    if (!is_mirrored) continue;
    std::reverse(target.ring_vertex.begin() + first_corner + shape.ring_begin[r - 1],
                 target.ring_vertex.begin() + first_corner + shape.ring_begin[r]);
  }
  for (std::size_t p = 0; p < shape.polygon_count(); ++p) {
    target.polygon_ring.push_back(first_ring + shape.polygon_ring[p + 1]);
    target.facts.push_back(shape.facts[p]);
    auto& polygon = target.facts.back();
    polygon.object = facts.object;
    if (polygon.surface == Surface::other) polygon.surface = facts.surface;
  }
}

}  // namespace

CityTemplates::CityTemplates(const std::string& path, const SceneFromFile& scene_from_file,
                             std::size_t file_bytes)
    : path_(path),
      scene_from_file_(scene_from_file),
      corners_left_(corners_at_least + corners_per_byte * file_bytes) {}

void CityTemplates::set_header(const json& header, const CityMaterials& materials) {
  materials_ = materials;
  const auto* templates = find_member(header, "geometry-templates");
  if (templates == nullptr) return;
  list_ = find_member(*templates, "templates");
  vertices_ = find_member(*templates, "vertices-templates");
  if (list_ != nullptr && list_->is_array()) models_.resize(list_->size());
}

std::size_t CityTemplates::index_of(const json& instance, const GeometryPlace& place) const {
  const auto* index = find_member(instance, "template");
  if (index == nullptr || !index->is_number_unsigned() ||
      index->get<std::size_t>() >= models_.size()) {
    place.fail("names no template", "the file has " + std::to_string(models_.size()));
  }
  // cppcheck-suppress nullPointerRedundantCheck  // fail() does not come back
  return index->get<std::size_t>();
}

const json& CityTemplates::shape_of(const json& instance, const GeometryPlace& place) const {
  const auto index = index_of(instance, place);  // refuses where there is no list
  return (*list_)[index];
}

/// The polygons of a template in its own frame, read when it is first used.
const PolygonModel& CityTemplates::model_of(std::size_t index, const GeometryPlace& place,
                                            NoteCounter& notes) {
  if (!models_[index]) {
    auto made = std::make_unique<PolygonModel>();
    const GeometryPlace template_place{path_, 0, place.object, index, "template"};
    CityVertices vertices(vertices_, {}, nullptr, template_place);
    append_geometry((*list_)[index], vertices, materials_, {}, template_place, *made, notes);
    models_[index] = std::move(made);
  }
  return *models_[index];
}

void CityTemplates::append_instance(const json& instance, const CityVertices& vertices,
                                    PolygonModel::Facts facts, const GeometryPlace& place,
                                    PolygonModel& target, NoteCounter& notes) {
  const auto& shape = model_of(index_of(instance, place), place, notes);
  const auto affine = affine_of(instance, place);
  const auto reference = reference_point(instance, vertices, place);
  constexpr std::size_t most_vertices = std::numeric_limits<std::int32_t>::max();
  if (shape.ring_vertex.size() > corners_left_ ||
      shape.vertices.size() + target.vertices.size() > most_vertices) {
    place.fail("shows a template once too often",
               "the instances of this file make too many polygons for its size");
  }
  corners_left_ -= shape.ring_vertex.size();
  const auto first_vertex = static_cast<std::int32_t>(target.vertices.size());
  for (const auto& vertex : shape.vertices) {
    target.vertices.push_back(reference + scene_from_file_(affine(vertex)));
    if (!is_usable(target.vertices.back())) place.fail("reaches beyond all coordinates on Earth");
  }
  append_polygons(shape, first_vertex, affine.is_mirror(), facts, target);
}

}  // namespace sunload
