// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "geo/base/check.h"
#include "geo/mesh/polygon_match.h"
#include "io/base/json_text.h"
#include "io/base/names.h"
#include "io/base/standard_streams.h"
#include "io/export/cityjson.h"
#include "io/export/surface_values.h"
#include "io/scene/base/from_file.h"
#include "io/scene/cityjson/geometry.h"
#include "io/scene/cityjson/select.h"
#include "io/scene/cityjson/templates.h"
#include "io/study/file_place.h"

namespace sunload {
namespace {

using nlohmann::json;
using Numbers = std::vector<std::size_t>;

/// The file of a study's scene that `path` most likely is: the one of its name, whatever the folder
/// it has been moved to, else the only one. Null where that is open.
const SceneFileStudy* file_in(const SceneStudy& scene, const std::string& path) {
  const auto name = std::filesystem::path(path).filename();
  const auto is_named = [&](const SceneFileStudy& file) {
    return std::filesystem::path(file.path).filename() == name;
  };
  const auto found = std::find_if(scene.files.begin(), scene.files.end(), is_named);
  if (found != scene.files.end()) return &*found;
  return scene.files.size() == 1 ? &scene.files.front() : nullptr;
}

/// How the study of a result reads the file, and where it puts it.
struct FileInScene {
  SceneFileRules rules;
  std::optional<FilePlace> place;  ///< absent: where it is
};

FileInScene file_in_scene(const ResultReader& result, const std::string& path) {
  const auto text = result.strings("study_yaml");
  const SceneStudy scene =
      scene_of_text(text.empty() ? "" : text.front(), result.text_attribute("variant"));
  const SceneFileStudy* file = file_in(scene, path);
  if (file == nullptr) return {rules_of({}, scene), {}};
  FileInScene in_scene{rules_of(*file, scene), {}};
  if (file->is_placed()) in_scene.place = place_of(*file, result.text_attribute("crs"));
  return in_scene;
}

/// One surface of the model that patches were cut from.
struct ValuedSurface {
  Numbers place;    ///< indices in the nested lists of `boundaries`
  Numbers patches;  ///< fronts
};

/// The patches of a result by object and input triangle.
class PatchPolygons {
 public:
  explicit PatchPolygons(const ResultReader& result)
      : patches(result),
        side(result.integers("patch_side")),
        surface(result.integers("patch_surface")) {
    const auto triangle = result.integers("patch_input_triangle"),
               corners = result.integers("input_triangle_vertices");
    for (std::size_t p = 0; p < side.size(); ++p) {
      if (side[p] != 0) continue;
      const auto t = static_cast<std::size_t>(triangle[p]);
      auto& faces = by_object[patches.object_names[static_cast<std::size_t>(patches.object[p])]];
      if (faces.empty() || faces.back().triangle != t) {
        Face face{t, {}, patches.normal[p], {}};
        for (std::size_t k = 0; k < 3; ++k)
          face.middle +=
              (patches.vertices[static_cast<std::size_t>(corners[3 * t + k])] + patches.origin) / 3;
        faces.push_back(std::move(face));
      }
      faces.back().patches.push_back(p);
    }
  }

  /// An input triangle with its patches.
  struct Face {
    std::size_t triangle;
    Vec3 middle;  ///< absolute
    Vec3 normal;
    Numbers patches;
  };
  ResultPatches patches;
  std::vector<std::int32_t> side, surface;
  std::map<std::string, std::vector<Face>> by_object;
};

/// Calls `action(surface, place)` for every surface of `boundaries`.
template <class Action>
void each_surface(const json& boundaries, int levels, Numbers& place, const Action& action) {
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    place.push_back(i);
    if (levels == 0)
      action(boundaries[i], place);
    else
      each_surface(boundaries[i], levels - 1, place, action);
    place.pop_back();
  }
}

/// The place for a surface in semantics' `values`, lists made as long as the boundaries.
json& semantic_place(json& values, const json& boundaries, const Numbers& place) {
  json* inner = &values;
  const json* shape = &boundaries;
  for (const auto i : place) {
    if (!inner->is_array()) *inner = json::array();
    while (inner->size() < shape->size()) inner->push_back(nullptr);
    inner = &(*inner)[i];
    shape = &(*shape)[i];
  }
  return *inner;
}

/// Whether semantic surfaces of that type may be put on objects that have none
/// (CityJSON 2.0.1, 3.3).
bool may_bear(const std::string& object, const std::string& surface) {
  const bool is_built = object.starts_with("Building") || object.starts_with("Bridge") ||
                        object.starts_with("Tunnel");
  const bool is_way = object == "Road" || object == "Railway" || object == "TransportSquare";
  return surface == "TrafficArea" ? is_way : is_built;
}

class ModelWriter {
 public:
  ModelWriter(const ResultReader& result, const ExportRules& rules)
      : path_(rules.model),
        in_scene_(file_in_scene(result, path_)),
        scene_from_file_(in_scene_.rules, 'z', path_),
        wish_(in_scene_.rules.lod, path_),
        patches_(result),
        values_(result, rules) {}

