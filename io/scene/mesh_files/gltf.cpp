// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/mesh_files/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>

#include "geo/mesh/affine.h"
#include "io/scene/base/indexed_faces.h"
#include "io/scene/mesh_files/gltf_buffers.h"

namespace sunload {

namespace {

using nlohmann::json;

constexpr int deepest_node = 500;  // of a tree; a circle is found by it
/// Trees visit each once; some exporters share nodes.
constexpr std::size_t most_visits_per_node = 10;
constexpr std::size_t fewest_visits = 10'000;  // that are allowed

std::string name_of(const json& object) {
  const auto name = object.value("name", json());
  return name.is_string() ? name.get<std::string>() : std::string();
}

/// Numbers of a list of that length, nothing for anything else.
std::optional<std::vector<double>> numbers_of(const json& object, const char* key,
                                              std::size_t length) {
  const auto list = object.value(key, json());
  if (!list.is_array() || list.size() != length) return std::nullopt;
  std::vector<double> numbers;
  for (const auto& entry : list) {
    if (!entry.is_number()) return std::nullopt;
    numbers.push_back(entry.get<double>());
  }
  return numbers;
}

double number_of(const json& object, const char* key, double otherwise) {
  const auto number = object.value(key, json());
  return number.is_number() ? number.get<double>() : otherwise;
}

/// A unit quaternion (x, y, z, w) as axes, whatever rounding has made of its length; nothing for
/// one of another length, which is no rotation.
std::optional<Affine> rotation(const std::array<double, 4>& q) {
  constexpr double rounding = 0.04;  // of bytes, of which instances may be, also cut off
  const auto [x, y, z, w] = q;
  const double length2 = x * x + y * y + z * z + w * w;
  if (!(std::abs(length2 - 1) <= rounding)) return {};
  const double s = 2 / length2;
  return Affine{{Vec3{1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
                 Vec3{s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)},
                 Vec3{s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)}},
                {}};
}

Affine scaling(Vec3 s) { return {{Vec3{s.x, 0, 0}, Vec3{0, s.y, 0}, Vec3{0, 0, s.z}}, {}}; }

constexpr const char* no_rotation = "a rotation is a quaternion of length 1 (glTF 2.0, 5.25)";
constexpr const char* instancing = "EXT_mesh_gpu_instancing";

class GltfReader {
 public:
  GltfReader(const std::string& path, const SceneFileRules& rules)
      : file_(path), faces_(path, rules, 'y'), stem_(std::filesystem::path(path).stem().string()) {}

  PolygonModel read() {
    refuse_unknown_extensions();
    const auto nodes = file_.root().value("nodes", json());
    most_visits_ = std::max(fewest_visits, most_visits_per_node * nodes.size());
    for (const auto& root : roots()) visit(root, {}, {}, 0);
    PolygonModel model = faces_.finish();
    model.files = file_.buffer_files();
    return model;
  }

 private:
  void refuse_unknown_extensions() {
    const auto required = file_.root().value("extensionsRequired", json());
    if (!required.is_array()) return;
    for (const auto& name : required) {
      const auto text = name.is_string() ? name.get<std::string>() : std::string();
      // Those of materials change nothing but looks.
      const bool is_fine = text.starts_with("KHR_materials_") || text == "KHR_texture_transform" ||
                           text == "KHR_mesh_quantization" || text == "KHR_lights_punctual" ||
                           text == "KHR_texture_basisu" || text == "EXT_texture_webp" ||
                           text == instancing;
      if (!is_fine)
        file_.fail("requires the extension " + text, "it is not read",
                   "export the model without it, for example uncompressed");
    }
  }

  /// Of the file's scene, or all nodes that are nobody's children.
  std::vector<json> roots() {
    const auto& all = file_.root();
    const auto scenes = all.value("scenes", json());
    if (scenes.is_array() && !scenes.empty()) {
      const auto& scene = file_.entry("scenes", all.value("scene", json(0u)));
      const auto nodes = scene.value("nodes", json::array());
      return nodes.is_array() ? std::vector<json>(nodes.begin(), nodes.end()) : std::vector<json>();
    }
    const auto nodes = all.value("nodes", json::array());
    std::vector<bool> is_child(nodes.size(), false);
    for (const auto& node : nodes) {
      for (const auto& child : children_of(node))
        if (child.is_number_unsigned() && child.get<std::size_t>() < is_child.size())
          is_child[child.get<std::size_t>()] = true;
    }
    std::vector<json> roots;
    for (std::size_t n = 0; n < is_child.size(); ++n)
      if (!is_child[n]) roots.emplace_back(n);
    return roots;
  }

  static std::vector<json> children_of(const json& node) {
    const auto children = node.is_object() ? node.value("children", json()) : json();
    return children.is_array() ? std::vector<json>(children.begin(), children.end())
                               : std::vector<json>();
  }

