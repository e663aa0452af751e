// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Templates of a CityJSON file and the instances that show them.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geo/mesh/mesh.h"
#include "io/scene/base/from_file.h"
#include "io/scene/base/placed_shape.h"
#include "io/scene/cityjson/geometry.h"

namespace sunload {

/// Shapes that are stored once and placed by a matrix and a reference point:
/// file position = matrix · template vertex + reference point.
class CityTemplates {
 public:
  /// What instances may make in all is limited by the size of the file.
  CityTemplates(const std::string& path, const SceneFromFile& scene_from_file,
                std::size_t file_bytes);
  /// `header` must outlive this object; its materials are those of the templates.
  void set_header(const nlohmann::json& header, const CityMaterials& materials);
  /// The geometry that an instance shows; throws InputError if there is none.
  const nlohmann::json& shape_of(const nlohmann::json& instance, const GeometryPlace& place) const;
  void append_instance(const nlohmann::json& instance, const CityVertices& vertices,
                       PolygonModel::Facts facts, const GeometryPlace& place, PolygonModel& target,
                       NoteCounter& notes);

 private:
  std::size_t index_of(const nlohmann::json& instance, const GeometryPlace& place) const;
  const PolygonModel& model_of(std::size_t index, const GeometryPlace& place, NoteCounter& notes);

  std::string path_;
  ShapePlacer placer_;
  const nlohmann::json* list_ = nullptr;
  const nlohmann::json* vertices_ = nullptr;
  CityMaterials materials_;
  std::vector<std::unique_ptr<PolygonModel>> models_;  ///< null until first used
};

}  // namespace sunload
