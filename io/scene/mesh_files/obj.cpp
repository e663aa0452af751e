// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/mesh_files/obj.h"

#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "io/scene/base/from_file.h"
#include "io/scene/base/transparent_materials.h"
#include "io/scene/base/words.h"
#include "io/scene/mesh_files/mtl.h"

namespace sunload {

namespace {

/// Statements of the format that carry no surface, and what the notes call them.
const std::unordered_map<std::string_view, const char*>& ignored_statements() {
  static constexpr const char* shapes = "statements of lines, points or free-form shapes ignored";
  static constexpr const char* looks = "";  // normals, texture coordinates, smoothing: no note
  static const std::unordered_map<std::string_view, const char*> table{
      {"vt", looks},       {"vn", looks},       {"s", looks},          {"mg", looks},
      {"bevel", looks},    {"lod", looks},      {"usemap", looks},     {"maplib", looks},
      {"c_interp", looks}, {"d_interp", looks}, {"shadow_obj", looks}, {"trace_obj", looks},
      {"l", shapes},       {"p", shapes},       {"curv", shapes},      {"curv2", shapes},
      {"surf", shapes},    {"vp", shapes},      {"cstype", shapes},    {"deg", shapes},
      {"bmat", shapes},    {"step", shapes},    {"parm", shapes},      {"trim", shapes},
      {"hole", shapes},    {"scrv", shapes},    {"sp", shapes},        {"end", shapes},
      {"con", shapes},     {"ctech", shapes},   {"stech", shapes},     {"call", shapes},
      {"csh", shapes}};
  return table;
}

class ObjReader {
 public:
  ObjReader(const std::string& path, const SceneFileRules& rules)
      : path_(path),
        text_(read_text_file(path)),
        words_(text_),
        scene_from_file_(rules, 'z', path) {
    model_.source = path;
    use_object(std::filesystem::path(path).stem().string());
  }

  PolygonModel read() {
    if (const auto zero = text_.find('\0'); zero != text_.npos) {
      fail(zero, "is no OBJ text", "it has a zero byte here");
    }
    for (; !words_.at_end(); words_.go_to_next_line()) {
      if (const auto keyword = words_.next(); !keyword.empty()) read_statement(keyword);
    }
    check_indices();
    keep_what_is_used();
    resolve_materials();
    put_notes(notes_, model_);
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(std::size_t byte, const std::string& what, const std::string& why = {},
                         const std::string& hint = {}) const {
    throw InputError(place_in_text(path_, text_, byte), what, why, hint);
  }
  [[noreturn]] void fail(std::string_view word, const std::string& what,
                         const std::string& why = {}, const std::string& hint = {}) const {
    fail(words_.byte_of(word), what, why, hint);
  }

  void read_statement(std::string_view keyword) {
    if (keyword == "v") return read_vertex();
    if (keyword == "f" || keyword == "fo") return read_face();
    if (keyword == "o") return read_object();
    if (keyword == "g") return read_group();
    if (keyword == "usemtl") return use_material(std::string(words_.rest()));
    if (keyword == "mtllib") return read_libraries();
    const auto found = ignored_statements().find(keyword);
    if (found == ignored_statements().end()) {
      notes_.count("statements of unknown kind ignored");
      if (model_.facts.empty() && vertices_.empty()) {
        fail(keyword, "unknown statement '" + shortened(keyword) + "'",
             "no vertex came before it, so that this is hardly an OBJ file");
      }
    } else if (*found->second != '\0') {
      notes_.count(found->second);
    }
  }

  void read_vertex() {
    std::array<double, 3> xyz{};
    for (auto& coordinate : xyz) {
      const auto word = words_.next();
      if (word.empty()) fail(word, "vertex of fewer than 3 coordinates", "is the file cut off?");
      coordinate = number(word);
    }
    const Vec3 position = scene_from_file_({xyz[0], xyz[1], xyz[2]});
    if (!is_usable(position)) {
      fail(words_.byte_of({}), "vertex beyond all coordinates on Earth",
           "no map projection reaches 1e9 m", "is unit_m right?");
    }
    vertices_.push_back(position);
  }

  double number(std::string_view word) const {
    const auto value = finite_number(word);
    if (!value)
      fail(word, "'" + shortened(word) + "' is no finite number", "a coordinate was expected");
    return *value;
  }

  void read_face() {
    std::size_t count = 0;
    for (auto word = words_.next(); !word.empty(); word = words_.next(), ++count) {
      model_.ring_vertex.push_back(vertex_index(word));
    }
    if (count < 3) {
      fail(std::string_view{}, "face of " + std::to_string(count) + " vertices",
           "a face has at least 3", "is the file cut off?");
    }
    model_.ring_begin.push_back(static_cast<std::int64_t>(model_.ring_vertex.size()));
    model_.polygon_ring.push_back(static_cast<std::int64_t>(model_.ring_begin.size()) - 1);
    model_.facts.push_back({.object = face_object(), .material = material_});
  }

  /// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or, negative, from the last.
  std::int32_t vertex_index(std::string_view word) {
    const auto digits = word.substr(0, word.find('/'));
    std::int32_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc() || end != digits.data() + digits.size() || digits.empty()) {
      fail(word, "'" + shortened(word) + "' is no vertex of a face", "an index was expected");
    }
    const auto known = static_cast<std::int32_t>(vertices_.size());
    if (index == 0 || index < -known) out_of_range(words_.byte_of(word), index);
    // A face may come before its vertices: only the end of the file tells.
    if (index > highest_index_) {
      highest_index_ = index;
      highest_index_byte_ = words_.byte_of(word);
    }
    return index > 0 ? index - 1 : known + index;
  }