  void visit(const json& index, const Affine& file_from_parent, const std::string& outer_name,
             int depth) {
    const auto& node = file_.entry("nodes", index);
    if (depth > deepest_node || ++visits_ > most_visits_)
      file_.fail("has too many nodes within nodes", "node " + index.dump() + " may contain itself");
    const Affine file_from_node = file_from_parent * placement(node, index);
    const auto name = name_of(node).empty() ? outer_name : name_of(node);
    if (node.contains("mesh")) {
      if (node.contains("skin")) faces_.notes().count("skins ignored");
      const auto& mesh = file_.entry("meshes", node["mesh"]);
      for (const Affine& node_from_mesh : instances_of(node))
        add_mesh(mesh, file_from_node * node_from_mesh, name);
    }
    for (const auto& child : children_of(node)) visit(child, file_from_node, name, depth + 1);
  }

  /// glTF 2.0, 5.25: `matrix`, column by column, or T·R·S.
  Affine placement(const json& node, const json& index) const {
    const auto refuse = [&](const char* key, const std::string& why = {}) {
      file_.fail("node " + index.dump() + " has a broken '" + key + "'", why);
    };
    if (node.contains("matrix")) {
      const auto m = numbers_of(node, "matrix", 16);
      if (!m) refuse("matrix");
      const auto column = [&](std::size_t c) {
        return Vec3{(*m)[4 * c], (*m)[4 * c + 1], (*m)[4 * c + 2]};
      };
      return {{column(0), column(1), column(2)}, column(3)};
    }
    Affine all;
    if (node.contains("translation")) {
      const auto t = numbers_of(node, "translation", 3);
      if (!t) refuse("translation");
      all.origin = {(*t)[0], (*t)[1], (*t)[2]};
    }
    if (node.contains("rotation")) {
      const auto q = numbers_of(node, "rotation", 4);
      if (!q) refuse("rotation");
      const auto turned = rotation({(*q)[0], (*q)[1], (*q)[2], (*q)[3]});
      if (!turned) refuse("rotation", no_rotation);
      all = all * *turned;
    }
    if (node.contains("scale")) {
      const auto s = numbers_of(node, "scale", 3);
      if (!s) refuse("scale");
      all = all * scaling({(*s)[0], (*s)[1], (*s)[2]});
    }
    return all;
  }

  /// Where the mesh of a node stands in it: once, or as EXT_mesh_gpu_instancing says, each time
  /// T·R·S.
  std::vector<Affine> instances_of(const json& node) {
    const auto extensions = node.value("extensions", json());
    if (!extensions.is_object() || !extensions.contains(instancing)) return {Affine{}};
    const auto attributes = extensions[instancing].value("attributes", json::object());
    std::optional<std::size_t> count;
    std::vector<Affine> all;
    const auto take = [&](const char* key, const auto& read, const auto& placed) {
      if (!attributes.contains(key)) return;
      const auto values = read(attributes[key]);
      if (count && *count != values.size())
        file_.fail("has instances of two numbers", fmt::format("{} and {}", *count, values.size()));
      count = values.size();
      all.resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) all[i] = all[i] * placed(values[i]);
    };
    const auto points = [&](const json& accessor) { return file_.points(accessor); };
    take("TRANSLATION", points, [](Vec3 t) {
      Affine moved;
      moved.origin = t;
      return moved;
    });
    take(
        "ROTATION", [&](const json& accessor) { return file_.quaternions(accessor); },
        [&](const std::array<double, 4>& q) {
          const auto turned = rotation(q);
          if (!turned) file_.fail("has instances with a broken 'ROTATION'", no_rotation);
          return *turned;
        });
    take("SCALE", points, scaling);
    return count ? all : std::vector<Affine>{Affine{}};
  }

  void add_mesh(const json& mesh, const Affine& file_from_mesh, const std::string& node_name) {
    const auto name = !node_name.empty() ? node_name : name_of(mesh);
    faces_.use_object(object_names_(name.empty() ? stem_ : name));
    const auto primitives = mesh.value("primitives", json::array());
    for (const auto& primitive : primitives)
      if (primitive.is_object()) add_primitive(primitive, file_from_mesh);
  }

  void add_primitive(const json& primitive, const Affine& file_from_mesh) {
    constexpr unsigned triangles = 4, strip = 5, fan = 6;  // glTF 2.0, 5.24.4
    const auto mode_entry = primitive.value("mode", json(triangles));
    const auto mode = mode_entry.is_number_unsigned() ? mode_entry.get<unsigned>() : 0;
    if (mode != triangles && mode != strip && mode != fan)
      return faces_.notes().count("sets of points or lines left out");
    if (primitive.contains("targets")) faces_.notes().count("morph targets ignored");
    const auto attributes = primitive.value("attributes", json::object());
    if (!attributes.is_object() || !attributes.contains("POSITION"))
      return faces_.notes().count("meshes without positions left out");
    const auto first = add_points(file_.points(attributes["POSITION"]), file_from_mesh);
    const auto count = faces_.vertex_count() - static_cast<std::size_t>(first);
    std::vector<std::int32_t> order;
    if (primitive.contains("indices")) {
      order = file_.indices(primitive["indices"], count);
    } else {
      for (std::size_t i = 0; i < count; ++i) order.push_back(static_cast<std::int32_t>(i));
    }
    if (faces_.corner_count() + 3 * order.size() > most_corners_of(file_.bytes()))
      file_.fail("has too many faces", "shared meshes make too many for its size");
    use_material(primitive.value("material", json()));
    const bool is_mirrored = file_from_mesh.determinant() < 0;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (is_mirrored) std::swap(b, c);  // keeps the front where it was
      for (const auto corner : {a, b, c}) faces_.add_corner(first + order[corner]);
      faces_.end_face();
    };
    if (mode == triangles && order.size() % 3 != 0)
      faces_.notes().count("triangles of fewer than 3 corners left out");
    if (mode == triangles)
      for (std::size_t i = 0; i + 2 < order.size(); i += 3) add(i, i + 1, i + 2);
    if (mode == strip)
      for (std::size_t i = 0; i + 2 < order.size(); ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
    if (mode == fan)
      for (std::size_t i = 1; i + 1 < order.size(); ++i) add(i, i + 1, 0);
  }