  /// The document, or header and features of a sequence, each on its line.
  void write(std::ostream& out) {
    const auto bytes = read_whole_file(path_);
    std::string_view text = without_byte_order_mark(bytes);
    if (const auto first = text.find_first_not_of(" \t\r\n");
        first != text.npos && text[first] == '<')
      throw InputError({path_}, "is no CityJSON", "it is of XML, as CityGML is",
                       "leave --model out: every patch becomes a surface; or run the study of a "
                       "CityJSON of the model (sunload scene STUDY -o FILE.city.json)");
    json header;
    for (int line = 0; text.find_first_not_of(" \t\r\n") != text.npos; ++line) {
      const auto end = std::min(first_json_value_end(path_, text), text.size());
      json document = parse_json(path_, text.substr(0, end));
      text.remove_prefix(end);
      if (line == 0) {
        if (document.value("type", "") != "CityJSON")
          throw InputError({path_}, "is no CityJSON", "its type is not CityJSON");
        read_transform(document);
        header = document;
      }
      templates_ = std::make_unique<CityTemplates>(path_, scene_from_file_, bytes.size());
      templates_->set_header(header, {});
      add_values(document, line);
      out << document.dump(-1, ' ', false, json::error_handler_t::replace) << "\n";
    }
  }

  /// What a reader of the file must know; throws where nothing has found its place.
  void expect_met() const {
    std::size_t count = 0, lost = 0;
    for (const auto& [name, faces] : patches_.by_object)
      for (const auto& face : faces) {
        if (!seen_objects_.contains(name)) continue;
        count += face.patches.size();
        if (!matched_.contains(face.triangle)) lost += face.patches.size();
      }
    if (seen_objects_.empty())
      throw InputError({path_}, "has none of the result's objects", "their ids differ",
                       "name the file that the study read");
    if (count == lost)
      throw InputError({path_}, "no patch lies on a surface of the model",
                       "the study has moved it, or it is another version",
                       "name the file that the study read");
    if (lost > 0)
      tell(fmt::format("{}: {} of {} patches lie on no surface of the model; objects hold them",
                       path_, lost, count));
  }

 private:
  void read_transform(const json& header) {
    const auto* transform = find_member(header, "transform");
    if (transform == nullptr) return;
    const auto scale = numbers<3>(find_member(*transform, "scale"));
    const auto translate = numbers<3>(find_member(*transform, "translate"));
    if (!scale || !translate) throw InputError({path_}, "transform has no scale and translate");
    transform_ = {{(*scale)[0], (*scale)[1], (*scale)[2]},
                  {(*translate)[0], (*translate)[1], (*translate)[2]}};
  }

  void add_values(json& document, int line) {
    auto found = document.find("CityObjects");
    if (found == document.end() || !found->is_object()) return;
    const auto template_of = [&](const json& instance, const std::string& object,
                                 std::size_t geometry) -> const json& {
      return templates_->shape_of(instance, {path_, line, object, geometry});
    };
    const auto choices = choose_geometries(*found, wish_, template_of, {path_, line}, notes_);
    const CityVertices vertices(find_member(document, "vertices"), transform_, &scene_from_file_,
                                {path_, line, "", 0});
    for (const auto& [id, choice] : choices)
      if (const std::string name = clean_name(id); patches_.by_object.contains(name)) {
        seen_objects_.insert(name);
        add_to_surfaces((*found)[id], id, choice, vertices, line);
      }
    for (auto& [id, object] : found->items()) {
      Numbers own;
      std::set<std::string> seen;
      collect(*found, id, own, seen);
      if (own.empty()) continue;
      for (const auto& [name, value] : values_.of(own)) object["attributes"][name] = value;
    }
  }

  /// Patches of an object and of its parts.
  void collect(const json& objects, const std::string& id, Numbers& to,
               std::set<std::string>& seen) const {
    if (!seen.insert(id).second) return;
    if (const auto found = patches_.by_object.find(clean_name(id));
        found != patches_.by_object.end())
      for (const auto& face : found->second)
        to.insert(to.end(), face.patches.begin(), face.patches.end());
    const auto object = objects.find(id);
    const auto* children = object == objects.end() ? nullptr : find_member(*object, "children");
    if (children == nullptr || !children->is_array()) return;
    for (const auto& child : *children)
      if (child.is_string()) collect(objects, child.get<std::string>(), to, seen);
  }

