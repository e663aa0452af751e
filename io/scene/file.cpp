// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/file.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/scene/base/from_file.h"
#include "io/scene/base/plain_names.h"
#include "io/scene/citygml/reader.h"
#include "io/scene/cityjson/reader.h"
#include "io/scene/mesh_files/gltf.h"
#include "io/scene/mesh_files/obj.h"
#include "io/scene/mesh_files/off.h"
#include "io/scene/mesh_files/ply.h"
#include "io/scene/mesh_files/stl.h"
#include "io/scene/raster/footprints.h"
#include "io/scene/raster/raster_scene.h"
#include "io/scene/vrml/reader.h"

namespace sunload {

namespace {

/// Enough for the header of a text file with a comment in front.
constexpr std::size_t head_bytes = 4096;

using Reader = PolygonModel (*)(const std::string& path, const SceneFileRules& rules);

/// One format: told by its first bytes, where it has a mark, or by its extension.
struct Format {
  const char* name;
  std::vector<std::string_view> marks;       ///< what the file may begin with
  std::vector<std::string_view> extensions;  ///< in lower case, with the dot
  Reader read;
  SceneFileKind kind;
  bool says_up = true;
};

// A format is added by its row. The mark 1F 8B is gzip's: VRML, but for names of CityGML.
const std::vector<Format>& formats() {
  constexpr bool up_is_unsaid = false;
  static const std::vector<Format> table{
      {"CityJSON",
       {"{"},
       {".city.json", ".city.jsonl", ".json", ".jsonl"},
       read_scene_cityjson,
       SceneFileKind::city},
      {"CityGML",
       {"<"},
       {".gml", ".citygml", ".xml", ".gml.gz", ".citygml.gz", ".xml.gz"},
       read_scene_citygml,
       SceneFileKind::city},
      {"OBJ", {}, {".obj"}, read_scene_obj, SceneFileKind::mesh, up_is_unsaid},
      {"VRML",
       {"#VRML", "#Inventor", "\x1F\x8B"},
       {".wrl", ".wrl.gz", ".vrml", ".wrz", ".iv"},
       read_scene_vrml,
       SceneFileKind::mesh},
      {"PLY", {"ply\n", "ply\r"}, {".ply"}, read_scene_ply, SceneFileKind::mesh, up_is_unsaid},
      {"OFF",
       {"OFF", "COFF", "NOFF", "STOFF"},
       {".off"},
       read_scene_off,
       SceneFileKind::mesh,
       up_is_unsaid},
      {"STL", {"solid "}, {".stl"}, read_scene_stl, SceneFileKind::mesh, up_is_unsaid},
      {"glTF", {"glTF"}, {".gltf", ".glb"}, read_scene_gltf, SceneFileKind::mesh},
      {"GeoTIFF raster",
       {{"II*\0", 4}, {"MM\0*", 4}, {"II+\0", 4}},
       {".tif", ".tiff"},
       read_scene_raster,
       SceneFileKind::raster},
      {"ESRI ASCII raster", {"ncols", "NCOLS"}, {".asc"}, read_scene_raster, SceneFileKind::raster},
      {"footprints (GeoJSON, GeoPackage, Shapefile, FlatGeobuf)",
       {},
       {".geojson", ".gpkg", ".shp", ".fgb"},
       read_scene_footprints,
       SceneFileKind::plan},
  };
  return table;
}

std::string_view without_leading_blanks(std::string_view head) {
  head = without_byte_order_mark(head);
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  return head;
}

const Format* format_by_mark(std::string_view head) {
  for (const auto& format : formats()) {
    for (const auto mark : format.marks) {
      if (head.starts_with(mark)) return &format;
    }
  }
  return nullptr;
}

const Format* format_by_extension(const std::string& path) {
  const auto name = lower_case(path);
  for (const auto& format : formats()) {
    for (const auto extension : format.extensions) {
      if (name.ends_with(extension)) return &format;
    }
  }
  return nullptr;
}

/// The content is stronger than the name, but for JSON, which glTF is, too, and for what gzip
/// hides.
const Format* format_of(const std::string& path, std::string_view head) {
  if (is_footprint_file(path, head)) return &formats().back();
  const auto* by_mark = format_by_mark(head);
  const bool may_be_gltf = head.starts_with('{') && lower_extension(path) == ".gltf";
  const auto* by_extension = format_by_extension(path);
  const bool is_packed_gml = head.starts_with("\x1F\x8B") && by_extension != nullptr &&
                             by_extension->read == read_scene_citygml;
  return by_mark != nullptr && !may_be_gltf && !is_packed_gml ? by_mark : by_extension;
}

std::string names_of_formats() {
  std::string names;
  for (const auto& format : formats()) {
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  return names;
}

}  // namespace

std::optional<SceneFormat> scene_format_of_name(const std::string& path) {
  const auto* format = format_by_extension(path);
  if (format == nullptr) return {};
  return SceneFormat{format->kind, format->says_up};
}

bool is_of_footprints(const std::string& path) {
  return is_footprint_file(path, without_leading_blanks(read_file_head(path, head_bytes)));
}

PolygonModel read_scene_file(const std::string& path, const SceneFileRules& rules) {
  const auto head = read_file_head(path, head_bytes);
  if (head.empty()) throw InputError({path}, "is empty", "a scene file was expected");
  const auto* format = format_of(path, without_leading_blanks(head));
  if (format == nullptr) {
    throw InputError({path}, "is of no known scene format",
                     "neither its content nor its name tells",
                     "formats that can be read: " + names_of_formats());
  }
  PolygonModel model = format->read(path, rules);
  make_names_plain(model);
  model.files.push_back(path);
  return model;
}

}  // namespace sunload
