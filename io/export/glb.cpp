// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "geo/base/check.h"
#include "io/base/byte_text.h"
#include "io/base/version.h"
#include "io/export/format.h"
#include "io/export/light_map.h"

namespace sunload {
namespace {

using nlohmann::json;

// Numbers of glTF 2.0, 3.6 and 4.4.
constexpr std::uint32_t file_magic = 0x46546C67, file_version = 2;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
constexpr int type_float = 5126, type_unsigned_short = 5123, target_vertices = 34962;
constexpr int filter_linear = 9729, wrap_clamp = 33071;
constexpr std::size_t alignment = 4, head_bytes = 12;
constexpr double largest_short = 65535;

template <class Number>
void append(std::string& bytes, Number number) {
  append_bytes<std::endian::little>(bytes, number);
}

/// COLOR_0 of glTF is linear light, not encoded.
std::uint16_t linear_short(double channel) {
  return static_cast<std::uint16_t>(std::lround(largest_short * linear_from_srgb(channel)));
}

/// Positions of the corners of one object, which share nothing, and their colours or their places
/// in the texture.
struct ObjectMesh {
  std::string positions, colours, places;
  std::array<float, 3> low{}, high{};
  std::size_t corners = 0;

  void add(Vec3 p) {
    // y is up: (x, y, z) → (x, z, −y), which turns no face.
    const std::array<float, 3> place{static_cast<float>(p.x), static_cast<float>(p.z),
                                     static_cast<float>(0.0 - p.y)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = corners == 0 ? place[axis] : std::min(low[axis], place[axis]);
      high[axis] = corners == 0 ? place[axis] : std::max(high[axis], place[axis]);
      append(positions, place[axis]);
    }
    ++corners;
  }
  void add_colour(Colour c) {
    for (const double channel : {c.red, c.green, c.blue}) append(colours, linear_short(channel));
    append(colours, std::uint16_t{65535});
  }
  void add_place(const std::array<float, 2>& place) {
    for (const float share : place) append(places, share);
  }
};

std::vector<ObjectMesh> object_meshes(const ResultPatches& patches, const ExportColours& colours,
                                      const std::optional<LightMap>& light_map) {
  std::vector<ObjectMesh> meshes(patches.object_names.size());
  for (std::size_t i = 0; i < patches.corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      auto& mesh = meshes.at(static_cast<std::size_t>(patches.object[i]));
      mesh.add(patches.vertices[static_cast<std::size_t>(patches.corners[i][k])]);
      if (light_map) {
        mesh.add_place(light_map->place(i, k));
        continue;
      }
      const auto step =
          colours.corner_step.empty() ? colours.patch_step[i] : colours.corner_step[i][k];
      mesh.add_colour(export_colour(colours.palette, step));
    }
  return meshes;
}

/// The tree and the buffer of a scene, filled object by object.
class Scene {
 public:
  json tree;
  std::string buffer;

  void add(const std::string& name, const ObjectMesh& mesh) {
    json position{{"bufferView", view(mesh.positions, target_vertices)},
                  {"componentType", type_float},
                  {"count", mesh.corners},
                  {"type", "VEC3"},
                  {"min", mesh.low},
                  {"max", mesh.high}};
    const bool textured = !mesh.places.empty();
    json shown{{"bufferView", view(textured ? mesh.places : mesh.colours, target_vertices)},
               {"componentType", textured ? type_float : type_unsigned_short},
               {"count", mesh.corners},
               {"type", textured ? "VEC2" : "VEC4"}};
    if (!textured) shown["normalized"] = true;
    const auto first = tree["accessors"].size(), node = tree["nodes"].size();
    tree["accessors"].push_back(std::move(position));
    tree["accessors"].push_back(std::move(shown));
    json primitive{
        {"attributes", {{"POSITION", first}, {textured ? "TEXCOORD_0" : "COLOR_0", first + 1}}},
        {"material", 0}};
    tree["meshes"].push_back({{"name", name}, {"primitives", json::array({std::move(primitive)})}});
    tree["nodes"].push_back({{"name", name}, {"mesh", node}});
    tree["scenes"][0]["nodes"].push_back(node);
  }

  /// The texture of all objects. Neither smaller copies of it, which would mix patches, nor
  /// repeats.
  void add(const LightMap& map) {
    tree["images"].push_back({{"bufferView", view(map.png())}, {"mimeType", "image/png"}});
    tree["samplers"].push_back({{"magFilter", filter_linear},
                                {"minFilter", filter_linear},
                                {"wrapS", wrap_clamp},
                                {"wrapT", wrap_clamp}});
    tree["textures"].push_back({{"sampler", 0}, {"source", 0}});
    tree["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    tree["asset"]["extras"]["light_map"] = {
        {"width", map.width()}, {"height", map.height()}, {"block", map.block()}};
  }

 private:
  std::size_t view(const std::string& bytes, int target = 0) {
    const auto index = tree["bufferViews"].size();
    json about{{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
    if (target != 0) about["target"] = target;
    tree["bufferViews"].push_back(std::move(about));
    buffer += bytes;
    buffer.resize((buffer.size() + alignment - 1) / alignment * alignment);
    return index;
  }
};

/// Colours are shown as they are, not lit; readers without the extension light a white matt
/// surface.
json unlit_material() {
  return {{"name", "colours"},
          {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
          {"extensions", {{"KHR_materials_unlit", json::object()}}}};
}

void append_chunk(std::string& file, std::uint32_t kind, std::string content, char filler) {
  content.resize((content.size() + alignment - 1) / alignment * alignment, filler);
  append(file, static_cast<std::uint32_t>(content.size()));
  append(file, kind);
  file += content;
}

}  // namespace

void export_glb(const ResultReader& result, const ExportRules& rules, const ExportTarget& target) {
  const ResultPatches patches(result);
  const auto colours = export_colours(result, rules, patches);
  Scene scene;
  const Vec3 origin = patches.origin;
  scene.tree["asset"] = {{"version", "2.0"},
                         {"generator", std::string("sunload ") + version},
                         {"extras",
                          {{"caption", export_caption(result, colours.shown)},
                           {"colours_from", colours.least},
                           {"colours_to", colours.largest},
                           {"units", colours.shown.units},
                           {"origin", {origin.x, origin.y, origin.z}}}}};
  scene.tree["extensionsUsed"] = json::array({"KHR_materials_unlit"});
  scene.tree["materials"] = json::array({unlit_material()});
  scene.tree["scene"] = 0;
  std::optional<LightMap> light_map;
  if (rules.light_map) light_map.emplace(colours, result.path());
  const auto meshes = object_meshes(patches, colours, light_map);
  for (std::size_t k = 0; k < meshes.size(); ++k)
    if (meshes[k].corners > 0) scene.add(patches.object_names[k], meshes[k]);
  if (light_map) scene.add(*light_map);
  scene.tree["buffers"] = json::array({json{{"byteLength", scene.buffer.size()}}});

  std::string chunks;
  append_chunk(chunks, json_chunk, scene.tree.dump(-1, ' ', false, json::error_handler_t::replace),
               ' ');
  append_chunk(chunks, binary_chunk, scene.buffer, '\0');
  const std::size_t bytes = head_bytes + chunks.size();
  if (bytes > UINT32_MAX)
    throw InputError({result.path()}, fmt::format("{} bytes of glTF", bytes),
                     "a .glb file has at most 4 GiB", "export to vtk or ply");
  std::string head;
  append(head, file_magic);
  append(head, file_version);
  append(head, static_cast<std::uint32_t>(bytes));
  target.stream << head << chunks;
}

}  // namespace sunload
