// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/cityjson/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "geo/sun/map_axes.h"
#include "io/base/json_text.h"
#include "io/scene/base/city_types.h"
#include "io/scene/base/from_file.h"
#include "io/scene/base/transparent_materials.h"
#include "io/scene/base/words.h"
#include "io/scene/cityjson/geometry.h"
#include "io/scene/cityjson/select.h"
#include "io/scene/cityjson/templates.h"

namespace sunload {

namespace {

using nlohmann::json;

class CityReader {
 public:
  CityReader(const std::string& path, const SceneFileRules& rules, std::size_t file_bytes)
      : path_(path),
        scene_from_file_(rules, 'z', path),
        wish_(rules.lod, path),
        templates_(path, scene_from_file_, file_bytes) {
    model_.source = path;
    model_.is_city_format = true;
  }

  /// The document, or the first line of a sequence.
  void read_header(json root) {
    header_ = std::move(root);
    check_type(header_, "CityJSON", 0);
    check_version();
    read_transform();
    if (const auto* metadata = find_member(header_, "metadata")) {
      const auto* crs = find_member(*metadata, "referenceSystem");
      if (crs != nullptr && crs->is_string()) model_.crs = crs->get<std::string>();
    }
    if (const auto* extensions = find_member(header_, "extensions")) {
      notes_.count("extensions of CityJSON, tolerated", extensions->size());
    }
    header_materials_ = read_materials(header_).value_or(CityMaterials{});
    templates_.set_header(header_, header_materials_);
    const auto* objects = find_member(header_, "CityObjects");
    if (objects == nullptr) throw InputError({path_}, "has no CityObjects");
    read_objects(header_, *objects, 0);
  }

  void read_feature(const json& feature, int line) {
    check_type(feature, "CityJSONFeature", line);
    const auto* objects = find_member(feature, "CityObjects");
    if (objects == nullptr) throw InputError({path_, line}, "feature has no CityObjects");
    read_objects(feature, *objects, line);
  }

  PolygonModel finish() {
    refuse_degrees();
    add_families();
    transparent_.count_used(model_, notes_);
    put_notes(notes_, model_);
    return std::move(model_);
  }

 private:
  /// The order of degrees in CityJSON is that of who wrote the file: whoever projects them knows.
  void refuse_degrees() const {
    constexpr double half_turn = 180;
    const bool may_be_degrees = std::all_of(
        model_.vertices.begin(), model_.vertices.end(),
        [](Vec3 p) { return std::abs(p.x) <= half_turn && std::abs(p.y) <= half_turn; });
    if (model_.crs.empty() || model_.vertices.empty() || !may_be_degrees) return;
    const MapAxes axes(model_.crs);
    if (!axes.is_known() || !axes.is_in_degrees()) return;
    const Vec3 p = model_.vertices.front();
    const auto zone = [](double east, double north) {
      return utm_at(north, east).substr(std::string_view("EPSG:").size());
    };
    const bool fits = axes.is_in_use_at(p.x, p.y), fits_exchanged = axes.is_in_use_at(p.y, p.x);
    std::string zones = fits ? zone(p.x, p.y) : std::string();
    if (fits_exchanged && (zones.empty() || zones != zone(p.y, p.x)))
      zones +=
          (fits ? " (or " : "") + zone(p.y, p.x) + (fits ? " where latitudes come first)" : "");
    throw InputError({path_}, "is in degrees (referenceSystem " + axes.name() + ")",
                     "the scene's x and y must be lengths",
                     fmt::format("project it, for example with cjio, crs_reproject {}; where they "
                                 "are lengths, remove metadata.referenceSystem",
                                 zones.empty() ? "of a map projection" : zones));
  }

  void check_type(const json& root, const std::string& expected, int line) const {
    const Where where{path_, line};
    if (!root.is_object()) {
      throw InputError(where, "is no " + expected, "an object in braces was expected");
    }
    const auto* type = find_member(root, "type");
    if (type == nullptr || !type->is_string()) {
      throw InputError(where, "is no " + expected, "it has no \"type\"");
    }
    if (*type != expected) {
      throw InputError(
          where, "is no " + expected,
          "its type is '" + shortened(type->get_ref<const std::string&>()) + "'",
          *type == "CityJSONFeature" ? "a sequence begins with a line of CityJSON" : "");
    }
  }