  /// Index of the first one.
  std::int32_t add_points(const std::vector<Vec3>& points, const Affine& file_from_mesh) {
    const auto first = static_cast<std::int32_t>(faces_.vertex_count());
    if (faces_.vertex_count() + points.size() > most_corners_of(file_.bytes()))
      file_.fail("has too many vertices", "shared meshes make too many for its size");
    for (const Vec3 point : points) {
      faces_.note_single_precision(point);
      if (!faces_.add_vertex(file_from_mesh(point)))
        file_.fail("has a vertex beyond all coordinates on Earth",
                   "a coordinate is no finite number below 1e9 m", "is unit_m right?");
    }
    return first;
  }

  void use_material(const json& index) {
    if (index.is_null()) return faces_.use_material(MaterialId::none());
    const auto& material = file_.entry("materials", index);
    const auto [entry, is_new] = materials_.try_emplace(index.get<std::size_t>());
    if (is_new) {
      entry->second = faces_.add_material(read_material(material));
      if (is_transparent(material)) faces_.note_transparent(entry->second);
    }
    const auto two = material.value("doubleSided", json());
    faces_.use_material(entry->second,
                        two.is_boolean() && two.get<bool>() ? Sides::two : Sides::one);
  }

  /// The member that tells the colour of a material, and what it calls the colour and its texture.
  struct Colours {
    json members;
    const char *factor, *texture;

    std::optional<std::vector<double>> rgba() const {
      return members.is_object() ? numbers_of(members, factor, 4) : std::nullopt;
    }
  };

  static Colours colours_of(const json& material) {
    const auto extensions = material.value("extensions", json::object());
    if (const char* glossy = "KHR_materials_pbrSpecularGlossiness";
        extensions.is_object() && extensions.contains(glossy))
      return {extensions[glossy], "diffuseFactor", "diffuseTexture"};
    return {material.value("pbrMetallicRoughness", json::object()), "baseColorFactor",
            "baseColorTexture"};
  }

  /// glTF 2.0, 3.9.4, and KHR_materials_transmission; the alpha of textures is not looked at.
  static bool is_transparent(const json& material) {
    const auto extensions = material.value("extensions", json());
    const auto transmission =
        extensions.is_object() ? extensions.value("KHR_materials_transmission", json()) : json();
    if (transmission.is_object() && number_of(transmission, "transmissionFactor", 0) > 0)
      return true;
    const auto rgba = colours_of(material).rgba();
    const double alpha = rgba ? (*rgba)[3] : 1;
    constexpr double usual_cutoff = 0.5;
    const auto mode = material.value("alphaMode", json());
    return (mode == "BLEND" && alpha < 1) ||
           (mode == "MASK" && alpha < number_of(material, "alphaCutoff", usual_cutoff));
  }

  FileMaterial read_material(const json& material) {
    FileMaterial read;
    read.name = material_names_(name_of(material).empty() ? "material" : name_of(material));
    const auto colours = colours_of(material);
    if (colours.members.is_object() && colours.members.contains(colours.texture)) {
      faces_.notes().count("materials are coloured by a texture: their reflectance is the study's");
    } else if (const auto rgba = colours.rgba()) {
      if (!read.set_diffuse({(*rgba)[0], (*rgba)[1], (*rgba)[2]}))
        faces_.notes().count("colours outside [0, 1] ignored");
    }
    const auto emissive =
        numbers_of(material, "emissiveFactor", 3).value_or(std::vector<double>(3));
    read.glows = *std::max_element(emissive.begin(), emissive.end()) > 0;
    return read;
  }

  GltfFile file_;
  IndexedFaces faces_;
  std::string stem_;
  UniqueNames object_names_, material_names_;
  std::map<std::size_t, MaterialId> materials_;
  std::size_t visits_ = 0, most_visits_ = 0;
};

}  // namespace

PolygonModel read_scene_gltf(const std::string& path, const SceneFileRules& rules) {
  try {
    return GltfReader(path, rules).read();
  } catch (const json::exception& error) {
    throw InputError({path}, "contradicts the glTF format", error.what());
  }
}

}  // namespace sunload