  [[noreturn]] void out_of_range(std::size_t byte, std::int32_t index) const {
    fail(byte, "vertex index " + std::to_string(index) + " is out of range",
         std::to_string(vertices_.size()) + " vertices were read, counted from 1",
         "is the file cut off?");
  }

  void check_indices() const {
    if (highest_index_ > static_cast<std::int32_t>(vertices_.size())) {
      out_of_range(highest_index_byte_, highest_index_);
    }
  }

  /// Vertices that no face uses would only blow up the bounding box.
  void keep_what_is_used() {
    std::vector<std::int32_t> place(vertices_.size(), -1);
    for (auto& vertex : model_.ring_vertex) {
      auto& target = place[static_cast<std::size_t>(vertex)];
      if (target < 0) {
        target = static_cast<std::int32_t>(model_.vertices.size());
        model_.vertices.push_back(vertices_[static_cast<std::size_t>(vertex)]);
      }
      vertex = target;
    }
    const auto unused = vertices_.size() - model_.vertices.size();
    if (unused > 0) notes_.count("vertices used by no face left out", unused);
  }

  void read_object() {
    has_object_name_ = true;
    use_object(std::string(words_.rest()));
  }
  void read_group() {
    if (!has_object_name_) use_object(std::string(words_.rest()));
  }
  void use_object(std::string name) {
    if (name.empty()) name = std::filesystem::path(path_).stem().string();
    object_name_ = std::move(name);
    object_ = ObjectId::none();
  }
  /// Objects enter the table with their first face.
  ObjectId face_object() {
    if (!object_.exists()) {
      const auto [entry, is_new] =
          objects_.try_emplace(object_name_, make_id<ObjectId>(model_.object_names.size()));
      if (is_new) {
        model_.object_names.push_back(object_name_);
        model_.object_kinds.emplace_back();
      }
      object_ = entry->second;
    }
    return object_;
  }

  void use_material(const std::string& name) {
    if (name.empty()) {
      material_ = MaterialId::none();
      return;
    }
    const auto [entry, is_new] =
        materials_.try_emplace(name, make_id<MaterialId>(model_.materials.size()));
    if (is_new) model_.materials.emplace_back().name = name;
    material_ = entry->second;
  }

  void read_libraries() {
    const auto line = words_.rest();
    if (read_library(line)) return;  // one name, which may hold blanks
    Words names(line);
    bool all = true;
    for (auto name = names.next(); !name.empty(); name = names.next()) {
      all = read_library(name) && all;
    }
    if (!all) notes_.say("material library '" + shortened(line) + "' is not there");
  }

  /// False where there is no such file.
  bool read_library(std::string_view name) {
    const auto file = std::filesystem::path(path_).parent_path() / name;
    std::error_code no_matter;
    if (name.empty() || !std::filesystem::is_regular_file(file, no_matter)) return false;
    library_.merge(read_material_library(file.string(), notes_));
    model_.files.push_back(file.string());
    return true;
  }

  /// At the end, since a library may come after its use.
  void resolve_materials() {
    TransparentMaterials transparent;
    for (std::size_t m = 0; m < model_.materials.size(); ++m) {
      auto& material = model_.materials[m];
      if (const auto found = library_.find(material.name); found != library_.end()) {
        material = found->second.material;
        if (found->second.is_transparent) transparent.add(make_id<MaterialId>(m));
      } else {
        notes_.count("materials without a definition have a name only");
      }
    }
    transparent.count_used(model_, notes_);
  }

  std::string path_;
  std::string text_;
  Words words_;
  SceneFromFile scene_from_file_;
  PolygonModel model_;
  NoteCounter notes_;
  std::vector<Vec3> vertices_;
  std::int32_t highest_index_ = 0;
  std::size_t highest_index_byte_ = 0;
  std::unordered_map<std::string, ObjectId> objects_;
  std::unordered_map<std::string, MaterialId> materials_;
  std::string object_name_;
  std::map<std::string, LibraryMaterial> library_;
  ObjectId object_;
  bool has_object_name_ = false;
  MaterialId material_;
};

}  // namespace

PolygonModel read_scene_obj(const std::string& path, const SceneFileRules& rules) {
  return ObjReader(path, rules).read();
}

}  // namespace sunload