  void check_version() const {
    const auto* member = find_member(header_, "version");
    if (member == nullptr) throw InputError({path_}, "has no CityJSON version");
    const auto version = member->is_string() ? member->get<std::string>() : member->dump();
    if (version.starts_with("1.") || version.starts_with("2.")) return;
    const bool is_old = version.starts_with("0.");
    throw InputError({path_}, "CityJSON version '" + shortened(version) + "' is not supported",
                     is_old ? "it is older than 1.0" : "1.0, 1.1 and 2.0 can be read",
                     is_old ? "upgrade it, for example with `cjio FILE upgrade`" : "");
  }

  void read_transform() {
    const auto* transform = find_member(header_, "transform");
    if (transform == nullptr) return;  // CityJSON 1.0: coordinates as they are
    const auto scale = numbers<3>(find_member(*transform, "scale"));
    const auto translate = numbers<3>(find_member(*transform, "translate"));
    if (!scale || !translate) {
      throw InputError({path_}, "transform must have scale and translate of 3 numbers each");
    }
    transform_ = {{(*scale)[0], (*scale)[1], (*scale)[2]},
                  {(*translate)[0], (*translate)[1], (*translate)[2]}};
  }

  /// Adds the materials of a document or feature to the model's table.
  std::optional<CityMaterials> read_materials(const json& document) {
    const auto* appearance = find_member(document, "appearance");
    if (appearance == nullptr) return std::nullopt;
    CityMaterials materials;
    if (const auto* theme = find_member(*appearance, "default-theme-material");
        theme != nullptr && theme->is_string()) {
      materials.default_theme = theme->get<std::string>();
    }
    if (const auto* textures = find_member(*appearance, "textures")) {
      notes_.count("textures ignored", textures->size());
    }
    const auto* list = find_member(*appearance, "materials");
    if (list == nullptr || !list->is_array()) return std::nullopt;
    for (std::size_t i = 0; i < list->size(); ++i) {
      materials.ids.push_back(add_material((*list)[i], i));
    }
    return materials;
  }

  MaterialId add_material(const json& material, std::size_t index) {
    FileMaterial result;
    const auto* name = find_member(material, "name");
    result.name = name != nullptr && name->is_string() ? name->get<std::string>()
                                                       : "material_" + std::to_string(index);
    if (const auto colour = numbers<3>(find_member(material, "diffuseColor"))) {
      if (!result.set_diffuse(*colour)) notes_.count("colours outside [0, 1] ignored");
    }
    // Features repeat the materials that they share.
    auto key = result.name + '\n' + std::to_string(result.diffuse.value_or(-1));
    for (const double share : result.diffuse_rgb.value_or(std::array<double, 3>{}))
      key += ' ' + std::to_string(share);
    const auto [entry, is_new] =
        material_ids_.try_emplace(key, make_id<MaterialId>(model_.materials.size()));
    if (is_new) model_.materials.push_back(std::move(result));
    const auto* transparency = find_member(material, "transparency");
    if (transparency != nullptr && transparency->is_number() && transparency->get<double>() > 0)
      transparent_.add(entry->second);
    return entry->second;
  }

  void read_objects(const json& document, const json& city_objects, int line) {
    const Where where{path_, line};
    const auto template_of = [&](const json& instance, const std::string& object,
                                 std::size_t geometry) -> const json& {
      return templates_.shape_of(instance, {path_, line, object, geometry});
    };
    const auto choices = choose_geometries(city_objects, wish_, template_of, where, notes_);
    const auto own_materials = line > 0 ? read_materials(document) : std::nullopt;
    const auto& materials = own_materials ? *own_materials : header_materials_;
    CityVertices vertices(find_member(document, "vertices"), transform_, &scene_from_file_,
                          {path_, line, "", 0});
    for (const auto& [id, choice] : choices) {
      read_object(id, choice, vertices, materials, line);
      if (!choice.owner.empty() || !object_ids_.contains(id))
        relatives_.push_back({id, choice.type, choice.owner});
    }
  }

