// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/cityjson/templates.h"

namespace sunload {

namespace {

using nlohmann::json;

Affine affine_of_instance(const json& instance, const GeometryPlace& place) {
  const auto matrix = numbers<16>(find_member(instance, "transformationMatrix"));
  if (!matrix) place.fail("has no transformationMatrix of 16 numbers");
  const auto affine = affine_of(*matrix);
  if (!affine) {
    place.fail("has a transformationMatrix whose last row is not 0 0 0 1",
               "it is to be listed row by row");
  }
  return *affine;
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

}  // namespace

CityTemplates::CityTemplates(const std::string& path, const SceneFromFile& scene_from_file,
                             std::size_t file_bytes)
    : path_(path), placer_(scene_from_file, file_bytes) {}

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
  const auto placed = placer_.append(shape, affine_of_instance(instance, place),
                                     reference_point(instance, vertices, place), facts, target);
  if (placed == Placed::too_many_corners) {
    place.fail("shows a template once too often",
               "the instances of this file make too many polygons for its size");
  }
  if (placed == Placed::beyond_coordinates) place.fail("reaches beyond all coordinates on Earth");
}

}  // namespace sunload