  void add_to_surfaces(json& object, const std::string& id, const GeometryChoice& choice,
                       const CityVertices& vertices, int line) {
    std::vector<PolygonRings> polygons;
    std::vector<std::pair<std::size_t, Numbers>> places;  // geometry, indices
    for (const auto g : choice.geometries) {
      const auto& geometry = choice.object->at("geometry")[g];
      const auto type = geometry.at("type").get<std::string>();
      const auto* boundaries = find_member(geometry, "boundaries");
      if (!has_surfaces(type) || boundaries == nullptr) continue;  // an instance of a template
      Numbers place;
      each_surface(*boundaries, lists_around_surfaces(type), place,
                   [&](const json& surface, const Numbers& at) {
                     polygons.push_back(rings(surface, vertices, {path_, line, id, g}));
                     places.emplace_back(g, at);
                   });
    }
    const PolygonMatch match(std::move(polygons));
    std::map<std::size_t, std::map<Numbers, ValuedSurface>> valued;
    for (const auto& face : patches_.by_object.at(clean_name(id))) {
      const auto found = match.polygon_at(face.middle, face.normal);
      if (!found) continue;
      matched_.insert(face.triangle);
      const auto& [g, place] = places[*found];
      auto& surface = valued[g][place];
      surface.place = place;
      surface.patches.insert(surface.patches.end(), face.patches.begin(), face.patches.end());
    }
    for (const auto& [g, surfaces] : valued)
      add_semantics(object["geometry"][g], choice.type, surfaces);
  }

  PolygonRings rings(const json& surface, const CityVertices& vertices,
                     const GeometryPlace& where) const {
    PolygonRings all;
    for (const auto& ring : surface) {
      std::vector<Vec3> points;
      for (const auto& index : ring) {
        const auto k = index.get<std::size_t>();
        if (k >= vertices.size()) where.fail("names a vertex that is not there");
        const Vec3 p = vertices.position(k, where);
        points.push_back(in_scene_.place ? (*in_scene_.place)(p) : p);
      }
      constexpr std::size_t smallest_ring = 3;
      if (points.size() >= smallest_ring) all.push_back(std::move(points));
    }
    return all;
  }

  /// Values of each surface on a semantic surface of its own: those that several share are copied.
  void add_semantics(json& geometry, const std::string& object_type,
                     const std::map<Numbers, ValuedSurface>& valued) const {
    const json boundaries = geometry["boundaries"];
    auto& semantics = geometry["semantics"];
    if (!semantics.is_object())
      semantics = {{"surfaces", json::array()}, {"values", json::array()}};
    auto& surfaces = semantics["surfaces"];
    auto& values = semantics["values"];
    std::map<std::size_t, std::size_t> users;
    Numbers place;
    each_surface(boundaries, lists_around_surfaces(geometry["type"]), place,
                 [&](const json&, const Numbers& at) {
                   const json& user = semantic_place(values, boundaries, at);
                   if (user.is_number_unsigned()) ++users[user.get<std::size_t>()];
                 });
    for (const auto& [at, surface] : valued) {
      json& user = semantic_place(values, boundaries, at);
      if (!user.is_number_unsigned()) {
        const auto first = surface.patches.front();
        const auto type = surface_type(static_cast<Surface>(patches_.surface[first]),
                                       patches_.patches.normal[first]);
        if (!may_bear(object_type, type)) continue;
        user = surfaces.size();
        surfaces.push_back({{"type", type}});
      } else if (auto& count = users[user.get<std::size_t>()]; count > 1) {
        --count;
        json copy = surfaces.at(user.get<std::size_t>());
        copy.erase("children");  // a window has one parent: the first
        user = surfaces.size();
        surfaces.push_back(std::move(copy));
      }
      auto& semantic = surfaces.at(user.get<std::size_t>());
      for (const auto& [name, value] : values_.of(surface.patches)) semantic[name] = value;
    }
    if (surfaces.empty()) geometry.erase("semantics");
  }

  std::string path_;
  FileInScene in_scene_;
  SceneFromFile scene_from_file_;
  LodWish wish_;
  PatchPolygons patches_;
  SurfaceValues values_;
  NoteCounter notes_;
  VertexTransform transform_;
  std::unique_ptr<CityTemplates> templates_;
  std::set<std::string> seen_objects_;
  std::set<std::size_t> matched_;  ///< input triangles
};

}  // namespace

void write_model_with_values(const ResultReader& result, const ExportRules& rules,
                             const ExportTarget& target) {
  if (result.is_derived())
    throw InputError({result.path()}, "holds no study", "--model gives values back to its model",
                     "name the result of one variant, or leave --model out");
  try {
    ModelWriter writer(result, rules);
    writer.write(target.stream);
    writer.expect_met();
  } catch (const json::exception& error) {
    throw InputError({rules.model}, "is no CityJSON that can be read", error.what(),
                     "name the file that the study read");
  }
}

}  // namespace sunload