  void read_object(const std::string& id, const GeometryChoice& choice, CityVertices& vertices,
                   const CityMaterials& materials, int line) {
    if (choice.geometries.empty()) return;
    const auto polygons_before = model_.polygon_count();
    const auto [entry, is_new] =
        object_ids_.try_emplace(id, make_id<ObjectId>(model_.object_names.size()));
    for (const auto place : choice.geometries) {
      const auto& geometry = choice.object->at("geometry")[place];
      const GeometryPlace where{path_, line, id, place};
      PolygonModel::Facts facts{.object = entry->second};
      const bool is_instance = geometry.at("type") == "GeometryInstance";
      const auto& shape = is_instance ? templates_.shape_of(geometry, where) : geometry;
      if (is_terrain(choice.type) && !is_solid(shape.at("type"))) facts.surface = Surface::ground;
      if (is_instance) {
        templates_.append_instance(geometry, vertices, facts, where, model_, notes_);
      } else {
        append_geometry(geometry, vertices, materials, facts, where, model_, notes_);
      }
    }
    if (!is_new) {
      notes_.count("objects whose id came before: joined with it");
    } else if (model_.polygon_count() > polygons_before) {
      model_.object_names.push_back(id);
      model_.object_kinds.push_back(choice.type);
    } else {
      object_ids_.erase(entry);
    }
  }

  /// Objects that belong to others, and those of which nothing is read.
  void add_families() {
    std::unordered_map<std::string, BareId> bare_ids;
    auto& [of_object, bare] = model_.families;
    for (const Relative& each : relatives_) {
      if (object_ids_.contains(each.id)) continue;
      if (bare_ids.try_emplace(each.id, make_id<BareId>(bare.size())).second)
        bare.push_back({each.id, each.type});
    }
    for (const Relative& each : relatives_) {
      if (each.owner.empty()) continue;
      Owner owner;
      if (const auto found = object_ids_.find(each.owner); found != object_ids_.end())
        owner.object = found->second;
      else
        owner.bare = bare_ids.at(each.owner);
      if (const auto found = object_ids_.find(each.id); found == object_ids_.end()) {
        bare[bare_ids.at(each.id).index()].owner = owner;
      } else {
        of_object.resize(model_.object_names.size());
        of_object[found->second.index()] = owner;
      }
    }
  }

  struct Relative {
    std::string id, type, owner;
  };

  std::string path_;
  SceneFromFile scene_from_file_;
  LodWish wish_;
  CityTemplates templates_;
  PolygonModel model_;
  NoteCounter notes_;
  TransparentMaterials transparent_;
  json header_;
  VertexTransform transform_;
  CityMaterials header_materials_;
  std::unordered_map<std::string, ObjectId> object_ids_;
  std::unordered_map<std::string, MaterialId> material_ids_;
  std::vector<Relative> relatives_;
};

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == text.npos; }

/// Header and features, one on each line.
void read_sequence(CityReader& reader, const std::string& path, std::string_view text) {
  int line_number = 0;
  bool has_header = false;
  while (!text.empty()) {
    const auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    ++line_number;
    if (is_blank(line)) continue;
    auto value = parse_json(path, line, line_number);
    if (has_header) {
      reader.read_feature(value, line_number);
    } else {
      reader.read_header(std::move(value));
    }
    has_header = true;
  }
}

}  // namespace

PolygonModel read_scene_cityjson(const std::string& path, const SceneFileRules& rules) {
  const auto bytes = read_whole_file(path);
  const std::string_view text = without_byte_order_mark(bytes);
  CityReader reader(path, rules, text.size());
  const auto first_end = first_json_value_end(path, text);
  const auto rest = first_end == text.npos ? std::string_view{} : text.substr(first_end);
  const auto next = rest.find_first_not_of(" \t\r\n");
  const bool is_sequence =
      next != rest.npos && rest[next] == '{' && rest.substr(0, next).find('\n') != rest.npos;
  if (is_sequence) {
    read_sequence(reader, path, text);
  } else {
    reader.read_header(parse_json(path, text));
  }
  return reader.finish();
}

}  // namespace sunload
