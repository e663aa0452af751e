// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/cityjson/geometry.h"

#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "io/scene/base/city_types.h"

namespace sunload {

namespace {

using nlohmann::json;

/// How many lists lie around the list of surfaces in `boundaries`.
const std::unordered_map<std::string_view, int>& levels_around_surfaces() {
  static const std::unordered_map<std::string_view, int> table{{"MultiSurface", 0},
                                                               {"CompositeSurface", 0},
                                                               {"Solid", 1},
                                                               {"MultiSolid", 2},
                                                               {"CompositeSolid", 2}};
  return table;
}

/// Element of a list that may be shorter than it should be, or missing, or null.
const json* element(const json* list, std::size_t index) {
  if (list == nullptr || !list->is_array() || index >= list->size()) return nullptr;
  const auto& value = (*list)[index];
  return value.is_null() ? nullptr : &value;
}

/// A whole number that is not negative.
std::optional<std::uint64_t> whole_number(const json& value) {
  const auto* number = value.get_ptr<const json::number_unsigned_t*>();
  return number == nullptr ? std::nullopt : std::optional<std::uint64_t>(*number);
}

std::string shown(const json& value) {
  constexpr std::size_t longest = 40;  // characters in a message
  return value.is_structured()
             ? std::string(value.type_name())
             : value.dump(-1, ' ', false, json::error_handler_t::replace).substr(0, longest);
}

/// The values of one theme, per surface or one for all.
struct ThemeValues {
  const json* values = nullptr;
  const json* value = nullptr;
};

ThemeValues theme_values(const json& geometry, const CityMaterials& materials, NoteCounter& notes) {
  const auto* themes = find_member(geometry, "material");
  if (themes == nullptr || !themes->is_object() || themes->empty()) return {};
  auto chosen = themes->find(materials.default_theme);
  if (chosen == themes->end()) chosen = themes->begin();
  notes.say("material theme '" + chosen.key() + "' taken");
  if (themes->size() > 1) notes.count("geometries have further material themes, not taken");
  return {find_member(chosen.value(), "values"), find_member(chosen.value(), "value")};
}

class GeometryReader {
 public:
  GeometryReader(const json& geometry, CityVertices& vertices, const CityMaterials& materials,
                 PolygonModel::Facts facts, const GeometryPlace& place, PolygonModel& target,
                 NoteCounter& notes)
      : vertices_(vertices),
        materials_(materials),
        facts_(facts),
        place_(place),
        target_(target),
        notes_(notes),
        theme_(theme_values(geometry, materials, notes)) {
    read_semantics(geometry);
  }

  /// Surfaces lie `levels` lists deep; semantics and materials are nested alike.
  void walk(const json& boundaries, int levels, const json* semantics, const json* material) {
    if (!boundaries.is_array()) {
      place_.fail("boundaries are no list", "found " + shown(boundaries));
    }
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
      const auto *inner_semantics = element(semantics, i), *inner_material = element(material, i);
      if (levels == 0) {
        read_surface(boundaries[i], inner_semantics, inner_material);
        ++surface_;
      } else {
        walk(boundaries[i], levels - 1, inner_semantics, inner_material);
      }
    }
  }

  const json* semantic_values() const { return semantic_values_; }
  const json* material_values() const { return theme_.values; }

 private:
  void read_semantics(const json& geometry) {
    const auto* semantics = find_member(geometry, "semantics");
    if (semantics == nullptr || !semantics->is_object()) return;
    semantic_values_ = find_member(*semantics, "values");
    const auto* surfaces = find_member(*semantics, "surfaces");
    if (surfaces == nullptr || !surfaces->is_array()) return;
    for (const auto& surface : *surfaces) {
      const auto* type = surface.is_object() ? find_member(surface, "type") : nullptr;
      const bool is_text = type != nullptr && type->is_string();
      rules_.push_back(semantic_surface(is_text ? type->get_ref<const std::string&>() : ""));
      if (!rules_.back().is_known) {
        notes_.count("semantic surfaces of unknown type: kind of surface by slope");
      }
    }
    has_rooms_inside_ = has_rooms_inside(
        rules_, [](const SemanticSurface& rule) -> const SemanticSurface& { return rule; });
  }

  void read_surface(const json& surface, const json* semantics, const json* material) {
    auto facts = facts_;
    if (semantics != nullptr) {
      const auto& rule = semantic_rule(*semantics);
      if (!rule.kind) return notes_.count("closure surfaces left out: light passes them");
      if (has_rooms_inside_ && rule.of_room != OfRoom::no)
        return notes_.count(surfaces_of_rooms_left_out);
      if (*rule.kind != Surface::other) facts.surface = *rule.kind;
    }
    if (material == nullptr) material = theme_.value;
    if (material != nullptr) facts.material = material_of(*material);
    if (!surface.is_array()) {
      place_.fail_at_surface(surface_, "is no list of rings", "found " + shown(surface));
    }
    if (!append_rings(surface)) return notes_.count("surfaces of fewer than 3 vertices left out");
    target_.polygon_ring.push_back(static_cast<std::int64_t>(target_.ring_begin.size()) - 1);
    target_.facts.push_back(facts);
  }

