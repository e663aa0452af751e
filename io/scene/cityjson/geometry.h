// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Boundaries, semantics and materials of one CityJSON geometry.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geo/mesh/mesh.h"
#include "io/scene/base/from_file.h"

namespace sunload {

/// What a message about a geometry names.
struct GeometryPlace {
  std::string file;
  int line = 0;  ///< of a feature; 0 = the file is one document
  std::string object;
  std::size_t geometry = 0;
  const char* what = "geometry";  ///< or "template"

  [[noreturn]] void fail(const std::string& problem, const std::string& why = {}) const;
  [[noreturn]] void fail_at_surface(std::size_t surface, const std::string& problem,
                                    const std::string& why = {}) const;
};

/// The member of a JSON object, or null if it is missing or null.
const nlohmann::json* find_member(const nlohmann::json& object, const char* name);

/// A list of N numbers, or nothing where `list` is null or anything else.
template <std::size_t N>
std::optional<std::array<double, N>> numbers(const nlohmann::json* list) {
  if (list == nullptr || !list->is_array() || list->size() != N) return std::nullopt;
  std::array<double, N> values{};
  for (std::size_t i = 0; i < N; ++i) {
    if (!(*list)[i].is_number()) return std::nullopt;
    values[i] = (*list)[i].get<double>();
  }
  return values;
}

/// File from stored: `scale · vertex + translate`.
struct VertexTransform {
  Vec3 scale{1, 1, 1};
  Vec3 translate;
};

/// The vertex list of a document; positions enter a model when they are first used.
class CityVertices {
 public:
  /// `list` may be null: a document without vertices. It must outlive this object.
  CityVertices(const nlohmann::json* list, const VertexTransform& transform,
               const SceneFromFile* scene_from_file, const GeometryPlace& place);
  std::size_t size() const;
  /// Position in the frame of the scene; without `scene_from_file` in that of the file.
  Vec3 position(std::size_t index, const GeometryPlace& place) const;
  /// Index in `target` of the vertex that `index` means; always of the same `target`.
  std::int32_t use(const nlohmann::json& index, PolygonModel& target, const GeometryPlace& place,
                   std::size_t surface);

 private:
  const nlohmann::json* list_;
  VertexTransform transform_;
  const SceneFromFile* scene_from_file_;
  std::vector<std::int32_t> index_in_model_;
};

/// Materials of the document that a geometry belongs to.
struct CityMaterials {
  std::vector<MaterialId> ids;  ///< by their index in the document
  std::string default_theme;
};

/// How many lists lie around the list of surfaces in the `boundaries` of a geometry that has
/// surfaces.
int lists_around_surfaces(const std::string& geometry_type);

/// MultiSurface … CompositeSolid, which have surfaces.
bool has_surfaces(const std::string& geometry_type);
/// Solid, MultiSolid, CompositeSolid.
bool is_solid(const std::string& geometry_type);

/// Appends the polygons of a geometry that has surfaces. `facts` hold the object and the kind
/// of surface where the semantics tell none. Throws InputError, naming object and surface.
void append_geometry(const nlohmann::json& geometry, CityVertices& vertices,
                     const CityMaterials& materials, PolygonModel::Facts facts,
                     const GeometryPlace& place, PolygonModel& target, NoteCounter& notes);

}  // namespace sunload