  /// False, and nothing appended, where the outer ring is no polygon.
  bool append_rings(const json& surface) {
    constexpr std::size_t smallest_ring = 3;
    for (std::size_t r = 0; r < surface.size(); ++r) {
      const auto& ring = surface[r];
      if (!ring.is_array()) {
        place_.fail_at_surface(surface_, "has a ring that is no list", "found " + shown(ring));
      }
      if (ring.size() < smallest_ring) {
        if (r == 0) return false;
        notes_.count("inner rings of fewer than 3 vertices left out");
        continue;
      }
      for (const auto& index : ring) {
        target_.ring_vertex.push_back(vertices_.use(index, target_, place_, surface_));
      }
      target_.ring_begin.push_back(static_cast<std::int64_t>(target_.ring_vertex.size()));
    }
    return !surface.empty();
  }

  const SemanticSurface& semantic_rule(const json& value) const {
    const auto index = whole_number(value);
    if (!index || *index >= rules_.size()) {
      place_.fail_at_surface(surface_, "semantic surface index " + shown(value),
                             "there are " + std::to_string(rules_.size()));
    }
    return rules_[static_cast<std::size_t>(*index)];
  }

  /// A wrong material spoils no geometry, and real files have them.
  MaterialId material_of(const json& value) {
    const auto index = whole_number(value);
    if (index && *index < materials_.ids.size()) {
      return materials_.ids[static_cast<std::size_t>(*index)];
    }
    notes_.count("surfaces name a material that is not there");
    return MaterialId::none();
  }

  CityVertices& vertices_;
  const CityMaterials& materials_;
  PolygonModel::Facts facts_;
  const GeometryPlace& place_;
  PolygonModel& target_;
  NoteCounter& notes_;
  ThemeValues theme_;
  const json* semantic_values_ = nullptr;
  bool has_rooms_inside_ = false;
  std::vector<SemanticSurface> rules_;
  std::size_t surface_ = 0;
};

}  // namespace

void GeometryPlace::fail(const std::string& problem, const std::string& why) const {
  throw InputError(
      {file, line},
      "CityObject '" + object + "', " + what + " " + std::to_string(geometry) + ": " + problem,
      why);
}

void GeometryPlace::fail_at_surface(std::size_t surface, const std::string& problem,
                                    const std::string& why) const {
  fail("surface " + std::to_string(surface) + ": " + problem, why);
}

const json* find_member(const json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(name);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

CityVertices::CityVertices(const json* list, const VertexTransform& transform,
                           const SceneFromFile* scene_from_file, const GeometryPlace& place)
    : list_(list), transform_(transform), scene_from_file_(scene_from_file) {
  if (list_ != nullptr && !list_->is_array()) {
    throw InputError({place.file, place.line}, "vertices are no list");
  }
  index_in_model_.assign(size(), -1);
}

std::size_t CityVertices::size() const { return list_ == nullptr ? 0 : list_->size(); }

Vec3 CityVertices::position(std::size_t index, const GeometryPlace& place) const {
  const auto& vertex = (*list_)[index];
  const auto is_number = [&](std::size_t k) { return vertex[k].is_number(); };
  if (!vertex.is_array() || vertex.size() < 3 || !is_number(0) || !is_number(1) || !is_number(2)) {
    throw InputError({place.file, place.line}, "vertex " + std::to_string(index),
                     "3 numbers were expected");
  }
  const auto& [scale, translate] = transform_;
  const Vec3 file{scale.x * vertex[0].get<double>() + translate.x,
                  scale.y * vertex[1].get<double>() + translate.y,
                  scale.z * vertex[2].get<double>() + translate.z};
  const Vec3 position = scene_from_file_ == nullptr ? file : (*scene_from_file_)(file);
  if (!is_usable(position)) {
    throw InputError({place.file, place.line},
                     "vertex " + std::to_string(index) + " lies beyond all coordinates on Earth",
                     "no map projection reaches 1e9 m", "are transform and unit_m right?");
  }
  return position;
}

std::int32_t CityVertices::use(const json& value, PolygonModel& target, const GeometryPlace& place,
                               std::size_t surface) {
  const auto index = whole_number(value);
  if (!index || *index >= size()) {
    place.fail_at_surface(surface, "vertex index " + shown(value),
                          "there are " + std::to_string(size()) + " vertices, counted from 0");
  }
  auto& place_in_model = index_in_model_[static_cast<std::size_t>(*index)];
  if (place_in_model < 0) {
    if (target.vertices.size() >= std::numeric_limits<std::int32_t>::max()) {
      throw InputError({place.file}, "has too many vertices", "2³¹ can be counted");
    }
    place_in_model = static_cast<std::int32_t>(target.vertices.size());
    target.vertices.push_back(position(static_cast<std::size_t>(*index), place));
  }
  return place_in_model;
}

int lists_around_surfaces(const std::string& geometry_type) {
  return levels_around_surfaces().at(geometry_type);
}

bool has_surfaces(const std::string& geometry_type) {
  return levels_around_surfaces().contains(geometry_type);
}

bool is_solid(const std::string& geometry_type) {
  const auto found = levels_around_surfaces().find(geometry_type);
  return found != levels_around_surfaces().end() && found->second > 0;
}

void append_geometry(const json& geometry, CityVertices& vertices, const CityMaterials& materials,
                     PolygonModel::Facts facts, const GeometryPlace& place, PolygonModel& target,
                     NoteCounter& notes) {
  const auto* boundaries = find_member(geometry, "boundaries");
  if (boundaries == nullptr) place.fail("has no boundaries");
  const int levels = levels_around_surfaces().at(geometry.at("type").get_ref<const std::string&>());
  GeometryReader reader(geometry, vertices, materials, facts, place, target, notes);
  reader.walk(*boundaries, levels, reader.semantic_values(), reader.material_values());
}

}  // namespace sunload
